// SPDX-License-Identifier: BSD-3-Clause
#include "Exponential.h"
#include "HeightFieldMethods.h"
#include "WideLoops.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
constexpr int Steps = SampleBlock::Steps;

/// Coefficients of 1, t, t^2, t^3 of a cubic.
struct Cubic
{
  double a[4];
};

/**
 * The cubic that is closest to exp(-x t) on [-1, 1] in the mean square, to x^7: the even and odd parts of the series with t^4, t^5
 * and t^6 replaced by 6/7 t^2 - 3/35, 10/9 t^3 - 5/21 t and 5/7 t^2 - 2/21, their projections.
 */
Cubic fading(double x)
{
  const double x2 = x * x;
  return { { 1 - x2 * x2 * (1.0 / 280 + x2 / 7560), -x * (1 - x2 * x2 / 504),
    x2 * (0.5 + x2 * (1.0 / 28 + x2 / 1008)), -x * x2 * (1.0 / 6 + x2 / 108) } };
}

/// The same cubic in u, where t = scale u + shift.
Cubic in(const Cubic& c, double scale, double shift)
{
  const double* const a = c.a;
  return { { a[0] + shift * (a[1] + shift * (a[2] + shift * a[3])),
    scale * (a[1] + shift * (2 * a[2] + shift * 3 * a[3])),
    scale * scale * (a[2] + shift * 3 * a[3]), scale * scale * scale * a[3] } };
}

/// G = exp(-rhoA g) for the two Gauss points of each step.
NEPHOSCOPE_WIDE void transmitted(
  const SampleBlock& block, double sun, double twoC, double* left, double* right)
{
  constexpr double X = 0.21132486540518712; // (1 - 1 / sqrt 3) / 2
  // Hermite weights of the nearer and the farther value and slope.
  constexpr double Near = (1 + 2 * X) * (1 - X) * (1 - X);
  constexpr double NearSlope = X * (1 - X) * (1 - X);
  constexpr double FarSlope = X * X * (1 - X);
  for (int j = 0; j < Steps; ++j)
  {
    const double d0 = block.slope[j] * block.spacing;
    const double d1 = block.slope[j + 1] * block.spacing;
    const double a =
      Near * block.f[j] + (1 - Near) * block.f[j + 1] + NearSlope * d0 - FarSlope * d1;
    const double b =
      Near * block.f[j + 1] + (1 - Near) * block.f[j] + FarSlope * d0 - NearSlope * d1;
    const double f = a > 0 ? a : 0.0;
    const double g = b > 0 ? b : 0.0;
    left[j] = exponential(-sun * std::sqrt(f * (f + twoC)));
    right[j] = exponential(-sun * std::sqrt(g * (g + twoC)));
  }
}
}

/// A segment that is being integrated.
struct HeightFieldMoments::Stretch
{
  const HeightFieldRay& ray;
  double nearEnd;
  double r;  ///< how far it is done
  int block; ///< of r
  int step;
};

void HeightFieldMoments::run(const CloudSlice& slice)
{
  this->Tables.clear();
  this->Tall = false;
  this->Sweep.run(this->Field, this->PlaneHeight, slice, this->Slopes,
    this->Settings.samplesPerWave, this->resolution(), *this);
}

