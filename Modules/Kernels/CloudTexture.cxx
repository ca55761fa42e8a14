// SPDX-License-Identifier: BSD-3-Clause
#include "CloudTexture.h"

#include "Sine.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace nephoscope
{
namespace
{
constexpr double Pi = 3.14159265358979323846;

double inRange(double value, double low, double high, double whenNaN)
{
  return std::isnan(value) ? whenNaN : std::min(std::max(value, low), high);
}

CloudTextureParameters valid(CloudTextureParameters p)
{
  const CloudTextureParameters standard;
  p.wavelength = inRange(p.wavelength, 1e-6, 1e12, standard.wavelength);
  p.octaves = std::min(std::max(p.octaves, 1), CloudTextureParameters::MaximumOctaves);
  p.amplitudeRatio = inRange(p.amplitudeRatio, 0, 1, standard.amplitudeRatio);
  p.offset = inRange(p.offset, 0, 1e3, standard.offset);
  p.threshold = inRange(p.threshold, -1, 1, standard.threshold);
  p.rimThreshold = inRange(p.rimThreshold, -1, 1, standard.rimThreshold);
  p.range = inRange(p.range, 1e-6, 1e3, standard.range);
  return p;
}

/// A number in [0, 1) that is the same with every standard library.
double uniform(std::mt19937& random)
{
  return random() / 4294967296.0;
}

/// A uniformly distributed rotation (Shoemake 1992: a unit quaternion from three uniform numbers), by rows.
std::array<std::array<double, 3>, 3> randomRotation(std::mt19937& random)
{
  const double u = uniform(random);
  const double a = 2 * Pi * uniform(random);
  const double b = 2 * Pi * uniform(random);
  const double x = std::sqrt(1 - u) * std::sin(a);
  const double y = std::sqrt(1 - u) * std::cos(a);
  const double z = std::sqrt(u) * std::sin(b);
  const double w = std::sqrt(u) * std::cos(b);
  return { { { 1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w) },
    { 2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w) },
    { 2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y) } } };
}

double smoothStep(double t)
{
  t = std::min(std::max(t, 0.0), 1.0);
  return t * t * (3 - 2 * t);
}
}

CloudTexture::CloudTexture(const CloudTextureParameters& parameters)
  : Parameters(valid(parameters))
{
  double amplitude = 1;
  double sum = 0;
  for (int i = 0; i < this->Parameters.octaves; ++i)
  {
    this->Frequencies[i] = 2 * Pi / this->Parameters.wavelength * (1 << i);
    this->Amplitudes[i] = amplitude;
    sum += amplitude;
    amplitude *= this->Parameters.amplitudeRatio;
  }
  this->setFrames();
  this->Reach = 1e9 * 2 * Pi / this->Frequencies[this->Parameters.octaves - 1];
  this->Constant = this->Parameters.octaves * this->Parameters.offset;
  const double bound = (sum + this->Constant) * (sum + this->Constant);
  this->K = 1 / (this->Parameters.turned ? bound : this->searchMaximum());
}

void CloudTexture::setFrames()
{
  std::mt19937 random(this->Parameters.seed);
  for (int i = 0; i < this->Parameters.octaves; ++i)
  {
    std::array<std::array<double, 3>, 3> frame = { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } };
    if (this->Parameters.turned)
    {
      frame = randomRotation(random);
    }
    for (int row = 0; row < 3; ++row)
    {
      for (int column = 0; column < 3; ++column)
      {
        this->Axes[row][column][i] = frame[row][column] * this->Frequencies[i];
      }
      // A term repeats after 4 pi because of the halves in its phases.
      this->Shifts[row][i] = this->Parameters.turned ? 4 * Pi * uniform(random) : 0;
    }
  }
}

CloudTexture::Sums CloudTexture::sums(const double x[3], const Terms& weights) const
{
  // Terms finer than the footprint weigh nothing; they are left out by half a row of them.
  constexpr int Half = N / 2;
  const bool fine =
    std::any_of(weights.begin() + Half, weights.end(), [](double weight) { return weight != 0; });
  return fine ? this->sumsOf<N>(x, weights) : this->sumsOf<Half>(x, weights);
}

