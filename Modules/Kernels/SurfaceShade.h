// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file SurfaceShade.h
 * @brief How bright a surface in the sun is: Gardner 1985 eq. 8, with the sun's and the sky's colours.
 *
 *     I = (1 - a) { (1 - t) [ (1 - s) Id + s Is ] + t It } + a
 *
 * Id = max(0, (n . l + w) / (1 + w)) with w = 0 is Lambert's law; w > 0 lets the light creep round the body, as it does
 * in clouds. Is = max(0, r . v)^p, r the mirror image of l (Phong). The first term takes the sun's colour, the second
 * (a) the sky's: radiance = colour (sun (1 - a) {...} + sky a).
 */
#ifndef SurfaceShade_h
#define SurfaceShade_h

#include "Segment.h"
#include "Vector3.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
struct SurfaceShade
{
  Vector3 towardSun{ 0, 0, 1 }; ///< unit
  Vector3 color{ 1, 1, 1 };     ///< reflectance, linear RGB
  Vector3 sun{ 1, 1, 1 };       ///< radiance of a white surface that faces the sun, linear RGB
  Vector3 sky{ 1, 1, 1 };       ///< radiance of a white surface under the sky alone, linear RGB
  double ambient = 0;           ///< a, 0..1
  double texture = 0;           ///< t, 0..1
  double specular = 0;          ///< s, 0..1
  double specularPower = 10;    ///< p, > 0
  double wrap = 0;              ///< w, 0..1

  /**
   * Radiance, linear RGB.
   * @param normal unit, outward; @param towardEye unit; @param textureValue It, 0..1
   */
  RGB operator()(const Vector3& normal, const Vector3& towardEye, double textureValue = 0) const
  {
    const double facing = dot(normal, this->towardSun);
    const double diffuse = std::max(0.0, (facing + this->wrap) / (1 + this->wrap));
    double shine = 0;
    if (this->specular > 0 && facing > 0)
    {
      const Vector3 mirrored = 2 * facing * normal - this->towardSun;
      shine = std::pow(std::max(0.0, dot(mirrored, towardEye)), this->specularPower);
    }
    const double lit = (1 - this->ambient) *
      ((1 - this->texture) * ((1 - this->specular) * diffuse + this->specular * shine) +
        this->texture * textureValue);
    RGB radiance;
    for (int i = 0; i < 3; ++i)
    {
      radiance[i] =
        static_cast<float>(this->color[i] * (this->sun[i] * lit + this->sky[i] * this->ambient));
    }
    return radiance;
  }
};
}
#endif
