// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file ColumnTetrahedra.h
 * @brief The tetrahedra of some columns, numbered, and which of two that share a face is before the other.
 *
 * Neighbours are known from the grid's indices: of the five tetrahedra of a cell (TetrahedralSplit.h) the one in the middle
 * shares its faces with the other four, and each of these has one face in three of the cell's faces, which the tetrahedron
 * at the same grid point shares on the other side. Nothing is searched for; kept are two bytes a cell and a number for each
 * column.
 *
 * Outward is what the grid's indices and its handedness (that of most of its volume) say. A cell that is inside out where
 * most are not lies in others: no order of them is right. Cells without volume, as at a pole, are gaps to their
 * neighbours: no ray tells which side of them it is on.
 *
 * @sa CellColumns.h, VisibilityOrder.h, RayGaps.h, TestVisibilityOrder.cxx
 */
#ifndef ColumnTetrahedra_h
#define ColumnTetrahedra_h

#include "CellColumns.h"
#include "TetrahedralSplit.h"
#include "VisibilityOrder.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace nephoscope
{
class ColumnTetrahedra
{
public:
  /// The columns have to stay, and are read: their handedness and gaps are found.
  explicit ColumnTetrahedra(const CellColumns& columns);

  /// Number the tetrahedra from each column's lowest drawn cell to its highest. Returns how many there are.
  std::size_t number(const std::vector<std::uint32_t>& columns);

  /// The number of a tetrahedron, 0 to 4, of a cell of a numbered column.
  std::uint32_t number(std::size_t column, int k, int tetrahedron) const
  {
    return this->Base[column] + 5 * static_cast<std::uint32_t>(k - this->Columns.first[column]) +
      tetrahedron;
  }

  bool isDrawn(std::size_t column, int k) const
  {
    return this->Columns.drawn[this->index(column, k)] != 0;
  }

  /// Its points in CellColumns, ascending: an order on which neighbours agree.
  std::array<std::size_t, 4> points(std::size_t column, int k, int tetrahedron) const;

  Vector3 middle(std::size_t column, int k, int tetrahedron) const;

  /// Whether it has a face with nothing drawn behind, or nothing with a volume.
  bool isAtGap(std::size_t column, int k, int tetrahedron) const
  {
    return (this->Gaps[this->index(column, k)] >> tetrahedron & 1) != 0;
  }

  /// Add the relations of a numbered column's tetrahedra with each other and with the next columns along i and j.
  void relate(std::size_t column, const ViewPoint& view, CellRelations& relations) const;

private:
  static constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();

  /// A cell's place in the grid.
  struct Cell
  {
    std::size_t column;
    int k;
    int ij[2];
    int parity;
  };
  std::size_t index(std::size_t column, int k) const { return column * (this->Columns.nz - 1) + k; }
  template <class Visit>
  void forEachDrawnCell(Visit&& visit) const;
  void findVolumes();
  void findGaps();
  bool isSolid(const Cell& cell, int tetrahedron) const
  {
    return (this->Solid[this->index(cell.column, cell.k)] >> tetrahedron & 1) != 0;
  }
  Cell cell(std::size_t column, int k) const;
  /// The cell on the other side of a face; false if there is none that is drawn.
  bool step(const Cell& from, int axis, bool upward, Cell& to) const;
  std::size_t point(const Cell& cell, int vertex) const;
  const Vector3& at(const Cell& cell, int vertex) const
  {
    return this->Columns.points[this->point(cell, vertex)];
  }
  void relateInside(
    const Cell& cell, int tetrahedron, const ViewPoint& view, CellRelations& relations) const;
  void relateAcross(
    const Cell& cell, int tetrahedron, const ViewPoint& view, CellRelations& relations) const;

  const CellColumns& Columns;
  std::vector<std::uint32_t> Base; ///< [column]: number of its first tetrahedron, or None
  std::vector<std::uint8_t> Solid; ///< [cell]: a bit for each tetrahedron that has a volume
  std::vector<std::uint8_t> Gaps;  ///< [cell]: a bit for each that is at a gap
  int Handedness = 1;
};
}
#endif
