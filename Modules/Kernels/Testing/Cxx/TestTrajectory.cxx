// SPDX-License-Identifier: BSD-3-Clause
#include "Trajectory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

using namespace nephoscope;

namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr double Day = 86400;
constexpr double Radius = 6.37122e6; // Williamson et al. 1992

ColumnGrid globe(int nx, int ny)
{
  std::vector<double> lon;
  std::vector<double> lat;
  for (int i = 0; i < nx; ++i)
  {
    lon.push_back(2 * Pi * i / nx);
  }
  for (int j = 0; j < ny; ++j)
  {
    lat.push_back(-Pi / 2 + Pi * (j + 0.5) / ny);
  }
  return ColumnGrid::sphere(lon, lat);
}

using Wind = std::function<Vector3(const Vector3&, double)>;

std::vector<float> sample(const ColumnGrid& grid, const Wind& wind, double time)
{
  std::vector<float> field;
  for (int j = 0; j < grid.rows(); ++j)
  {
    for (int i = 0; i < grid.columns(); ++i)
    {
      const Vector3 v = wind(grid.position(i, j), time);
      field.insert(field.end(), { float(v[0]), float(v[1]), float(v[2]) });
    }
  }
  return field;
}

/// Solid-body rotation, once in 12 days, about an axis tilted by alpha (Williamson et al. 1992, test 1).
Wind rotation(double alpha)
{
  const Vector3 axis{ -std::sin(alpha), 0, std::cos(alpha) };
  const double u0 = 2 * Pi * Radius / (12 * Day);
  return [axis, u0](const Vector3& p, double) { return u0 * cross(axis, p); };
}

/// Deformational flow, Nair and Lauritzen 2010; cases 1 to 4 with T = 12 days, k scaled to metres per second.
Wind deformation(int number)
{
  const double T = 12 * Day;
  const double scale = Radius / (12 * Day) * 5; // their unit time is T / 5
  return [=](const Vector3& p, double t) -> Vector3
  {
    const double lon0 = std::atan2(p[1], p[0]);
    const double theta = std::asin(std::min(std::max(p[2], -1.0), 1.0));
    const double period = std::cos(Pi * t / T);
    double u = 0;
    double v = 0;
    const double drift = 2 * Pi * t / T;
    const double lon = number == 4 ? lon0 - drift : lon0;
    const auto sq = [](double x) { return x * x; };
    if (number == 1)
    {
      u = 2.4 * sq(std::sin(lon / 2)) * std::sin(2 * theta) * period;
      v = 1.2 * std::sin(lon) * std::cos(theta) * period;
    }
    else if (number == 3)
    {
      u = -sq(std::sin(lon / 2)) * std::sin(2 * theta) * sq(std::cos(theta)) * period;
      v = 0.5 * std::sin(lon) * std::pow(std::cos(theta), 3) * period;
    }
    else
    {
      u = 2 * sq(std::sin(lon)) * std::sin(2 * theta) * period;
      v = 2 * std::sin(2 * lon) * std::cos(theta) * period;
    }
    u = u * scale + (number == 4 ? 2 * Pi * Radius / T * std::cos(theta) : 0);
    v *= scale;
    const Vector3 east{ -std::sin(lon0), std::cos(lon0), 0 };
    const Vector3 north{ -std::sin(theta) * std::cos(lon0), -std::sin(theta) * std::sin(lon0),
      std::cos(theta) };
    return u * east + v * north;
  };
}

std::vector<Parcel> start(int n)
{
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::vector<Parcel> parcels = { { { 0, 0, 1 }, 0 }, { { 0, 0, -1 }, 0 }, { { -1, 0, 0 }, 0 } };
  while (static_cast<int>(parcels.size()) < n)
  {
    parcels.push_back({ normalized({ normal(random), normal(random), normal(random) }), 0 });
  }
  return parcels;
}

/// Follow parcels through `intervals` of a wind sampled at their ends; returns positions.
std::vector<Parcel> journey(const ColumnGrid& grid, const Wind& wind, std::vector<Parcel> parcels,
  double t0, double t1, int intervals, const TrajectoryScheme& scheme)
{
  for (int n = 0; n < intervals; ++n)
  {
    const double a = t0 + (t1 - t0) * n / intervals;
    const double b = t0 + (t1 - t0) * (n + 1) / intervals;
    const std::vector<float> va = sample(grid, wind, a);
    const std::vector<float> vb = sample(grid, wind, b);
    WindPair pair;
    pair.grid = &grid;
    pair.radius = Radius;
    pair.velocity[0] = va.data();
    pair.velocity[1] = vb.data();
    pair.seconds = b - a;
    for (Parcel& parcel : parcels)
    {
      parcel = follow(pair, scheme, parcel, 0, 1);
    }
  }
  return parcels;
}

