// SPDX-License-Identifier: BSD-3-Clause
#include "DeepTile.h"

#include <limits>

namespace nephoscope
{
void DeepTile::reset(const TileExtent& extent)
{
  this->Extent = extent;
  this->Segments.clear();
  this->Pixels.clear();
  this->OpaqueAt.assign(static_cast<std::size_t>(extent.width) * extent.height,
    std::numeric_limits<double>::infinity());
}

void DeepTile::composite(std::vector<PixelLight>& light)
{
  // Counting sort by pixel, stable, so that the order of arrival decides between equal distances.
  const std::size_t pixels = this->OpaqueAt.size();
  this->Starts.assign(pixels + 1, 0);
  for (const std::uint32_t pixel : this->Pixels)
  {
    ++this->Starts[pixel + 1];
  }
  for (std::size_t p = 0; p < pixels; ++p)
  {
    this->Starts[p + 1] += this->Starts[p];
  }
  this->Sorted.resize(this->Segments.size());
  for (std::size_t s = 0; s < this->Segments.size(); ++s)
  {
    this->Sorted[this->Starts[this->Pixels[s]]++] = this->Segments[s];
  }
  // Each start has moved on to the next pixel's.
  light.resize(pixels);
  std::size_t begin = 0;
  for (std::size_t p = 0; p < pixels; ++p)
  {
    const std::size_t end = this->Starts[p];
    light[p] = nephoscope::composite(this->Sorted.data() + begin, this->Sorted.data() + end);
    begin = end;
  }
}
}
