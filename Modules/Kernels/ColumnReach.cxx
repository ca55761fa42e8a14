// SPDX-License-Identifier: BSD-3-Clause
#include "ColumnReach.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr double Rounding = 1e-9;
constexpr double Intervals = 3; // that stencils reach beyond a place

/// Coordinates of lines, one after the other, that a block has.
struct Range
{
  double least;
  double most;

  Range(const std::vector<double>& values, int first, int count)
  {
    const auto ends =
      std::minmax(values[first], values[static_cast<std::size_t>(first) + count - 1]);
    this->least = ends.first;
    this->most = ends.second;
  }
  double farthestFromZero() const { return std::max(std::abs(this->least), std::abs(this->most)); }
  /// 0 within; on a circle the shorter way.
  double distance(double value, bool circle) const
  {
    const double half = 0.5 * (this->most - this->least);
    double away = std::abs(value - (this->least + half));
    away = circle ? std::abs(std::remainder(away, 2 * Pi)) : away;
    return std::max(away - half, 0.0);
  }
};

double widestInterval(const std::vector<double>& values)
{
  double widest = 0;
  for (std::size_t n = 1; n < values.size(); ++n)
  {
    widest = std::max(widest, std::abs(values[n] - values[n - 1]));
  }
  return widest;
}

double marginOf(const std::vector<double>& values)
{
  return Intervals * widestInterval(values) + Rounding;
}

/// How far in longitude parcels of a block may come to be where a row is read. @param margin of latitude about the row
double turnAtRow(double row, double margin, double highestOfBlock, double angle)
{
  const double there = std::abs(row) + margin;
  const double here = std::min(there + angle, highestOfBlock);
  const double across = std::cos(there) * std::cos(here);
  if (there >= Pi / 2 || angle >= Pi || !(across > 0))
  {
    return Pi;
  }
  return 2 * std::asin(std::min(std::sin(angle / 2) / std::sqrt(across), 1.0));
}
}

std::array<int, 2> rowsWithin(
  const ColumnGrid& grid, const ColumnRectangle& block, double distance, double radius)
{
  std::array<int, 2> rows{ grid.rows(), -1 };
  if (block.size() == 0)
  {
    return rows;
  }
  const std::vector<double>& y = grid.rowCoordinates();
  const Range blockY(y, block.firstRow, block.rows);
  const double angle = grid.isSphere() ? distance / radius : distance;
  const double reach = angle + marginOf(y);
  for (int j = 0; j < grid.rows(); ++j)
  {
    if (blockY.distance(y[j], false) <= reach)
    {
      rows = { std::min(rows[0], j), j };
    }
  }
  return rows;
}

std::vector<int> columnsWithin(
  const ColumnGrid& grid, const ColumnRectangle& block, double distance, double radius)
{
  if (block.size() == 0)
  {
    return {};
  }
  const std::vector<double>& x = grid.columnCoordinates();
  const std::vector<double>& y = grid.rowCoordinates();
  const Range blockX(x, block.firstColumn, block.columns);
  const double highest = Range(y, block.firstRow, block.rows).farthestFromZero();
  const double angle = grid.isSphere() ? distance / radius : distance;
  // The interval that closes a circle is as wide as the others, to half an interval.
  const double beside = marginOf(x) + widestInterval(x);
  const double margin = marginOf(y);
  std::vector<int> found;
  const auto [first, last] = rowsWithin(grid, block, distance, radius);
  for (int j = first; j <= last; ++j)
  {
    const double across =
      beside + (grid.isSphere() ? turnAtRow(y[j], margin, highest, angle) : angle);
    for (int i = 0; i < grid.columns(); ++i)
    {
      if (blockX.distance(x[i], grid.isSphere()) <= across)
      {
        found.push_back(i + grid.columns() * j);
      }
    }
  }
  return found;
}
}