double largestDistance(const std::vector<Parcel>& a, const std::vector<Parcel>& b)
{
  double largest = 0;
  for (std::size_t n = 0; n < a.size(); ++n)
  {
    largest = std::max(largest, length(a[n].position - b[n].position));
  }
  return largest;
}

const TrajectoryScheme Best{ Integrator::RungeKutta4, Interpolation::Cubic, 1 };
}

TEST(Trajectory, SolidRotationReturnsAfterTwelveDaysWithinATenthOfACell)
{
  const ColumnGrid grid = globe(128, 64);
  const std::vector<Parcel> parcels = start(300);
  for (const double alpha : { 0.0, Pi / 4, Pi / 2 - 0.05 })
  {
    const auto back = journey(grid, rotation(alpha), parcels, 0, 12 * Day, 48, Best);
    EXPECT_LT(largestDistance(back, parcels), 0.1 * 2 * Pi / 128) << alpha;
  }
}

TEST(Trajectory, OrderInTheStepIsTheIntegrators)
{
  // A fine grid, so that the step is what counts; a steady deformation against many small steps.
  const ColumnGrid grid = globe(256, 128);
  const Wind steady = [](const Vector3& p, double) { return deformation(2)(p, 0); };
  const std::vector<Parcel> parcels = start(100);
  const auto orderOf = [&](Integrator integrator, int steps)
  {
    const auto errorOf = [&](int n)
    {
      const TrajectoryScheme scheme{ integrator, Interpolation::Cubic, n };
      const TrajectoryScheme fine{ Integrator::RungeKutta4, Interpolation::Cubic, 400 };
      return largestDistance(journey(grid, steady, parcels, 0, 2 * Day, 1, scheme),
        journey(grid, steady, parcels, 0, 2 * Day, 1, fine));
    };
    return std::log2(errorOf(steps) / errorOf(2 * steps));
  };
  EXPECT_GT(orderOf(Integrator::RungeKutta2, 16), 1.9);
  EXPECT_GT(orderOf(Integrator::RungeKutta4, 8), 3.5);
}

TEST(Trajectory, DeformationalFlowsBringEveryParcelBack)
{
  // At T the flow of cases 1 to 4 has undone itself. Wind given every 3 h, then 1.5 h: that it is linear in between is the
  // larger part of the error.
  const std::vector<Parcel> parcels = start(200);
  for (int number = 1; number <= 4; ++number)
  {
    const ColumnGrid coarse = globe(64, 32);
    const ColumnGrid fine = globe(128, 64);
    const double first = largestDistance(
      journey(coarse, deformation(number), parcels, 0, 12 * Day, 96, Best), parcels);
    const double second =
      largestDistance(journey(fine, deformation(number), parcels, 0, 12 * Day, 192, Best), parcels);
    EXPECT_LT(second, 0.1 * 2 * Pi / 128) << number;
    EXPECT_LT(second, first / 3) << number; // time-linear wind: second order in the interval
  }
}

TEST(Trajectory, ForwardAndBackEndsAtTheStart)
{
  const ColumnGrid grid = globe(64, 32);
  const std::vector<float> wind = sample(grid, deformation(2), 0);
  WindPair pair;
  pair.grid = &grid;
  pair.radius = Radius;
  pair.velocity[0] = pair.velocity[1] = wind.data();
  pair.seconds = 6 * 3600;
  const TrajectoryScheme scheme{ Integrator::RungeKutta4, Interpolation::Cubic, 4 };
  for (const Parcel& parcel : start(200))
  {
    const Parcel there = follow(pair, scheme, parcel, 0, 1);
    const Parcel back = follow(pair, scheme, there, 1, 0);
    EXPECT_LT(length(back.position - parcel.position), 1e-6);
  }
}

TEST(Trajectory, AnyCourantNumberStaysOnTheSphere)
{
  const ColumnGrid grid = globe(64, 32);
  const double cell = 2 * Pi * Radius / 64;
  for (const double courant : { 0.0, 0.1, 1.0, 10.0, 50.0, 1e6 })
  {
    for (const Integrator integrator : { Integrator::RungeKutta2, Integrator::RungeKutta4 })
    {
      const std::vector<float> wind = sample(grid, rotation(Pi / 4), 0);
      WindPair pair;
      pair.grid = &grid;
      pair.radius = Radius;
      pair.velocity[0] = pair.velocity[1] = wind.data();
      pair.seconds = courant * cell / (2 * Pi * Radius / (12 * Day));
      for (const Parcel& parcel : start(50))
      {
        const Parcel end = follow(pair, { integrator, Interpolation::Cubic, 1 }, parcel, 1, 0);
        EXPECT_NEAR(length(end.position), 1, 1e-12) << courant;
        if (courant == 0)
        {
          EXPECT_LT(length(end.position - parcel.position), 1e-15);
        }
      }
    }
  }
}

