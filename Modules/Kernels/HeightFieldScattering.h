// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file HeightFieldScattering.h
 * @brief Sunlight scattered once in clouds between two height functions, along the rays of a vertical slice (Max 1986 section 3).
 *
 * A slice is the vertical plane through the eye along a horizontal unit direction; r is the horizontal distance from the eye. A
 * ray of slope s is at height z(r) = z_eye + s r, zeta = z - H over the cloud plane, and gamma = sqrt(1 + s^2) is its length per r.
 * (Max has planes x = alpha y and rays (alpha y, y, beta y): there r = y sqrt(1 + alpha^2), s = beta / sqrt(1 + alpha^2).) The sun
 * is overhead, the cloud uniform. Where the ray is in the cloud from rL to rR it gains
 *
 *     I = int_rL^rR rhoB gamma exp(-rhoA (g(r) - zeta(r)) - rhoB gamma (r - rL)) dr
 *     J <- J + T I,   T <- T exp(-rhoC gamma (rR - rL))
 *
 * segment after segment, front to back, J = 0 and T = 1 at the eye. J is in units of the sun's irradiance times albedo times phase
 * function. rhoA attenuates the sunlight, rhoB what is scattered on its way to the eye, rhoC what lies behind. Max does not say
 * which density scatters; rhoB does here, so that a thick cloud in full light has J = 1.
 *
 * Methods, by name:
 *   Exact     adaptive Gauss-Kronrod quadrature, split at kinks and where light fades, with an error estimate
 *   March     midpoints of equal steps along the ray: what everyone has
 *   Sexp1986  Max's quadratic for the exponentials and running sums of moments, misprints corrected (delta, d and e; T with the
 *             true rR); y_R and g limited as he says. Wrong by 16 % at optical depth 1 and 86 % at 16. With
 *             fitted factors and gain less so.
 *   Moments   tables of the moments of exp(-rhoA g) and orthogonal polynomials for what depends on the ray; the default. Errs by less
 *             than 0.1 % in the median and 1 % at the 95th percentile where samples are as dense as ScatteringSettings asks for; in
 *             pictures reaching 50 km, whose far samples are up to 1.4 pixels apart, by up to 0.1 % and 1.3 %.
 *
 * Errors     none thrown but by make() for a name it does not know. A slice that is not finite is empty.
 * Limits     densities are brought to [0, 1e9] 1/m, slopes to +-1e7. Methods that sample (all but Exact) take a ray that leaves the
 *            cloud and enters it again between two samples as inside all the while, and may miss one that is in the cloud between
 *            two samples only: fewer than 1 % of rays and 5e-5 of the light, in clouds of many waves.
 * @sa HeightField.h, TestHeightFieldScattering.cxx
 */
#ifndef HeightFieldScattering_h
#define HeightFieldScattering_h

