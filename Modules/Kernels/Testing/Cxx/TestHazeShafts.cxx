// SPDX-License-Identifier: BSD-3-Clause
#include "Camera.h"
#include "HazeShafts.h"

#include <gtest/gtest.h>

#include <limits>

using nephoscope::Channels;
using nephoscope::CloudShadow;
using nephoscope::GridFrame;
using nephoscope::GridPyramid;
using nephoscope::HazeMethod;
using nephoscope::HazeShafts;
using nephoscope::Ray;
using nephoscope::Vector3;

namespace
{
constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double Plane = 1000;
const Vector3 Eye{ 150, -220, 30 };
const Channels Tau{ 1e-4, 1.5e-4, 3e-4 };
const std::vector<HazeMethod> Methods{ HazeMethod::Exact, HazeMethod::March, HazeMethod::Moments };

/// A cloud plane of 12.8 km x 9.6 km about the origin.
template <class Function>
CloudShadow cloudsOf(Function function)
{
  const GridFrame frame{ -6400, -4800, 50, 50, 257, 193 };
  std::vector<float> values;
  for (int j = 0; j < frame.ny; ++j)
  {
    for (int i = 0; i < frame.nx; ++i)
    {
      values.push_back(
        static_cast<float>(function(frame.x0 + i * frame.dx, frame.y0 + j * frame.dy)));
    }
  }
  return { GridPyramid(frame, std::move(values)), Plane };
}

/// Scattered clouds: between clear and nearly dark.
double scattered(double x, double y)
{
  const double f = std::sin(x / 180 + 0.4 * std::sin(y / 300)) + std::sin(y / 220 + 1);
  return std::exp(-3 * std::max(0.0, f));
}

Ray rayOf(double x, double y, double z)
{
  return { Eye, normalized(Vector3{ x, y, z }) };
}

const std::vector<Ray> Rays{ rayOf(0.3, 1, 0.1), rayOf(-1, 0.2, 0.3), rayOf(0.1, -1, 0),
  rayOf(0.7, 0.7, 2), rayOf(-0.2, 1, -0.02), rayOf(0, 1, 0.02) };
}

TEST(HazeShafts, WithoutCloudsHasTheClosedForm)
{
  const CloudShadow open{ {}, Plane };
  const CloudShadow clear = cloudsOf([](double, double) { return 1; });
  for (const Vector3& sun : { Vector3{ 0, 0, 1 }, Vector3{ -0.5, 0.8, 0.6 }, Vector3{ 1, 0, 0.1 } })
  {
    for (const CloudShadow* clouds : { &open, &clear })
    {
      HazeShafts haze(*clouds, sun, Eye, Tau);
      haze.tabulate(128);
      for (const Ray& ray : Rays)
      {
        const HazeShafts::Stretch s = haze.below(ray, 0, 9000);
        for (HazeMethod method : Methods)
        {
          const Channels glow = haze.glow(method, ray, s, 2);
          for (int c = 0; c < 3; ++c)
          {
            const double sine = normalized(sun)[2];
            const double eps = Tau[c] * (1 - ray.direction[2] / sine);
            const double expected = Tau[c] * std::exp(-Tau[c] * (Plane - Eye[2]) / sine) *
              -std::expm1(-eps * (s.far - s.near)) / eps;
            EXPECT_NEAR(glow[c] / expected, 1, 1e-4);
          }
        }
      }
    }
  }
}

TEST(HazeShafts, UnderAClosedCoverItIsDark)
{
  const CloudShadow closed = cloudsOf([](double, double) { return 0; });
  HazeShafts haze(closed, { 0.1, 0, 1 }, Eye, Tau);
  haze.tabulate(64);
  for (const Ray& ray : Rays)
  {
    for (HazeMethod method : Methods)
    {
      const Channels glow = haze.glow(method, ray, haze.below(ray, 0, 3000));
      EXPECT_EQ(glow, (Channels{ 0, 0, 0 }));
    }
  }
}

TEST(HazeShafts, HalfACoverShinesBehindItsEdge)
{
  // Clear beyond y = 500 under a sun overhead: only that part of a level ray along +y glows.
  const CloudShadow half =
    cloudsOf([](double, double y) { return y < 475 ? 0 : (y > 525 ? 1 : 0.5); });
  HazeShafts haze(half, { 0, 0, 1 }, Eye, Tau);
  haze.tabulate(512);
  const Ray ray = rayOf(0, 1, 0);
  const Channels exact = haze.glow(HazeMethod::Exact, ray, { 0, 3000 });
  const Channels moments = haze.glow(HazeMethod::Moments, ray, { 0, 3000 });
  for (int c = 0; c < 3; ++c)
  {
    const double expected =
      std::exp(-Tau[c] * (Plane - Eye[2])) * (std::exp(-Tau[c] * 720) - std::exp(-Tau[c] * 3000));
    EXPECT_NEAR(exact[c] / expected, 1, 1e-4);
    EXPECT_NEAR(moments[c] / expected, 1, 2e-3);
  }
}

