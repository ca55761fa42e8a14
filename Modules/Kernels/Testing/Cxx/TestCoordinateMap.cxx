// SPDX-License-Identifier: BSD-3-Clause
#include "CoordinateMap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

using namespace nephoscope;

namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr double Day = 86400;
constexpr double Radius = 6.37122e6;

/// A globe of levels with constant heights and a steady wind.
struct Air
{
  ColumnGrid grid;
  std::vector<float> velocity;
  std::vector<float> height;
  AirMotion motion;

  Air(const ColumnGrid& columns, int levels, const std::function<Vector3(const Vector3&)>& wind,
    const std::function<double(const Vector3&, int)>& heightOf)
    : grid(columns)
  {
    for (int k = 0; k < levels; ++k)
    {
      for (int j = 0; j < this->grid.rows(); ++j)
      {
        for (int i = 0; i < this->grid.columns(); ++i)
        {
          const Vector3 p = this->grid.position(i, j);
          const Vector3 v = wind(p);
          this->velocity.insert(this->velocity.end(), { float(v[0]), float(v[1]), float(v[2]) });
          this->height.push_back(float(heightOf(p, k)));
        }
      }
    }
    this->motion.wind.grid = &this->grid;
    this->motion.wind.levels = levels;
    this->motion.wind.radius = Radius;
    this->motion.wind.seconds = 6 * 3600;
    for (int time = 0; time < 2; ++time)
    {
      this->motion.wind.velocity[time] = this->velocity.data();
      this->motion.height[time] = this->height.data();
    }
  }
  Air(const Air&) = delete;

  template <class Function>
  void forEach(const Function& function) const
  {
    for (int k = 0; k < this->motion.wind.levels; ++k)
    {
      for (int j = 0; j < this->grid.rows(); ++j)
      {
        for (int i = 0; i < this->grid.columns(); ++i)
        {
          function(i, j, k);
        }
      }
    }
  }
};

ColumnGrid globe(int nx, int ny, bool closed)
{
  std::vector<double> lon;
  std::vector<double> lat;
  for (int i = 0; i < nx + (closed ? 1 : 0); ++i)
  {
    lon.push_back(-Pi + 2 * Pi * i / nx);
  }
  for (int j = 0; j < ny; ++j)
  {
    lat.push_back(-Pi / 2 + Pi * (j + 0.5) / ny);
  }
  return ColumnGrid::sphere(lon, lat);
}

Vector3 spin(double alpha, const Vector3& p)
{
  return 2 * Pi * Radius / (12 * Day) * cross(Vector3{ -std::sin(alpha), 0, std::cos(alpha) }, p);
}

/// Rotate p about the axis of spin by an angle.
Vector3 turned(double alpha, double angle, const Vector3& p)
{
  const Vector3 n{ -std::sin(alpha), 0, std::cos(alpha) };
  return std::cos(angle) * p + std::sin(angle) * cross(n, p) +
    ((1 - std::cos(angle)) * dot(n, p)) * n;
}

/// The map at the interval's end, from that at its beginning.
Vector3 coordinatesOf(const AirMotion& motion, const TrajectoryScheme& scheme,
  const float* displacement, int i, int j, int k)
{
  Departure departure;
  depart(motion, scheme, i, j, k, 0, 1, departure);
  return carriedCoordinates(departure, displacement);
}
}

TEST(CoordinateMap, CalmAirKeepsItsCoordinatesToTheLastBit)
{
  const Air air(
    globe(24, 13, true), 3,
    [](const Vector3&) {
      return Vector3{ 0, 0, 0 };
    },
    [](const Vector3& p, int k) { return 500 * p[2] + 1000 * k; });
  const std::vector<float> still(3 * air.height.size(), 0.0F);
  for (const Interpolation interpolation : { Interpolation::Linear, Interpolation::Cubic })
  {
    air.forEach(
      [&](int i, int j, int k)
      {
        const Vector3 place = placeOfPoint(air.motion, i, j, k, 1);
        const Vector3 c = coordinatesOf(
          air.motion, { Integrator::RungeKutta2, interpolation, 2 }, still.data(), i, j, k);
        EXPECT_LT(length(c - place), 1e-6);
      });
  }
}

TEST(CoordinateMap, SolidRotationForTwelveDaysStaysWithinATenthOfACellAndConverges)
{
  // 48 steps of 6 hours with remapping each: after a whole turn the coordinates are the places again.
  const auto errorOf = [](int nx, int ny, double alpha, int steps)
  {
    Air air(
      globe(nx, ny, false), 1, [alpha](const Vector3& p) { return spin(alpha, p); },
      [](const Vector3&, int) { return 5000.0; });
    air.motion.wind.seconds = 12 * Day / steps;
    const TrajectoryScheme scheme{ Integrator::RungeKutta4, Interpolation::Cubic, 1 };
    std::vector<float> displacement(3 * air.height.size(), 0.0F);
    std::vector<float> next(displacement.size());
    double largest = 0;
    for (int n = 1; n <= steps; ++n)
    {
      air.forEach(
        [&](int i, int j, int k)
        {
          const Vector3 c =
            coordinatesOf(air.motion, scheme, n == 1 ? nullptr : displacement.data(), i, j, k);
          const Vector3 d = c - placeOfPoint(air.motion, i, j, k, 1);
          for (int component = 0; component < 3; ++component)
          {
            next[3 * (i + nx * j) + component] = static_cast<float>(d[component]);
          }
          const Vector3 exact =
            (Radius + 5000) * turned(alpha, -2 * Pi * n / steps, air.grid.position(i, j));
          largest = std::max(largest, length(c - exact));
        });
      displacement.swap(next);
    }
    return largest;
  };
  for (const double alpha : { 0.0, Pi / 4, Pi / 2 - 0.05 })
  {
    EXPECT_LT(errorOf(128, 64, alpha, 48), 0.1 * 2 * Pi * Radius / 128) << alpha;
    // With steps so short that the grid is what counts.
    const double order = std::log2(errorOf(32, 16, alpha, 96) / errorOf(64, 32, alpha, 96));
    EXPECT_GT(order, 3.5) << alpha;
  }
}

