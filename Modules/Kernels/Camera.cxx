// SPDX-License-Identifier: BSD-3-Clause
#include "Camera.h"

#include <algorithm>

namespace nephoscope
{
namespace
{
constexpr double Degree = 0.0174532925199432958;
}

Camera::Camera(const Vector3& eye, const Vector3& target, const Vector3& up, int width, int height)
  : Eye(eye)
  , HalfWidth(0.5 * width)
  , HalfHeight(0.5 * height)
  , Width(width)
  , Height(height)
{
  const Vector3 axis = target - eye;
  this->Forward = dot(axis, axis) > 0 ? normalized(axis) : Vector3{ 0, 0, -1 };
  Vector3 right = cross(this->Forward, up);
  if (!(length(right) > 1e-12 * length(up)))
  {
    // No upward direction is given: take the axis that is most across.
    const Vector3& f = this->Forward;
    const bool steep = std::abs(f[2]) > std::max(std::abs(f[0]), std::abs(f[1]));
    right = cross(f, steep ? Vector3{ 0, 1, 0 } : Vector3{ 0, 0, 1 });
  }
  this->Right = normalized(right);
  this->Up = cross(this->Right, this->Forward);
}

Camera Camera::perspective(const Vector3& eye, const Vector3& target, const Vector3& up,
  double viewAngle, int width, int height)
{
  Camera camera(eye, target, up, width, height);
  camera.Pixel = std::tan(viewAngle * Degree / 2) / camera.HalfHeight;
  return camera;
}

Camera Camera::parallel(const Vector3& eye, const Vector3& target, const Vector3& up,
  double halfHeight, int width, int height)
{
  Camera camera(eye, target, up, width, height);
  camera.Pixel = halfHeight / camera.HalfHeight;
  camera.Parallel = true;
  return camera;
}

Camera Camera::cylindrical(const Vector3& eye, const Vector3& target, const Vector3& up,
  double angleAcross, int width, int height)
{
  const Vector3 axis = length(up) > 0 ? normalized(up) : Vector3{ 0, 0, 1 };
  const Vector3 toTarget = target - eye;
  const double along = dot(toTarget, axis);
  const Vector3 across = toTarget - along * axis;
  const double radius = length(across);
  const bool seen = radius > 1e-12 * length(toTarget);
  // Right and up as for a level look; a target on the axis has no azimuth, and one across the axis is taken.
  const bool steep = std::abs(axis[1]) > 0.9;
  const Vector3 other = cross(axis, steep ? Vector3{ 1, 0, 0 } : Vector3{ 0, 1, 0 });
  Camera camera(eye, eye + (seen ? across : cross(other, axis)), axis, width, height);
  camera.Pixel = angleAcross * Degree / width;
  camera.Slope = seen ? along / radius : 0;
  camera.Cylindrical = true;
  return camera;
}
}
