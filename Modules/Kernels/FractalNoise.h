// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file FractalNoise.h
 * @brief Gradient noise of the plane with its derivatives, sums of its octaves, and hills made of them.
 *
 * Noise: at each point of the integer lattice a unit gradient that a hash of the point and of the seed chooses; between them the
 * gradients' ramps are mixed with Perlin's weight 6 t^5 - 15 t^4 + 10 t^3, so that second derivatives are continuous. It is 0
 * at lattice points and within -1 to 1.
 *
 * The same seed gives the same bits on every machine with IEEE 754 arithmetic. Thread-safe.
 * @sa vtkCloudTerrainSource, vtkCloudTerrain, TestFractalNoise.cxx
 */
#ifndef FractalNoise_h
#define FractalNoise_h

#include <cstddef>
#include <cstdint>

namespace nephoscope
{
/// A value and its derivatives along x and y.
struct Noise
{
  double value;
  double dx;
  double dy;
};

/// Noise of lattice width 1. Precondition: |x|, |y| < 2^31.
Noise gradientNoise(double x, double y, std::uint32_t seed);

/**
 * A sum of octaves: waves of `wavelength` (the width of two lattice cells), each next half as long with `gain` times the
 * amplitude, the first's is 1. An octave is whole where its wavelength is at least 4 footprints, gone at 2.
 * The derivatives are those of the sum.
 */
struct NoiseOctaves
{
  double wavelength = 1; ///< scene units, > 0
  int octaves = 6;
  double gain = 0.5;
  std::uint32_t seed = 1;

  Noise operator()(double x, double y, double footprint = 0) const;
  /// The same without derivatives, in less time.
  double value(double x, double y, double footprint = 0) const;

private:
  template <class Add>
  void forEach(double footprint, const Add& add) const;
};

/**
 * Hills: octaves of noise that are laid flatter where the ones before are steep, which wears the slopes and leaves
 * detail on ridges and in valleys,
 *
 *     height = mean + relief / 2 sum_i gain^i n_i / (1 + wear |sum_{k <= i} grad n_k|^2)
 *
 * with n_i the noise of wavelength / 2^i, each octave turned by 37 degrees so that no lattice shows.
 */
struct FractalHills
{
  double wavelength = 12000; ///< of the largest hills, m, > 0
  double relief = 1800;      ///< m; heights lie within about half of it from the mean
  double mean = 60;          ///< m; a negative one floods more land
  double gain = 0.5;         ///< 0 to 1; large is rough
  double wear = 0.25;        ///< >= 0
  int octaves = 10;
  std::uint32_t seed = 1;

  /// Heights at places (x + i spacing, y), i from 0 to count - 1, m. Precondition: they are within 2^30 wavelengths of the last octave.
  void row(double x, double y, double spacing, std::size_t count, float* heights) const;
};
}
#endif
