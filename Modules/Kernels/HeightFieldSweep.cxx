// SPDX-License-Identifier: BSD-3-Clause
#include "HeightFieldSweep.h"

#include "WideLoops.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
constexpr int Steps = SampleBlock::Steps;
constexpr int MostBlocks = 1 << 14; ///< a million samples

NEPHOSCOPE_WIDE void boundsOf(
  const SampleBlock& block, const HeightFieldShape& shape, double eye, SampleBounds& bounds)
{
  const double c2 = shape.c * shape.c;
  for (int j = 0; j <= Steps; ++j)
  {
    const double inverse = 1 / std::max(block.at(j), 1e-300);
    const double u = std::abs(block.f[j]) + shape.c;
    const double sum = u * u + c2;
    const double ratio = shape.depth / std::max(std::sqrt(sum), 1e-300); // -h / g
    bounds.top[j] = (block.top[j] - eye) * inverse;
    bounds.bottom[j] = (-ratio * block.top[j] - eye) * inverse;
    bounds.plane[j] = -eye * inverse;
  }
}

/// The number of slopes below one, searched from a number that was right nearby.
inline std::uint32_t below(const std::vector<double>& slopes, std::uint32_t from, double slope)
{
  const auto count = static_cast<std::uint32_t>(slopes.size());
  while (from < count && slopes[from] < slope)
  {
    ++from;
  }
  while (from > 0 && slopes[from - 1] >= slope)
  {
    --from;
  }
  return from;
}
}

HeightFieldSweep::Inside HeightFieldSweep::insideAt(int j)
{
  const std::vector<double>& slopes = *this->Slopes;
  const SampleBounds& bounds = this->Bounds;
  const std::uint32_t plane = below(slopes, this->Last.plane, bounds.plane[j]);
  if (!(this->Blocks.back().top[j] > 0))
  {
    return { plane, plane, plane };
  }
  return { below(slopes, this->Last.first, bounds.bottom[j]),
    below(slopes, this->Last.last, bounds.top[j]), plane };
}

/// Newton's method from the secant's root, within bounds that bisection keeps closing.
double HeightFieldSweep::crossing(std::uint32_t ray, int j, double from, double to) const
{
  const SampleBlock& block = this->Blocks.back();
  const double slope = (*this->Slopes)[ray];
  const double height = this->Eye + slope * block.at(j);
  const double rise = slope * block.spacing;
  const SampleCubic f = block.cubic(j);
  const HeightField& field = *this->Field;
  const auto inside = [&](double x) { return field.inside(f(x), height + rise * x); };
  double a = from;
  double b = to;
  const double atA = inside(a);
  const double atB = inside(b);
  if ((atA > 0) == (atB > 0))
  {
    return std::abs(atA) < std::abs(atB) ? a : b;
  }
  // Steep rays and dense clouds ask for more digits.
  const double digits = std::min(1e-5, this->Resolution / block.spacing) / (1 + std::abs(slope));
  const double enough = std::max(1e-13, digits * (to - from));
  double x = (a * atB - b * atA) / (atB - atA);
  for (int n = 1; n < 60 && b - a > enough; ++n)
  {
    double at;
    const double change = field.insideSlope(f(x), f.slope(x), height + rise * x, rise, at);
    ((at > 0) == (atB > 0) ? b : a) = x;
    const double next = x - at / change;
    if (n % 8 == 0 || !(next >= a && next <= b))
    {
      x = 0.5 * (a + b);
      continue;
    }
    // What is left is of the order of the step's square.
    if ((next - x) * (next - x) < enough)
    {
      return next;
    }
    x = next;
  }
  return 0.5 * (a + b);
}

void HeightFieldSweep::enter(std::uint32_t ray, int j)
{
  const int last = static_cast<int>(this->Blocks.size()) - 1;
  const SampleBlock& block = this->Blocks.back();
  this->Entered[ray] = { block.start + block.spacing * (j + this->crossing(ray, j, 0, 1)), last,
    j };
}

void HeightFieldSweep::end(std::uint32_t ray, const SweepPlace& out, Listener& listener)
{
  const SweepPlace in = this->Entered[ray];
  this->Entered[ray].block = -1;
  if (out.r > in.r && !listener.chord(ray, in, out))
  {
    this->Done[ray] = 1;
  }
}

void HeightFieldSweep::leave(std::uint32_t ray, int j, Listener& listener)
{
  if (this->Entered[ray].block < 0)
  {
    return;
  }
  const int last = static_cast<int>(this->Blocks.size()) - 1;
  const SampleBlock& block = this->Blocks.back();
  this->end(
    ray, { block.start + block.spacing * (j + this->crossing(ray, j, 0, 1)), last, j }, listener);
}

