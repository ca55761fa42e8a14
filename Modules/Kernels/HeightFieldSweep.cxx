// SPDX-License-Identifier: BSD-3-Clause
#include "HeightFieldSweep.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
constexpr int Steps = SampleBlock::Steps;
constexpr int MostBlocks = 1 << 14; ///< a million samples

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

/// Adds a wave to F and dF/dr, its value and its derivative from the sine and the cosine of its argument.
template <class Add>
void addWave(SampleBlock& block, double sine0, double cosine0, const double* cosine,
  const double* sine, const Add& add)
{
  for (int j = 0; j <= Steps; ++j)
  {
    const double s = sine0 * cosine[j] + cosine0 * sine[j];
    const double c = cosine0 * cosine[j] - sine0 * sine[j];
    add(block.f[j], block.slope[j], s, c);
  }
}
}

void HeightFieldSweep::prepare(const CloudSlice& slice)
{
  const HeightFieldShape& shape = this->Field->shape();
  const auto& a = shape.polynomial;
  const HeightGradient f = HeightField({ a, {}, shape.c, shape.depth }).gradient(slice.x, slice.y);
  this->Polynomial[0] = f.value;
  this->Polynomial[1] = f.x * slice.ux + f.y * slice.uy;
  this->Polynomial[2] =
    a[3] * slice.ux * slice.ux + a[4] * slice.ux * slice.uy + a[5] * slice.uy * slice.uy;
  this->Phases.resize(shape.waves.size());
  for (std::size_t i = 0; i < this->Phases.size(); ++i)
  {
    const HeightWave& wave = shape.waves[i];
    Phase& phase = this->Phases[i];
    phase.amplitude = wave.amplitude;
    phase.speed = wave.p * slice.ux + wave.q * slice.uy;
    phase.angle = wave.p * slice.x + wave.q * slice.y + wave.r;
    phase.shape = wave.shape;
  }
  this->Turned = 0;
  this->Blocks.clear();
}

void HeightFieldSweep::turn(double spacing)
{
  for (Phase& phase : this->Phases)
  {
    // By doubling, the angle of each turn twice that of the one before.
    phase.cosine[0] = 1;
    phase.sine[0] = 0;
    double c = std::cos(phase.speed * spacing);
    double s = std::sin(phase.speed * spacing);
    for (int n = 1; n <= Steps; n *= 2)
    {
      for (int j = 0; j < n && n + j <= Steps; ++j)
      {
        phase.cosine[n + j] = c * phase.cosine[j] - s * phase.sine[j];
        phase.sine[n + j] = s * phase.cosine[j] + c * phase.sine[j];
      }
      const double twice = 2 * s * c;
      c = (c - s) * (c + s);
      s = twice;
    }
  }
  this->Turned = spacing;
}

void HeightFieldSweep::sample(double start, double spacing)
{
  if (spacing != this->Turned)
  {
    this->turn(spacing);
  }
  SampleBlock& block = this->Blocks.emplace_back();
  block.start = start;
  block.spacing = spacing;
  for (int j = 0; j <= Steps; ++j)
  {
    const double r = start + spacing * j;
    block.f[j] = this->Polynomial[0] + r * (this->Polynomial[1] + r * this->Polynomial[2]);
    block.slope[j] = this->Polynomial[1] + 2 * r * this->Polynomial[2];
  }
  for (const Phase& phase : this->Phases)
  {
    const double s0 = std::sin(phase.angle + phase.speed * start);
    const double c0 = std::cos(phase.angle + phase.speed * start);
    const double a = phase.amplitude;
    const double b = a * phase.speed;
    if (phase.shape == WaveShape::Sine)
    {
      addWave(block, s0, c0, phase.cosine, phase.sine,
        [a, b](double& f, double& slope, double s, double c)
        {
          f += a * s;
          slope += b * c;
        });
    }
    else if (phase.shape == WaveShape::Absolute)
    {
      addWave(block, s0, c0, phase.cosine, phase.sine,
        [a, b](double& f, double& slope, double s, double c)
        {
          f += a * std::abs(s);
          slope += b * std::copysign(c, c * s);
        });
    }
    else
    {
      // Towards its kink the slope of the root is held, as that of a sine of 1 / 400 is.
      addWave(block, s0, c0, phase.cosine, phase.sine,
        [a, b](double& f, double& slope, double s, double c)
        {
          const double root = std::sqrt(std::abs(s));
          f += a * root;
          slope += b * std::copysign(c, c * s) * 0.5 / (root > 0.05 ? root : 0.05);
        });
    }
  }
  const double twoC = 2 * this->Field->shape().c;
  for (int j = 0; j <= Steps; ++j)
  {
    const double f = std::abs(block.f[j]);
    block.top[j] = std::copysign(std::sqrt(f * (f + twoC)), block.f[j]);
  }
}

