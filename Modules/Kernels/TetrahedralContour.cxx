// SPDX-License-Identifier: BSD-3-Clause
#include "TetrahedralContour.h"

#include <algorithm>

namespace nephoscope
{
namespace
{
/// The edge between two vertices of a cell: the low corner of what both span owns it.
CellEdge edgeBetween(int a, int b)
{
  constexpr std::uint8_t SlotOfAxes[8] = { 0, SideI, SideJ, DiagonalIJ, SideK, DiagonalIK,
    DiagonalJK, 0 };
  return { static_cast<std::uint8_t>(a & b), SlotOfAxes[a ^ b] };
}

/// Collects one case's edges and triangles.
class CaseBuilder
{
public:
  explicit CaseBuilder(ContourCase& result)
    : Result(result)
  {
  }

  void addTetrahedron(const TetrahedronVertices& t, unsigned inside)
  {
    unsigned mask = 0;
    for (int c = 0; c < 4; ++c)
    {
      mask |= (inside >> t[c] & 1) << c;
    }
    // Even permutations that bring the corners inside (or the one outside) to the front keep the orientation.
    static constexpr std::uint8_t One[4][4] = { { 0, 1, 2, 3 }, { 1, 0, 3, 2 }, { 2, 3, 0, 1 },
      { 3, 2, 1, 0 } };
    static constexpr std::uint8_t Two[16][4] = { {}, {}, {}, { 0, 1, 2, 3 }, {}, { 0, 2, 3, 1 },
      { 1, 2, 0, 3 }, {}, {}, { 0, 3, 1, 2 }, { 1, 3, 2, 0 }, {}, { 2, 3, 0, 1 }, {}, {}, {} };
    for (int c = 0; c < 4; ++c)
    {
      const int a = t[One[c][0]];
      const int b = t[One[c][1]];
      const int d = t[One[c][2]];
      const int e = t[One[c][3]];
      if (mask == 1U << c)
      {
        this->addTriangle(edgeBetween(a, b), edgeBetween(a, d), edgeBetween(a, e));
      }
      if (mask == (15U ^ 1U << c))
      {
        this->addTriangle(edgeBetween(a, b), edgeBetween(a, e), edgeBetween(a, d));
      }
    }
    const std::uint8_t* p = Two[mask];
    if (p[0] != p[1])
    {
      const CellEdge ac = edgeBetween(t[p[0]], t[p[2]]);
      const CellEdge ad = edgeBetween(t[p[0]], t[p[3]]);
      const CellEdge bc = edgeBetween(t[p[1]], t[p[2]]);
      const CellEdge bd = edgeBetween(t[p[1]], t[p[3]]);
      this->addTriangle(ac, ad, bd);
      this->addTriangle(ac, bd, bc);
    }
  }

private:
  std::uint8_t listed(CellEdge edge)
  {
    for (std::uint8_t e = 0; e < this->Result.edges; ++e)
    {
      if (this->Result.edge[e].owner == edge.owner && this->Result.edge[e].slot == edge.slot)
      {
        return e;
      }
    }
    this->Result.edge[this->Result.edges] = edge;
    return this->Result.edges++;
  }
  void addTriangle(CellEdge a, CellEdge b, CellEdge c)
  {
    this->Result.triangle[this->Result.triangles++] = { this->listed(a), this->listed(b),
      this->listed(c) };
  }

