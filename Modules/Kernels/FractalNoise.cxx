// SPDX-License-Identifier: BSD-3-Clause
#include "FractalNoise.h"

#include "WideLoops.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
/// What a lattice point's coordinates put into its hash; the next point's is a step further.
constexpr std::uint32_t StepX = 0x8da6b343U;
constexpr std::uint32_t StepY = 0xd8163841U;

/// A number that looks drawn by lot (the finaliser of MurmurHash3).
inline std::uint32_t lot(std::uint32_t h)
{
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

constexpr double A = 0.98078528040323045;
constexpr double B = 0.83146961230254524;
constexpr double C = 0.55557023301960218;
constexpr double D = 0.19509032201612825;

/// One of 16 directions, evenly round the circle and none along an axis: by selections, which can be vector instructions.
struct SelectedGradient
{
  [[gnu::always_inline]] Gradient operator()(std::uint32_t hash) const
  {
    const std::uint32_t n = lot(hash);
    const double x = n & 8U ? (n & 4U ? D : C) : (n & 4U ? B : A);
    const double y = n & 8U ? (n & 4U ? A : B) : (n & 4U ? C : D);
    return { n & 1U ? x : -x, n & 2U ? y : -y };
  }
};

/// The same from a table, which is faster one by one.
struct ListedGradient
{
  Gradient operator()(std::uint32_t hash) const
  {
    static constexpr Gradient All[16] = { { -A, -D }, { A, -D }, { -A, D }, { A, D }, { -B, -C },
      { B, -C }, { -B, C }, { B, C }, { -C, -B }, { C, -B }, { -C, B }, { C, B }, { -D, -A },
      { D, -A }, { -D, A }, { D, A } };
    return All[lot(hash) & 15U];
  }
};

/// The greatest whole number that is not above x; std::floor is a call.
inline std::int32_t wholePart(double x)
{
  const auto whole = static_cast<std::int32_t>(x);
  return whole - (whole > x ? 1 : 0);
}

double weight(double t)
{
  return t * t * t * (t * (6 * t - 15) + 10);
}

double weightSlope(double t)
{
  return 30 * t * t * (t - 1) * (t - 1);
}
/// gradientNoise, to be part of loops.
template <class GradientOf>
[[gnu::always_inline]] inline Noise noiseAt(double x, double y, std::uint32_t seed)
{
  const GradientOf gradientOf{};
  const std::int32_t i = wholePart(x);
  const std::int32_t j = wholePart(y);
  const double u = x - i;
  const double v = y - j;
  const std::uint32_t column = static_cast<std::uint32_t>(i) * StepX;
  const std::uint32_t row = static_cast<std::uint32_t>(j) * StepY;
  const std::uint32_t seeded = seed * 0xcb1ab31fU;
  const Gradient g00 = gradientOf(column ^ row ^ seeded);
  const Gradient g10 = gradientOf((column + StepX) ^ row ^ seeded);
  const Gradient g01 = gradientOf(column ^ (row + StepY) ^ seeded);
  const Gradient g11 = gradientOf((column + StepX) ^ (row + StepY) ^ seeded);
  const double ramp00 = g00.x * u + g00.y * v;
  const double ramp10 = g10.x * (u - 1) + g10.y * v;
  const double ramp01 = g01.x * u + g01.y * (v - 1);
  const double ramp11 = g11.x * (u - 1) + g11.y * (v - 1);
  const double wu = weight(u);
  const double wv = weight(v);
  const double low = ramp00 + wu * (ramp10 - ramp00);
  const double high = ramp01 + wu * (ramp11 - ramp01);
  const auto mixed = [wu, wv](double a, double b, double c, double d)
  { return (1 - wv) * (a + wu * (b - a)) + wv * (c + wu * (d - c)); };
  // Each gradient is at most 1 long and each corner's weight falls with its distance: 1 / sqrt(1/2) makes the bound 1.
  constexpr double Scale = 1.4142135623730951;
  return { Scale * (low + wv * (high - low)),
    Scale *
      (mixed(g00.x, g10.x, g01.x, g11.x) +
        weightSlope(u) * ((1 - wv) * (ramp10 - ramp00) + wv * (ramp11 - ramp01))),
    Scale * (mixed(g00.y, g10.y, g01.y, g11.y) + weightSlope(v) * (high - low)) };
}

/// Some places of hills, worked at together.
struct HillPlaces
{
  static constexpr int Size = 16;
  double u[Size]; ///< in lattice widths of the octave
  double v[Size];
  double slopeX[Size];
  double slopeY[Size];
  double sum[Size];
};

/// Adds an octave and goes on to the lattice of the next.
NEPHOSCOPE_WIDE void addOctave(
  HillPlaces& places, double amplitude, double wear, std::uint32_t seed)
{
  constexpr double Cosine = 0.79863551004729283; // of 37 degrees
  constexpr double Sine = 0.60181502315204827;
  for (int n = 0; n < HillPlaces::Size; ++n)
  {
    const double u = places.u[n];
    const double v = places.v[n];
    const Noise noise = noiseAt<SelectedGradient>(u, v, seed);
    const double slopeX = places.slopeX[n] + noise.dx;
    const double slopeY = places.slopeY[n] + noise.dy;
    places.slopeX[n] = slopeX;
    places.slopeY[n] = slopeY;
    places.sum[n] += amplitude * noise.value / (1 + wear * (slopeX * slopeX + slopeY * slopeY));
    places.u[n] = 2 * (Cosine * u - Sine * v);
    places.v[n] = 2 * (Sine * u + Cosine * v);
  }
}
}

