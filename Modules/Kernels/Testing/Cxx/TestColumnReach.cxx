// SPDX-License-Identifier: BSD-3-Clause
#include "ColumnReach.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

using nephoscope::ColumnGrid;
using nephoscope::ColumnRectangle;
using nephoscope::ColumnStencil;
using nephoscope::Interpolation;
using nephoscope::Vector3;

namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr double Radius = 6371229;

std::vector<double> evenly(double first, double spacing, int count)
{
  std::vector<double> values;
  for (int n = 0; n < count; ++n)
  {
    values.push_back(first + spacing * n);
  }
  return values;
}

/// A place some way off, in any direction.
Vector3 wayFrom(const ColumnGrid& grid, const Vector3& from, double way, double direction)
{
  if (!grid.isSphere())
  {
    return from + Vector3{ way * std::cos(direction), way * std::sin(direction), 0 };
  }
  const Vector3 aside =
    normalized(cross(from, std::abs(from[2]) < 0.9 ? Vector3{ 0, 0, 1 } : Vector3{ 1, 0, 0 }));
  const Vector3 heading = std::cos(direction) * aside + std::sin(direction) * cross(from, aside);
  return std::cos(way / Radius) * from + std::sin(way / Radius) * heading;
}

/// All that is read at places within the distance is among the columns; returns how many there are.
std::size_t expectEnough(const ColumnGrid& grid, const ColumnRectangle& block, double distance)
{
  const std::vector<int> columns = columnsWithin(grid, block, distance, Radius);
  EXPECT_TRUE(std::is_sorted(columns.begin(), columns.end()));
  const std::set<int> held(columns.begin(), columns.end());
  EXPECT_EQ(held.size(), columns.size());
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  int missing = 0;
  for (int n = 0; n < 20000; ++n)
  {
    const auto at = static_cast<std::size_t>(uniform(random) * static_cast<double>(block.size()));
    const double share = n % 2 == 0 ? 1 : uniform(random); // the farthest matter most
    const Vector3 place = wayFrom(grid, grid.position(block.column(at), block.row(at)),
      share * distance, 2 * Pi * uniform(random));
    ColumnStencil stencil;
    grid.locate(place, n % 3 == 0 ? Interpolation::Linear : Interpolation::Cubic, stencil);
    for (int s = 0; s < stencil.count; ++s)
    {
      missing += held.count(stencil.column[s]) == 0 ? 1 : 0;
    }
  }
  EXPECT_EQ(missing, 0);
  return columns.size();
}

TEST(ColumnReach, OfAGlobeInBlocks)
{
  // 3 degrees, rows between the poles; the same turned round, with a closing column and rows at the poles.
  const double spacing = Pi / 60;
  const ColumnGrid grids[2] = { ColumnGrid::sphere(evenly(0, spacing, 120),
                                  evenly(-Pi / 2 + spacing / 2, spacing, 60)),
    ColumnGrid::sphere(evenly(Pi, -spacing, 121), evenly(Pi / 2, -spacing, 61)) };
  for (const ColumnGrid& grid : grids)
  {
    const auto all = static_cast<std::size_t>(grid.columns()) * grid.rows();
    for (const double distance : { 0.0, 200e3, 1300e3 })
    {
      SCOPED_TRACE(distance);
      EXPECT_LT(expectEnough(grid, { 0, 20, 30, 20 }, distance), all / 2); // at the seam
      EXPECT_LT(expectEnough(grid, { 40, 0, 20, 15 }, distance), all / 2); // at a pole
      EXPECT_LT(expectEnough(grid, { 50, 52, 3, 5 }, distance), all / 2);  // near the other
      EXPECT_LT(expectEnough(grid, { 60, 0, 60, 60 }, distance), all);     // from pole to pole
    }
    EXPECT_EQ(expectEnough(grid, { 0, 20, 30, 20 }, 3 * Radius), all);
  }
}

TEST(ColumnReach, OfARegionAndAPlane)
{
  const ColumnGrid region = ColumnGrid::sphere(evenly(0.2, 0.02, 50), evenly(1.2, -0.015, 40));
  const ColumnGrid plane = ColumnGrid::plane(evenly(0, 4e3, 60), evenly(9e4, -7e3, 33));
  EXPECT_LT(expectEnough(region, { 0, 0, 10, 40 }, 500e3), 50U * 40U);
  EXPECT_LT(expectEnough(region, { 30, 20, 9, 8 }, 100e3), 25U * 22U);
  EXPECT_LT(expectEnough(plane, { 50, 0, 10, 11 }, 30e3), 23U * 20U);
  EXPECT_EQ(
    expectEnough(plane, { 7, 9, 1, 1 }, 0), 9U * 7U); // four columns and three rows either way
}

TEST(ColumnReach, RowsAreThoseOfTheColumns)
{
  const ColumnGrid region = ColumnGrid::sphere(evenly(0.2, 0.02, 50), evenly(1.2, -0.015, 40));
  const ColumnRectangle block{ 30, 20, 9, 8 };
  const std::vector<int> columns = columnsWithin(region, block, 100e3, Radius);
  const std::array<int, 2> rows = rowsWithin(region, block, 100e3, Radius);
  EXPECT_EQ(rows[0], columns.front() / region.columns());
  EXPECT_EQ(rows[1], columns.back() / region.columns());
  // 100 km are 1.05 rows, and three more are for stencils.
  EXPECT_EQ(rows, (std::array<int, 2>{ 16, 31 }));
  const std::array<int, 2> none = rowsWithin(region, {}, 100e3, Radius);
  EXPECT_LT(none[1], none[0]);
}

TEST(ColumnReach, AnEmptyBlockNeedsNothing)
{
  const ColumnGrid plane = ColumnGrid::plane(evenly(0, 1, 3), evenly(0, 1, 2));
  EXPECT_TRUE(columnsWithin(plane, {}, 1e6, Radius).empty());
  EXPECT_EQ(expectEnough(plane, { 2, 1, 1, 1 }, 1), 6U);
}
}
