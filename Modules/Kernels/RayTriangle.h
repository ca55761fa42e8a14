// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file RayTriangle.h
 * @brief Where a ray that is known to meet a triangle does so.
 */
#ifndef RayTriangle_h
#define RayTriangle_h

#include "Camera.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
/// A point of a triangle abc, (1 - b - c) A + b B + c C, and its distance along the ray.
struct TriangleHit
{
  double b = 1.0 / 3;  ///< weight of the second corner, 0..1
  double c = 1.0 / 3;  ///< weight of the third corner, 0..1, b + c <= 1
  double distance = 0; ///< along the ray, scene units
};

/**
 * @brief The intersection of a ray with the plane of a triangle, brought into the triangle if it is outside.
 *
 * Moeller and Trumbore 1997: o + t d = A + b (B - A) + c (C - A). Whether the ray meets the triangle is decided by
 * ScreenTriangle; a hit that rounding has put outside is moved in, so that attributes never leave their range. Where
 * the ray lies in the plane, the middle is taken.
 * Precondition: finite corners. Postcondition: finite, 0 <= b, c, b + c <= 1.
 */
inline TriangleHit intersect(
  const Ray& ray, const Vector3& cornerA, const Vector3& cornerB, const Vector3& cornerC)
{
  const Vector3 toB = cornerB - cornerA;
  const Vector3 toC = cornerC - cornerA;
  const Vector3 fromA = ray.origin - cornerA;
  const Vector3 p = cross(ray.direction, toC);
  const double determinant = dot(toB, p);
  TriangleHit hit;
  const double b = dot(fromA, p) / determinant;
  const double c = dot(ray.direction, cross(fromA, toB)) / determinant;
  if (std::isfinite(b) && std::isfinite(c))
  {
    hit.b = std::clamp(b, 0.0, 1.0);
    hit.c = std::clamp(c, 0.0, 1.0);
    const double sum = hit.b + hit.c;
    if (sum > 1)
    {
      hit.b /= sum;
      hit.c = 1 - hit.b;
    }
  }
  hit.distance =
    hit.b * dot(toB, ray.direction) + hit.c * dot(toC, ray.direction) - dot(fromA, ray.direction);
  return hit;
}
}
#endif
