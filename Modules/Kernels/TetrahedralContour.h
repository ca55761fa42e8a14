// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file TetrahedralContour.h
 * @brief Contour triangles of a lattice whose cells are split into five tetrahedra, without making tetrahedra.
 *
 * A point is inside where its value >= the contour value. Inside is a bit, 64 points of a row at once: an edge is crossed where
 * its ends' bits differ, a cell where its corners' bits do, and the rest of the lattice is never looked at.
 *
 * Every edge belongs to the point at its low corner, which owns six: the sides along i, j and k and the diagonals of the
 * three faces. A crossed edge carries one vertex of the surface, so a vertex's id is the number of crossed edges before
 * it, found by prefix sums: no search, no merging, and the same for any number of threads. Crossed edges are not stored:
 * they follow from the bits. Along a row of cells the ids on its 13 kinds of edge only count upwards, by what a cell's
 * case says.
 *
 * Passes, each over rows of points that share (j, k), in any order and in parallel:
 *  1. classify      values to bits
 *  2. countRow      bits to crossed edges; vertices and triangles counted, after all rows are classified
 *     accumulate    prefix sums over rows, by one thread
 *  3. forEachEdge, forEachTriangle     what the caller writes its output from
 *
 * Triangles wind counter-clockwise seen from outside, the side of lower values, where i, j, k is right-handed. Two cells
 * at a face cut it along the same lines, so the surface is watertight whatever the values; where a point's value equals the
 * contour value, vertices coincide there and triangles without area keep the surface connected.
 *
 * A cell that is not valid (a corner that is not finite, a blanked point or cell) yields nothing.
 *
 * Memory: a bit a point and 56 bytes a row. @sa TetrahedralSplit.h, vtkCloudContour, TestTetrahedralContour.cxx
 */
#ifndef TetrahedralContour_h
#define TetrahedralContour_h