#include "HeightField.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace nephoscope
{
/// Extinctions, 1/m. Max's figures used these.
struct ScatteringDensities
{
  double sun = 0.0093;    ///< rhoA: from the sun to the scatterer
  double view = 0.0163;   ///< rhoB: from the scatterer to the eye; scatters
  double behind = 0.0198; ///< rhoC: what lies behind

  /// One density for all, as physics has it.
  static ScatteringDensities physical(double extinctionPerMeter)
  {
    return { extinctionPerMeter, extinctionPerMeter, extinctionPerMeter };
  }
};

/// A vertical half plane from the eye.
struct CloudSlice
{
  double x = 0; ///< eye, m
  double y = 0;
  double z = 0;
  double ux = 0; ///< horizontal unit direction
  double uy = 1;
  double far = 50000; ///< horizontal distance where clouds end, m
  /// A pixel's width per r: waves that pixels cannot show fade (waveLeft() in HeightField.h), for all methods. Samples are
  /// 0.7 to 1.4 pixels apart, unless the field asks for more. 0 for neither.
  double growth = 0;
};

/// A stretch of a ray in the cloud.
struct HeightFieldSegment
{
  std::uint32_t ray;   ///< index of its slope
  double nearEnd;      ///< horizontal distance, m
  double farEnd;       ///< m
  double light;        ///< I, before what lies in front attenuates it
  double opticalDepth; ///< rhoC gamma (farEnd - nearEnd)
};

struct RayLight
{
  double light = 0;         ///< J
  double transmittance = 1; ///< T
  double error = 0;         ///< estimate of J's error: Exact only, else 0
};

/// What a slice's rays gain, and how far the conditions of Max 1986 section 4 were from holding: each asks for at most 2.
struct SliceLight
{
  std::vector<RayLight> rays;               ///< as the slopes
  std::vector<HeightFieldSegment> segments; ///< those of one ray from front to back
  double largestViewArgument = 0;           ///< of delta (rR - rL)
  double largestSunArgument = 0;            ///< of rhoA g where the method looked
  std::size_t pieces =
    0; ///< March, Moments: stretches of rays evaluated one by one, what rays cost over the samples
};

struct ScatteringSettings
{
  double step = 5;            ///< March: along the ray, m
  double samplesPerWave = 12; ///< Sexp1986, Moments: of the shortest wave
  double pieceDepth = 1.5;    ///< Moments: delta times the length of the first piece of a segment
  double tolerance = 1e-10;   ///< Exact: of each part of a segment, relative
  double sunFactor =
    1; ///< Sexp1986: on rhoA in the exponentials' stand-ins, >= 0; fitted, see FitHeightField.h
  double viewFactor = 1; ///< Sexp1986: on rhoB there, but not where it scatters
  double gain = 1;       ///< Sexp1986: on I
};

/// Beyond this optical depth along the ray less than 2e-8 of the sunlight is left to see.
inline constexpr double OpaqueViewDepth = 18;

/**
 * One method at work. Keeps scratch memory: one object per thread.
 */
class HeightFieldScattering
{
public:
  /// The methods' names.
  static const std::vector<std::string>& names();
  /// @throws std::invalid_argument for a name that is none, with the list of them.
  static std::unique_ptr<HeightFieldScattering> make(const std::string& name,
    const HeightField& field, double planeHeight, const ScatteringDensities& densities,
    const ScatteringSettings& settings = {});

  /// The methods' own; make() is for all others.
  HeightFieldScattering(const HeightField& field, double planeHeight,
    const ScatteringDensities& densities, const ScatteringSettings& settings);
  virtual ~HeightFieldScattering() = default;

  /**
   * The light of a slice's rays.
   * @param slopes ascending; NaN is taken as the steepest
   * @param ends horizontal distances where rays end at something opaque, as slopes, or none
   * @param light overwritten
   * Cost: that of the samples of the slice, plus a bounded one per segment (Sexp1986, Moments); of each ray's length (March,
   * Exact).
   */
  void shine(const CloudSlice& slice, const std::vector<double>& slopes, SliceLight& light,
    const std::vector<double>& ends = {});

  /// I of a part of a segment that was found, by quadrature upon the field itself; ends are those of the stretch, m.
  double part(const CloudSlice& slice, double slope, double nearEnd, double farEnd) const;

protected:
  /// Slopes are in range and ascending, the slice is finite.
  virtual void run(const CloudSlice& slice) = 0;

  /// Add a segment of a ray; false once nothing can be seen behind.
  bool add(std::uint32_t ray, double nearEnd, double farEnd, double light, double error = 0);
  double endOf(std::uint32_t ray) const
  {
    return this->Ends.empty() ? std::numeric_limits<double>::infinity() : this->Ends[ray];
  }

  /// F at a distance, as a pixel sees it.
  double valueAt(const CloudSlice& slice, double r) const
  {
    return this->Field.value(slice.x + r * slice.ux, slice.y + r * slice.uy, slice.growth * r);
  }

  /// A thousandth of an optical depth, m.
  double resolution() const
  {
    return 1e-3 / std::max({ this->Densities.sun, this->Densities.view, 1e-300 });
  }

  HeightField Field;
  double PlaneHeight;
  ScatteringDensities Densities;
  ScatteringSettings Settings;
  std::vector<double> Slopes;
  std::vector<double> Ends;
  SliceLight* Light = nullptr;
};
}
#endif
