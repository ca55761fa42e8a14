// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file DisplayTransfer.h
 * @brief Linear light to the numbers of a display: IEC 61966-2-1 (sRGB), and a shoulder that keeps highlights.
 */
#ifndef DisplayTransfer_h
#define DisplayTransfer_h

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace nephoscope
{
/// sRGB of linear light in 0..1: 12.92 x up to 0.0031308, 1.055 x^(1/2.4) - 0.055 above. Clamped; NaN is black.
inline double srgb(double linear)
{
  if (!(linear > 0))
  {
    return 0;
  }
  return linear <= 0.0031308 ? 12.92 * linear
                             : std::min(1.0, 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

/// The inverse of srgb on 0..1.
inline double linearOfSrgb(double encoded)
{
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/**
 * Light above k = 1 - s is bent so that it nears 1 and never reaches it: k + s (1 - exp(-(x - k) / s)). Value and slope
 * are continuous at k. s = 0 changes nothing.
 */
inline double shoulder(double linear, double s)
{
  const double k = 1 - s;
  return s > 0 && linear > k ? k - s * std::expm1(-(linear - k) / s) : linear;
}

/// sRGB in 0..255, to the nearest.
inline std::uint8_t srgb8(double linear)
{
  return static_cast<std::uint8_t>(std::lround(255 * srgb(linear)));
}
}
#endif
