// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file ScreenBins.h
 * @brief Which things may touch which square of the image, found in parallel: count, prefix sum, fill.
 *
 * The lists are in ascending order whatever the number of threads. Memory: 4 bytes a pair of thing and square, 24 a thing.
 */
#ifndef ScreenBins_h
#define ScreenBins_h

#include "TetrahedronScan.h" // for PixelBox
#include "vtkType.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

class ScreenBins
{
public:
  /// Bin `things` of them over an image; `boxOf` makes the function, one for each thread, that gives a thing's pixels.
  using BoxOf = std::function<nephoscope::PixelBox(std::size_t)>;
  void Build(std::size_t things, int width, int height, const std::function<BoxOf()>& makeBoxOf);

  /// Call visit(thing) once for each that may touch the tile's pixels, nearer than `limit`.
  template <class Visit>
  void ForEach(const nephoscope::TileExtent& tile, double limit, Visit&& visit) const
  {
    const int bx0 = tile.x0 / this->Edge;
    const int by0 = tile.y0 / this->Edge;
    const int bx1 = (tile.x0 + tile.width - 1) / this->Edge;
    const int by1 = (tile.y0 + tile.height - 1) / this->Edge;
    for (int by = by0; by <= by1; ++by)
    {
      for (int bx = bx0; bx <= bx1; ++bx)
      {
        const std::size_t bin = static_cast<std::size_t>(by) * this->Across + bx;
        for (std::size_t at = this->Starts[bin]; at < this->Starts[bin + 1]; ++at)
        {
          const std::uint32_t thing = this->Things[at];
          const nephoscope::PixelBox& box = this->Boxes[thing];
          // In several bins of the tile, it is visited in the first.
          const bool first =
            (bx == bx0 || box.x0 >= bx * this->Edge) && (by == by0 || box.y0 >= by * this->Edge);
          if (first && box.nearest <= limit && box.x0 < tile.x0 + tile.width && box.x1 > tile.x0 &&
            box.y0 < tile.y0 + tile.height && box.y1 > tile.y0)
          {
            visit(thing);
          }
        }
      }
    }
  }

  const nephoscope::PixelBox& GetBox(std::size_t thing) const { return this->Boxes[thing]; }

private:
  template <class Visit>
  void ForEachBin(const nephoscope::PixelBox& box, Visit&& visit) const;

  int Edge = 32;
  int Across = 0;
  std::vector<nephoscope::PixelBox> Boxes;
  std::vector<std::size_t> Starts;
  std::vector<std::uint32_t> Things;
};
#endif
