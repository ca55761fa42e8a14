// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file HazeShafts.h
 * @brief Sunlight scattered once by haze under a cloud plane: the glow with shafts through the clouds' gaps.
 *
 * Haze of extinction tau fills the space below the cloud plane z = H. The sun's light comes through the plane dimmed by the
 * transmittance c(x, y) of the clouds where it meets it, then through haze to the scatterer and from there to the eye. With S
 * the unit direction toward the sun, a ray E + t V, and A = H - z(t0) the depth below the plane of a stretch's near end t0,
 *
 *     G = tau exp(-tau A / S_z) int_t0^t1 c(R(t)) exp(-eps (t - t0)) dt        eps = tau (1 - V_z / S_z)
 *     R(t) = R0 + t D      R0 = E + S (H - E_z) / S_z      D = V - S V_z / S_z
 *
 * times the sun's irradiance, albedo and phase function is the radiance that the stretch adds. This is Max 1986, section 5,
 * without its restriction to a sun overhead (S = (0, 0, 1) gives his integral, with V of length 1 instead of gamma), and with the
 * true exponential; c holds the whole vertical thickness g - h. A ray that goes steeper than the sun has eps < 0.
 *
 * All rays of an eye run along straight tracks from the one point R0 of the cloud plane: that is the polar raster about the sun
 * which the paper proposes, and its shafts converge at the sun. On it
 *   Moments   tabulates c's running moments int c r^k dr, k = 0, 1, 2, for `radials` directions once, from grid samples as wide as the
 *             raster there; a ray is cut in pieces of eps length at most 1/2, in each of which the exponential is the quadratic
 *             that is nearest (error below 7e-4 of it); directions between two radials are interpolated. A piece costs the
 *             same however long it is. Rays of pieces below a tenth of a sample (towards the sun; thick fog) are summed as by Exact.
 *   March     midpoints of equal steps along the ray, the plain way
 *   Exact     5-point Gauss quadrature between the grid lines that the track crosses, where c is smooth
 *
 * Stretches are cut to what lies below the plane; if the sun is not above the horizon (sine at most 1e-9) nothing is lit. Finite input gives
 * finite results.
 *
 * @sa CloudShadow.h, vtkCloudHaze, TestHazeShafts.cxx
 */
#ifndef HazeShafts_h
#define HazeShafts_h

#include "Camera.h"
#include "CloudShadow.h"

#include <array>
#include <vector>

namespace nephoscope
{
using Channels = std::array<double, 3>;

enum class HazeMethod
{
  Exact,
  March,
  Moments
};

class HazeShafts
{
public:
  /**
   * @param clouds is kept by reference
   * @param towardSun any length > 0
   * @param eye from which all rays come, for Moments
   * @param extinction tau of red, green and blue, per scene unit; below 0 and not finite are 0
   */
  HazeShafts(const CloudShadow& clouds, const Vector3& towardSun, const Vector3& eye,
    const Channels& extinction);

  /// Make the tables of Moments: `radials` directions of as many samples. Without them, or without clouds, it is Exact. Cost:
  /// radials^2 lookups, 28 bytes each.
  void tabulate(int radials);
  /// The same in parts, which threads may share: memory for the tables, then each radial once. False if there is nothing to tabulate.
  bool beginTables(int radials);
  void tabulateRadials(int first, int last);

  /// Which part of a ray from t0 to t1 lies below the cloud plane; turned around if none does.
  struct Stretch
  {
    double near;
    double far;
  };
  Stretch below(const Ray& ray, double t0, double t1) const;

  /**
   * G of a stretch, for each channel.
   * @param ray from the eye (Moments); others from anywhere
   * @param stretch as below() gives it
   * @param step March's, scene units
   */
  Channels glow(HazeMethod method, const Ray& ray, const Stretch& stretch, double step = 20) const;

private:
  /// Running moments of c along a radial: int_0^r c r^k dr, r in samples.
  struct Moments
  {
    double m[3];
  };
  /// Of a ray's track on the raster.
  struct Heading
  {
    double speed; ///< samples a scene unit
    double turn;  ///< radials round from the first, Radials / 2 to 3 / 2 Radials
  };
  Heading headingOf(const Ray& ray) const;
  struct Track;
  Track trackOf(const Ray& ray, const Stretch& stretch, double tau) const;
  double exact(const Track& track) const;
  double march(const Track& track, double step) const;
  double moments(const Track& track, const Heading& heading) const;
  double cover(const Track& track, double t) const;
  Moments momentsTo(int radial, double r) const;

  const CloudShadow& Clouds;
  Vector3 TowardSun;
  Channels Extinction;
  double R0[2];
  int Radials = 0;
  double Sample = 1;         // scene units
  std::vector<float> Covers; // c at the samples, Radials rows
  std::vector<Moments> Sums; // up to the samples
};
}
#endif