TEST(HazeShafts, MethodsConvergeToTheExactOne)
{
  const CloudShadow clouds = cloudsOf(scattered);
  for (const Vector3& sun : { Vector3{ 0, 0, 1 }, Vector3{ -0.6, 0.9, 0.7 } })
  {
    HazeShafts coarse(clouds, sun, Eye, Tau);
    HazeShafts fine(clouds, sun, Eye, Tau);
    coarse.tabulate(200);
    fine.tabulate(1600);
    double error[4] = { 0, 0, 0, 0 };
    for (double angle = 0; angle < 6.28; angle += 0.1)
    {
      const Ray ray = rayOf(std::cos(angle), std::sin(angle), 0.2 + 0.15 * std::sin(3 * angle));
      const HazeShafts::Stretch s = coarse.below(ray, 0, 6000);
      const double exact = coarse.glow(HazeMethod::Exact, ray, s)[1];
      error[0] += std::abs(coarse.glow(HazeMethod::Moments, ray, s)[1] / exact - 1) / 63;
      error[1] += std::abs(fine.glow(HazeMethod::Moments, ray, s)[1] / exact - 1) / 63;
      error[2] += std::abs(coarse.glow(HazeMethod::March, ray, s, 200)[1] / exact - 1) / 63;
      error[3] += std::abs(coarse.glow(HazeMethod::March, ray, s, 20)[1] / exact - 1) / 63;
    }
    EXPECT_LT(error[1], 0.005);
    EXPECT_LT(error[1], 0.3 * error[0]);
    EXPECT_LT(error[3], 0.002);
    EXPECT_LT(error[3], 0.1 * error[2]);
  }
}

TEST(HazeShafts, StretchesAddUp)
{
  const CloudShadow clouds = cloudsOf(scattered);
  HazeShafts haze(clouds, { 0.2, 0.1, 1 }, Eye, Tau);
  haze.tabulate(400);
  const Ray ray = Rays[0];
  for (HazeMethod method : { HazeMethod::Exact, HazeMethod::Moments })
  {
    const Channels whole = haze.glow(method, ray, { 100, 2900 });
    const Channels front = haze.glow(method, ray, { 100, 1700 });
    const Channels back = haze.glow(method, ray, { 1700, 2900 });
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR((front[c] + std::exp(-Tau[c] * 1600) * back[c]) / whole[c], 1, 2e-4);
    }
  }
}

TEST(HazeShafts, EndsAtTheCloudPlane)
{
  const CloudShadow open{ {}, Plane };
  const HazeShafts haze(open, { 0, 0, 1 }, Eye, Tau);
  EXPECT_NEAR(haze.below(rayOf(0, 0, 1), 0, 1e6).far, 970, 1e-9);
  EXPECT_EQ(haze.below(rayOf(0, 1, 0), 5, 1e6).far, 1e6) << "never reaches the plane";
  const Ray down{ { 0, 0, 1500 }, normalized(Vector3{ 0, 1, -1 }) };
  EXPECT_NEAR(haze.below(down, 0, 1e6).near, 500 * std::sqrt(2.0), 1e-9);
  const Ray up{ { 0, 0, 1500 }, { 0, 0, 1 } };
  const Ray level{ { 0, 0, 1500 }, { 0, 1, 0 } };
  for (const Ray& ray : { up, level })
  {
    const HazeShafts::Stretch none = haze.below(ray, 0, 1e6);
    EXPECT_LT(none.far, none.near);
    EXPECT_EQ(haze.glow(HazeMethod::Exact, ray, none), (Channels{ 0, 0, 0 }));
  }
}

TEST(HazeShafts, ExtremesGiveNumbers)
{
  const CloudShadow clouds = cloudsOf(scattered);
  for (const Vector3& sun :
    { Vector3{ 0, 0, 1 }, Vector3{ 1, 0, 1e-3 }, Vector3{ 0, 1, 0 }, Vector3{ 0, 0, -1 },
      Vector3{ 0.3, 1, 0.1 }, Vector3{ 1, 0, 5e-324 }, Vector3{ 1, 0, 1e-300 } })
  {
    for (const Channels& tau :
      { Channels{ 0, 0, 0 }, Channels{ 1e6, 1e-9, 0 }, Channels{ std::nan(""), -1, 5 } })
    {
      HazeShafts haze(clouds, sun, Eye, tau);
      haze.tabulate(64);
      for (Vector3 direction :
        { sun, Vector3{ 0, 0, 1 }, Vector3{ 0, 1, 1e-9 }, Vector3{ 0, 1, -1 } })
      {
        const Ray ray{ Eye, normalized(direction) };
        for (HazeMethod method : Methods)
        {
          const double far = method == HazeMethod::March ? 1e5 : Infinity;
          for (double light : haze.glow(method, ray, haze.below(ray, 0, far)))
          {
            EXPECT_TRUE(std::isfinite(light));
            EXPECT_GE(light, -1e-9);
            EXPECT_LE(light, 1.0 + 1e-3);
          }
        }
      }
    }
  }
}
