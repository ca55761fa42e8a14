// SPDX-License-Identifier: BSD-3-Clause
#include "ColumnTetrahedra.h"

#include <algorithm>

namespace nephoscope
{
namespace
{
/// The tetrahedron of a split that has a vertex of the cell for its own.
int tetrahedronOf(int parity, int vertex)
{
  int t = 1;
  while (t < 4 && TetrahedralSplit[parity][t][0] != vertex)
  {
    ++t;
  }
  return t;
}

/// Add the relation that a side tells: 1 if the eye is on the side of the first.
void add(CellRelations& relations, int side, std::uint32_t first, std::uint32_t second)
{
  if (side != 0)
  {
    relations.push_back(side > 0 ? CellRelation{ first, second } : CellRelation{ second, first });
  }
}
}

ColumnTetrahedra::ColumnTetrahedra(const CellColumns& columns)
  : Columns(columns)
  , Solid(columns.drawn.size(), 0)
  , Gaps(columns.drawn.size(), 0)
{
  this->findVolumes();
  this->findGaps();
}

template <class Visit>
void ColumnTetrahedra::forEachDrawnCell(Visit&& visit) const
{
  for (std::size_t column = 0; column < this->Columns.numberOfColumns(); ++column)
  {
    for (int k = this->Columns.first[column]; k < this->Columns.last[column]; ++k)
    {
      if (this->isDrawn(column, k))
      {
        visit(this->cell(column, k));
      }
    }
  }
}

void ColumnTetrahedra::findVolumes()
{
  constexpr double Thin = 1e-9; // less than this part of the box of its edges is next to nothing
  double sum = 0;
  this->forEachDrawnCell(
    [this, &sum](const Cell& c)
    {
      for (int t = 0; t < 5; ++t)
      {
        const TetrahedronVertices& v = TetrahedralSplit[c.parity][t];
        const Vector3 e1 = this->at(c, v[1]) - this->at(c, v[0]);
        const Vector3 e2 = this->at(c, v[2]) - this->at(c, v[0]);
        const Vector3 e3 = this->at(c, v[3]) - this->at(c, v[0]);
        const double volume = dot(e1, cross(e2, e3));
        const bool solid = std::abs(volume) > Thin * length(e1) * length(e2) * length(e3);
        this->Solid[this->index(c.column, c.k)] |= solid ? 1 << t : 0;
        sum += volume;
      }
    });
  this->Handedness = sum < 0 ? -1 : 1;
}

void ColumnTetrahedra::findGaps()
{
  this->forEachDrawnCell(
    [this](const Cell& c)
    {
      constexpr int All = 31;
      int gaps = this->Solid[this->index(c.column, c.k)] == All ? 0 : All;
      for (int t = 1; t < 5; ++t)
      {
        const int own = TetrahedralSplit[c.parity][t][0];
        for (int axis = 0; axis < 3; ++axis)
        {
          Cell other;
          const bool met = this->step(c, axis, (own >> axis & 1) != 0, other) &&
            this->isSolid(other, tetrahedronOf(other.parity, own ^ 1 << axis));
          gaps |= met ? 0 : 1 << t;
        }
      }
      this->Gaps[this->index(c.column, c.k)] = static_cast<std::uint8_t>(gaps);
    });
}

std::size_t ColumnTetrahedra::number(const std::vector<std::uint32_t>& columns)
{
  this->Base.assign(this->Columns.numberOfColumns(), None);
  std::size_t count = 0;
  for (const std::uint32_t column : columns)
  {
    this->Base[column] = static_cast<std::uint32_t>(count);
    count += 5 * static_cast<std::size_t>(this->Columns.last[column] - this->Columns.first[column]);
  }
  return count;
}

ColumnTetrahedra::Cell ColumnTetrahedra::cell(std::size_t column, int k) const
{
  const std::size_t across = static_cast<std::size_t>(this->Columns.nx) - 1;
  const int i = static_cast<int>(column % across);
  const int j = static_cast<int>(column / across);
  return { column, k, { i, j },
    splitParity(this->Columns.parity + static_cast<long long>(i), j, k) };
}

bool ColumnTetrahedra::step(const Cell& from, int axis, bool upward, Cell& to) const
{
  const int sizes[3] = { this->Columns.nx - 1, this->Columns.ny - 1, this->Columns.nz - 1 };
  int index[3] = { from.ij[0], from.ij[1], from.k };
  index[axis] += upward ? 1 : -1;
  if (index[axis] < 0 || index[axis] >= sizes[axis])
  {
    return false;
  }
  const std::size_t column = static_cast<std::size_t>(index[1]) * sizes[0] + index[0];
  to = { column, index[2], { index[0], index[1] }, 1 - from.parity };
  return this->isDrawn(column, index[2]);
}

std::size_t ColumnTetrahedra::point(const Cell& cell, int vertex) const
{
  const auto i = static_cast<std::size_t>(cell.ij[0] + (vertex & 1));
  const auto j = static_cast<std::size_t>(cell.ij[1] + (vertex >> 1 & 1));
  return (j * this->Columns.nx + i) * this->Columns.nz + cell.k + (vertex >> 2);
}

std::array<std::size_t, 4> ColumnTetrahedra::points(
  std::size_t column, int k, int tetrahedron) const
{
  const Cell c = this->cell(column, k);
  std::array<std::size_t, 4> all{};
  for (std::size_t n = 0; n < 4; ++n)
  {
    all[n] = this->point(c, TetrahedralSplit[c.parity][tetrahedron][n]);
  }
  std::sort(all.begin(), all.end());
  return all;
}

Vector3 ColumnTetrahedra::middle(std::size_t column, int k, int tetrahedron) const
{
  Vector3 sum{ 0, 0, 0 };
  for (const std::size_t point : this->points(column, k, tetrahedron))
  {
    sum = sum + 0.25 * this->Columns.points[point];
  }
  return sum;
}

void ColumnTetrahedra::relateInside(
  const Cell& c, int tetrahedron, const ViewPoint& view, CellRelations& relations) const
{
  const TetrahedronVertices& t = TetrahedralSplit[c.parity][tetrahedron];
  const int side =
    this->Handedness * view.side(this->at(c, t[1]), this->at(c, t[2]), this->at(c, t[3]));
  add(relations, side, this->number(c.column, c.k, 0), this->number(c.column, c.k, tetrahedron));
}

/// The faces in the cell's upper sides; those in its lower ones are the next cell's to look at.
void ColumnTetrahedra::relateAcross(
  const Cell& c, int tetrahedron, const ViewPoint& view, CellRelations& relations) const
{
  const TetrahedronVertices& t = TetrahedralSplit[c.parity][tetrahedron];
  const int own = t[0];
  for (std::size_t n = 0; n < 3; ++n)
  {
    const int bit =
      own ^ t[1 + n];          // the face opposite this corner lies in the side that `own` is on
    const int axis = bit >> 1; // 1, 2, 4 to 0, 1, 2
    Cell other;
    if ((own & bit) == 0 || !this->step(c, axis, true, other) || this->Base[other.column] == None)
    {
      continue;
    }
    const int side = this->Handedness *
      view.side(this->at(c, own), this->at(c, t[1 + (n + 1) % 3]), this->at(c, t[1 + (n + 2) % 3]));
    add(relations, side, this->number(c.column, c.k, tetrahedron),
      this->number(other.column, other.k, tetrahedronOf(other.parity, own ^ bit)));
  }
}

void ColumnTetrahedra::relate(
  std::size_t column, const ViewPoint& view, CellRelations& relations) const
{
  for (int k = this->Columns.first[column]; k < this->Columns.last[column]; ++k)
  {
    if (this->isDrawn(column, k))
    {
      const Cell c = this->cell(column, k);
      for (int t = 1; t < 5; ++t)
      {
        this->relateInside(c, t, view, relations);
        this->relateAcross(c, t, view, relations);
      }
    }
  }
}
}