TEST(Trajectory, NotANumberInTheWindLeavesTheAirAtRest)
{
  const ColumnGrid grid = globe(16, 8);
  std::vector<float> wind(std::size_t(3 * 16 * 8), std::nanf(""));
  WindPair pair;
  pair.grid = &grid;
  pair.velocity[0] = pair.velocity[1] = wind.data();
  pair.seconds = 3600;
  const Parcel parcel{ { 0, 1, 0 }, 0 };
  const Parcel end = follow(pair, Best, parcel, 1, 0);
  EXPECT_EQ(end.position[1], 1);
}

TEST(Trajectory, WindThatChangesLinearlyInTimeIsFollowedExactly)
{
  // In a plane: u = 10 + 2 t; back from t = 4 to 0 is 40 + 16 m.
  const ColumnGrid grid = ColumnGrid::plane({ -500, 0, 500 }, { -10, 10 });
  std::vector<float> first;
  std::vector<float> second;
  for (int n = 0; n < 6; ++n)
  {
    first.insert(first.end(), { 10, 0, 0 });
    second.insert(second.end(), { 18, 0, 0 });
  }
  WindPair pair;
  pair.grid = &grid;
  pair.velocity[0] = first.data();
  pair.velocity[1] = second.data();
  pair.seconds = 4;
  for (const Integrator integrator : { Integrator::RungeKutta2, Integrator::RungeKutta4 })
  {
    const Parcel end =
      follow(pair, { integrator, Interpolation::Linear, 1 }, { { 100, 3, 0 }, 0 }, 1, 0);
    EXPECT_NEAR(end.position[0], 44, 1e-12);
    EXPECT_NEAR(end.position[1], 3, 1e-15);
  }
}

TEST(Trajectory, AscentCrossesLevelsAtTheRateOfTheirThickness)
{
  // Levels 100, 300, 700, 1500 m; w = 2 m/s where the levels stand still.
  const double height[4] = { 100, 300, 700, 1500 };
  const double w[4] = { 2, 2, 2, 2 };
  double velocity[4];
  levelVelocity(4, height, w, velocity);
  EXPECT_NEAR(velocity[0], 2 / 200.0, 1e-15);
  EXPECT_NEAR(velocity[1], 2 / 300.0, 1e-15);
  EXPECT_NEAR(velocity[3], 2 / 800.0, 1e-15);
  const double down[4] = { 1500, 700, 300, 100 }; // stored from above
  levelVelocity(4, down, w, velocity);
  EXPECT_NEAR(velocity[0], -2 / 800.0, 1e-15);
  const double folded[4] = { 100, 300, 250, 260 };
  levelVelocity(4, folded, w, velocity);
  EXPECT_EQ(velocity[2], 0);
  levelVelocity(1, height, w, velocity);
  EXPECT_EQ(velocity[0], 0);
}

TEST(Trajectory, LevelsAreReadToTheirOrderAndClampedAtTheEnds)
{
  for (const double level : { -3.0, 0.0, 0.4, 1.0, 2.7, 3.9, 5.0, 99.0 })
  {
    const double inside = std::min(std::max(level, 0.0), 5.0);
    const LevelStencil cubic = levelStencil(level, 6, Interpolation::Cubic);
    double value = 0;
    for (int n = 0; n < cubic.count; ++n)
    {
      const double k = cubic.first + n;
      value += cubic.weight[n] * (k * k * k - 2 * k);
    }
    EXPECT_NEAR(value, inside * inside * inside - 2 * inside, 1e-12);
    const LevelStencil linear = levelStencil(level, 6, Interpolation::Linear);
    EXPECT_NEAR(linear.first + linear.weight[1], inside, 1e-12);
  }
  EXPECT_EQ(levelStencil(0.7, 1, Interpolation::Cubic).count, 1);
}

