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

#include "DeepTile.h"
#include "Segment.h"
#include "TetrahedronRays.h"
#include "Vector3.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephoscope
{
/// Pixels [x0, x1) x [y0, y1); empty where x0 >= x1 or y0 >= y1.
struct PixelBox
{
  int x0 = 0;
  int y0 = 0;
  int x1 = 0;
  int y1 = 0;
  double nearest = 0; ///< no depth in it is less
  bool empty() const { return this->x0 >= this->x1 || this->y0 >= this->y1; }
};

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

/// The rays of a tile's pixels.
class TileRays
{
public:
  TileRays(const RaySpace& space, const DeepTile& tile);

  struct Pixel
  {
    double stretch; ///< distance along the ray per depth
    double limit;   ///< depth of what is opaque
  };
  const TileExtent& extent() const { return this->Extent; }
  const Pixel& pixel(int x, int y) const
  {
    return this->Pixels[static_cast<std::size_t>(y - this->Extent.y0) * this->Extent.width +
      (x - this->Extent.x0)];
  }
  const double* u() const { return this->U.data(); } ///< of the pixels of a row
  double limit() const { return this->Limit; }       ///< the greatest of the pixels'

private:
  TileExtent Extent;
  std::vector<Pixel> Pixels;
  std::vector<double> U;
  double Limit = 0;
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

  /// Add its segments to the tile. The source is one of DeepTile::addSource, kappa of Max 1994 eq. 5-7.
  void emit(DeepTile& tile, const TileRays& rays, std::uint32_t source) const;

private:
  struct Corner
  {
    Vector3 q; ///< in ray space
    double x;  ///< image coordinates; 0 if not in front of the eye
    double y;
  };
  struct Cell
  {
    const Corner* corner[8]; ///< by bit pattern
    float extinction[8];
  };
  struct Bounds;

  Cell cell(int k) const;
  template <std::size_t N>
  Bounds bounds(const Corner* const (&corners)[N]) const;
  Bounds boundsAtEye(const Corner* const* corners, std::size_t n) const;
  static PixelBox pixels(const Bounds& bounds, const TileExtent& within);
  template <bool Parallel>
  void emitCells(DeepTile& tile, const TileRays& rays, std::uint32_t source) const;
  template <bool Parallel>
  void emitTetrahedron(DeepTile& tile, const TileRays& rays, std::uint32_t source, const Cell& cell,
    const std::array<std::uint8_t, 4>& vertices) const;

  const CellColumns& Columns;
  RaySpace Space;
  int Width;
  int Height;
  std::size_t Column = 0;
  int Parity = 0;              ///< of the column's lowest cell
  std::size_t Lines[4] = {};   ///< first points of its vertical lines
  std::vector<Corner> Corners; ///< [line nz + k]
};
}
#endif
