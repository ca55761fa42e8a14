// SPDX-License-Identifier: BSD-3-Clause
#include "Camera.h"

#include <gtest/gtest.h>

using nephoscope::Camera;
using nephoscope::cross;
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

TEST(Camera, CylinderInvertsRaysAllRound)
{
  expectRoundTrip(Camera::cylindrical({ 3, -4, 5 }, { 0, 1, 2 }, { 0, 0, 1 }, 180, 30, 20));
  expectRoundTrip(Camera::cylindrical({ 3, -4, 5 }, { 0, 1, 9 }, { 1, 2, 3 }, 360, 30, 20));
  expectRoundTrip(Camera::cylindrical({ 0, 0, 0 }, { 0, 0, 7 }, { 0, 0, 2 }, 90, 30, 20));
  expectRoundTrip(Camera::cylindrical({ 1, 2, 3 }, { 1, 2, 3 }, { 0, 0, 0 }, 90, 30, 20));
}

TEST(Camera, CylinderIsEvenInAzimuthAndInSlope)
{
  // Looks along +y and upward by a slope of 1/2; z is the axis.
  const Camera camera = Camera::cylindrical({ 0, 0, 2 }, { 0, 10, 7 }, { 0, 0, 1 }, 180, 180, 100);
  const double degree = std::acos(-1.0) / 180;
  for (double x : { 0.0, 37.0, 90.0, 180.0 })
  {
    for (double y : { 0.0, 50.0, 99.5 })
    {
      const Vector3 d = camera.ray(x, y).direction;
      EXPECT_NEAR(std::atan2(d[0], d[1]), (x - 90) * degree, 1e-12);
      EXPECT_NEAR(d[2] / std::hypot(d[0], d[1]), 0.5 + (y - 50) * degree, 1e-12);
    }
  }
  EXPECT_NEAR(camera.ray(0, 50).direction[0], -std::sqrt(0.8), 1e-12); // left is at 90 degrees
  EXPECT_NEAR(camera.project({ 3, 4, 2 }).depth, 5, 1e-12);
  EXPECT_TRUE(camera.isCylindrical());
  EXPECT_FALSE(camera.isParallel());
}

TEST(Camera, ColumnsOfACylinderArePlanesThroughItsAxis)
{
  const Camera camera = Camera::cylindrical({ 1, 2, 3 }, { 5, 9, 4 }, { 1, 1, 4 }, 140, 33, 21);
  const Vector3 low = camera.ray(4.5, 0).direction;
  for (double y : { 3.0, 11.0, 21.0 })
  {
    EXPECT_NEAR(dot(cross(low, camera.ray(4.5, y).direction), camera.up()), 0, 1e-14);
  }
}

TEST(Camera, CylinderHasItsSeamBehindTheEye)
{
  const Camera camera = Camera::cylindrical({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, 360, 72, 40);
  EXPECT_NEAR(camera.project({ 1e-9, -1, 0 }).x, 72, 1e-6);
  EXPECT_NEAR(camera.project({ -1e-9, -1, 0 }).x, 0, 1e-6);
  const Vector3 first = camera.ray(0, 20).direction;
  const Vector3 last = camera.ray(72, 20).direction;
  EXPECT_NEAR(length(first - last), 0, 1e-14);
}
