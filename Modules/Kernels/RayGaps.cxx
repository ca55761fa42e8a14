// SPDX-License-Identifier: BSD-3-Clause
#include "RayGaps.h"

#include <algorithm>
#include <cstddef>

namespace nephoscope
{
void RayGaps::reset(const TileExtent& extent)
{
  this->Extent = extent;
  this->Meetings.clear();
  this->U.clear();
  for (int x = extent.x0; x < extent.x0 + extent.width; ++x)
  {
    this->U.push_back(this->Space.u(x));
  }
}

template <bool Parallel>
void RayGaps::meet(std::uint32_t cell, const TetrahedronRays& rays, const PixelBox& box)
{
  const int first = box.x0 - this->Extent.x0;
  for (int y = box.y0; y < box.y1; ++y)
  {
    const int row = (y - this->Extent.y0) * this->Extent.width + first;
    rays.meetRow<Parallel>(this->U.data() + first, box.x1 - box.x0, this->Space.v(y),
      [this, cell, row](int i, const RayPiece& piece)
      {
        // Less of a ray than rounding makes has no place in an order.
        constexpr double Rounding = 1e-12;
        if (piece.farDepth - piece.nearDepth > Rounding * piece.farDepth)
        {
          this->Meetings.push_back({ piece.nearDepth, static_cast<std::uint32_t>(row + i), cell });
        }
      });
  }
}

void RayGaps::add(std::uint32_t cell, const std::array<Vector3, 4>& points)
{
  RayCorner corners[4];
  for (std::size_t n = 0; n < 4; ++n)
  {
    corners[n] = this->Scan.corner(points[n]);
  }
  const RayCorner* const of[4] = { corners, corners + 1, corners + 2, corners + 3 };
  const PixelBox box = this->Scan.bounds(of).pixels(this->Extent);
  const Vector3* const q[4] = { &corners[0].q, &corners[1].q, &corners[2].q, &corners[3].q };
  TetrahedronRays rays;
  if (box.empty() || !rays.set(q, { 0, 0, 0, 0 }, this->Scan.isParallel()))
  {
    return;
  }
  this->Scan.isParallel() ? this->meet<true>(cell, rays, box) : this->meet<false>(cell, rays, box);
}

void RayGaps::relate(CellRelations& relations)
{
  std::sort(this->Meetings.begin(), this->Meetings.end(),
    [](const Meeting& a, const Meeting& b)
    {
      return a.pixel != b.pixel ? a.pixel < b.pixel
        : a.depth != b.depth    ? a.depth < b.depth
                                : a.cell < b.cell;
    });
  CellRelations found;
  for (std::size_t m = 1; m < this->Meetings.size(); ++m)
  {
    if (this->Meetings[m].pixel == this->Meetings[m - 1].pixel)
    {
      found.push_back({ this->Meetings[m - 1].cell, this->Meetings[m].cell });
    }
  }
  const auto key = [](const CellRelation& r)
  { return static_cast<std::uint64_t>(r.before) << 32 | r.after; };
  std::sort(found.begin(), found.end(),
    [&key](const CellRelation& a, const CellRelation& b) { return key(a) < key(b); });
  const auto last = std::unique(found.begin(), found.end(),
    [&key](const CellRelation& a, const CellRelation& b) { return key(a) == key(b); });
  relations.insert(relations.end(), found.begin(), last);
}
}
