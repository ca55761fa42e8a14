// SPDX-License-Identifier: BSD-3-Clause
#include "GridPyramid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nephoscope
{
GridPyramid::GridPyramid(const GridFrame& frame, std::vector<float> values)
  : Frame(frame)
{
  if (frame.nx < 1 || frame.ny < 1 ||
    values.size() != static_cast<std::size_t>(frame.nx) * frame.ny)
  {
    return;
  }
  for (float& value : values)
  {
    value = std::isfinite(value) ? value : 0;
  }
  this->Levels.push_back({ frame.nx, frame.ny, std::move(values) });
  while (this->Levels.back().nx > 1 || this->Levels.back().ny > 1)
  {
    this->Levels.push_back(halved(this->Levels.back()));
  }
}

GridPyramid::Level GridPyramid::halved(const Level& fine)
{
  Level coarse{ (fine.nx + 1) / 2, (fine.ny + 1) / 2, {} };
  coarse.values.reserve(static_cast<std::size_t>(coarse.nx) * coarse.ny);
  for (int j = 0; j < coarse.ny; ++j)
  {
    const int j1 = std::min(2 * j + 1, fine.ny - 1);
    for (int i = 0; i < coarse.nx; ++i)
    {
      const int i1 = std::min(2 * i + 1, fine.nx - 1);
      coarse.values.push_back(
        (fine.at(2 * i, 2 * j) + fine.at(i1, 2 * j) + fine.at(2 * i, j1) + fine.at(i1, j1)) / 4);
    }
  }
  return coarse;
}

double GridPyramid::mean() const
{
  if (this->empty())
  {
    return 0;
  }
  const std::vector<float>& values = this->Levels[0].values;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

bool GridPyramid::contains(double x, double y) const
{
  const double u = (x - this->Frame.x0) / this->Frame.dx;
  const double v = (y - this->Frame.y0) / this->Frame.dy;
  return u >= 0 && u <= this->Frame.nx - 1 && v >= 0 && v <= this->Frame.ny - 1;
}

/// Bilinear in a level; u, v are places in spacings of level 0.
double GridPyramid::valueOf(int level, double u, double v) const
{
  const Level& samples = this->Levels[level];
  const auto width = static_cast<double>(1LL << level);
  // A sample's middle is that of the points it is the mean of.
  u = std::clamp((u + 0.5) / width - 0.5, 0.0, samples.nx - 1.0);
  v = std::clamp((v + 0.5) / width - 0.5, 0.0, samples.ny - 1.0);
  const int i = std::min(static_cast<int>(u), std::max(samples.nx - 2, 0));
  const int j = std::min(static_cast<int>(v), std::max(samples.ny - 2, 0));
  const int i1 = std::min(i + 1, samples.nx - 1);
  const int j1 = std::min(j + 1, samples.ny - 1);
  const double a = u - i;
  const double b = v - j;
  return (1 - b) * ((1 - a) * samples.at(i, j) + a * samples.at(i1, j)) +
    b * ((1 - a) * samples.at(i, j1) + a * samples.at(i1, j1));
}

double GridPyramid::levelOf(double footprint) const
{
  const double spacings = footprint / std::sqrt(this->Frame.dx * this->Frame.dy);
  const double top = static_cast<double>(this->Levels.size()) - 1;
  return spacings > 1 ? std::min(std::log2(spacings), top) : 0;
}

double GridPyramid::value(double x, double y, double footprint) const
{
  if (this->empty() || !std::isfinite(x) || !std::isfinite(y))
  {
    return 0;
  }
  const double u = (x - this->Frame.x0) / this->Frame.dx;
  const double v = (y - this->Frame.y0) / this->Frame.dy;
  const double level = this->levelOf(footprint);
  const int fine = static_cast<int>(level);
  const double share = level - fine;
  const double value = this->valueOf(fine, u, v);
  return share > 0 ? value + share * (this->valueOf(fine + 1, u, v) - value) : value;
}

GridPyramid::Slopes GridPyramid::slopes(double x, double y, double footprint) const
{
  if (this->empty())
  {
    return { 0, 0 };
  }
  const double width = std::exp2(this->levelOf(footprint));
  const double hx = width * this->Frame.dx;
  const double hy = width * this->Frame.dy;
  return { (this->value(x + hx, y, footprint) - this->value(x - hx, y, footprint)) / (2 * hx),
    (this->value(x, y + hy, footprint) - this->value(x, y - hy, footprint)) / (2 * hy) };
}
}