#include "TetrahedralSplit.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephoscope
{
/// Which of its six edges a point means, by the axes it runs along; the number of the slot.
enum EdgeSlot : std::uint8_t
{
  SideI,
  SideJ,
  SideK,
  DiagonalIJ,
  DiagonalIK,
  DiagonalJK,
  EdgeSlots
};

/// An edge of a cell: the cell's vertex (bit pattern) that owns it, and which of the owner's.
struct CellEdge
{
  std::uint8_t owner;
  std::uint8_t slot;
};

/// What a cell with some corners inside contributes. Edges are listed once; triangles refer to that list.
struct ContourCase
{
  std::uint8_t edges = 0;
  std::uint8_t triangles = 0;
  std::array<CellEdge, 18> edge{};
  std::array<std::array<std::uint8_t, 3>, 10> triangle{};
};

/// @param parity of the cell, 0 or 1  @param inside bit v is set where cell vertex v is inside
const ContourCase& contourCase(int parity, unsigned inside);

/**
 * A case as a walk along a row of cells needs it. The edges of a row of cells, without those that differ by a step along i, are 13
 * streams: the slots of the four rows of points. A cell has an edge of each, and of five a second, one step on.
 */
struct StreamCase
{
  std::array<std::uint8_t, 16> crossed{}; ///< 1 for the streams whose edge is crossed
  std::uint8_t triangles = 0;
  std::array<std::array<std::uint8_t, 3>, 10> triangle{}; ///< streams; 16 more for one step on
};
using StreamCases = std::array<std::array<StreamCase, 256>, 2>;
const StreamCases& streamCases(); ///< [parity][inside]

/// Which row of points of a cell, j + 2 k, and which slot a stream is.
struct EdgeStream
{
  std::uint8_t row;
  std::uint8_t slot;
};
constexpr int Streams = 13;
constexpr EdgeStream StreamEdges[Streams] = { { 0, SideI }, { 0, SideJ }, { 0, SideK },
  { 0, DiagonalIJ }, { 0, DiagonalIK }, { 0, DiagonalJK }, { 1, SideI }, { 1, SideK },
  { 1, DiagonalIK }, { 2, SideI }, { 2, SideJ }, { 2, DiagonalIJ }, { 3, SideI } };

/// The two corners, as bit patterns from the owner, that an edge joins; the first is where interpolation starts.
constexpr std::array<std::uint8_t, 2> edgeEnds(int slot, int ownerParity)
{
  constexpr std::uint8_t Sides[3] = { 1, 2, 4 };
  constexpr std::uint8_t Diagonals[3][2] = { { 1, 2 }, { 1, 4 }, { 2, 4 } };
  if (slot < DiagonalIJ)
  {
    return { 0, Sides[slot] };
  }
  const auto& d = Diagonals[slot - DiagonalIJ];
  if (ownerParity == 0)
  {
    return { 0, static_cast<std::uint8_t>(d[0] | d[1]) };
  }
  return { d[0], d[1] };
}

using Index = std::int64_t;
using Bits = std::uint64_t;

/// The lattice's extent. Row r is the points with (j, k) = (r % n[1], r / n[1]).
struct LatticeShape
{
  std::array<int, 3> n{ 0, 0, 0 }; ///< points along i, j, k, each >= 2
  int parity = 0;                  ///< (i + j + k) & 1 of the first point in the whole grid
  bool closed = false; ///< the last point of each row is the first again; n[0] - 1 must be even

  Index rows() const { return Index(n[1]) * n[2]; }
  Index words() const { return (Index(n[0]) + 63) / 64; }
  int rowParity(int j, int k) const { return splitParity(j, k, parity); }
};

/// One bit for each point (or cell, at its low corner), in rows of whole words; what lies past a row's end is 0.
class LatticeBits
{
public:
  explicit LatticeBits(const LatticeShape& shape)
    : Words(shape.words())
    , Data(static_cast<std::size_t>(shape.rows() * shape.words()))
  {
  }
  Bits* row(Index r) { return this->Data.data() + r * this->Words; }
  const Bits* row(Index r) const { return this->Data.data() + r * this->Words; }
  bool test(Index r, int i) const { return this->row(r)[i / 64] >> (i % 64) & 1; }

private:
  Index Words;
  std::vector<Bits> Data;
};

/// Cells whose eight corners are usable, from points that are. @param cells in and out: cells that may be used
void restrictToUsablePoints(
  const LatticeShape& shape, const LatticeBits& points, Index row, LatticeBits& cells);

/// The surface for one value.
class ContourLevel
{
public:
  /// @param valid cells that count, one bit at each low corner; null for all. Must outlive this.
  ContourLevel(const LatticeShape& shape, const LatticeBits* valid);

  /**
   * Pass 1.
   * @param value finite; compared exactly whatever T
   * @param least,greatest bounds of each 64 values of the row, or null: where they do not enclose the value, values are not read
   */
  template <class T>
  void classify(
    Index row, const T* values, T value, const T* least = nullptr, const T* greatest = nullptr)
  {
    Bits* out = this->Inside.row(row);
    const int n = this->Shape.n[0];
    for (int first = 0; first < n; first += 64)
    {
      const int count = n - first < 64 ? n - first : 64;
      const bool none = greatest && greatest[first / 64] < value;
      const bool all = least && least[first / 64] >= value;
      out[first / 64] = none ? 0
        : all                ? ~Bits(0) >> (64 - count)
                             : atLeast(values + first, count, value);
    }
    if (this->Shape.closed)
    {
      Bits& last = out[(n - 1) / 64];
      const Bits bit = Bits(1) << ((n - 1) % 64);
      last = (out[0] & 1) ? last | bit : last & ~bit;
    }
  }

  void countRow(Index row); ///< pass 2
  void accumulate();        ///< after pass 2: ids and numbers are known from here on

  Index numberOfVertices() const { return this->FirstVertex.back(); }
  Index numberOfTriangles() const { return this->FirstTriangle.back(); }
  Index firstTriangle(Index row) const { return this->FirstTriangle[row]; }

  /// Pass 3. Calls f(id, i, slot) for each crossed edge that a point of the row owns. Ids run along i, slot after slot.
  template <class F>
  void forEachEdge(Index row, F&& f) const
  {
    std::array<Index, EdgeSlots> id;
    std::copy_n(&this->FirstVertex[row * EdgeSlots], EdgeSlots, id.begin());
    for (Index w = 0; w < this->Words; ++w)
    {
      const SlotBits edges = this->edges(row, w);
      for (int slot = 0; slot < EdgeSlots; ++slot)
      {
        for (Bits left = edges[slot]; left != 0; left &= left - 1)
        {
          f(id[slot]++, static_cast<int>(64 * w) + __builtin_ctzll(left), slot);
        }
      }
    }
  }

  /// Points of a word that are ends of crossed edges, and maybe others where cells do not count.
  Bits endsOfCrossedEdges(Index row, Index word) const;

  /// Pass 3. Calls f(id0, id1, id2), of type Id, for each triangle of the row's cells, in order.
  template <class Id = Index, class F>
  void forEachTriangle(Index row, F&& f) const
  {
    const int j = static_cast<int>(row % this->Shape.n[1]);
    const int k = static_cast<int>(row / this->Shape.n[1]);
    if (j + 1 >= this->Shape.n[1] || k + 1 >= this->Shape.n[2])
    {
      return;
    }
    const int parity = this->Shape.rowParity(j, k);
    const StreamCases& cases = streamCases();
    const Index end = this->Shape.closed ? this->Shape.n[0] - 2 : -1; // the cell before the seam
    const std::array<Id, 16> first = this->template firstIds<Id>(row);
    std::array<Id, 16> wordStart = first;
    std::array<Id, 32> ids; // of the streams at this cell, and one step on
    std::copy(first.begin(), first.end(), ids.begin() + 16);
    for (Index w = 0; w < this->Words; ++w)
    {
      const StreamBits streams = this->Valid ? this->streamBits(row, w) : StreamBits{};
      const Corners corners = this->corners(row, w);
      for (Bits left = this->crossed(corners, row, w); left != 0; left &= left - 1)
      {
        const int bit = __builtin_ctzll(left);
        const StreamCase& c = cases[(parity + bit) & 1][corners.inside(bit)];
        std::copy_n(ids.begin() + 16, 16, ids.begin());
        if (this->Valid)
        {
          countIds(streams, (Bits(1) << bit) - 1, wordStart.data(), ids.data());
        }
        for (int s = 0; s < 16; ++s)
        {
          ids[16 + s] = ids[s] + static_cast<Id>(c.crossed[s]);
        }
        if (64 * w + bit == end)
        {
          std::copy(first.begin(), first.end(), ids.begin() + 16);
        }
        for (int t = 0; t < c.triangles; ++t)
        {
          f(ids[c.triangle[t][0]], ids[c.triangle[t][1]], ids[c.triangle[t][2]]);
        }
      }
      if (this->Valid)
      {
        countIds(streams, ~Bits(0), wordStart.data(), wordStart.data());
      }
    }
  }

private:
  /// The inside bits of a row's cells at their eight vertices.
  struct Corners
  {
    Bits bits[8];
    unsigned inside(int bit) const
    {
      unsigned mask = 0;
      for (int v = 0; v < 8; ++v)
      {
        mask |= static_cast<unsigned>(this->bits[v] >> bit & 1) << v;
      }
      return mask;
    }
  };

  using SlotBits = std::array<Bits, EdgeSlots>;
  using StreamBits = std::array<Bits, Streams>;

  Corners corners(Index row, Index word) const;
  Bits crossed(const Corners& corners, Index row, Index word) const;
  Bits cellsOfWord(Index word) const;
  SlotBits edges(Index row, Index word) const;
  void keepEdgesOfValidCells(Index row, Index word, SlotBits& edges) const;
  StreamBits streamBits(Index row, Index word) const;
  Bits validCells(int j, int k, Index word) const;
  Bits validCellsEitherSide(int j, int k, Index word) const;
  Index trianglesOf(Index row) const;

  /// The ids that the streams of a row of cells start with.
  template <class Id>
  std::array<Id, 16> firstIds(Index row) const
  {
    std::array<Id, 16> ids{};
    for (int s = 0; s < Streams; ++s)
    {
      const EdgeStream e = StreamEdges[s];
      const Index owner = row + (e.row & 1) + (e.row >> 1) * Index(this->Shape.n[1]);
      ids[s] = static_cast<Id>(this->FirstVertex[owner * EdgeSlots + e.slot]);
    }
    return ids;
  }

  /// ids = start + crossed edges under the mask, for each stream: where cells do not count, ids may jump.
  template <class Id>
  static void countIds(const StreamBits& streams, Bits mask, const Id* start, Id* ids)
  {
    for (int s = 0; s < Streams; ++s)
    {
      ids[s] = start[s] + static_cast<Id>(count(streams[s] & mask));
    }
  }

  template <class T>
  static Bits atLeast(const T* values, int count, T value)
  {
    Bits word = 0;
    for (int b = 0; b < count; ++b)
    {
      word |= static_cast<Bits>(values[b] >= value) << b;
    }
    return word;
  }

  static int count(Bits b)
  {
    // Without a call, whatever the instruction set.
    b -= b >> 1 & 0x5555555555555555;
    b = (b & 0x3333333333333333) + (b >> 2 & 0x3333333333333333);
    b = (b + (b >> 4)) & 0x0f0f0f0f0f0f0f0f;
    return static_cast<int>(b * 0x0101010101010101 >> 56);
  }

  LatticeShape Shape;
  Index Words;
  const LatticeBits* Valid;
  LatticeBits Inside;
  std::vector<Index> FirstVertex;   // of each row's slots, and the total
  std::vector<Index> FirstTriangle; // of each row, and the total
};
}
#endif
