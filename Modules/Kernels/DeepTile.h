// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file DeepTile.h
 * @brief The deep pixels of a rectangle of the image: where bodies put their segments.
 */
#ifndef DeepTile_h
#define DeepTile_h

#include "Segment.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephoscope
{
/// A rectangle of pixels of the image, [x0, x0 + width) x [y0, y0 + height).
struct TileExtent
{
  int x0 = 0;
  int y0 = 0;
  int width = 0;
  int height = 0;
};

/**
 * @brief Collects segments in any order and composites them pixel by pixel.
 *
 * One thread fills one tile. Memory is that of the tile's segments (52 bytes each) and is kept for the next tile.
 * What lies behind an opaque surface that was added before is not kept.
 */
class DeepTile
{
public:
  /// Empty the tile and move it.
  void reset(const TileExtent& extent);

  const TileExtent& extent() const { return this->Extent; }

  /// Add a segment to a pixel, in image coordinates; the pixel has to lie in the tile.
  void add(int x, int y, const Segment& segment)
  {
    const std::uint32_t pixel = this->index(x, y);
    double& hidden = this->OpaqueAt[pixel];
    if (segment.nearEnd > hidden)
    {
      return;
    }
    if (segment.opticalDepth[0] == Opaque && segment.opticalDepth[1] == Opaque &&
      segment.opticalDepth[2] == Opaque)
    {
      hidden = segment.nearEnd;
    }
    this->Segments.push_back(segment);
    this->Pixels.push_back(pixel);
  }

  /// No segment beyond this distance along the pixel's ray can be seen (infinity if nothing opaque is known yet).
  double opaqueAt(int x, int y) const { return this->OpaqueAt[this->index(x, y)]; }

  std::size_t numberOfSegments() const { return this->Segments.size(); }

  /// Composite every pixel; light[(y - y0) * width + (x - x0)] on return.
  void composite(std::vector<PixelLight>& light);

private:
  std::uint32_t index(int x, int y) const
  {
    return static_cast<std::uint32_t>(
      (y - this->Extent.y0) * this->Extent.width + (x - this->Extent.x0));
  }

  TileExtent Extent;
  std::vector<Segment> Segments;
  std::vector<std::uint32_t> Pixels;
  std::vector<double> OpaqueAt;
  std::vector<Segment> Sorted;
  std::vector<std::size_t> Starts;
};
}
#endif
