// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file AirGrid.h
 * @brief Where the columns of a structured grid stand, in the form that the trajectory kernels take, and which of them are whose.
 */
#ifndef AirGrid_h
#define AirGrid_h

#include "ColumnShare.h"
#include "CoordinateMap.h"

#include "vtkType.h"

#include <vector>

class vtkStructuredGrid;

namespace nephoscope
{
/// What stays the same at all times: where the columns stand, what a metre of height is in the scene, and which columns are whose.
struct AirGrid
{
  ColumnGrid columns; ///< of the whole grid, in all processes
  ColumnShare share;
  PointExtent whole{}; ///< of the grid's data
  int levels = 1;
  double radius = 6371229; ///< m; of a Globe its PlanetRadius
  double heightScale = 1;  ///< metres of place per metre of height
  bool sphere = false;     ///< Globe or Map
  bool globe = false;      ///< points and winds are Cartesian already

  /// Own points, and what is the number of one: own columns in their order, level after level.
  std::size_t points() const { return this->share.own().size() * this->levels; }
  /// Of the whole grid.
  std::size_t allPoints() const
  {
    return static_cast<std::size_t>(this->share.columns()) * this->share.rows() * this->levels;
  }
  struct Point
  {
    int i;
    int j;
    int k;
  };
  Point point(std::size_t number) const
  {
    const ColumnRectangle& own = this->share.own();
    const std::size_t column = number % own.size();
    return { own.column(column), own.row(column), static_cast<int>(number / own.size()) };
  }
  /// Air at rest on the grid, without heights.
  AirMotion still() const;
};

/**
 * The columns of a grid by its field data Geometry (Globe, Map or Local; without it Local): lines of equal i and j have to lie along
 * meridians and parallels, or along x and y, to a twentieth of their spacing. A Map whose numbers all lie within
 * 720 x 90 is in degrees. Throws GridError.
 */
AirGrid airGridOf(vtkStructuredGrid* grid);

/// Of a grid whose blocks several processes have: `grid` is this one's, with or without more about it, or has no points where the share
/// has none. All processes get the same, or all throw. @param whole extent of the grid
AirGrid airGridOf(
  vtkStructuredGrid* grid, vtkMultiProcessController* controller, const PointExtent& whole);

/// Where the block of a process is found in its grid.
class BlockOfGrid
{
public:
  BlockOfGrid() = default;
  /// @param whole extent, whose first point is point 0
  BlockOfGrid(vtkStructuredGrid* grid, const PointExtent& whole);
  vtkIdType id(int i, int j, int k) const
  {
    return i - this->First[0] +
      this->Count[0] *
      (j - this->First[1] + static_cast<vtkIdType>(this->Count[1]) * (k - this->First[2]));
  }
  bool has(const ColumnRectangle& block, int levels) const;

private:
  int First[3] = { 0, 0, 0 };
  int Count[3] = { 0, 0, 0 };
};

/// What makes a grid useless as this process's part, whose block is found there; empty if nothing does.
std::string whatIsWrong(
  vtkStructuredGrid* grid, const BlockOfGrid& block, const ColumnShare& share, int levels);
}
#endif