void HeightFieldMoments::sampled(const SampleBlock& block)
{
  const double sun = this->Densities.sun;
  const double highest = *std::max_element(block.top, block.top + Steps + 1);
  this->Light->largestSunArgument = std::max(this->Light->largestSunArgument, sun * highest);
  this->Tall = this->Tall || sun * highest > 300;
  double left[Steps] = {}; // of no use where no ray is inside at any sample
  double right[Steps] = {};
  if (highest > 0)
  {
    transmitted(block, sun, 2 * this->Field.shape().c, left, right);
  }
  const bool isFirst = this->Tables.empty();
  if (isFirst)
  {
    this->First = block.start;
    this->Unit = Steps * block.spacing;
  }
  Table& table = this->Tables.emplace_back();
  double sum[Orders] = {};
  for (int j = 0; j < Steps; ++j)
  {
    constexpr double X = 0.21132486540518712;
    const double u = (j + X) / Steps;
    const double v = (j + 1 - X) / Steps;
    double a = 0.5 * block.spacing * left[j];
    double b = 0.5 * block.spacing * right[j];
    for (int i = 0; i < Orders; ++i)
    {
      table.moment[i][j] = sum[i];
      sum[i] += a + b;
      a *= u;
      b *= v;
    }
  }
  for (int i = 0; i < Orders; ++i)
  {
    table.moment[i][Steps] = sum[i];
    table.before[i] = 0;
  }
  if (!isFirst)
  {
    this->joinTables();
  }
}

/// What lies before the newest table.
void HeightFieldMoments::joinTables()
{
  const std::size_t now = this->Tables.size() - 1;
  Table& table = this->Tables[now];
  const Table& previous = this->Tables[now - 1];
  // v = scale u + shift in the block before.
  const SampleBlock& last = this->Sweep.block(static_cast<int>(now) - 1);
  const double scale = Steps * last.spacing / this->Unit;
  const double shift = (last.start - this->First) / this->Unit;
  for (int i = 0; i < Orders; ++i)
  {
    Cubic power{};
    power.a[i] = 1;
    const Cubic local = in(power, scale, shift);
    double whole = 0;
    for (int n = 0; n < Orders; ++n)
    {
      whole += local.a[n] * previous.moment[n][Steps];
    }
    table.before[i] = previous.before[i] + whole;
  }
}

/// The light of whole steps from the stretch's place to another, from the tables.
double HeightFieldMoments::table(const Stretch& stretch, int toBlock, int toStep) const
{
  const int block = stretch.block;
  const int step = stretch.step;
  const HeightFieldRay& ray = stretch.ray;
  const double from = stretch.r;
  const double to = this->Sweep.block(toBlock).at(toStep);
  const double half = 0.5 * (to - from);
  const double middle = 0.5 * (to + from);
  const Cubic cubic = fading(ray.delta() * half);
  const auto local = [&](int b, int j0, int j1)
  {
    const SampleBlock& samples = this->Sweep.block(b);
    const Cubic c = in(cubic, Steps * samples.spacing / half, (samples.start - middle) / half);
    const auto& moment = this->Tables[static_cast<std::size_t>(b)].moment;
    double sum = 0;
    for (int i = 0; i < Orders; ++i)
    {
      sum += c.a[i] * (moment[i][j1] - moment[i][j0]);
    }
    return sum;
  };
  double sum;
  if (block == toBlock)
  {
    sum = local(block, step, toStep);
  }
  else
  {
    sum = local(block, step, Steps) + local(toBlock, 0, toStep);
    if (toBlock > block + 1)
    {
      const Cubic c = in(cubic, this->Unit / half, (this->First - middle) / half);
      const Table& first = this->Tables[static_cast<std::size_t>(block) + 1];
      const Table& last = this->Tables[static_cast<std::size_t>(toBlock)];
      for (int i = 0; i < Orders; ++i)
      {
        sum += c.a[i] * (last.before[i] - first.before[i]);
      }
    }
  }
  const double depth = ray.view * (middle - stretch.nearEnd) - ray.sun * ray.zeta(middle);
  return ray.view * exponential(-depth) * sum;
}

