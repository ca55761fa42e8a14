// SPDX-License-Identifier: BSD-3-Clause
#include "TetrahedronScan.h"

#include "LinearEmission.h"

namespace nephoscope
{
namespace
{
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

TileRays::TileRays(const RaySpace& space, const DeepTile& tile)
  : Extent(tile.extent())
  , RowLength(tile.rowLength())
{
  const std::size_t rays = static_cast<std::size_t>(this->RowLength) * this->Extent.height;
  this->Stretch.reserve(rays);
  this->LimitDepth.reserve(rays);
  this->LimitKey.reserve(rays);
  for (int y = this->Extent.y0; y < this->Extent.y0 + this->Extent.height; ++y)
  {
    for (int x = this->Extent.x0; x < this->Extent.x0 + this->Extent.width; ++x)
    {
      this->addRay(space, tile, x, y);
    }
    this->Stretch.resize(this->Stretch.size() + DeepTile::RowPadding, 1);
    this->LimitDepth.resize(this->LimitDepth.size() + DeepTile::RowPadding, 0);
    this->LimitKey.resize(this->LimitKey.size() + DeepTile::RowPadding, -ImageBounds::Infinity);
  }
  for (int x = 0; x < this->RowLength; ++x)
  {
    this->U.push_back(space.u(this->Extent.x0 + x));
  }
}

void TileRays::addRay(const RaySpace& space, const DeepTile& tile, int x, int y)
{
  const double stretch = space.stretch(space.u(x), space.v(y));
  const double limit = tile.opaqueAt(x, y) / stretch;
  this->Stretch.push_back(stretch);
  this->LimitDepth.push_back(limit);
  const double key = limit > 0 ? -1 / limit : -ImageBounds::Infinity;
  this->LimitKey.push_back(space.isParallel() ? limit : key);
  this->Limit = std::max(this->Limit, limit);
}

PixelBox ImageBounds::pixels(const TileExtent& within) const
{
  PixelBox box;
  box.nearest = std::max(this->depth[0], 0.0);
  if (this->depth[1] > 0 && this->x[0] <= this->x[1])
  {
    pixelRange(this->x, within.x0, within.x0 + within.width, box.x0, box.x1);
    pixelRange(this->y, within.y0, within.y0 + within.height, box.y0, box.y1);
  }
  return box;
}

/// The same of a hull with points behind the eye: what reaches its plane goes on to infinity there.
ImageBounds TetrahedronScan::boundsAtEye(const RayCorner* const* corners, std::size_t n)
{
  ImageBounds b;
  for (std::size_t i = 0; i < n; ++i)
  {
    ImageBounds::reach(b.depth, corners[i]->q[2]);
    if (corners[i]->q[2] > 0)
    {
      ImageBounds::reach(b.x, corners[i]->x);
      ImageBounds::reach(b.y, corners[i]->y);
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
        b.x[0] = x <= 0 ? -ImageBounds::Infinity : b.x[0];
        b.x[1] = x >= 0 ? ImageBounds::Infinity : b.x[1];
        b.y[0] = y <= 0 ? -ImageBounds::Infinity : b.y[0];
        b.y[1] = y >= 0 ? ImageBounds::Infinity : b.y[1];
      }
    }
  }
  return b;
}

template <bool Parallel>
void TetrahedronScan::emit(DeepTile& tile, const TileRays& rays, std::uint32_t source,
  const RayCorner* const (&corners)[4], const float (&extinction)[4],
  const RGB* const (&color)[4]) const
{
  const PixelBox box = this->bounds(corners).pixels(rays.extent());
  if (box.empty() || box.nearest > rays.limit() ||
    extinction[0] + extinction[1] + extinction[2] + extinction[3] == 0)
  {
    return;
  }
  const Vector3* const q[4] = { &corners[0]->q, &corners[1]->q, &corners[2]->q, &corners[3]->q };
  TetrahedronRays tetrahedron;
  if (!tetrahedron.set(q, extinction, Parallel))
  {
    return;
  }
  if (color[0])
  {
    this->emitColored<Parallel>(tile, rays, tetrahedron, box, q, color);
  }
  else if (tile.isSum())
  {
    tile.countSummed(sumOpticalDepths(tetrahedron, Parallel, rays.row(box.x0, box.y0),
      { tile.opticalDepths(box.x0, box.y0), tile.rowLength(), box.x1 - box.x0, box.y1 - box.y0,
        this->Space.v(box.y0) }));
  }
  else
  {
    this->emitPieces<Parallel>(tile, rays, source, tetrahedron, box);
  }
}

template <bool Parallel>
void TetrahedronScan::emitPieces(DeepTile& tile, const TileRays& rays, std::uint32_t source,
  const TetrahedronRays& tetrahedron, const PixelBox& box) const
{
  for (int y = box.y0; y < box.y1; ++y)
  {
    const double v = this->Space.v(y);
    const RayRow row = rays.row(box.x0, y);
    tetrahedron.meetRow<Parallel>(row.u, box.x1 - box.x0, v,
      [&](int i, const RayPiece& piece)
      {
        const double z1 = std::min(piece.farDepth, row.limitDepth[i]);
        const double s0 = tetrahedron.density<Parallel>(row.u[i], v, piece.nearDepth);
        const double s1 = tetrahedron.density<Parallel>(row.u[i], v, z1);
        const auto length = static_cast<float>((z1 - piece.nearDepth) * row.stretch[i]);
        const auto tau =
          static_cast<float>(0.5 * (z1 - piece.nearDepth) * row.stretch[i] * (s0 + s1));
        if (tau > 0 && length > 0)
        {
          tile.addPiece(box.x0 + i, y, source, piece.nearDepth * row.stretch[i], length, tau,
            static_cast<float>((s1 - s0) / (s0 + s1)));
        }
      });
  }
}

template <bool Parallel>
void TetrahedronScan::emitInOrder(OrderedTile& tile, const TileRays& rays,
  const RayCorner* const (&corners)[4], const float (&extinction)[4],
  const RGB* const (&color)[4]) const
{
  const PixelBox box = this->bounds(corners).pixels(rays.extent());
  const Vector3* const q[4] = { &corners[0]->q, &corners[1]->q, &corners[2]->q, &corners[3]->q };
  TetrahedronRays tetrahedron;
  if (!box.empty() && box.nearest <= rays.limit() && tetrahedron.set(q, extinction, Parallel))
  {
    this->emitColored<Parallel>(tile, rays, tetrahedron, box, q, color);
  }
}

template <bool Parallel, class Tile>
void TetrahedronScan::emitColored(Tile& tile, const TileRays& rays,
  const TetrahedronRays& tetrahedron, const PixelBox& box, const Vector3* const (&q)[4],
  const RGB* const (&color)[4]) const
{
  Vector3 normals[4];
  const double det = faceNormals(q, normals);
  RayField fields[3];
  for (std::size_t c = 0; c < 3; ++c)
  {
    fields[c].set(normals, det, *q[0],
      { (*color[0])[c], (*color[1])[c], (*color[2])[c], (*color[3])[c] }, Parallel);
  }
  for (int y = box.y0; y < box.y1; ++y)
  {
    const double v = this->Space.v(y);
    const RayRow row = rays.row(box.x0, y);
    tetrahedron.meetRow<Parallel>(row.u, box.x1 - box.x0, v,
      [&](int i, const RayPiece& piece)
      {
        const double stretch = row.stretch[i];
        const double z0 = piece.nearDepth;
        const double z1 = std::min(piece.farDepth, row.limitDepth[i]);
        const double s0 = tetrahedron.density<Parallel>(row.u[i], v, z0);
        const double s1 = tetrahedron.density<Parallel>(row.u[i], v, z1);
        const double tau = 0.5 * (z1 - z0) * stretch * (s0 + s1);
        const double skew = (s1 - s0) / (s0 + s1);
        if (static_cast<float>(tau) > 0)
        {
          const auto depth = static_cast<float>(tau);
          const EmissionWeights weights = linearEmission(tau, skew);
          Segment segment{ z0 * stretch, z1 * stretch, { depth, depth, depth }, {},
            static_cast<float>(skew) };
          for (std::size_t c = 0; c < 3; ++c)
          {
            segment.radiance[c] = static_cast<float>(
              weights.nearEnd * fields[c].template at<Parallel>(row.u[i], v, z0) +
              weights.farEnd * fields[c].template at<Parallel>(row.u[i], v, z1));
          }
          tile.add(box.x0 + i, y, segment);
        }
      });
  }
}

template void TetrahedronScan::emitInOrder<false>(OrderedTile&, const TileRays&,
  const RayCorner* const (&)[4], const float (&)[4], const RGB* const (&)[4]) const;
template void TetrahedronScan::emitInOrder<true>(OrderedTile&, const TileRays&,
  const RayCorner* const (&)[4], const float (&)[4], const RGB* const (&)[4]) const;
template void TetrahedronScan::emit<false>(DeepTile&, const TileRays&, std::uint32_t,
  const RayCorner* const (&)[4], const float (&)[4], const RGB* const (&)[4]) const;
template void TetrahedronScan::emit<true>(DeepTile&, const TileRays&, std::uint32_t,
  const RayCorner* const (&)[4], const float (&)[4], const RGB* const (&)[4]) const;
}
