// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file SliceFan.h
 * @brief The pixels of a picture, sorted into vertical half planes and within each by the slope of their rays.
 */
#ifndef SliceFan_h
#define SliceFan_h

#include "Vector3.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephoscope
{
class Camera;

/// A vertical half plane and its rays: slots first to the next slice's first.
struct PixelSlice
{
  Vector3 eye;
  double ux; ///< unit, horizontal
  double uy;
  std::size_t first;
};

class SliceFan
{
public:
  /**
   * @param spacing of slices where columns are not vertical, pixels where they are widest apart. Where that makes more slices than there are
   * pixels, and for 0 and parallel views, each pixel has its own: exact, and as dear as rays one by one.
   */
  SliceFan(const Camera& camera, double spacing);

  std::size_t numberOfSlices() const { return this->Slices.size() - 1; }
  const PixelSlice& slice(std::size_t s) const { return this->Slices[s]; }
  std::size_t end(std::size_t s) const { return this->Slices[s + 1].first; }
  /// dz / dr of a slot's ray, ascending within a slice; a vertical one is steep, not infinite.
  double slope(std::size_t slot) const { return this->Slopes[slot]; }
  /// Where a pixel is: its slice and its slot.
  struct Place
  {
    std::size_t slice;
    std::size_t slot;
  };
  Place placeOf(int x, int y) const
  {
    const auto row = static_cast<std::size_t>(y);
    const auto column = static_cast<std::size_t>(x);
    if (this->Slots.empty())
    {
      return { column, column * static_cast<std::size_t>(this->Height) + row };
    }
    const std::size_t pixel = row * static_cast<std::size_t>(this->Width) + column;
    return { this->SliceOf[pixel], this->Slots[pixel] };
  }
  std::size_t numberOfSlots() const { return this->Slopes.size(); }

private:
  void perColumn(const Camera& camera);
  void perPixel(const Camera& camera);
  /// @return false, and nothing is done, if there would be more slices than pixels
  bool byAzimuth(const Camera& camera, double spacing);
  void fill(const std::vector<double>& slopeOf);

  int Width;
  int Height;
  std::vector<PixelSlice> Slices; ///< and one past the last
  std::vector<double> Slopes;
  std::vector<std::uint32_t> SliceOf; ///< of each pixel; empty where slices are columns
  std::vector<std::uint32_t> Slots;   ///< of each pixel; empty where they go up column by column
};
}
#endif
