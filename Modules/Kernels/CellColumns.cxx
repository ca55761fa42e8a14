// SPDX-License-Identifier: BSD-3-Clause
#include "CellColumns.h"

#include "TetrahedralSplit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephoscope
{
namespace
{
constexpr double Infinity = std::numeric_limits<double>::infinity();

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

/// First and one past the last pixel in [begin, end) whose centre lies between two image coordinates; begin >= 0.
void pixelRange(const double (&range)[2], int begin, int end, int& first, int& past)
{
  constexpr double Margin = 1e-6; // over rounding and the rays' displacement
  const double low = std::clamp<double>(range[0] - 0.5 - Margin, begin, end);
  const double high = std::clamp<double>(range[1] + 0.5 + Margin, begin, end);
  first = static_cast<int>(low);
  first += first < low ? 1 : 0;
  past = static_cast<int>(high);
}
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

TileRays::TileRays(const RaySpace& space, const DeepTile& tile)
  : Extent(tile.extent())
{
  this->Pixels.reserve(static_cast<std::size_t>(this->Extent.width) * this->Extent.height);
  for (int y = this->Extent.y0; y < this->Extent.y0 + this->Extent.height; ++y)
  {
    for (int x = this->Extent.x0; x < this->Extent.x0 + this->Extent.width; ++x)
    {
      const double stretch = space.stretch(space.u(x), space.v(y));
      const double limit = tile.opaqueAt(x, y) / stretch;
      this->Pixels.push_back({ stretch, limit });
      this->Limit = std::max(this->Limit, limit);
    }
  }
  for (int x = this->Extent.x0; x < this->Extent.x0 + this->Extent.width; ++x)
  {
    this->U.push_back(space.u(x));
  }
}

/// Where points lie in the image.
struct ColumnRays::Bounds
{
  double x[2] = { Infinity, -Infinity };
  double y[2] = { Infinity, -Infinity };
  double depth[2] = { Infinity, -Infinity };

  static void reach(double (&range)[2], double value)
  {
    range[0] = std::min(range[0], value);
    range[1] = std::max(range[1], value);
  }
  void join(const Bounds& o)
  {
    for (int e = 0; e < 2; ++e)
    {
      reach(this->x, o.x[e]);
      reach(this->y, o.y[e]);
      reach(this->depth, o.depth[e]);
    }
  }
};

ColumnRays::ColumnRays(const CellColumns& columns, const RaySpace& space, int width, int height)
  : Columns(columns)
  , Space(space)
  , Width(width)
  , Height(height)
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
      Corner& corner = this->Corners[line * c.nz + k];
      corner.q = this->Space.point(c.points[this->Lines[line] + k]);
      const double scale = this->Space.isParallel() ? 1 : (corner.q[2] > 0 ? 1 / corner.q[2] : 0);
      corner.x = this->Space.imageX(corner.q[0] * scale);
      corner.y = this->Space.imageY(corner.q[1] * scale);
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
    cell.extinction[v] = this->Columns.extinction[this->Lines[line] + level];
  }
  return cell;
}

/// Of the convex hull of some points.
template <std::size_t N>
ColumnRays::Bounds ColumnRays::bounds(const Corner* const (&corners)[N]) const
{
  Bounds b;
  for (const Corner* corner : corners)
  {
    Bounds::reach(b.x, corner->x);
    Bounds::reach(b.y, corner->y);
    Bounds::reach(b.depth, corner->q[2]);
  }
  return b.depth[0] > 0 || this->Space.isParallel() ? b : this->boundsAtEye(corners, N);
}

/// The same of a hull with points behind the eye: what reaches its plane goes on to infinity there.
ColumnRays::Bounds ColumnRays::boundsAtEye(const Corner* const* corners, std::size_t n) const
{
  Bounds b;
  for (std::size_t i = 0; i < n; ++i)
  {
    Bounds::reach(b.depth, corners[i]->q[2]);
    if (corners[i]->q[2] > 0)
    {
      Bounds::reach(b.x, corners[i]->x);
      Bounds::reach(b.y, corners[i]->y);
    }
  }
  for (std::size_t i = 0; i < n; ++i)
  {
    for (std::size_t j = 0; j < n; ++j)
    {
      const Vector3& before = corners[i]->q;
      const Vector3& after = corners[j]->q;
      if (before[2] > 0 && !(after[2] > 0))
      {
        // The signs of where the line between them crosses the eye's plane.
        const double x = before[2] * after[0] - after[2] * before[0];
        const double y = before[2] * after[1] - after[2] * before[1];
        b.x[0] = x <= 0 ? -Infinity : b.x[0];
        b.x[1] = x >= 0 ? Infinity : b.x[1];
        b.y[0] = y <= 0 ? -Infinity : b.y[0];
        b.y[1] = y >= 0 ? Infinity : b.y[1];
      }
    }
  }
  return b;
}

