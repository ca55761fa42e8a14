// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file ColumnReach.h
 * @brief Which columns of a grid may be read by parcels that set off in a block of its columns and go no farther than a distance.
 *
 * On the sphere a parcel that goes at most an angle r from latitude b to latitude p changes its longitude by d with
 *
 *     sin(d / 2) <= sin(r / 2) / sqrt(cos b cos p)                                                      (haversine)
 *
 * so rows have more columns the nearer to a pole they are, and beside it all. To the range of places three of the widest intervals are added
 * either way, in which the stencils about a place lie, also those of cubics at an edge and of central differences.
 */
#ifndef ColumnReach_h
#define ColumnReach_h

#include "ColumnGrid.h"

namespace nephoscope
{
/// Columns first to first + count - 1 along both axes.
struct ColumnRectangle
{
  int firstColumn = 0;
  int firstRow = 0;
  int columns = 0;
  int rows = 0;

  std::size_t size() const { return static_cast<std::size_t>(this->columns) * this->rows; }
  int column(std::size_t n) const
  {
    return this->firstColumn + static_cast<int>(n % this->columns);
  }
  int row(std::size_t n) const { return this->firstRow + static_cast<int>(n / this->columns); }
};

/// The rows that may be read, from the first to the last. An empty block has none: then the last is before the first.
std::array<int, 2> rowsWithin(
  const ColumnGrid& grid, const ColumnRectangle& block, double distance, double radius);

/// Numbers of columns, rising. @param distance m, >= 0, @param radius of the sphere, m  An empty block has none.
std::vector<int> columnsWithin(
  const ColumnGrid& grid, const ColumnRectangle& block, double distance, double radius);
}
#endif