/// A ray that is outside at both samples but crosses the cloud plane between them: through a cloud, if one is there.
void HeightFieldSweep::pierce(std::uint32_t ray, int j, Listener& listener)
{
  const SampleBlock& block = this->Blocks.back();
  const double x = (-this->Eye / (*this->Slopes)[ray] - block.at(j)) / block.spacing;
  if (this->Done[ray] || !(x > 0 && x < 1) || !(block.between(j, x) > 0))
  {
    return;
  }
  const int last = static_cast<int>(this->Blocks.size()) - 1;
  const auto place = [&](double from, double to)
  {
    return SweepPlace{ block.start + block.spacing * (j + this->crossing(ray, j, from, to)), last,
      j };
  };
  this->Entered[ray] = place(0, x);
  this->end(ray, place(x, 1), listener);
}

void HeightFieldSweep::step(int j, const Inside& before, const Inside& after, Listener& listener)
{
  // One range may leave at either end, and one join.
  for (std::uint32_t ray = before.first; ray < before.last; ++ray)
  {
    if (after.holds(ray))
    {
      ray = after.last - 1;
      continue;
    }
    this->leave(ray, j, listener);
  }
  for (std::uint32_t ray = after.first; ray < after.last; ++ray)
  {
    if (before.holds(ray))
    {
      ray = before.last - 1;
      continue;
    }
    if (!this->Done[ray])
    {
      this->enter(ray, j);
    }
  }
  for (std::uint32_t ray = std::min(before.plane, after.plane);
       ray < std::max(before.plane, after.plane); ++ray)
  {
    if (!before.holds(ray) && !after.holds(ray))
    {
      this->pierce(ray, j, listener);
    }
  }
}

void HeightFieldSweep::scan(Listener& listener)
{
  const SampleBlock& block = this->Blocks.back();
  boundsOf(block, this->Field->shape(), this->Eye, this->Bounds);
  if (this->Blocks.size() == 1)
  {
    this->Last = this->insideAt(0);
    this->IsLastKnown = true;
    for (std::uint32_t ray = this->Last.first; ray < this->Last.last; ++ray)
    {
      this->Entered[ray] = { block.start, 0, 0 };
    }
  }
  for (int j = 0; j < Steps; ++j)
  {
    if (!(block.f[j] > 0) && !(block.f[j + 1] > 0))
    {
      this->IsLastKnown = false;
      continue;
    }
    this->Last = this->IsLastKnown ? this->Last : this->insideAt(j);
    this->IsLastKnown = true;
    const Inside next = this->insideAt(j + 1);
    this->step(j, this->Last, next, listener);
    this->Last = next;
  }
}

void HeightFieldSweep::closeAll(Listener& listener)
{
  const int last = static_cast<int>(this->Blocks.size()) - 1;
  for (std::uint32_t ray = 0; ray < this->Entered.size(); ++ray)
  {
    if (this->Entered[ray].block >= 0)
    {
      this->end(ray, { this->Blocks.back().at(Steps), last, Steps - 1 }, listener);
    }
  }
}

/// Whether any ray can still meet the layer beyond r; those at both ends of the fan that cannot are forgotten.
bool HeightFieldSweep::isAhead(double r, double far)
{
  const auto isOver = [&](std::uint32_t ray)
  {
    const double near = this->Eye + (*this->Slopes)[ray] * r;
    const double end = this->Eye + (*this->Slopes)[ray] * far;
    return this->Done[ray] || std::max(near, end) < this->Low || std::min(near, end) > this->High;
  };
  auto& [first, last] = this->Ahead;
  while (first < last && isOver(first))
  {
    ++first;
  }
  while (first < last && isOver(last - 1))
  {
    --last;
  }
  return first < last;
}

void HeightFieldSweep::run(const HeightField& field, double planeHeight, const CloudSlice& slice,
  const std::vector<double>& slopes, double samplesPerWave, double resolution, Listener& listener)
{
  this->Resolution = resolution;
  this->Field = &field;
  this->Slopes = &slopes;
  this->Eye = slice.z - planeHeight;
  this->Low = -field.shape().depth;
  this->High = field.top(std::max(0.0, field.upperBound()));
  const HeightFieldRange range =
    layerRange(this->Eye, this->Low, this->High, slopes.front(), slopes.back(), slice.far);
  if (!(range.first < range.last))
  {
    return;
  }
  this->Entered.assign(slopes.size(), { -1, -1, 0 });
  this->Done.assign(slopes.size(), 0);
  this->Ahead = { 0, static_cast<std::uint32_t>(slopes.size()) };
  this->Last = {};
  this->Blocks.clear();
  this->Samples.begin(field, slice, range.first);
  // Without waves F is a parabola, which the cubics follow exactly.
  double spacing =
    std::min(field.shortestWave() / samplesPerWave, (range.last - range.first) / 256);
  spacing = std::max(spacing, (range.last - range.first) / (1.0 * MostBlocks * Steps));
  double start = range.first;
  while (start < range.last && this->isAhead(start, slice.far))
  {
    while (1.4 * spacing < slice.growth * start)
    {
      spacing *= 2;
    }
    this->Samples.sample(
      start, std::min(spacing, (range.last - start) / Steps), this->Blocks.emplace_back());
    listener.sampled(this->Blocks.back());
    this->scan(listener);
    start = this->Blocks.back().at(Steps);
    if ((range.last - start) < 1e-9 * range.last)
    {
      break;
    }
  }
  this->closeAll(listener);
}
}