  ContourCase& Result;
};

std::array<std::array<ContourCase, 256>, 2> allCases()
{
  std::array<std::array<ContourCase, 256>, 2> cases;
  for (int parity = 0; parity < 2; ++parity)
  {
    for (unsigned inside = 0; inside < 256; ++inside)
    {
      CaseBuilder builder(cases[parity][inside]);
      for (const TetrahedronVertices& t : TetrahedralSplit[parity])
      {
        builder.addTetrahedron(t, inside);
      }
    }
  }
  return cases;
}

const std::array<std::array<ContourCase, 256>, 2> Cases = allCases();

/// The number of the stream that the cell's edge is in, 16 more where it is one step on.
std::uint8_t streamOf(CellEdge edge)
{
  std::uint8_t stream = 0;
  while (StreamEdges[stream].row != edge.owner >> 1 || StreamEdges[stream].slot != edge.slot)
  {
    ++stream;
  }
  return static_cast<std::uint8_t>(stream + 16 * (edge.owner & 1));
}

StreamCases allStreamCases()
{
  StreamCases cases;
  for (int parity = 0; parity < 2; ++parity)
  {
    for (unsigned inside = 0; inside < 256; ++inside)
    {
      const ContourCase& from = contourCase(parity, inside);
      StreamCase& to = cases[parity][inside];
      for (int e = 0; e < from.edges; ++e)
      {
        const std::uint8_t stream = streamOf(from.edge[e]);
        to.crossed[stream % 16] |= static_cast<std::uint8_t>(stream < 16);
      }
      to.triangles = from.triangles;
      for (int t = 0; t < from.triangles; ++t)
      {
        for (int c = 0; c < 3; ++c)
        {
          to.triangle[t][c] = streamOf(from.edge[from.triangle[t][c]]);
        }
      }
    }
  }
  return cases;
}

/// The word's bits moved up by one, the last word's last coming in: each point's neighbour at i - 1.
Bits previous(const Bits* row, Index word)
{
  return row[word] << 1 | (word > 0 ? row[word - 1] >> 63 : 0);
}

/// The word's bits moved down by one, the next word's first coming in: each point's neighbour at i + 1.
Bits next(const Bits* row, Index word, Index words)
{
  return row[word] >> 1 | (word + 1 < words ? row[word + 1] << 63 : 0);
}

/// Bits first to last - 1 of a row, as far as they are in this word.
Bits firstBits(Index count, Index word)
{
  const Index here = std::min<Index>(std::max<Index>(count - 64 * word, 0), 64);
  return here == 64 ? ~Bits(0) : (Bits(1) << here) - 1;
}
}

const ContourCase& contourCase(int parity, unsigned inside)
{
  return Cases[parity][inside];
}

const StreamCases& streamCases()
{
  static const StreamCases All = allStreamCases();
  return All;
}

void restrictToUsablePoints(
  const LatticeShape& shape, const LatticeBits& points, Index row, LatticeBits& cells)
{
  const Index words = shape.words();
  const bool last = row % shape.n[1] == shape.n[1] - 1 || row / shape.n[1] == shape.n[2] - 1;
  for (Index w = 0; w < words; ++w)
  {
    Bits usable = last ? 0 : firstBits(shape.n[0] - 1, w);
    for (int v = 0; v < 4 && !last; ++v)
    {
      const Bits* p = points.row(row + (v & 1) + (v >> 1) * Index(shape.n[1]));
      usable &= p[w] & next(p, w, words);
    }
    cells.row(row)[w] &= usable;
  }
}

ContourLevel::ContourLevel(const LatticeShape& shape, const LatticeBits* valid)
  : Shape(shape)
  , Words(shape.words())
  , Valid(valid)
  , Inside(shape)
  , FirstVertex(static_cast<std::size_t>(shape.rows() * EdgeSlots + 1))
  , FirstTriangle(static_cast<std::size_t>(shape.rows() + 1))
{
}

Bits ContourLevel::cellsOfWord(Index word) const
{
  return firstBits(this->Shape.n[0] - 1, word);
}

ContourLevel::Corners ContourLevel::corners(Index row, Index word) const
{
  Corners c;
  for (int v = 0; v < 8; v += 2)
  {
    const Bits* r = this->Inside.row(row + (v >> 1 & 1) + (v >> 2) * Index(this->Shape.n[1]));
    c.bits[v] = r[word];
    c.bits[v + 1] = next(r, word, this->Words);
  }
  return c;
}

Bits ContourLevel::crossed(const Corners& c, Index row, Index word) const
{
  Bits any = 0;
  Bits all = ~Bits(0);
  for (Bits b : c.bits)
  {
    any |= b;
    all &= b;
  }
  const Bits cells = this->Valid ? this->Valid->row(row)[word] : this->cellsOfWord(word);
  return any & ~all & cells;
}

void ContourLevel::countRow(Index row)
{
  Index* vertices = &this->FirstVertex[row * EdgeSlots + 1];
  std::fill_n(vertices, EdgeSlots, 0);
  for (Index w = 0; w < this->Words; ++w)
  {
    const SlotBits bits = this->edges(row, w);
    for (int slot = 0; slot < EdgeSlots; ++slot)
    {
      vertices[slot] += count(bits[slot]);
    }
  }
  this->FirstTriangle[row + 1] = this->trianglesOf(row);
}

ContourLevel::SlotBits ContourLevel::edges(Index row, Index w) const
{
  const auto& n = this->Shape.n;
  const int j = static_cast<int>(row % n[1]);
  const int k = static_cast<int>(row / n[1]);
  const Bits hasJ = j + 1 < n[1] ? ~Bits(0) : 0;
  const Bits hasK = k + 1 < n[2] ? ~Bits(0) : 0;
  // Words start at multiples of 64, so one pattern marks the even points of the whole row.
  const Bits even = 0x5555555555555555 << this->Shape.rowParity(j, k);
  const Bits* r00 = this->Inside.row(row);
  const Bits* r10 = hasJ ? this->Inside.row(row + 1) : r00;
  const Bits* r01 = hasK ? this->Inside.row(row + n[1]) : r00;
  const Bits* r11 = hasJ && hasK ? this->Inside.row(row + n[1] + 1) : r00;
  const Bits a = r00[w];
  const Bits a1 = next(r00, w, this->Words);
  const Bits b = r10[w];
  const Bits b1 = next(r10, w, this->Words);
  const Bits c = r01[w];
  const Bits c1 = next(r01, w, this->Words);
  const Bits d = r11[w];
  const Bits inRow = this->cellsOfWord(w);
  const Bits across = firstBits(n[0] - (this->Shape.closed ? 1 : 0), w);
  SlotBits bits = { (a ^ a1) & inRow, (a ^ b) & across & hasJ, (a ^ c) & across & hasK,
    ((even & (a ^ b1)) | (~even & (a1 ^ b))) & inRow & hasJ,
    ((even & (a ^ c1)) | (~even & (a1 ^ c))) & inRow & hasK,
    ((even & (a ^ d)) | (~even & (b ^ c))) & across & hasJ & hasK };
  if (this->Valid)
  {
    this->keepEdgesOfValidCells(row, w, bits);
  }
  return bits;
}

ContourLevel::StreamBits ContourLevel::streamBits(Index row, Index word) const
{
  SlotBits bits[4];
  for (int r = 0; r < 4; ++r)
  {
    bits[r] = this->edges(row + (r & 1) + (r >> 1) * Index(this->Shape.n[1]), word);
  }
  StreamBits streams;
  for (int s = 0; s < Streams; ++s)
  {
    streams[s] = bits[StreamEdges[s].row][StreamEdges[s].slot];
  }
  return streams;
}

Bits ContourLevel::endsOfCrossedEdges(Index row, Index word) const
{
  const auto& n = this->Shape.n;
  const int j = static_cast<int>(row % n[1]);
  const int k = static_cast<int>(row / n[1]);
  const Bits* here = this->Inside.row(row);
  const Bits a = here[word];
  Bits sides = (a ^ next(here, word, this->Words)) | (a ^ previous(here, word));
  Bits diagonals = 0; // they join even points
  for (int dk = k > 0 ? -1 : 0; dk <= (k + 1 < n[2] ? 1 : 0); ++dk)
  {
    for (int dj = j > 0 ? -1 : 0; dj <= (j + 1 < n[1] ? 1 : 0); ++dj)
    {
      const Bits* there = this->Inside.row(row + dj + dk * Index(n[1]));
      const Bits differ = a ^ there[word];
      if (dj == 0 || dk == 0)
      {
        sides |= differ;
        diagonals |= (a ^ next(there, word, this->Words)) | (a ^ previous(there, word));
      }
      else
      {
        diagonals |= differ;
      }
    }
  }
  const Bits even = 0x5555555555555555 << this->Shape.rowParity(j, k);
  return (sides | (diagonals & even)) & firstBits(n[0], word);
}

Bits ContourLevel::validCells(int j, int k, Index word) const
{
  const auto& n = this->Shape.n;
  return j < 0 || k < 0 || j + 1 >= n[1] || k + 1 >= n[2]
    ? 0
    : this->Valid->row(j + Index(k) * n[1])[word];
}

Bits ContourLevel::validCellsEitherSide(int j, int k, Index word) const
{
  const Bits here = this->validCells(j, k, word);
  Bits before = here << 1;
  if (word > 0)
  {
    before |= this->validCells(j, k, word - 1) >> 63;
  }
  else if (this->Shape.closed)
  {
    const int last = this->Shape.n[0] - 2;
    before |= this->validCells(j, k, last / 64) >> (last % 64) & 1;
  }
  return here | before;
}

void ContourLevel::keepEdgesOfValidCells(Index row, Index w, SlotBits& bits) const
{
  const int j = static_cast<int>(row % this->Shape.n[1]);
  const int k = static_cast<int>(row / this->Shape.n[1]);
  const Bits c00 = this->validCells(j, k, w);
  const Bits c10 = this->validCells(j - 1, k, w);
  const Bits c01 = this->validCells(j, k - 1, w);
  const Bits c11 = this->validCells(j - 1, k - 1, w);
  const Bits s00 = this->validCellsEitherSide(j, k, w);
  bits[SideI] &= c00 | c10 | c01 | c11;
  bits[SideJ] &= s00 | this->validCellsEitherSide(j, k - 1, w);
  bits[SideK] &= s00 | this->validCellsEitherSide(j - 1, k, w);
  bits[DiagonalIJ] &= c00 | c01;
  bits[DiagonalIK] &= c00 | c10;
  bits[DiagonalJK] &= s00;
}

Index ContourLevel::trianglesOf(Index row) const
{
  Index triangles = 0;
  const int j = static_cast<int>(row % this->Shape.n[1]);
  const int k = static_cast<int>(row / this->Shape.n[1]);
  const int parity = this->Shape.rowParity(j, k);
  const bool cells = j + 1 < this->Shape.n[1] && k + 1 < this->Shape.n[2];
  const StreamCases& cases = streamCases();
  for (Index w = 0; cells && w < this->Words; ++w)
  {
    const Corners c = this->corners(row, w);
    for (Bits left = this->crossed(c, row, w); left != 0; left &= left - 1)
    {
      const int bit = __builtin_ctzll(left);
      triangles += cases[(parity + bit) & 1][c.inside(bit)].triangles;
    }
  }
  return triangles;
}

void ContourLevel::accumulate()
{
  for (std::size_t r = 1; r < this->FirstVertex.size(); ++r)
  {
    this->FirstVertex[r] += this->FirstVertex[r - 1];
  }
  for (std::size_t r = 1; r < this->FirstTriangle.size(); ++r)
  {
    this->FirstTriangle[r] += this->FirstTriangle[r - 1];
  }
}
}