TEST(Trajectory, SubstepsGrowWithStrainAndShrinkWithOrder)
{
  const double six = 6 * 3600;
  EXPECT_EQ(substepsFor(Integrator::RungeKutta2, six, 0, 0, 100), 1);
  const int second = substepsFor(Integrator::RungeKutta2, six, 50, 1e-4, 100);
  EXPECT_GT(second, 4);
  EXPECT_LT(substepsFor(Integrator::RungeKutta4, six, 50, 1e-4, 100), second);
  EXPECT_EQ(substepsFor(Integrator::RungeKutta2, six, 300, 1, 1e-3), 64);
  // The estimate bounds the error of a rotation, whose strain rate is its angular velocity.
  const ColumnGrid grid = globe(128, 64);
  const std::vector<float> wind = sample(grid, rotation(0.3), 0);
  WindMeasure all;
  for (int j = 0; j < grid.rows(); ++j)
  {
    all.include(measureRow(grid, Radius, wind.data(), j, 0));
  }
  const auto [speed, strain] = all;
  EXPECT_NEAR(speed, 2 * Pi * Radius / (12 * Day), 0.1);
  EXPECT_NEAR(strain, 2 * Pi / (12 * Day), 2e-7);
  for (const double tolerance : { 1e5, 1e4, 1e3 })
  {
    for (const Integrator integrator : { Integrator::RungeKutta2, Integrator::RungeKutta4 })
    {
      const int n = substepsFor(integrator, Day, speed, strain, tolerance);
      const auto got =
        journey(grid, rotation(0.3), start(50), 0, Day, 1, { integrator, Interpolation::Cubic, n });
      const auto exact = journey(grid, rotation(0.3), start(50), 0, Day, 1,
        { Integrator::RungeKutta4, Interpolation::Cubic, 64 });
      EXPECT_LT(Radius * largestDistance(got, exact), tolerance);
    }
  }
}

TEST(Trajectory, RowsHaveTheSubstepsOfTheWindWithinReach)
{
  // A jet at 45 degrees north in the middle one of five levels, calm elsewhere.
  const ColumnGrid grid = globe(48, 60);
  std::vector<float> wind;
  for (int k = 0; k < 5; ++k)
  {
    const std::vector<float> level = sample(
      grid,
      [k](const Vector3& p, double)
      {
        const double off = (std::asin(p[2]) - Pi / 4) / 0.1;
        return (k == 2 ? 80 * std::exp(-off * off) : 0.0) * Vector3{ -p[1], p[0], 0 };
      },
      0);
    wind.insert(wind.end(), level.begin(), level.end());
  }
  std::vector<WindMeasure> rows;
  for (int n = 0; n < 5 * 60; ++n)
  {
    rows.push_back(measureRow(grid, Radius, wind.data(), n % 60, n / 60));
  }
  const double hours = 6 * 3600;
  const double tolerance = 2000;
  const std::vector<unsigned char> substeps =
    substepsOfRows(grid, 5, Radius, rows, Integrator::RungeKutta2, hours, tolerance);
  ASSERT_EQ(substeps.size(), rows.size());
  const int jet = 45;
  EXPECT_GT(substeps[jet + 60 * 2], 3);
  EXPECT_EQ(substeps[jet + 60 * 1], substeps[jet + 60 * 2]); // the levels beside it
  EXPECT_EQ(substeps[jet + 60 * 3], substeps[jet + 60 * 2]);
  EXPECT_EQ(substeps[jet], 1);         // two levels below
  EXPECT_EQ(substeps[20 + 60 * 2], 1); // in the south
  // What they are for: every trajectory that ends on a point is as exact as asked.
  WindPair pair;
  pair.grid = &grid;
  pair.levels = 5;
  pair.radius = Radius;
  pair.velocity[0] = pair.velocity[1] = wind.data();
  pair.seconds = hours;
  for (int n = 0; n < 5 * 60; ++n)
  {
    const TrajectoryScheme scheme{ Integrator::RungeKutta2, Interpolation::Cubic, substeps[n] };
    const TrajectoryScheme fine{ Integrator::RungeKutta4, Interpolation::Cubic, 64 };
    const Parcel got = followFromPoint(pair, scheme, 7, n % 60, n / 60, 1, 0);
    const Parcel exact = followFromPoint(pair, fine, 7, n % 60, n / 60, 1, 0);
    EXPECT_LT(Radius * length(got.position - exact.position), tolerance) << n;
  }
}

TEST(Trajectory, FromAPointIsAsFromItsPlace)
{
  const ColumnGrid grid = globe(32, 16);
  const std::vector<float> wind = sample(grid, deformation(2), 0);
  WindPair pair;
  pair.grid = &grid;
  pair.radius = Radius;
  pair.velocity[0] = pair.velocity[1] = wind.data();
  pair.seconds = 3600;
  for (int j = 0; j < 16; ++j)
  {
    const Parcel point = followFromPoint(pair, Best, 5, j, 0, 1, 0);
    const Parcel place = follow(pair, Best, { grid.position(5, j), 0 }, 1, 0);
    EXPECT_LT(length(point.position - place.position), 1e-12) << j;
  }
}
