// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file RadianceError.h
 * @brief By how much a pixel's radiance is wrong: the measure of tolerances, predictions and verifications.
 *
 *     error = max_c |L_c - E_c| / max(max_c E_c, DarkestRadiance)          c: red, green, blue; E: exact
 *
 * White in full sun has radiance 1. What is darker than a hundredth of it counts as that: a hundredth of a hundredth is a third of the
 * smallest step of an 8-bit picture.
 * @sa MethodChoice.h
 */
#ifndef RadianceError_h
#define RadianceError_h

#include <algorithm>
#include <cmath>
#include <vector>

namespace nephoscope
{
inline constexpr double DarkestRadiance = 0.01;

/// 0 where both are the same; infinite where one of them is no number.
template <class A, class B>
double radianceError(const A* radiance, const B* exact)
{
  double difference = 0;
  double largest = DarkestRadiance;
  for (int c = 0; c < 3; ++c)
  {
    const double d = std::abs(static_cast<double>(radiance[c]) - static_cast<double>(exact[c]));
    if (std::isnan(d))
    {
      return HUGE_VAL;
    }
    difference = std::max(difference, d);
    largest = std::max<double>(largest, exact[c]);
  }
  return difference / largest;
}

/**
 * No more than this can a pixel change if matter of an optical depth is left out of its ray.
 *
 * With T = exp(-depth) the ray has L = (1 - T) S + T B, without it B: |L - B| = (1 - T) |S - B|. If B is larger than S that is at most
 * (1 - T) B <= (1 / T - 1) L, else (1 - T) S <= L.
 * @param source the largest radiance S of the matter
 */
inline double errorOfLeavingOut(double depth, double source)
{
  const double covered = -std::expm1(-depth);
  return covered > 0
    ? std::max(std::expm1(depth), std::min(1.0, covered * source / DarkestRadiance))
    : 0;
}

/// The value that a share of all is at or below; 0 of none. Sorts.
inline double quantile(std::vector<double>& values, double share)
{
  if (values.empty())
  {
    return 0;
  }
  std::sort(values.begin(), values.end());
  const double rank = std::ceil(share * static_cast<double>(values.size()));
  return values[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}
}
#endif
