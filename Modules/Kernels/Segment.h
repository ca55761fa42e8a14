// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Segment.h
 * @brief The currency of the renderer: what a stretch of a viewing ray adds and what it lets through.
 *
 *     L = L_stretch + T_stretch * L_behind        T = exp(-opticalDepth)
 *
 * Max 1994 eq. 1 (cloud plane), eq. 7 (density emitter) and Max 1986 section 4 (J + T I) are all this equation.
 */
#ifndef Segment_h
#define Segment_h

#include <array>
#include <limits>
#include <vector>

namespace nephoscope
{
using RGB = std::array<float, 3>;

/// A stretch of a viewing ray. A surface has nearEnd == farEnd; an opaque one has infinite optical depth.
struct Segment
{
  double nearEnd = 0;          ///< distance along the ray, scene units
  double farEnd = 0;           ///< distance along the ray, scene units, >= nearEnd
  RGB opticalDepth{ 0, 0, 0 }; ///< per channel, >= 0, dimensionless
  RGB radiance{ 0, 0, 0 };     ///< per channel, leaving the near end, attenuated within the segment
  float skew =
    0; ///< extinction is linear: mean (1 + skew (2 x - 1)), x from 0 to 1 along it; -1 to 1
};

/// What the segments of one pixel amount to.
struct PixelLight
{
  RGB radiance{ 0, 0, 0 }; ///< sum of the segments' radiances, each attenuated by those before it
  RGB transmittance{ 1, 1, 1 }; ///< product of the segments' transmittances
  double depth = std::numeric_limits<
    double>::infinity(); ///< where the mean transmittance falls to 1/2, else infinity
};

constexpr float Opaque =
  std::numeric_limits<float>::infinity(); ///< optical depth of what hides all behind it

/**
 * @brief Composite one pixel's segments front to back.
 *
 * Segments are sorted in place by nearEnd; equal ones (surfaces at one distance) keep the order they came in.
 * Where segments overlap, they are split at each other's ends and the common stretch is mixed: of segment i it holds
 * the optical depth tau_i,part after its linear extinction, and with the source function S_i = L_i / (1 - exp(-tau_i)) that
 * is constant in it, the stretch has tau = sum tau_i,part, L = (sum S_i tau_i,part) (1 - exp(-tau)) / tau. Splitting a
 * single segment changes nothing; transmittances are exact, radiances are where the shares of the mixture are constant. Segments whose ends or optical depths are NaN, that end behind the eye
 * or are turned around (farEnd < nearEnd) are dropped; a part behind the eye (distance < 0) is cut off.
 *
 * Depth is interpolated within its segment after its linear extinction.
 *
 * @param segments all segments of the pixel, any order; sorted on return
 * @return the light that they add and let through; without segments nothing added and all let through
 * Cost: O(n log n) plus O(n m) where m segments overlap. No allocation unless more than 64 overlap.
 */
PixelLight composite(std::vector<Segment>& segments);
PixelLight composite(Segment* begin, Segment* end); ///< the same on a range

/// Where a segment's linear extinction has let a part of its optical depth pass: x (1 + skew (x - 1)) = part, all from 0 to 1. A part
/// that is rounded beyond 1 is all.
double placeOf(double part, double skew);

/// (1 - exp(-x)) / x for x >= 0, by series where that cancels; 1 at 0, 0 at infinity.
double transmittedMean(double x);
}
#endif
