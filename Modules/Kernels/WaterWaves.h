// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file WaterWaves.h
 * @brief Wind waves as a sum of sines, seen as finely as a pixel can.
 *
 * The surface is sum A_i sin(k_i . x - w_i t + p_i), of deep-water waves, w^2 = g k. Wavelengths fall geometrically from the longest
 * to the shortest, each with the same mean square slope, together that which Cox and Munk measured under a wind of U m/s,
 *
 *     mean square slope = 0.003 + 0.00512 U        (0 in a calm, U = 0)
 *
 * and directions lie about the wind's as cos^2 spreads them. A pixel sees slopes through a Gaussian filter whose standard deviation
 * is 3/4 of its footprint, which is long where the water is seen aslant: of each wave's slope there is left
 *
 *     w = exp(-9/32 ((k . a)^2 + (k . b)^2))       a, b the footprint's length and width
 *
 * and the rest of its variance, (1 - w^2) A^2 k k^T / 2, is roughness: nothing is lost, and of a wave of two pixels 6 % are seen (Max 1981 and
 * 1986 clamp such waves to zero).
 *
 * @sa vtkCloudWater, Fresnel.h, TestWaterWaves.cxx
 */
#ifndef WaterWaves_h
#define WaterWaves_h

#include "Vector3.h"

#include <cstdint>
#include <vector>

namespace nephoscope
{
/// Slopes dz/dx, dz/dy of water in a pixel: normally distributed.
struct WaterSlopes
{
  double x = 0; ///< mean
  double y = 0;
  double xx = 0; ///< covariance
  double xy = 0;
  double yy = 0;

  /// Probability density of a slope; the covariance has to be positive definite.
  double density(double slopeX, double slopeY) const;
};

struct WaterWavesParameters
{
  double windSpeed = 5;    ///< U, m/s, >= 0
  Vector3 wind{ 1, 0, 0 }; ///< where it blows to; z does not count
  double longest = 40;     ///< wavelength, m, > 0
  double shortest = 0.2;   ///< wavelength, m, > 0
  int number = 72;         ///< of waves, >= 1
  double time = 0;         ///< t, s
  double period =
    0; ///< s; if > 0 each w is rounded so that the sea repeats after it. Waves slower than that stand still.
  std::uint32_t seed = 1;
};

class WaterWaves
{
public:
  explicit WaterWaves(const WaterWavesParameters& parameters = {});

  /**
   * The slopes in a footprint about (x, y).
   * @param along, across horizontal vectors: length and width of the footprint, m
   */
  WaterSlopes slopes(double x, double y, const Vector3& along, const Vector3& across) const;

  /// Height of the surface itself, m.
  double height(double x, double y) const;

private:
  /// Some waves side by side, worked at together; what is left over has no amplitude.
  struct Group
  {
    static constexpr int Size = 4;
    double kx[Size]; // rad/m
    double ky[Size];
    double amplitude[Size]; // m
    double phase[Size];     // rad
  };
  std::vector<Group> Groups;
};
}
#endif
