// SPDX-License-Identifier: BSD-3-Clause
#include "CellColumns.h"

#include "TetrahedralSplit.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
/// TetrahedralSplit with each tetrahedron's vertices ascending: the global order on which neighbours agree.
constexpr std::array<HexahedronSplit, 2> ascendingSplit()
{
  std::array<HexahedronSplit, 2> splits = TetrahedralSplit;
  for (auto& split : splits)
  {
    for (auto& t : split)
    {
      for (std::size_t pass = 0; pass < 3; ++pass)
      {
        for (std::size_t i = 0; i < 3; ++i)
        {
          if (t[i] > t[i + 1])
          {
            const std::uint8_t v = t[i];
            t[i] = t[i + 1];
            t[i + 1] = v;
          }
        }
      }
    }
  }
  return splits;
}
constexpr std::array<HexahedronSplit, 2> AscendingSplit = ascendingSplit();

}

void CellColumns::resize(int x, int y, int z)
{
  this->nx = x;
  this->ny = y;
  this->nz = z;
  const std::size_t n = static_cast<std::size_t>(x) * y * z;
  this->points.resize(n);
  this->extinction.assign(n, 0);
  this->drawn.assign(this->numberOfColumns() * (z - 1), 1);
  this->first.assign(this->numberOfColumns(), 0);
  this->last.assign(this->numberOfColumns(), 0);
}

void CellColumns::classify(std::size_t column)
{
  const std::size_t across = static_cast<std::size_t>(this->nx) - 1;
  const std::size_t line = (column / across * this->nx + column % across) * this->nz;
  const std::size_t row = static_cast<std::size_t>(this->nx) * this->nz;
  std::uint8_t* const flags = this->drawn.data() + column * (this->nz - 1);
  int low = 0;
  int high = 0;
  for (int k = 0; k < this->nz - 1; ++k)
  {
    bool some = false;
    bool known = true;
    for (const std::size_t start : { line, line + this->nz, line + row, line + row + this->nz })
    {
      for (const std::size_t p : { start + k, start + k + 1 })
      {
        const Vector3& x = this->points[p];
        some = some || this->extinction[p] > 0;
        known = known && this->extinction[p] >= 0 && std::isfinite(x[0] + x[1] + x[2]);
      }
    }
    flags[k] = flags[k] && some && known;
    if (flags[k])
    {
      low = high > 0 ? low : k;
      high = k + 1;
    }
  }
  this->first[column] = low;
  this->last[column] = high;
}

int CellColumns::numberOfDrawnCells(std::size_t column) const
{
  int n = 0;
  for (int k = this->first[column]; k < this->last[column]; ++k)
  {
    n += this->drawn[column * (this->nz - 1) + k];
  }
  return n;
}

ColumnRays::ColumnRays(const CellColumns& columns, const RaySpace& space, int width, int height)
  : Columns(columns)
  , Scan(space, width, height)
  , Corners(4 * static_cast<std::size_t>(columns.nz))
{
}

void ColumnRays::look(std::size_t column)
{
  const CellColumns& c = this->Columns;
  const std::size_t across = static_cast<std::size_t>(c.nx) - 1;
  const std::size_t j = column / across;
  const std::size_t i = column % across;
  this->Column = column;
  this->Parity = splitParity(c.parity + static_cast<long long>(i), static_cast<long long>(j), 0);
  for (std::size_t line = 0; line < 4; ++line)
  {
    this->Lines[line] = ((j + (line >> 1)) * c.nx + i + (line & 1)) * c.nz;
    for (int k = c.first[column]; k <= c.last[column]; ++k)
    {
      this->Corners[line * c.nz + k] = this->Scan.corner(c.points[this->Lines[line] + k]);
    }
  }
}

ColumnRays::Cell ColumnRays::cell(int k) const
{
  Cell cell;
  for (std::size_t v = 0; v < 8; ++v)
  {
    const std::size_t line = v & 3;
    const std::size_t level = k + (v >> 2);
    cell.corner[v] = &this->Corners[line * this->Columns.nz + level];
    const std::size_t point = this->Lines[line] + level;
    cell.extinction[v] = this->Columns.extinction[point];
    cell.color[v] = this->Columns.color.empty() ? nullptr : &this->Columns.color[point];
  }
  return cell;
}

PixelBox ColumnRays::box() const
{
  const std::uint8_t* const drawn =
    this->Columns.drawn.data() + this->Column * (this->Columns.nz - 1);
  ImageBounds all;
  for (int k = this->Columns.first[this->Column]; k < this->Columns.last[this->Column]; ++k)
  {
    if (drawn[k])
    {
      all.join(this->Scan.bounds(this->cell(k).corner));
    }
  }
  return all.pixels(this->Scan.image());
}

bool ColumnRays::touches(const Cell& cell, const TileRays& rays) const
{
  const PixelBox box = this->Scan.bounds(cell.corner).pixels(rays.extent());
  return !box.empty() && box.nearest <= rays.limit();
}

void ColumnRays::emit(DeepTile& tile, const TileRays& rays, std::uint32_t source) const
{
  if (this->Scan.isParallel())
  {
    this->emitCells<true>(tile, rays, source);
  }
  else
  {
    this->emitCells<false>(tile, rays, source);
  }
}

template <bool Parallel>
void ColumnRays::emitCells(DeepTile& tile, const TileRays& rays, std::uint32_t source) const
{
  const std::uint8_t* const drawn =
    this->Columns.drawn.data() + this->Column * (this->Columns.nz - 1);
  for (int k = this->Columns.first[this->Column]; k < this->Columns.last[this->Column]; ++k)
  {
    if (drawn[k])
    {
      const Cell cell = this->cell(k);
      if (!this->touches(cell, rays))
      {
        continue;
      }
      for (const TetrahedronVertices& vertices : AscendingSplit[(this->Parity + k) & 1])
      {
        const auto [a, b, c, d] = vertices;
        this->Scan.emit<Parallel>(tile, rays, source,
          { cell.corner[a], cell.corner[b], cell.corner[c], cell.corner[d] },
          { cell.extinction[a], cell.extinction[b], cell.extinction[c], cell.extinction[d] },
          { cell.color[a], cell.color[b], cell.color[c], cell.color[d] });
      }
    }
  }
}
}
