// SPDX-License-Identifier: BSD-3-Clause
#include "Camera.h"

#include <gtest/gtest.h>

using nephoscope::Camera;
using nephoscope::dot;
using nephoscope::length;
using nephoscope::Projected;
using nephoscope::Ray;
using nephoscope::Vector3;

namespace
{
void expectRoundTrip(const Camera& camera)
{
  for (double x : { 0.5, 7.0, 29.5 })
  {
    for (double y : { 0.5, 3.25, 19.5 })
    {
      const Ray ray = camera.ray(x, y);
      EXPECT_NEAR(length(ray.direction), 1, 1e-15);
      const Projected seen = camera.project(ray.origin + 5.0 * ray.direction);
      EXPECT_NEAR(seen.x, x, 1e-11);
      EXPECT_NEAR(seen.y, y, 1e-11);
      EXPECT_GT(seen.depth, 0);
    }
  }
}
}

TEST(Camera, ProjectionInvertsRays)
{
  expectRoundTrip(Camera::perspective({ 3, -4, 5 }, { 0, 1, 2 }, { 0, 0, 1 }, 35, 30, 20));
  expectRoundTrip(Camera::parallel({ 3, -4, 5 }, { 0, 1, 2 }, { 0, 0, 1 }, 2.5, 30, 20));
}

TEST(Camera, CentreLooksAlongTheAxisAndRightIsRight)
{
  // From -y with z up: x grows to the right.
  const Camera camera = Camera::perspective({ 0, -10, 0 }, { 0, 0, 0 }, { 0, 0, 1 }, 90, 40, 20);
  const Vector3 centre = camera.ray(20, 10).direction;
  EXPECT_NEAR(centre[1], 1, 1e-15);
  const Projected right = camera.project({ 1, 0, 0 });
  EXPECT_NEAR(right.x, 20 + 1.0 / 10 * 10, 1e-12); // tan 45 degrees at 10 pixels
  const Projected above = camera.project({ 0, 0, 1 });
  EXPECT_NEAR(above.y, 11, 1e-12);
}

TEST(Camera, ViewAngleIsVertical)
{
  const Camera camera = Camera::perspective({ 0, 0, 0 }, { 0, 0, -1 }, { 0, 1, 0 }, 30, 64, 48);
  const double cosine = dot(camera.ray(32, 0).direction, camera.ray(32, 48).direction);
  EXPECT_NEAR(std::acos(cosine) * 180 / 3.14159265358979, 30, 1e-10);
  EXPECT_NEAR(camera.footprint(7), 7 * camera.pixel(), 0);
}

TEST(Camera, UpAlongTheAxisIsReplaced)
{
  for (const Vector3& axis : { Vector3{ 0, 0, 1 }, Vector3{ 0, 1, 0 }, Vector3{ 1, 0, 0 } })
  {
    expectRoundTrip(Camera::perspective({ 0, 0, 0 }, axis, axis, 40, 30, 20));
  }
  expectRoundTrip(Camera::perspective({ 1, 2, 3 }, { 1, 2, 3 }, { 0, 0, 0 }, 40, 30, 20));
}
