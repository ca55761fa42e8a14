// SPDX-License-Identifier: BSD-3-Clause
#include "HeightFieldMethods.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
void HeightFieldMarch::run(const CloudSlice& slice)
{
  for (std::uint32_t ray = 0; ray < this->Slopes.size(); ++ray)
  {
    this->shineRay(slice, ray);
  }
}

void HeightFieldMarch::shineRay(const CloudSlice& slice, std::uint32_t ray)
{
  const HeightFieldRay at(slice.z - this->PlaneHeight, this->Slopes[ray], this->Densities);
  const HeightFieldRange range = layerRange(at.eye, -this->Field.shape().depth,
    this->Field.top(std::max(0.0, this->Field.upperBound())), at.slope, at.slope,
    std::min(slice.far, this->endOf(ray)));
  constexpr double MostSteps = 1e7;
  const double length =
    std::max(this->Settings.step / at.gamma, (range.last - range.first) / MostSteps);
  double entered = -1;
  double light = 0;
  bool seen = true;
  for (double r = range.first; r < range.last && seen; r += length)
  {
    ++this->Light->pieces;
    const double middle = r + 0.5 * length;
    const double f = this->valueAt(slice, middle);
    const bool in = this->Field.inside(f, at.zeta(middle)) > 0;
    if (in)
    {
      entered = entered < 0 ? r : entered;
      const double top = this->Field.top(f);
      this->Light->largestSunArgument =
        std::max(this->Light->largestSunArgument, this->Densities.sun * top);
      light += at.view * length * std::exp(-at.depth(top, middle, entered));
    }
    if (entered >= 0 && (!in || r + length >= range.last))
    {
      seen = this->add(ray, entered, in ? std::min(r + length, range.last) : r, light);
      entered = -1;
      light = 0;
    }
  }
}
}
