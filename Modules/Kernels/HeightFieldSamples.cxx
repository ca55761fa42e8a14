// SPDX-License-Identifier: BSD-3-Clause
#include "HeightFieldSamples.h"

#include "WideLoops.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
constexpr int Steps = SampleBlock::Steps;

/// A wave about its mean, and its derivative by the argument.
struct WaveValue
{
  double value;
  double slope;
};

/// Adds what is left of a wave to F and dF/dr: `first` at the block's start, `last` at its end. `shape` makes its value of the sine and
/// cosine of its argument.
template <class Shape>
[[gnu::always_inline]] inline void addWave(
  const SampledWave& wave, double first, double last, SampleBlock& block, const Shape& shape)
{
  const double step = (last - first) / Steps;
  const double change = wave.amplitude * step / block.spacing;
  for (int j = 0; j <= Steps; ++j)
  {
    const double s = wave.startSine * wave.cosine[j] + wave.startCosine * wave.sine[j];
    const double c = wave.startCosine * wave.cosine[j] - wave.startSine * wave.sine[j];
    const WaveValue w = shape(s, c);
    const double left = wave.amplitude * (first + j * step);
    block.f[j] += left * w.value;
    block.slope[j] += wave.speed * left * w.slope + change * w.value;
  }
}

NEPHOSCOPE_WIDE void add(const SampledWave& wave, double first, double last, SampleBlock& block)
{
  switch (wave.shape)
  {
    case WaveShape::Sine:
      return addWave(wave, first, last, block,
        [](double s, double c) {
          return WaveValue{ s, c };
        });
    case WaveShape::Absolute:
      return addWave(wave, first, last, block,
        [](double s, double c) {
          return WaveValue{ std::abs(s) - MeanAbsolute, std::copysign(c, c * s) };
        });
    case WaveShape::Root:
      // Towards its kink the slope of the root is held, as that of a sine of 1 / 400 is.
      return addWave(wave, first, last, block,
        [](double s, double c)
        {
          const double root = std::sqrt(std::abs(s));
          return WaveValue{ root - MeanRoot,
            std::copysign(c, c * s) * 0.5 / (root > 0.05 ? root : 0.05) };
        });
  }
}

/// Turns by the wave's speed times a spacing.
void turn(SampledWave& wave, double spacing)
{
  const bool isTwice = spacing == 2 * wave.turned;
  double c = isTwice ? wave.cosine[2] : std::cos(wave.speed * spacing);
  double s = isTwice ? wave.sine[2] : std::sin(wave.speed * spacing);
  wave.cosine[0] = 1;
  wave.sine[0] = 0;
  // By doubling, the angle of each turn twice that of the one before.
  for (int n = 1; n <= Steps; n *= 2)
  {
    for (int j = 0; j < n && n + j <= Steps; ++j)
    {
      wave.cosine[n + j] = c * wave.cosine[j] - s * wave.sine[j];
      wave.sine[n + j] = s * wave.cosine[j] + c * wave.sine[j];
    }
    const double twice = 2 * s * c;
    c = (c - s) * (c + s);
    s = twice;
  }
  wave.turned = spacing;
}
}

void HeightFieldSamples::begin(const HeightField& field, const CloudSlice& slice, double first)
{
  const HeightFieldShape& shape = field.shape();
  const auto& a = shape.polynomial;
  const HeightGradient f = HeightField({ a, {}, shape.c, shape.depth }).gradient(slice.x, slice.y);
  this->Polynomial[0] = f.value;
  this->Polynomial[1] = f.x * slice.ux + f.y * slice.uy;
  this->Polynomial[2] =
    a[3] * slice.ux * slice.ux + a[4] * slice.ux * slice.uy + a[5] * slice.uy * slice.uy;
  this->TwoC = 2 * shape.c;
  this->Waves.resize(shape.waves.size());
  for (std::size_t i = 0; i < this->Waves.size(); ++i)
  {
    const HeightWave& wave = shape.waves[i];
    SampledWave& sampled = this->Waves[i];
    sampled.amplitude = wave.amplitude;
    sampled.shape = wave.shape;
    sampled.speed = wave.p * slice.ux + wave.q * slice.uy;
    sampled.waveNumber = waveNumber(wave) * slice.growth;
    const double angle = wave.p * slice.x + wave.q * slice.y + wave.r + sampled.speed * first;
    sampled.startCosine = std::cos(angle);
    sampled.startSine = std::sin(angle);
    sampled.turned = 0;
    this->Polynomial[0] += wave.amplitude * meanOf(wave.shape);
  }
}

void HeightFieldSamples::sample(double start, double spacing, SampleBlock& block)
{
  block.start = start;
  block.spacing = spacing;
  for (int j = 0; j <= Steps; ++j)
  {
    const double r = block.at(j);
    block.f[j] = this->Polynomial[0] + r * (this->Polynomial[1] + r * this->Polynomial[2]);
    block.slope[j] = this->Polynomial[1] + 2 * r * this->Polynomial[2];
  }
  for (SampledWave& wave : this->Waves)
  {
    const double left = waveLeft(wave.waveNumber * start);
    if (left == 0)
    {
      continue; // and with it all further blocks
    }
    if (spacing != wave.turned)
    {
      turn(wave, spacing);
    }
    add(wave, left, waveLeft(wave.waveNumber * block.at(Steps)), block);
    const double cosine = wave.startCosine;
    wave.startCosine = cosine * wave.cosine[Steps] - wave.startSine * wave.sine[Steps];
    wave.startSine = wave.startSine * wave.cosine[Steps] + cosine * wave.sine[Steps];
  }
  for (int j = 0; j <= Steps; ++j)
  {
    const double f = std::abs(block.f[j]);
    block.top[j] = std::copysign(std::sqrt(f * (f + this->TwoC)), block.f[j]);
  }
}
}