/// The sums of the first terms. Each loop over the terms is one that the compiler turns into vector instructions.
template <int Count>
CloudTexture::Sums CloudTexture::sumsOf(const double x[3], const Terms& weights) const
{
  Terms u;
  Terms v;
  Terms w;
  for (int i = 0; i < Count; ++i)
  {
    const auto& a = this->Axes;
    u[i] = a[0][0][i] * x[0] + a[0][1][i] * x[1] + a[0][2][i] * x[2] + this->Shifts[0][i];
    v[i] = a[1][0][i] * x[0] + a[1][1][i] * x[1] + a[1][2][i] * x[2] + this->Shifts[1][i];
    w[i] = a[2][0][i] * x[0] + a[2][1][i] * x[1] + a[2][2][i] * x[2] + this->Shifts[2][i];
  }
  Terms first;
  Terms second;
  for (int i = 0; i < Count; ++i)
  {
    const double common = Pi * sine(w[i] / 2);
    first[i] = weights[i] * sine(u[i] + Pi / 2 * sine(v[i] / 2) + common);
    second[i] = weights[i] * sine(v[i] + Pi / 2 * sine(u[i] / 2) + common);
  }
  double sumX = this->Constant;
  double sumY = this->Constant;
  for (int i = 0; i < Count; ++i)
  {
    sumX += first[i];
    sumY += second[i];
  }
  return { sumX, sumY };
}

double CloudTexture::unscaled(const double x[3], const Terms& weights) const
{
  const Sums s = this->sums(x, weights);
  return s.x * s.y;
}

double CloudTexture::searchMaximum() const
{
  // The formula repeats after two wavelengths along each axis: an R3 lattice (Roberts) over that, the best refined.
  constexpr int Samples = 131072;
  constexpr int Best = 1024;
  const double period = 2 * this->Parameters.wavelength;
  std::vector<std::array<double, 4>> found(Samples);
  for (int n = 0; n < Samples; ++n)
  {
    const double x[3] = { period * std::fmod(n * 0.8191725133961645, 1.0),
      period * std::fmod(n * 0.6710436067037893, 1.0),
      period * std::fmod(n * 0.5497004779019703, 1.0) };
    found[n] = { this->unscaled(x, this->Amplitudes), x[0], x[1], x[2] };
  }
  std::partial_sort(found.begin(), found.begin() + Best, found.end(),
    [](const auto& a, const auto& b) { return a[0] > b[0]; });
  double maximum = 0;
  for (int n = 0; n < Best; ++n)
  {
    std::array<double, 4> at = found[n];
    for (double step = period / 50; step > period * 1e-5; step /= 2)
    {
      for (int move = 0; move < 6; ++move)
      {
        double x[3] = { at[1], at[2], at[3] };
        x[move / 2] += move % 2 == 0 ? step : -step;
        const double value = this->unscaled(x, this->Amplitudes);
        if (value > at[0])
        {
          at = { value, x[0], x[1], x[2] };
          move = -1; // further from here
        }
      }
    }
    maximum = std::max(maximum, at[0]);
  }
  return maximum;
}

bool CloudTexture::isNear(const double x[3]) const
{
  // Written so that NaN fails.
  return std::abs(x[0]) <= this->Reach && std::abs(x[1]) <= this->Reach &&
    std::abs(x[2]) <= this->Reach;
}

CloudTexture::Terms CloudTexture::weightsFor(double footprint) const
{
  Terms weights = this->Amplitudes;
  for (int i = 0; footprint > 0 && i < this->Parameters.octaves; ++i)
  {
    const double samplesPerWave = 2 * Pi / (this->Frequencies[i] * footprint);
    weights[i] *= smoothStep(samplesPerWave / 4 - 1);
  }
  return weights;
}

int CloudTexture::termsAt(double footprint) const
{
  const Terms weights = this->weightsFor(footprint);
  return static_cast<int>(
    std::count_if(weights.begin(), weights.end(), [](double weight) { return weight != 0; }));
}

double CloudTexture::value(const double x[3], double footprint) const
{
  return this->isNear(x) ? this->K * this->unscaled(x, this->weightsFor(footprint))
                         : this->K * this->Constant * this->Constant;
}

double CloudTexture::blended(
  const double first[3], const double second[3], double weight, double footprint) const
{
  // Also for a weight that is NaN, and where one texture has no place.
  if (!(weight > 0) || !this->isNear(first))
  {
    return this->value(second, footprint);
  }
  if (weight >= 1 || !this->isNear(second))
  {
    return this->value(first, footprint);
  }
  const Terms weights = this->weightsFor(footprint);
  const Sums a = this->sums(first, weights);
  const Sums b = this->sums(second, weights);
  const double rest = 1 - weight;
  const double contrast = 1 / std::sqrt(weight * weight + rest * rest);
  const double mean = this->Constant;
  const double x = mean + contrast * (weight * (a.x - mean) + rest * (b.x - mean));
  const double y = mean + contrast * (weight * (a.y - mean) + rest * (b.y - mean));
  return std::min(this->K * x * y, 1.0);
}

double CloudTexture::opacity(const double x[3], double footprint, double rim) const
{
  return this->opacityOf(this->value(x, footprint), rim);
}

double CloudTexture::opacityOf(double value, double rim) const
{
  const CloudTextureParameters& p = this->Parameters;
  const double threshold = p.threshold + (p.rimThreshold - p.threshold) * (1 - rim);
  return std::min(std::max((value - threshold) / p.range, 0.0), 1.0);
}
}
