// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Fresnel.h
 * @brief How much unpolarised light a smooth surface of a clear substance reflects.
 */
#ifndef Fresnel_h
#define Fresnel_h

#include <cmath>

namespace nephoscope
{
/**
 * Reflectance, 0 to 1, by Fresnel's equations, the mean of both polarisations.
 * @param cosine of the angle between the ray and the normal, 0 to 1, in air
 * @param n index of refraction of the substance, >= 1; sea water has 1.34
 */
inline double fresnel(double cosine, double n)
{
  const double inside = std::sqrt(1 - (1 - cosine * cosine) / (n * n));
  const double across = (cosine - n * inside) / (cosine + n * inside);
  const double parallel = (n * cosine - inside) / (n * cosine + inside);
  return 0.5 * (across * across + parallel * parallel);
}
}
#endif
