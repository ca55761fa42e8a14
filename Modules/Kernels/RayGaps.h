// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file RayGaps.h
 * @brief Relations between cells that share no face, from the rays of a picture.
 *
 * A ray that leaves one cell at the mesh's boundary and enters the next behind a gap says which of the two is before the other
 * (Cook, Max, Silva, Williams 2004: image-space visibility ordering). So the cells at the boundary are met with
 * the rays of a tile's pixels, each ray's are sorted, and each is before the next of them. With the relations across
 * faces these put any two cells that one ray meets in that ray's order, unless there is a cycle.
 *
 * Cells that overlap are put in the order in which the ray enters them.
 *
 * @sa VisibilityOrder.h, TetrahedronRays.h, TestVisibilityOrder.cxx
 */
#ifndef RayGaps_h
#define RayGaps_h

#include "DeepTile.h"
#include "TetrahedronScan.h"
#include "VisibilityOrder.h"

#include <array>
#include <cstdint>
#include <vector>

namespace nephoscope
{
/// The gaps along the rays of one tile. Make one for each thread and turn it to one tile after another.
class RayGaps
{
public:
  RayGaps(const RaySpace& space, int width, int height)
    : Space(space)
    , Scan(space, width, height)
  {
  }

  /// Forget all and turn to a tile.
  void reset(const TileExtent& extent);

  /// Meet a tetrahedron at the boundary with the tile's rays. Its points come in an order on which neighbours agree.
  void add(std::uint32_t cell, const std::array<Vector3, 4>& points);

  /// Add the relations, each once.
  void relate(CellRelations& relations);

private:
  struct Meeting
  {
    double depth;
    std::uint32_t pixel;
    std::uint32_t cell;
  };
  template <bool Parallel>
  void meet(std::uint32_t cell, const TetrahedronRays& rays, const PixelBox& box);

  RaySpace Space;
  TetrahedronScan Scan;
  TileExtent Extent;
  std::vector<double> U; ///< of the pixels of a row
  std::vector<Meeting> Meetings;
};
}
#endif