Noise gradientNoise(double x, double y, std::uint32_t seed)
{
  return noiseAt<ListedGradient>(x, y, seed);
}

/// Calls add(amplitude, scale, seed) for each octave that a footprint can show.
template <class Add>
void NoiseOctaves::forEach(double footprint, const Add& add) const
{
  double length = this->wavelength;
  double amplitude = 1;
  for (int octave = 0; octave < this->octaves; ++octave)
  {
    const double fade = footprint > 0 ? std::clamp(length / (2 * footprint) - 1, 0.0, 1.0) : 1;
    if (fade <= 0)
    {
      break;
    }
    add(fade * amplitude, 2 / length, this->seed + static_cast<std::uint32_t>(octave));
    length /= 2;
    amplitude *= this->gain;
  }
}

Noise NoiseOctaves::operator()(double x, double y, double footprint) const
{
  Noise sum{ 0, 0, 0 };
  this->forEach(footprint,
    [&sum, x, y](double amplitude, double scale, std::uint32_t lots)
    {
      const Noise noise = noiseAt<ListedGradient>(x * scale, y * scale, lots);
      sum.value += amplitude * noise.value;
      sum.dx += amplitude * scale * noise.dx;
      sum.dy += amplitude * scale * noise.dy;
    });
  return sum;
}

double NoiseOctaves::value(double x, double y, double footprint) const
{
  double sum = 0;
  this->forEach(footprint,
    [&sum, x, y](double amplitude, double scale, std::uint32_t lots)
    { sum += amplitude * noiseAt<ListedGradient>(x * scale, y * scale, lots).value; });
  return sum;
}

void FractalHills::row(double x, double y, double spacing, std::size_t count, float* heights) const
{
  constexpr std::size_t Size = HillPlaces::Size;
  for (std::size_t first = 0; first < count; first += Size)
  {
    HillPlaces places{};
    for (std::size_t n = 0; n < Size; ++n)
    {
      places.u[n] = 2 * (x + static_cast<double>(first + n) * spacing) / this->wavelength;
      places.v[n] = 2 * y / this->wavelength;
    }
    double amplitude = 1;
    for (int octave = 0; octave < this->octaves; ++octave)
    {
      addOctave(places, amplitude, this->wear, this->seed + static_cast<std::uint32_t>(octave));
      amplitude *= this->gain;
    }
    const std::size_t here = std::min(Size, count - first);
    for (std::size_t n = 0; n < here; ++n)
    {
      heights[first + n] = static_cast<float>(this->mean + 0.5 * this->relief * places.sum[n]);
    }
  }
}
}
