// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file TetrahedronScan.h
 * @brief The segments that a tetrahedron adds to a deep tile: the pixels that it covers, row by row.
 *
 * Each pixel's ray that meets the tetrahedron (TetrahedronRays.h) is one segment with the linear extinction that it has.
 * A cloud of one colour gives pieces of a medium; one of several gives segments whose light has been integrated
 * (LinearEmission.h). Where a tile says that order does not matter, optical depths are summed (TetrahedronSum.h).
 *
 * @sa CellColumns.h, TetrahedronMesh.h, vtkCloudCellVolume, vtkCloudVolumeMapper
 */
#ifndef TetrahedronScan_h
#define TetrahedronScan_h

#include "DeepTile.h"
#include "OrderedTile.h"
#include "Segment.h"
#include "TetrahedronRays.h"
#include "TetrahedronSum.h"
#include "Vector3.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
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

/// The rays of a tile's pixels. Rows are as long as DeepTile::rowLength; rays beyond the width meet nothing.
class TileRays
{
public:
  TileRays(const RaySpace& space, const DeepTile& tile);

  const TileExtent& extent() const { return this->Extent; }
  /// From a pixel on along its row.
  RayRow row(int x, int y) const
  {
    const std::ptrdiff_t column = x - this->Extent.x0;
    const std::ptrdiff_t at = (y - this->Extent.y0) * this->RowLength + column;
    return { this->U.data() + column, this->Stretch.data() + at, this->LimitDepth.data() + at,
      this->LimitKey.data() + at };
  }
  double limit() const { return this->Limit; } ///< the greatest of the pixels' limit depths

private:
  void addRay(const RaySpace& space, const DeepTile& tile, int x, int y);

  TileExtent Extent;
  std::ptrdiff_t RowLength;
  std::vector<double> U;
  std::vector<double> Stretch;
  std::vector<double> LimitDepth;
  std::vector<double> LimitKey;
  double Limit = 0;
};

/// A point in ray space, and in the image if it lies before the eye (else 0).
struct RayCorner
{
  Vector3 q;
  double x;
  double y;
};

/// Where points lie in the image.
struct ImageBounds
{
  static constexpr double Infinity = std::numeric_limits<double>::infinity();
  double x[2] = { Infinity, -Infinity };
  double y[2] = { Infinity, -Infinity };
  double depth[2] = { Infinity, -Infinity };

  static void reach(double (&range)[2], double value)
  {
    range[0] = std::min(range[0], value);
    range[1] = std::max(range[1], value);
  }
  void join(const ImageBounds& o)
  {
    for (int e = 0; e < 2; ++e)
    {
      reach(this->x, o.x[e]);
      reach(this->y, o.y[e]);
      reach(this->depth, o.depth[e]);
    }
  }
  /// The pixels whose rays may lie within.
  PixelBox pixels(const TileExtent& within) const;
};

/// Tetrahedra to segments, for one camera.
class TetrahedronScan
{
public:
  /// @param width, height of the image, pixels
  TetrahedronScan(const RaySpace& space, int width, int height)
    : Space(space)
    , Image{ 0, 0, width, height }
  {
  }

  bool isParallel() const { return this->Space.isParallel(); }
  const TileExtent& image() const { return this->Image; }

  RayCorner corner(const Vector3& point) const
  {
    const Vector3 q = this->Space.point(point);
    const double scale = this->Space.isParallel() ? 1 : (q[2] > 0 ? 1 / q[2] : 0);
    return { q, this->Space.imageX(q[0] * scale), this->Space.imageY(q[1] * scale) };
  }

  /// Of the convex hull of some points.
  template <std::size_t N>
  ImageBounds bounds(const RayCorner* const (&corners)[N]) const
  {
    ImageBounds b;
    for (const RayCorner* corner : corners)
    {
      ImageBounds::reach(b.x, corner->x);
      ImageBounds::reach(b.y, corner->y);
      ImageBounds::reach(b.depth, corner->q[2]);
    }
    return b.depth[0] > 0 || this->Space.isParallel() ? b : boundsAtEye(corners, N);
  }

  /**
   * Add a tetrahedron's segments, or to the optical depths of a tile that is a sum.
   * @param corners in an order on which neighbours agree, @param extinction there, >= 0
   * @param color there, or nulls for the `source` of DeepTile::addSource
   */
  template <bool Parallel>
  void emit(DeepTile& tile, const TileRays& rays, std::uint32_t source,
    const RayCorner* const (&corners)[4], const float (&extinction)[4],
    const RGB* const (&color)[4]) const;

  /// The same with colours, none of them null, behind what was added to the tile before.
  template <bool Parallel>
  void emitInOrder(OrderedTile& tile, const TileRays& rays, const RayCorner* const (&corners)[4],
    const float (&extinction)[4], const RGB* const (&color)[4]) const;

private:
  template <bool Parallel>
  void emitPieces(DeepTile& tile, const TileRays& rays, std::uint32_t source,
    const TetrahedronRays& tetrahedron, const PixelBox& box) const;
  static ImageBounds boundsAtEye(const RayCorner* const* corners, std::size_t n);
  template <bool Parallel, class Tile>
  void emitColored(Tile& tile, const TileRays& rays, const TetrahedronRays& tetrahedron,
    const PixelBox& box, const Vector3* const (&q)[4], const RGB* const (&color)[4]) const;

  RaySpace Space;
  TileExtent Image;
};
}
#endif
