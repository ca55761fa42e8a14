// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file CellColumns.h
 * @brief The cells of a structured grid, column by column, and the segments that a column adds to a deep tile.
 *
 * Every hexahedral cell is five tetrahedra (TetrahedralSplit.h), as in the contour, and each tetrahedron that a pixel's ray
 * meets is one segment (TetrahedronRays.h), with the linear extinction that it has. No order of cells is needed: the deep
 * pixel sorts segments, whatever the mesh.
 *
 * @sa vtkCloudCellVolume, TestCellColumns.cxx
 */
#ifndef CellColumns_h
#define CellColumns_h

#include "TetrahedronScan.h"
#include "Vector3.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephoscope
{
/**
 * @brief What does not depend on the camera: points and extinctions, with the points of a vertical line next to each other.
 *
 * nx, ny, nz points; (nx-1) (ny-1) columns of nz-1 cells.
 */
struct CellColumns
{
  int nx = 0;
  int ny = 0;
  int nz = 0;
  int parity = 0;                  ///< splitParity of the first cell
  std::vector<Vector3> points;     ///< [(j nx + i) nz + k], scene units
  std::vector<float> extinction;   ///< like points, per scene unit, usableExtinction or NaN
  std::vector<RGB> color;          ///< like points, linear RGB; empty if the cloud has one colour
  std::vector<std::uint8_t> drawn; ///< [column (nz-1) + k]: whether the cell is not empty
  std::vector<int> first;          ///< [column]: lowest drawn cell
  std::vector<int> last; ///< [column]: one above the highest drawn cell; first if there is none

  std::size_t numberOfColumns() const
  {
    return static_cast<std::size_t>(this->nx - 1) * static_cast<std::size_t>(this->ny - 1);
  }
  int numberOfDrawnCells(std::size_t column) const;
  void resize(int x, int y, int z);
  /// Finish a column whose extinctions are known: cells with a NaN, or with nothing but zeros, are not drawn, nor those
  /// whose `drawn` was 0 before.
  void classify(std::size_t column);
};

/// One column as a camera sees it. Make one for each thread and turn it to column after column.
class ColumnRays
{
public:
  /// @param width, height of the image, pixels
  ColumnRays(const CellColumns& columns, const RaySpace& space, int width, int height);

  /// Turn to a column.
  void look(std::size_t column);

  /// The pixels that its drawn cells may touch.
  PixelBox box() const;

  /// Whether one of its cells may touch a tile before what is opaque there.
  bool touches(int k, const TileRays& rays) const { return this->touches(this->cell(k), rays); }

  /// Add its segments to the tile. The source is one of DeepTile::addSource, kappa of Max 1994 eq. 5-7, for a cloud of one
  /// colour.
  void emit(DeepTile& tile, const TileRays& rays, std::uint32_t source) const;

private:
  struct Cell
  {
    const RayCorner* corner[8]; ///< by bit pattern
    float extinction[8];
    const RGB* color[8]; ///< null if there is one colour
  };

  Cell cell(int k) const;
  bool touches(const Cell& cell, const TileRays& rays) const;
  template <bool Parallel>
  void emitCells(DeepTile& tile, const TileRays& rays, std::uint32_t source) const;

  const CellColumns& Columns;
  TetrahedronScan Scan;
  std::size_t Column = 0;
  int Parity = 0;                 ///< of the column's lowest cell
  std::size_t Lines[4] = {};      ///< first points of its vertical lines
  std::vector<RayCorner> Corners; ///< [line nz + k]
};
}
#endif
