// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file HeightGrid.h
 * @brief A ray's first hit on terrain: a solid block whose top is a height field, bilinear between the points of a grid.
 *
 * Blocks of 2^l x 2^l cells know their highest point; a ray descends, near blocks first, only into those that it passes
 * below that point, and meets the bilinear patches in closed form (a quadratic equation). It goes on from block to neighbouring
 * block by whole numbers, so that no rounding makes a gap between two. The sides are vertical walls at the grid's edge.
 * An eye below the ground sees it at distance 0.
 *
 * Cost: about log2 of the number of points for a ray; thread-safe.
 * @sa GridPyramid.h, TestHeightGrid.cxx
 */
#ifndef HeightGrid_h
#define HeightGrid_h

#include "Camera.h"
#include "GridPyramid.h"

namespace nephoscope
{
class HeightGrid
{
public:
  HeightGrid() = default;
  /// @param heights at least 2 x 2 points, scene units; fewer are never hit
  explicit HeightGrid(GridPyramid heights);

  const GridPyramid& heights() const { return this->Heights; }

  /// The highest point; -infinity if there is nothing to hit.
  double top() const;

  /// Distance of the first point from 0 to `far` along the ray that is not above the ground; infinity if there is none.
  double intersect(const Ray& ray, double far) const;

  /// Unit normal of the ground as a footprint sees it.
  Vector3 normal(double x, double y, double footprint) const;

private:
  struct Level
  {
    int nx;
    int ny;
    std::vector<float> highest;
    float at(int i, int j) const
    {
      return this->highest[static_cast<std::size_t>(j) * this->nx + i];
    }
  };
  struct Cast;
  struct Place;
  double descend(Cast& cast) const;
  void advance(const Cast& cast, int axis, Place& at) const;
  double patch(const Cast& cast, int i, int j, double far) const;

  GridPyramid Heights;
  std::vector<Level> Levels; // 0 is that of cells
};
}
#endif
