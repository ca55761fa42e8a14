// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file OrderedTile.h
 * @brief Puts segments into a deep tile so that those of a pixel are composited in the order in which they come.
 *
 * A deep tile sorts by distance. A segment that would begin before the last one of its pixel ended is pushed back to that
 * end, down to a length of nothing, with all its light and optical depth: the order given is the one that is seen, right or
 * wrong, and where it is right no segment is moved, so that other bodies' segments find their places among them.
 *
 * @sa DeepTile.h, VisibilityOrder.h
 */
#ifndef OrderedTile_h
#define OrderedTile_h

#include "DeepTile.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace nephoscope
{
class OrderedTile
{
public:
  explicit OrderedTile(DeepTile& tile)
    : Tile(tile)
    , Ends(static_cast<std::size_t>(tile.extent().width) * tile.extent().height, 0)
  {
  }

  const TileExtent& extent() const { return this->Tile.extent(); }

  /// Add a segment to a pixel, in image coordinates, behind those that were added to it before.
  void add(int x, int y, Segment segment)
  {
    const TileExtent& e = this->Tile.extent();
    double& end = this->Ends[static_cast<std::size_t>(y - e.y0) * e.width + (x - e.x0)];
    segment.nearEnd = std::min(std::max(segment.nearEnd, end), this->Tile.opaqueAt(x, y));
    segment.farEnd = std::max(segment.nearEnd, segment.farEnd);
    end = segment.farEnd;
    this->Tile.add(x, y, segment);
  }

private:
  DeepTile& Tile;
  std::vector<double> Ends; ///< of the pixels' last segments
};
}
#endif
