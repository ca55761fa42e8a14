// SPDX-License-Identifier: BSD-3-Clause
#include "ColumnGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

using nephoscope::ColumnGrid;
using nephoscope::ColumnStencil;
using nephoscope::Interpolation;
using nephoscope::Vector3;

namespace
{
constexpr double Pi = 3.14159265358979323846;

std::vector<double> longitudes(int n, double first, bool closed, bool descending = false)
{
  std::vector<double> values;
  for (int i = 0; i < n + (closed ? 1 : 0); ++i)
  {
    values.push_back(first + 2 * Pi * i / n);
  }
  if (descending)
  {
    std::reverse(values.begin(), values.end());
  }
  return values;
}

/// n rows between the poles, or from pole to pole.
std::vector<double> latitudes(int n, bool poleRows, bool descending = false)
{
  std::vector<double> values;
  for (int j = 0; j < n; ++j)
  {
    values.push_back(poleRows ? -Pi / 2 + Pi * j / (n - 1) : -Pi / 2 + Pi * (j + 0.5) / n);
  }
  if (descending)
  {
    std::reverse(values.begin(), values.end());
  }
  return values;
}

double smooth(const Vector3& p)
{
  return std::exp(p[0]) * (1 + p[1] * p[2]) + std::sin(2 * p[2] + p[1]);
}

double error(const ColumnGrid& grid, Interpolation interpolation,
  const std::vector<Vector3>& places, const std::function<double(const Vector3&)>& field)
{
  double largest = 0;
  for (const Vector3& place : places)
  {
    ColumnStencil stencil;
    grid.locate(place, interpolation, stencil);
    double value = 0;
    double sum = 0;
    for (int n = 0; n < stencil.count; ++n)
    {
      const int i = stencil.column[n] % grid.columns();
      const int j = stencil.column[n] / grid.columns();
      value += stencil.weight[n] * field(grid.position(i, j));
      sum += stencil.weight[n];
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    largest = std::max(largest, std::abs(value - field(place)));
  }
  return largest;
}

std::vector<Vector3> placesOnSphere()
{
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<Vector3> places = { { 0, 0, 1 }, { 0, 0, -1 }, { -1, 0, 0 }, { -1, 1e-17, 0 },
    { -1, -1e-17, 0 }, { 1e-9, 1e-9, 1 } };
  for (int n = 0; n < 3000; ++n)
  {
    places.push_back(nephoscope::normalized({ normal(random), normal(random), normal(random) }));
  }
  return places;
}
}

TEST(ColumnGrid, OrdersOfInterpolationHoldOnTheWholeSphereForEveryLayout)
{
  const std::vector<Vector3> places = placesOnSphere();
  for (int layout = 0; layout < 16; ++layout)
  {
    const auto gridOf = [layout](int n)
    {
      return ColumnGrid::sphere(
        longitudes(2 * n, layout & 1 ? -Pi : 0.3, (layout & 2) != 0, (layout & 8) != 0),
        latitudes(n, (layout & 4) != 0, (layout & 8) != 0));
    };
    const double linear = error(gridOf(24), Interpolation::Linear, places, smooth);
    const double linearFine = error(gridOf(48), Interpolation::Linear, places, smooth);
    EXPECT_GT(std::log2(linear / linearFine), 1.8) << layout;
    const double cubic = error(gridOf(24), Interpolation::Cubic, places, smooth);
    const double cubicFine = error(gridOf(48), Interpolation::Cubic, places, smooth);
    EXPECT_GT(std::log2(cubic / cubicFine), 3.6) << layout;
    EXPECT_LT(cubicFine, 2e-4) << layout;
  }
}

TEST(ColumnGrid, CubicsInThePlaneAreReadExactly)
{
  // Unequal spacing, descending rows.
  const ColumnGrid grid = ColumnGrid::plane({ 0, 1, 3, 4, 7, 8 }, { 9, 7, 6, 2, 1 });
  const auto cubic = [](const Vector3& p)
  { return 1 + p[0] * p[0] * p[0] - 2 * p[1] * p[1] * p[1] + p[0] * p[1] * p[1]; };
  std::vector<Vector3> places;
  for (double x = 0; x <= 8; x += 0.37)
  {
    for (double y = 1; y <= 9; y += 0.41)
    {
      places.push_back({ x, y, 0 });
    }
  }
  EXPECT_LT(error(grid, Interpolation::Cubic, places, cubic), 1e-9);
  const auto bilinear = [](const Vector3& p) { return 2 + p[0] - 3 * p[1]; };
  EXPECT_LT(error(grid, Interpolation::Linear, places, bilinear), 1e-12);
}

TEST(ColumnGrid, OutsideTheNearestEdgeIsRead)
{
  const ColumnGrid grid = ColumnGrid::plane({ 0, 1, 2, 3, 4 }, { 0, 2, 4, 6 });
  const auto field = [](const Vector3& p) { return p[0] + 10 * p[1]; };
  for (const Interpolation interpolation : { Interpolation::Linear, Interpolation::Cubic })
  {
    ColumnStencil stencil;
    grid.locate({ 1e9, -1e9, 0 }, interpolation, stencil);
    double value = 0;
    for (int n = 0; n < stencil.count; ++n)
    {
      value +=
        stencil.weight[n] * field(grid.position(stencil.column[n] % 5, stencil.column[n] / 5));
    }
    EXPECT_NEAR(value, 4, 1e-9);
  }
}

TEST(ColumnGrid, OneColumnIsReadEverywhere)
{
  const ColumnGrid grid = ColumnGrid::plane({ 5 }, { 7 });
  ColumnStencil stencil;
  grid.locate({ -3, 100, 0 }, Interpolation::Cubic, stencil);
  EXPECT_EQ(stencil.count, 1);
  EXPECT_EQ(stencil.column[0], 0);
  EXPECT_EQ(stencil.weight[0], 1);
}

/// Wherever longitudes are counted from. Beyond the edges the nearer edge is read.
TEST(ColumnGrid, RegionsOverTheDateLine)
{
  constexpr double Degree = Pi / 180;
  for (const double first : { 170.0, 250.0, -190.0, -20.0, 350.0 })
  {
    std::vector<double> x;
    for (int i = 0; i < 21; ++i)
    {
      x.push_back((first + i) * Degree);
    }
    const ColumnGrid grid =
      ColumnGrid::sphere(x, { 30 * Degree, 31 * Degree, 32 * Degree, 33 * Degree });
    const auto columnRead = [&](double longitude, Interpolation interpolation)
    {
      const double a = longitude * Degree;
      const double b = 31.3 * Degree;
      ColumnStencil stencil;
      grid.locate({ std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b) },
        interpolation, stencil);
      double column = 0;
      for (int n = 0; n < stencil.count; ++n)
      {
        column += stencil.weight[n] * (stencil.column[n] % grid.columns());
      }
      return column;
    };
    for (const auto interpolation : { Interpolation::Linear, Interpolation::Cubic })
    {
      SCOPED_TRACE(first);
      EXPECT_NEAR(columnRead(first + 3.25, interpolation), 3.25, 1e-9);
      EXPECT_NEAR(columnRead(first + 15.3, interpolation), 15.3, 1e-9);
      EXPECT_NEAR(columnRead(first - 5, interpolation), 0, 1e-9);
      EXPECT_NEAR(columnRead(first + 25, interpolation), 20, 1e-9);
    }
  }
}
