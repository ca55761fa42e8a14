// SPDX-License-Identifier: BSD-3-Clause
#include "PixelRuns.h"

#include <cmath>

namespace nephoscope
{
void PixelRuns::reset(std::size_t pixels)
{
  this->First.assign(pixels, None);
  this->Links.clear();
}

void PixelRuns::add(const PixelRun& run)
{
  const auto added = static_cast<std::uint32_t>(this->Links.size());
  this->Links.push_back({ run, None });
  std::uint32_t* at = &this->First[run.pixel];
  while (*at != None && this->Links[*at].run.nearEnd <= run.nearEnd)
  {
    at = &this->Links[*at].next;
  }
  this->Links[added].next = *at;
  *at = added;
}

bool PixelRuns::overlap(std::uint32_t first) const
{
  for (std::uint32_t at = first; at != None; at = this->Links[at].next)
  {
    const std::uint32_t next = this->Links[at].next;
    if (next != None && this->Links[at].run.farEnd > this->Links[next].run.nearEnd)
    {
      return true;
    }
  }
  return false;
}

/// The light of runs that follow one another; asks for the depth if it lies in a run that others are before.
PixelLight PixelRuns::inOrder(
  std::uint32_t first, bool depthWanted, std::vector<std::vector<PixelRequest>>& requests) const
{
  double radiance[3] = { 0, 0, 0 };
  double through[3] = { 1, 1, 1 };
  PixelLight light;
  for (std::uint32_t at = first; at != None; at = this->Links[at].next)
  {
    const PixelRun& run = this->Links[at].run;
    double before = 0;
    double after = 0;
    const RGB known = { static_cast<float>(through[0]), static_cast<float>(through[1]),
      static_cast<float>(through[2]) };
    for (int c = 0; c < 3; ++c)
    {
      before += through[c] / 3;
      radiance[c] += through[c] * run.light.radiance[c];
      through[c] *= run.light.transmittance[c];
      after += through[c] / 3;
    }
    if (depthWanted && before > 0.5 && after <= 0.5)
    {
      const bool foremost = at == first && std::isfinite(run.light.depth);
      const bool atOnce = before < 0.5 * (1 + 1e-6);
      light.depth = foremost ? run.light.depth : atOnce ? run.nearEnd : run.farEnd;
      if (!foremost && !atOnce && run.farEnd > run.nearEnd)
      {
        requests[run.part].push_back({ run.pixel, 0, known });
      }
    }
  }
  for (int c = 0; c < 3; ++c)
  {
    light.radiance[c] = static_cast<float>(radiance[c]);
    light.transmittance[c] = static_cast<float>(through[c]);
  }
  return light;
}

std::size_t PixelRuns::merge(bool depthWanted, std::vector<PixelLight>& light,
  std::vector<std::vector<PixelRequest>>& requests) const
{
  light.assign(this->First.size(), {});
  std::size_t overlapping = 0;
  for (std::size_t pixel = 0; pixel < this->First.size(); ++pixel)
  {
    const std::uint32_t first = this->First[pixel];
    if (!this->overlap(first))
    {
      light[pixel] = this->inOrder(first, depthWanted, requests);
      continue;
    }
    ++overlapping;
    for (std::uint32_t at = first; at != None; at = this->Links[at].next)
    {
      requests[this->Links[at].run.part].push_back(
        { static_cast<std::uint32_t>(pixel), 1, { 1, 1, 1 } });
    }
  }
  return overlapping;
}
}
