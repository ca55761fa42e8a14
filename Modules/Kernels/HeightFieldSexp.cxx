// SPDX-License-Identifier: BSD-3-Clause
#include "HeightFieldMethods.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
void HeightFieldSexp::run(const CloudSlice& slice)
{
  this->Places.clear();
  this->Tops.clear();
  this->Sums.clear();
  this->Sweep.run(this->Field, this->PlaneHeight, slice, this->Slopes,
    this->Settings.samplesPerWave, this->resolution(), *this);
}

void HeightFieldSexp::sampled(const SampleBlock& block)
{
  const double sun = this->Settings.sunFactor * this->Densities.sun;
  const double most = 2 / std::max(sun, 1e-300);
  std::array<double, 6> sum = this->Sums.empty() ? std::array<double, 6>{} : this->Sums.back();
  for (int j = this->Places.empty() ? 0 : 1; j <= SampleBlock::Steps; ++j)
  {
    const double y = block.at(j);
    const double top = std::max(0.0, block.top[j]);
    this->Light->largestSunArgument = std::max(this->Light->largestSunArgument, sun * top);
    const double g = std::min(top, most);
    const double width = this->Places.empty() ? 0 : y - this->Places.back();
    sum[0] += g * width;
    sum[1] += y * g * width;
    sum[2] += y * y * g * width;
    sum[3] += g * g * width;
    sum[4] += y * g * g * width;
    sum[5] += y * y * g * g * width;
    this->Places.push_back(y);
    this->Tops.push_back(g);
    this->Sums.push_back(sum);
  }
}

std::size_t HeightFieldSexp::nearest(double r, const SweepPlace& place) const
{
  const auto k = static_cast<std::size_t>(place.block) * SampleBlock::Steps +
    static_cast<std::size_t>(place.step);
  return r - this->Places[k] < this->Places[k + 1] - r ? k : k + 1;
}

bool HeightFieldSexp::chord(std::uint32_t ray, const SweepPlace& in, const SweepPlace& out)
{
  const double last = std::min(out.r, this->endOf(ray));
  if (!(last > in.r))
  {
    return true;
  }
  const ScatteringDensities fitted{ this->Settings.sunFactor * this->Densities.sun,
    this->Settings.viewFactor * this->Densities.view, this->Densities.behind };
  const HeightFieldRay at(this->Sweep.eye(), this->Slopes[ray], fitted);
  const double delta = at.delta();
  const double y1 = in.r;
  const double y2 = delta > 0 ? std::min(last, y1 + 2 / delta) : last;
  const double a = 1 + delta * y1 * (1 + delta * y1 / 4);
  const double b = -delta * (1 + 0.5 * delta * y1);
  const double c = 0.25 * delta * delta;
  const double d = -fitted.sun;
  const double e = 0.25 * d * d;
  const std::size_t k1 = this->nearest(y1, in);
  // The limited end can lie anywhere before the segment's.
  const std::size_t k2 = y2 < out.r
    ? static_cast<std::size_t>(
        std::lower_bound(this->Places.begin(), this->Places.end() - 1, y2) - this->Places.begin())
    : this->nearest(y2, out);
  std::array<double, 6> moment{};
  for (std::size_t i = 0; i < moment.size(); ++i)
  {
    const double power = static_cast<double>(i % 3);
    const double order = i < 3 ? 1 : 2;
    const auto rest = [&](std::size_t k, double y)
    {
      return std::pow(this->Places[k], power) * std::pow(this->Tops[k], order) *
        (this->Places[k] - y);
    };
    moment[i] = this->Sums[k2][i] - this->Sums[k1][i] + rest(k1, y1) - rest(k2, y2);
  }
  const double length = y2 - y1;
  const double plain =
    a * length + b * 0.5 * (y2 * y2 - y1 * y1) + c * (y2 * y2 * y2 - y1 * y1 * y1) / 3;
  const double sum = plain + d * (a * moment[0] + b * moment[1] + c * moment[2]) +
    e * (a * moment[3] + b * moment[4] + c * moment[5]);
  const double k = this->Settings.gain * this->Densities.view * at.gamma *
    std::exp(std::min(700.0, fitted.sun * at.zeta(y1)));
  return this->add(ray, y1, last, k * sum);
}
}
