// SPDX-License-Identifier: BSD-3-Clause
#include "Camera.h"

#include <algorithm>

namespace nephoscope
{
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
  constexpr double HalfDegree = 0.00872664625997164788;
  camera.Pixel = std::tan(viewAngle * HalfDegree) / camera.HalfHeight;
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
}