/// The light from the stretch's place to one before the next sample; isDense where a step is a large optical depth.
double HeightFieldMoments::direct(const Stretch& stretch, double to, bool isDense) const
{
  const SampleBlock& block = this->Sweep.block(stretch.block);
  const HeightFieldRay& ray = stretch.ray;
  const double from = stretch.r;
  const double sample = block.at(stretch.step);
  const auto topAt = [&](double r)
  {
    const double f = block.between(stretch.step, (r - sample) / block.spacing);
    return this->Field.top(f > 0 ? f : 0);
  };
  LinearSteps linear(ray, stretch.nearEnd);
  linear.start(from, topAt(from));
  if (!isDense)
  {
    // g is steepest at the segment's end.
    const double split = from + (from == stretch.nearEnd ? 0.25 : 0.75) * (to - from);
    const double first = linear.to(split, topAt(split));
    return first + linear.to(to, topAt(to));
  }
  const double step = std::min(2 / ray.view, 0.25 * block.spacing);
  double light = 0;
  for (double r = from; r < to && ray.view * (r - stretch.nearEnd) < OpaqueViewDepth;)
  {
    r = r + step < to ? r + step : to;
    light += linear.to(r, topAt(r));
  }
  return light;
}

/// The last sample at or before r, which is between the stretch's and the segment's last.
SweepPlace HeightFieldMoments::sampleBefore(
  double r, const Stretch& stretch, const SweepPlace& last) const
{
  int low = stretch.block;
  int high = last.block;
  while (low < high)
  {
    const int middle = (low + high + 1) / 2;
    const bool isBefore = this->Sweep.block(middle).start <= r;
    low = isBefore ? middle : low;
    high = isBefore ? high : middle - 1;
  }
  const SampleBlock& block = this->Sweep.block(low);
  const int step = std::min(Steps, static_cast<int>((r - block.start) / block.spacing));
  return { r, low, low == last.block ? std::min(step, last.step) : step };
}

double HeightFieldMoments::light(
  const HeightFieldRay& ray, const SweepPlace& in, const SweepPlace& out) const
{
  Stretch stretch{ ray, in.r, in.r, in.block, in.step };
  const double delta = std::max(std::abs(ray.delta()), 1e-300);
  double light = 0;
  bool onSample = false;
  while (stretch.r < out.r && stretch.block <= out.block)
  {
    const double depth = ray.view * (stretch.r - stretch.nearEnd);
    if (depth >= OpaqueViewDepth)
    {
      break;
    }
    ++this->Light->pieces;
    const SampleBlock& block = this->Sweep.block(stretch.block);
    const bool isDense =
      this->Tall || (ray.view + ray.sun * (1 + std::abs(ray.slope))) * block.spacing > 4;
    const double piece = this->Settings.pieceDepth * exponential(depth / 4) / delta;
    const SweepPlace to = onSample && !isDense
      ? this->sampleBefore(std::min(stretch.r + piece, out.r), stretch, out)
      : SweepPlace{ stretch.r, stretch.block, stretch.step };
    const double whole = this->Sweep.block(to.block).at(to.step);
    if (whole > stretch.r)
    {
      light += this->table(stretch, to.block, to.step);
      stretch.r = whole;
      stretch.block = to.block;
      stretch.step = to.step;
    }
    else
    {
      const double next = std::min(out.r, block.at(stretch.step + 1));
      light += this->direct(stretch, next, isDense);
      stretch.r = next;
      ++stretch.step;
      onSample = true;
    }
    if (stretch.step == Steps)
    {
      ++stretch.block;
      stretch.step = 0;
    }
  }
  return light;
}

bool HeightFieldMoments::chord(std::uint32_t ray, const SweepPlace& in, const SweepPlace& out)
{
  const HeightFieldRay at(this->Sweep.eye(), this->Slopes[ray], this->Densities);
  const double end = this->endOf(ray);
  if (!(end > in.r))
  {
    return true;
  }
  if (end >= out.r)
  {
    return this->add(ray, in.r, out.r, this->light(at, in, out));
  }
  const SweepPlace place =
    this->sampleBefore(end, Stretch{ at, in.r, in.r, in.block, in.step }, out);
  return this->add(ray, in.r, end, this->light(at, in, { end, place.block, place.step }));
}
}
