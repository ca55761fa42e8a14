// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file ColumnBlocks.h
 * @brief Pieces of a structured grid: blocks of whole columns, divided along i and j and never along the levels.
 *
 * Cells are what is divided: blocks share the points between them, and each cell is one block's. The longer side is halved,
 * pieces and cells alike, until one piece is left; so blocks are about square and their numbers of cells differ by little. Where there
 * are more pieces than columns of cells, the pieces left over are empty.
 */
#ifndef ColumnBlocks_h
#define ColumnBlocks_h

#include <algorithm>
#include <array>

namespace nephoscope
{
/// First and last point along i, j and k.
using PointExtent = std::array<int, 6>;

/**
 * @brief The points of a piece.
 * @param whole of the grid, one point at least along each axis  @param piece 0 .. pieces - 1
 * @return false if the piece is empty
 */
inline bool columnBlock(const PointExtent& whole, int piece, int pieces, PointExtent& block)
{
  block = whole;
  while (pieces > 1)
  {
    const int cells[2] = { block[1] - block[0], block[3] - block[2] };
    const int axis = cells[1] > cells[0] ? 1 : 0;
    if (cells[axis] < 2)
    {
      return piece == 0; // one column of cells, or none
    }
    const int before = pieces / 2;
    const long long share = static_cast<long long>(cells[axis]) * before / pieces;
    const int middle = block[2 * axis] + std::max(static_cast<int>(share), 1);
    const bool isBefore = piece < before;
    block[2 * axis + (isBefore ? 1 : 0)] = middle;
    piece -= isBefore ? 0 : before;
    pieces = isBefore ? before : pieces - before;
  }
  return true;
}

/**
 * @brief A block and its neighbours' cells as far as some levels of ghosts reach along i and j.
 * @param ring whether the grid closes on itself along i: then neighbours are found beyond its ends, unless the block is the whole way
 * round already
 */
inline PointExtent withGhosts(
  const PointExtent& whole, const PointExtent& block, int levels, bool ring)
{
  PointExtent grown = block;
  levels = std::min(levels, std::max(whole[1] - whole[0], whole[3] - whole[2]));
  const bool round = ring && (block[0] > whole[0] || block[1] < whole[1]);
  for (int side = 0; side < 4; ++side)
  {
    const int far = block[side] + (side % 2 == 0 ? -levels : levels);
    const bool free = side < 2 && round;
    grown[side] = free ? far
      : side % 2 == 0  ? std::max(far, whole[side])
                       : std::min(far, whole[side]);
  }
  return grown;
}

/// Number in the whole grid, from 0, of column i of points (cells = 0) or cells (cells = 1), which may lie any way round a ring beyond
/// its ends. The columns of points at both ends of a ring are each other's.
inline int ringColumn(const PointExtent& whole, int i, int cells)
{
  const int ring = whole[1] - whole[0];
  const int column = i - whole[0];
  const bool inside = column >= 0 && column <= ring - cells;
  return inside ? column : (column % ring + ring) % ring;
}

/// Call mark(number) for the points of an extent (cells = 0) or its cells (cells = 1) that lie outside of a block; a block's border
/// points are its own.
template <class Mark>
void markOutside(const PointExtent& extent, const PointExtent& block, int cells, Mark&& mark)
{
  long long number = 0;
  for (int k = extent[4]; k <= extent[5] - cells; ++k)
  {
    for (int j = extent[2]; j <= extent[3] - cells; ++j)
    {
      for (int i = extent[0]; i <= extent[1] - cells; ++i, ++number)
      {
        if (i < block[0] || i > block[1] - cells || j < block[2] || j > block[3] - cells)
        {
          mark(number);
        }
      }
    }
  }
}
}
#endif
