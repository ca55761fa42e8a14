// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file VisibilityOrder.h
 * @brief An order of cells, front to back, that keeps what is known of pairs: which of two is before the other.
 *
 * Williams 1992 (meshed polyhedra visibility ordering): two cells that share a face are ordered by the side of the face's
 * plane that the eye is on. Those relations are a directed graph; where it has no cycle, a topological order of it is
 * a visibility order of all cells that are joined by faces. Cells with a gap between them need relations of their own, as
 * RayGaps finds them.
 *
 *  1. Cells that none is before are taken, first come first served, and what they were before is released (Kahn).
 *  2. What is left lies in or behind a cycle. Its strongly connected components (Tarjan 1972) are counted: those of more than
 *     one cell are the cycles.
 *  3. The left are taken as in 1; whenever none is free, the cell of the foremost cycle with the least distance is taken
 *     against the relations that hold it back. So each cell is taken once, and a relation is broken only in a cycle.
 *
 * @sa ColumnTetrahedra.h, RayGaps.h, vtkCloudCellVolume, TestVisibilityOrder.cxx
 */
#ifndef VisibilityOrder_h
#define VisibilityOrder_h

#include "Camera.h"
#include "Vector3.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephoscope
{
/// One cell is before another, seen from the eye.
struct CellRelation
{
  std::uint32_t before;
  std::uint32_t after;
};
using CellRelations = std::vector<CellRelation>;

/// Where a camera sees from: a point, or a direction if it is parallel.
class ViewPoint
{
public:
  explicit ViewPoint(const Camera& camera)
    : Eye(camera.eye())
    , Forward(camera.forward())
    , Parallel(camera.isParallel())
  {
  }

  /// Which side of a triangle's plane the eye is on: 1 where cross(b - a, c - a) points to, -1 opposite, 0 in the plane,
  /// through which it sees no cell, and where there is no plane.
  int side(const Vector3& a, const Vector3& b, const Vector3& c) const
  {
    constexpr double Rounding = 1e-14;
    const Vector3 normal = cross(b - a, c - a);
    const Vector3 toEye = this->Parallel ? -1 * this->Forward : this->Eye - a;
    const double height = dot(normal, toEye);
    const double least = Rounding * length(normal) * length(toEye);
    return height > least ? 1 : height < -least ? -1 : 0;
  }

  /// Along the viewing axis, as vtkCellCenterDepthSort has it.
  double depth(const Vector3& p) const { return dot(p - this->Eye, this->Forward); }

private:
  Vector3 Eye;
  Vector3 Forward;
  bool Parallel;
};

struct VisibilityOrder
{
  std::vector<std::uint32_t> cells; ///< front to back, each once
  std::size_t cycles = 0;           ///< groups of cells of which each is before each other
  std::size_t cellsInCycles = 0;
};

/**
 * @brief Order cells 0 to `cells` - 1.
 * @param relations lists of pairs of such cells, in any order, repeated or not; a cell before itself counts for nothing
 * @param distance of each cell, decides where a cycle is broken
 * Cost: O(cells + relations), and a sort of the cells in cycles; 12 bytes a cell and 4 a relation. One thread.
 */
VisibilityOrder visibilityOrder(std::size_t cells, const std::vector<CellRelations>& relations,
  const std::vector<double>& distance);

/// The order of distances alone; equal ones in the order of their numbers.
std::vector<std::uint32_t> distanceOrder(const std::vector<double>& distance);
}
#endif
