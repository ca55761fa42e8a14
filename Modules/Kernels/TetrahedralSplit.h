// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file TetrahedralSplit.h
 * @brief The two splits of a hexahedral cell into five tetrahedra, alternating so that neighbours agree.
 *
 * Max 1994, "2-D Cloud Surfaces": each cell of the grid is divided into five tetrahedra, one in the middle and one at
 * each of four corners. The middle one joins every second corner, so there are two splits, mirror images of each other;
 * a cell takes the one of the parity of i+j+k, and both cells at a face then draw the same diagonal.
 *
 * Vertices of a cell are numbered by bit pattern: vertex v of cell (i, j, k) is the grid point
 * (i + (v & 1), j + (v >> 1 & 1), k + (v >> 2 & 1)). This is VTK_VOXEL's order, not VTK_HEXAHEDRON's.
 *
 * The rule in global terms: every face diagonal joins two grid points whose i+j+k is even, whatever the cell.
 *
 * Orientation: each tetrahedron (a, b, c, d) has det(b - a, c - a, d - a) > 0 where i, j, k is right-handed in space;
 * where the grid is left-handed, all are negative.
 *
 * @sa TestTetrahedralSplit.cxx
 */
#ifndef TetrahedralSplit_h
#define TetrahedralSplit_h

#include <array>
#include <cstdint>

namespace nephoscope
{
using TetrahedronVertices = std::array<std::uint8_t, 4>; ///< cell vertices by bit pattern
using HexahedronSplit = std::array<TetrahedronVertices, 5>;

/// Which split a cell takes: 0 or 1. Indices are >= 0 and global, so that pieces of one grid agree.
constexpr int splitParity(long long i, long long j, long long k)
{
  return static_cast<int>((i + j + k) & 1);
}

/// [parity][tetrahedron][corner]; tetrahedron 0 is the one in the middle, with a third of a cube's volume.
inline constexpr std::array<HexahedronSplit, 2> TetrahedralSplit = { {
  { { { 0, 5, 3, 6 }, { 1, 3, 0, 5 }, { 2, 0, 3, 6 }, { 4, 6, 5, 0 }, { 7, 5, 6, 3 } } },
  { { { 7, 4, 2, 1 }, { 0, 1, 2, 4 }, { 3, 2, 1, 7 }, { 5, 4, 7, 1 }, { 6, 7, 4, 2 } } },
} };
}
#endif
