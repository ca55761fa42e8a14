// SPDX-License-Identifier: BSD-3-Clause
#include "FractalNoise.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
/// A number that looks drawn by lot for each lattice point (the finaliser of MurmurHash3).
std::uint32_t lot(std::int64_t i, std::int64_t j, std::uint32_t seed)
{
  std::uint32_t h = static_cast<std::uint32_t>(i) * 0x8da6b343U ^
    static_cast<std::uint32_t>(j) * 0xd8163841U ^ seed * 0xcb1ab31fU;
  h ^= h >> 16;
  h *= 0x85ebca6bU;
  h ^= h >> 13;
  h *= 0xc2b2ae35U;
  return h ^ h >> 16;
}

struct Gradient
{
  double x;
  double y;
};

/// One of 16 directions, evenly round the circle and none along an axis.
Gradient gradientAt(std::int64_t i, std::int64_t j, std::uint32_t seed)
{
  constexpr double C[4] = { 0.98078528040323045, 0.83146961230254524, 0.55557023301960218,
    0.19509032201612825 };
  const std::uint32_t h = lot(i, j, seed);
  const int k = static_cast<int>(h >> 2 & 3U);
  return { h & 1U ? C[k] : -C[k], h & 2U ? C[3 - k] : -C[3 - k] };
}

double weight(double t)
{
  return t * t * t * (t * (6 * t - 15) + 10);
}

double weightSlope(double t)
{
  return 30 * t * t * (t - 1) * (t - 1);
}
}

Noise gradientNoise(double x, double y, std::uint32_t seed)
{
  const double i = std::floor(x);
  const double j = std::floor(y);
  const double u = x - i;
  const double v = y - j;
  Gradient g[2][2];
  double ramp[2][2];
  for (int b = 0; b < 2; ++b)
  {
    for (int a = 0; a < 2; ++a)
    {
      g[b][a] =
        gradientAt(static_cast<std::int64_t>(i) + a, static_cast<std::int64_t>(j) + b, seed);
      ramp[b][a] = g[b][a].x * (u - a) + g[b][a].y * (v - b);
    }
  }
  const double wu = weight(u);
  const double wv = weight(v);
  const double low = ramp[0][0] + wu * (ramp[0][1] - ramp[0][0]);
  const double high = ramp[1][0] + wu * (ramp[1][1] - ramp[1][0]);
  const auto mixed = [wu, wv](double a, double b, double c, double d)
  { return (1 - wv) * (a + wu * (b - a)) + wv * (c + wu * (d - c)); };
  // Each gradient is at most 1 long and each corner's weight falls with its distance: 1 / sqrt(1/2) makes the bound 1.
  constexpr double Scale = 1.4142135623730951;
  return { Scale * (low + wv * (high - low)),
    Scale *
      (mixed(g[0][0].x, g[0][1].x, g[1][0].x, g[1][1].x) +
        weightSlope(u) * ((1 - wv) * (ramp[0][1] - ramp[0][0]) + wv * (ramp[1][1] - ramp[1][0]))),
    Scale * (mixed(g[0][0].y, g[0][1].y, g[1][0].y, g[1][1].y) + weightSlope(v) * (high - low)) };
}

Noise NoiseOctaves::operator()(double x, double y, double footprint) const
{
  Noise sum{ 0, 0, 0 };
  double length = this->wavelength;
  double amplitude = 1;
  for (int octave = 0; octave < this->octaves; ++octave)
  {
    const double fade = footprint > 0 ? std::clamp(length / (2 * footprint) - 1, 0.0, 1.0) : 1;
    if (fade <= 0)
    {
      break;
    }
    const double scale = 2 / length;
    const Noise noise =
      gradientNoise(x * scale, y * scale, this->seed + static_cast<std::uint32_t>(octave));
    sum.value += fade * amplitude * noise.value;
    sum.dx += fade * amplitude * scale * noise.dx;
    sum.dy += fade * amplitude * scale * noise.dy;
    length /= 2;
    amplitude *= this->gain;
  }
  return sum;
}

double FractalHills::height(double x, double y) const
{
  constexpr double Cosine = 0.79863551004729283; // of 37 degrees
  constexpr double Sine = 0.60181502315204827;
  double u = 2 * x / this->wavelength;
  double v = 2 * y / this->wavelength;
  double slopeX = 0;
  double slopeY = 0;
  double amplitude = 1;
  double sum = 0;
  for (int octave = 0; octave < this->octaves; ++octave)
  {
    const Noise noise = gradientNoise(u, v, this->seed + static_cast<std::uint32_t>(octave));
    slopeX += noise.dx;
    slopeY += noise.dy;
    sum += amplitude * noise.value / (1 + this->wear * (slopeX * slopeX + slopeY * slopeY));
    amplitude *= this->gain;
    const double turned = 2 * (Cosine * u - Sine * v);
    v = 2 * (Sine * u + Cosine * v);
    u = turned;
  }
  return this->mean + 0.5 * this->relief * sum;
}
}