TEST(CoordinateMap, LinearHeightsOverSlopingLevelsAreNoMotionThroughThem)
{
  // Levels parallel to a slope, wind along the slope with w = v . grad z: none crosses.
  const Air air(
    ColumnGrid::plane({ 0, 100, 250, 400, 500 }, { 900, 700, 650, 300 }), 3,
    [](const Vector3&) {
      return Vector3{ 7, -3, 0 };
    },
    [](const Vector3& p, int k) { return 0.02 * p[0] - 0.01 * p[1] + 200 * k; });
  air.forEach(
    [&](int i, int j, int k)
    {
      const ColumnSlope slope(air.motion, i, j);
      for (int time = 0; time < 2; ++time)
      {
        EXPECT_NEAR(slope.motionThroughLevels(air.motion, time, k, 7 * 0.02 + 3 * 0.01), 0, 1e-6);
      }
    });
}

TEST(CoordinateMap, RisingLevelsLetStandingAirThrough)
{
  Air air(
    ColumnGrid::plane({ 0, 100 }, { 0, 100, 200 }), 2,
    [](const Vector3&) {
      return Vector3{ 0, 0, 0 };
    },
    [](const Vector3&, int k) { return 1000.0 * k; });
  std::vector<float> later = air.height;
  for (float& z : later)
  {
    z += 21600;
  }
  air.motion.height[1] = later.data();
  EXPECT_NEAR(
    ColumnSlope(air.motion, 1, 1).motionThroughLevels(air.motion, 0, 1, 0.25), -0.75, 1e-9);
}

TEST(CoordinateMap, StretchOfALinearMapIsItsSingularValues)
{
  // C = (2 x + y, y / 2, 0) has singular values from the eigenvalues of [[4, 2], [2, 5/4]].
  const Air air(
    ColumnGrid::plane({ 0, 1, 3, 4, 7 }, { 5, 4, 2, 0 }), 2,
    [](const Vector3&) {
      return Vector3{ 0, 0, 0 };
    },
    [](const Vector3&, int) { return 0.0; });
  std::vector<float> c;
  air.forEach(
    [&](int i, int j, int)
    {
      const Vector3 p = air.grid.position(i, j);
      c.insert(c.end(), { float(2 * p[0] + p[1]), float(p[1] / 2), 0.0F });
    });
  const double root = std::sqrt(2.625 * 2.625 - 1);
  air.forEach(
    [&](int i, int j, int k)
    {
      const Stretch stretch = stretchAt(air.motion, c.data(), i, j, k);
      EXPECT_NEAR(stretch.largest, std::sqrt(2.625 + root), 1e-6);
      EXPECT_NEAR(stretch.smallest, std::sqrt(2.625 - root), 1e-6);
    });
}

TEST(CoordinateMap, RotatedGlobeIsNotStretched)
{
  const Air air(
    globe(48, 24, true), 1, [](const Vector3& p) { return spin(0.7, p); },
    [](const Vector3&, int) { return 0.0; });
  std::vector<float> c;
  air.forEach(
    [&](int i, int j, int)
    {
      const Vector3 p = Radius * turned(0.7, 1.1, air.grid.position(i, j));
      c.insert(c.end(), { float(p[0]), float(p[1]), float(p[2]) });
    });
  air.forEach(
    [&](int i, int j, int k)
    {
      const Stretch stretch = stretchAt(air.motion, c.data(), i, j, k);
      EXPECT_NEAR(stretch.largest, 1, 1e-4);
      EXPECT_NEAR(stretch.smallest, 1, 1e-4);
    });
}

TEST(CoordinateMap, RowsAtThePolesAreNeitherStretchedNorStrained)
{
  // Columns of these rows coincide, but for rounding; so do their winds and coordinates.
  std::vector<double> longitudes;
  std::vector<double> latitudes;
  for (int i = 0; i <= 24; ++i)
  {
    longitudes.push_back(i * 2 * Pi / 24);
  }
  for (int j = 0; j <= 12; ++j)
  {
    latitudes.push_back((j - 6) * Pi / 12);
  }
  const Air air(
    ColumnGrid::sphere(longitudes, latitudes), 1, [](const Vector3& p) { return spin(0.7, p); },
    [](const Vector3&, int) { return 0.0; });
  std::vector<float> c;
  std::vector<float> wind;
  int n = 0;
  air.forEach(
    [&](int i, int j, int)
    {
      // A hundredth of a metre a second and a metre of noise.
      const float noise = 0.01F * static_cast<float>(n++ % 7 - 3);
      const Vector3 p = air.grid.position(i, j);
      const Vector3 v = spin(0.7, p);
      for (int d = 0; d < 3; ++d)
      {
        c.push_back(static_cast<float>(Radius * p[d]) + 100 * noise);
        wind.push_back(static_cast<float>(v[d]) + noise);
      }
    });
  air.forEach([&](int i, int j, int k)
    { EXPECT_NEAR(stretchAt(air.motion, c.data(), i, j, k).largest, 1, 1e-3); });
  for (int j = 0; j < air.grid.rows(); ++j)
  {
    const WindMeasure row = measureRow(air.grid, Radius, wind.data(), j, 0);
    EXPECT_LT(row.strain, 3 * row.speed / Radius) << j;
  }
}