PixelBox ColumnRays::pixels(const Bounds& bounds, const TileExtent& within)
{
  PixelBox box;
  box.nearest = std::max(bounds.depth[0], 0.0);
  if (bounds.depth[1] > 0 && bounds.x[0] <= bounds.x[1])
  {
    pixelRange(bounds.x, within.x0, within.x0 + within.width, box.x0, box.x1);
    pixelRange(bounds.y, within.y0, within.y0 + within.height, box.y0, box.y1);
  }
  return box;
}

PixelBox ColumnRays::box() const
{
  const std::uint8_t* const drawn =
    this->Columns.drawn.data() + this->Column * (this->Columns.nz - 1);
  Bounds all;
  for (int k = this->Columns.first[this->Column]; k < this->Columns.last[this->Column]; ++k)
  {
    if (drawn[k])
    {
      all.join(this->bounds(this->cell(k).corner));
    }
  }
  return pixels(all, { 0, 0, this->Width, this->Height });
}

void ColumnRays::emit(DeepTile& tile, const TileRays& rays, std::uint32_t source) const
{
  if (this->Space.isParallel())
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
      const PixelBox box = pixels(this->bounds(cell.corner), rays.extent());
      if (box.empty() || box.nearest > rays.limit())
      {
        continue;
      }
      for (const TetrahedronVertices& vertices : AscendingSplit[(this->Parity + k) & 1])
      {
        this->emitTetrahedron<Parallel>(tile, rays, source, cell, vertices);
      }
    }
  }
}

template <bool Parallel>
void ColumnRays::emitTetrahedron(DeepTile& tile, const TileRays& rays, std::uint32_t source,
  const Cell& cell, const TetrahedronVertices& vertices) const
{
  const Corner* const corners[4] = { cell.corner[vertices[0]], cell.corner[vertices[1]],
    cell.corner[vertices[2]], cell.corner[vertices[3]] };
  const float density[4] = { cell.extinction[vertices[0]], cell.extinction[vertices[1]],
    cell.extinction[vertices[2]], cell.extinction[vertices[3]] };
  const PixelBox box = pixels(this->bounds(corners), rays.extent());
  if (box.empty() || box.nearest > rays.limit() ||
    density[0] + density[1] + density[2] + density[3] == 0)
  {
    return;
  }
  TetrahedronRays tetrahedron;
  if (!tetrahedron.set(
        { &corners[0]->q, &corners[1]->q, &corners[2]->q, &corners[3]->q }, density, Parallel))
  {
    return;
  }
  for (int y = box.y0; y < box.y1; ++y)
  {
    const double v = this->Space.v(y);
    const double* const u = rays.u() + (box.x0 - rays.extent().x0);
    const TileRays::Pixel* const pixels = &rays.pixel(box.x0, y);
    tetrahedron.meetRow<Parallel>(u, box.x1 - box.x0, v,
      [&](int i, const RayPiece& piece)
      {
        const TileRays::Pixel& pixel = pixels[i];
        const double z1 = std::min(piece.farDepth, pixel.limit);
        const double s0 = tetrahedron.density<Parallel>(u[i], v, piece.nearDepth);
        const double s1 = tetrahedron.density<Parallel>(u[i], v, z1);
        const auto length = static_cast<float>((z1 - piece.nearDepth) * pixel.stretch);
        const auto tau =
          static_cast<float>(0.5 * (z1 - piece.nearDepth) * pixel.stretch * (s0 + s1));
        if (tau > 0 && length > 0)
        {
          tile.addPiece(box.x0 + i, y, source, piece.nearDepth * pixel.stretch, length, tau,
            static_cast<float>((s1 - s0) / (s0 + s1)));
        }
      });
  }
}
}