HeightFieldSweep::Inside HeightFieldSweep::insideAt(double r, double top, double bottom)
{
  const std::vector<double>& slopes = *this->Slopes;
  const double inverse = 1 / std::max(r, 1e-300);
  const std::uint32_t plane = below(slopes, this->Last.plane, -this->Eye * inverse);
  if (!(top > 0))
  {
    return { plane, plane, plane };
  }
  return { below(slopes, this->Last.first, (bottom - this->Eye) * inverse),
    below(slopes, this->Last.last, (top - this->Eye) * inverse), plane };
}

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
  double atA = inside(a);
  double atB = inside(b);
  if ((atA > 0) == (atB > 0))
  {
    return std::abs(atA) < std::abs(atB) ? a : b;
  }
  // The Illinois rule: a secant whose stale end counts half. Steep rays and dense clouds ask for more digits.
  const double digits = std::min(1e-5, this->Resolution / block.spacing) / (1 + std::abs(slope));
  const double enough = std::max(1e-13, digits * (to - from));
  int side = 0;
  for (int n = 0; n < 60 && b - a > enough; ++n)
  {
    const double x = n % 8 == 7 ? 0.5 * (a + b) : (a * atB - b * atA) / (atB - atA);
    const double at = inside(x);
    if (n > 0 && std::abs(x - (side > 0 ? b : a)) < enough)
    {
      return x;
    }
    if ((at > 0) == (atB > 0))
    {
      b = x;
      atB = at;
      atA *= side == 1 ? 0.5 : 1;
      side = 1;
    }
    else
    {
      a = x;
      atA = at;
      atB *= side == -1 ? 0.5 : 1;
      side = -1;
    }
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
  const double slope = (*this->Slopes)[ray];
  const double x = (-this->Eye / slope - block.at(j)) / block.spacing;
  if (!(x > 0 && x < 1) || !(block.between(j, x) > 0))
  {
    return;
  }
  const int last = static_cast<int>(this->Blocks.size()) - 1;
  this->Entered[ray] = { block.start + block.spacing * (j + this->crossing(ray, j, 0, x)), last,
    j };
  this->end(
    ray, { block.start + block.spacing * (j + this->crossing(ray, j, x, 1)), last, j }, listener);
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
    if (!this->Done[ray] && !before.holds(ray) && !after.holds(ray))
    {
      this->pierce(ray, j, listener);
    }
  }
}

void HeightFieldSweep::scan(Listener& listener)
{
  const SampleBlock& block = this->Blocks.back();
  const HeightFieldShape& shape = this->Field->shape();
  double bottom[Steps + 1];
  for (int j = 0; j <= Steps; ++j)
  {
    const double u = std::abs(block.f[j]) + shape.c;
    const double root = std::sqrt(u * u + shape.c * shape.c);
    bottom[j] = -shape.depth * block.top[j] / std::max(root, 1e-300);
  }
  if (this->Blocks.size() == 1)
  {
    this->Last = this->insideAt(block.start, block.top[0], bottom[0]);
    for (std::uint32_t ray = this->Last.first; ray < this->Last.last; ++ray)
    {
      this->Entered[ray] = { block.start, 0, 0 };
    }
  }
  for (int j = 0; j < Steps; ++j)
  {
    const Inside next = this->insideAt(block.at(j + 1), block.top[j + 1], bottom[j + 1]);
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
  this->prepare(slice);
  this->Low = -field.shape().depth;
  this->High = field.top(std::max(0.0, field.upperBound()));
  const HeightFieldRange range =
    layerRange(this->Eye, this->Low, this->High, slopes.front(), slopes.back(), slice.far);
  if (!(range.first < range.last))
  {
    return;
  }
  this->Entered.assign(slopes.size(), { 0, -1, 0 });
  this->Done.assign(slopes.size(), 0);
  this->Ahead = { 0, static_cast<std::uint32_t>(slopes.size()) };
  this->Last = {};
  // Without waves F is a parabola, which the cubics follow exactly.
  double spacing =
    std::min(field.shortestWave() / samplesPerWave, (range.last - range.first) / 256);
  spacing = std::max(spacing, (range.last - range.first) / (1.0 * MostBlocks * Steps));
  double start = range.first;
  while (start < range.last && this->isAhead(start, slice.far))
  {
    while (2 * spacing < slice.growth * start)
    {
      spacing *= 2;
    }
    this->sample(start, std::min(spacing, (range.last - start) / Steps));
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
