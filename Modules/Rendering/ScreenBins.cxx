// SPDX-License-Identifier: BSD-3-Clause
#include "ScreenBins.h"

#include "vtkSMPTools.h"

namespace
{
constexpr std::size_t Chunks = 16; // parts of the things that are counted apart
constexpr std::size_t MostBins = 65536;
}

template <class Visit>
void ScreenBins::ForEachBin(const nephoscope::PixelBox& box, Visit&& visit) const
{
  if (box.empty())
  {
    return;
  }
  for (int by = box.y0 / this->Edge; by <= (box.y1 - 1) / this->Edge; ++by)
  {
    for (int bx = box.x0 / this->Edge; bx <= (box.x1 - 1) / this->Edge; ++bx)
    {
      visit(static_cast<std::size_t>(by) * this->Across + bx);
    }
  }
}

void ScreenBins::Build(
  std::size_t things, int width, int height, const std::function<BoxOf()>& makeBoxOf)
{
  std::size_t bins = MostBins + 1;
  for (this->Edge = 32; bins > MostBins; this->Edge *= bins > MostBins ? 2 : 1)
  {
    this->Across = (width + this->Edge - 1) / this->Edge;
    bins = static_cast<std::size_t>(this->Across) * ((height + this->Edge - 1) / this->Edge);
  }
  this->Boxes.resize(things);
  vtkSMPTools::For(0, static_cast<vtkIdType>(things), 256,
    [this, &makeBoxOf](vtkIdType begin, vtkIdType end)
    {
      const BoxOf boxOf = makeBoxOf();
      for (vtkIdType thing = begin; thing < end; ++thing)
      {
        this->Boxes[thing] = boxOf(thing);
      }
    });

  // counts[bin * Chunks + chunk] becomes where the chunk's things of the bin start.
  std::vector<std::size_t> counts(bins * Chunks + 1, 0);
  const auto eachChunk = [this, things](vtkIdType begin, vtkIdType end, const auto& visit)
  {
    for (vtkIdType chunk = begin; chunk < end; ++chunk)
    {
      for (std::size_t t = things * chunk / Chunks; t < things * (chunk + 1) / Chunks; ++t)
      {
        this->ForEachBin(
          this->Boxes[t], [&visit, t, chunk](std::size_t bin) { visit(bin * Chunks + chunk, t); });
      }
    }
  };
  vtkSMPTools::For(0, Chunks, 1,
    [&counts, &eachChunk](vtkIdType begin, vtkIdType end)
    { eachChunk(begin, end, [&counts](std::size_t slot, std::size_t) { ++counts[slot]; }); });
  std::size_t sum = 0;
  this->Starts.resize(bins + 1);
  for (std::size_t slot = 0; slot < bins * Chunks; ++slot)
  {
    if (slot % Chunks == 0)
    {
      this->Starts[slot / Chunks] = sum;
    }
    const std::size_t here = counts[slot];
    counts[slot] = sum;
    sum += here;
  }
  this->Starts[bins] = sum;
  this->Things.resize(sum);
  vtkSMPTools::For(0, Chunks, 1,
    [this, &counts, &eachChunk](vtkIdType begin, vtkIdType end)
    {
      eachChunk(begin, end,
        [this, &counts](std::size_t slot, std::size_t t)
        { this->Things[counts[slot]++] = static_cast<std::uint32_t>(t); });
    });
}
