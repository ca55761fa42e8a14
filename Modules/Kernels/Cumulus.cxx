// SPDX-License-Identifier: BSD-3-Clause
#include "Cumulus.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
constexpr double Pi = 3.141592653589793;
constexpr std::size_t Head = 9; ///< numbers before the waves
constexpr std::size_t PerWave = 5;

/// Numbers in [0, 1) that look random (Steele, Lea and Flood 2014, SplitMix).
class Draw
{
public:
  explicit Draw(std::uint64_t seed)
    : State(seed)
  {
  }
  double operator()()
  {
    std::uint64_t z = (this->State += 0x9e3779b97f4a7c15U);
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1p-53;
  }

private:
  std::uint64_t State;
};

/// The x below which a share of the standard normal distribution lies, by bisection.
double normalQuantile(double share)
{
  double low = -6;
  double high = 6;
  for (int n = 0; n < 50; ++n)
  {
    const double x = 0.5 * (low + high);
    (0.5 * std::erfc(-x / std::sqrt(2.0)) < share ? low : high) = x;
  }
  return low;
}
}

HeightFieldShape cumulusShape(const Cumulus& cumulus)
{
  const int count = std::clamp(cumulus.waves, 1, 64);
  const double longest = std::max(1e-3, cumulus.wavelength);
  const double shortening = std::clamp(cumulus.shortening, 0.01, 1.0);
  HeightFieldShape shape;
  shape.c = cumulus.roundness;
  shape.depth = cumulus.depth;
  Draw draw(cumulus.seed);
  // Directions by the golden angle fill the half circle evenly.
  const double turn = Pi * draw();
  double mean = 0;
  double variance = 0;
  for (int i = 0; i < count; ++i)
  {
    const double part = std::pow(shortening, i);
    const double angle = turn + i * Pi * 0.6180339887498949 + 0.3 * (draw() - 0.5);
    const double k = 2 * Pi / (longest * part);
    const bool isBillow = i >= count - cumulus.billows;
    const double amplitude = cumulus.relief * std::pow(part, cumulus.smoothness);
    // A billow is as long as a wave: half a period of its sine.
    const double number = isBillow ? 0.5 * k : k;
    shape.waves.push_back({ amplitude, number * std::cos(angle), number * std::sin(angle),
      2 * Pi * draw(), isBillow ? WaveShape::Absolute : WaveShape::Sine });
    mean += isBillow ? amplitude * 2 / Pi : 0;
    variance += amplitude * amplitude * (isBillow ? 0.5 - 4 / (Pi * Pi) : 0.5);
  }
  const double cover = std::clamp(cumulus.cover, 1e-6, 1 - 1e-6);
  shape.polynomial[0] = std::sqrt(variance) * normalQuantile(cover) - mean;
  return shape;
}

std::vector<double> numbersOf(const HeightFieldShape& shape, double planeHeight)
{
  std::vector<double> numbers{ planeHeight, shape.c, shape.depth };
  numbers.insert(numbers.end(), shape.polynomial.begin(), shape.polynomial.end());
  for (const HeightWave& wave : shape.waves)
  {
    for (const double number :
      { wave.amplitude, wave.p, wave.q, wave.r, static_cast<double>(wave.shape) })
    {
      numbers.push_back(number);
    }
  }
  return numbers;
}

bool shapeOf(const double* numbers, std::size_t count, HeightFieldShape& shape, double& planeHeight)
{
  if (count < Head || (count - Head) % PerWave != 0)
  {
    return false;
  }
  planeHeight = numbers[0];
  shape.c = numbers[1];
  shape.depth = numbers[2];
  std::copy(numbers + 3, numbers + Head, shape.polynomial.begin());
  shape.waves.clear();
  for (const double* at = numbers + Head; at != numbers + count; at += PerWave)
  {
    if (!(at[4] == 0 || at[4] == 1 || at[4] == 2))
    {
      return false;
    }
    shape.waves.push_back({ at[0], at[1], at[2], at[3], static_cast<WaveShape>(at[4]) });
  }
  return true;
}
}
