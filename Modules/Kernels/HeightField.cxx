// SPDX-License-Identifier: BSD-3-Clause
#include "HeightField.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephoscope
{
namespace
{
constexpr double Pi = 3.141592653589793;

/// w(argument) and dw / d argument.
struct WaveValue
{
  double value;
  double slope;
};

WaveValue waveAt(WaveShape shape, double argument)
{
  const double s = std::sin(argument);
  const double c = std::cos(argument);
  if (shape == WaveShape::Sine)
  {
    return { s, c };
  }
  const double turned = s < 0 ? -c : (s > 0 ? c : 0);
  if (shape == WaveShape::Absolute)
  {
    return { std::abs(s), turned };
  }
  const double root = std::sqrt(std::abs(s));
  return { root, root > 0 ? turned / (2 * root) : 0 };
}

double finite(double x)
{
  return std::isfinite(x) ? x : 0;
}

/// How many periods of a wave lie in a vector, rounded.
double periods(const HeightWave& wave, double vx, double vy)
{
  const double period = wave.shape == WaveShape::Sine ? 2 * Pi : Pi;
  return std::round((wave.p * vx + wave.q * vy) / period);
}
}

HeightField::HeightField(HeightFieldShape shape)
  : Shape(std::move(shape))
{
  for (double& a : this->Shape.polynomial)
  {
    a = finite(a);
  }
  for (HeightWave& wave : this->Shape.waves)
  {
    wave = { finite(wave.amplitude), finite(wave.p), finite(wave.q), finite(wave.r), wave.shape };
  }
  this->Shape.c = std::max(0.0, finite(this->Shape.c));
  this->Shape.depth = std::max(1e-6, finite(this->Shape.depth));
  this->InverseDepthSquared = 1 / (this->Shape.depth * this->Shape.depth);
}

double HeightField::value(double x, double y) const
{
  return this->gradient(x, y).value;
}

HeightGradient HeightField::gradient(double x, double y) const
{
  const auto& a = this->Shape.polynomial;
  HeightGradient f{ a[0] + a[1] * x + a[2] * y + a[3] * x * x + a[4] * x * y + a[5] * y * y,
    a[1] + 2 * a[3] * x + a[4] * y, a[2] + a[4] * x + 2 * a[5] * y };
  for (const HeightWave& wave : this->Shape.waves)
  {
    const WaveValue w = waveAt(wave.shape, wave.p * x + wave.q * y + wave.r);
    f.value += wave.amplitude * w.value;
    f.x += wave.amplitude * wave.p * w.slope;
    f.y += wave.amplitude * wave.q * w.slope;
  }
  return f;
}

double HeightField::value(double x, double y, double pixel) const
{
  const auto& a = this->Shape.polynomial;
  double f = a[0] + a[1] * x + a[2] * y + a[3] * x * x + a[4] * x * y + a[5] * y * y;
  for (const HeightWave& wave : this->Shape.waves)
  {
    const double mean = meanOf(wave.shape);
    const double left = waveLeft(waveNumber(wave) * pixel);
    f += wave.amplitude * mean;
    if (left > 0)
    {
      f +=
        left * wave.amplitude * (waveAt(wave.shape, wave.p * x + wave.q * y + wave.r).value - mean);
    }
  }
  return f;
}

HeightGradient HeightField::top(const HeightGradient& f) const
{
  const double g = this->top(f.value);
  const double slope = g != 0 ? (std::abs(f.value) + this->Shape.c) / std::abs(g) : 0;
  return { g, slope * f.x, slope * f.y };
}

HeightGradient HeightField::bottom(const HeightGradient& f) const
{
  // h = -D sqrt((t - c^2) / (t + c^2)), dh/dt = -D c^2 / ((t + c^2)^2 sqrt(...)), dt/dF = 2 (|F| + c).
  const double u = std::abs(f.value) + this->Shape.c;
  const double c2 = this->Shape.c * this->Shape.c;
  const double sum = u * u + c2;
  const double g = std::abs(this->top(f.value));
  const double slope = g > 0 ? -2 * this->Shape.depth * c2 * u / (sum * std::sqrt(sum) * g) : 0;
  return { this->bottom(f.value), slope * f.x, slope * f.y };
}

double HeightField::upperBound() const
{
  const auto& a = this->Shape.polynomial;
  double bound = a[0];
  const double determinant = 4 * a[3] * a[5] - a[4] * a[4];
  if (a[3] < 0 && determinant > 0)
  {
    const double x = (a[4] * a[2] - 2 * a[5] * a[1]) / determinant;
    const double y = (a[4] * a[1] - 2 * a[3] * a[2]) / determinant;
    bound += 0.5 * (a[1] * x + a[2] * y);
  }
  else if (std::any_of(a.begin() + 1, a.end(), [](double k) { return k != 0; }))
  {
    // A ridge along an axis still has a maximum.
    const bool ridgeX = a[3] < 0 && a[2] == 0 && a[4] == 0 && a[5] == 0;
    const bool ridgeY = a[5] < 0 && a[1] == 0 && a[4] == 0 && a[3] == 0;
    if (!ridgeX && !ridgeY)
    {
      return std::numeric_limits<double>::infinity();
    }
    bound -= ridgeX ? a[1] * a[1] / (4 * a[3]) : a[2] * a[2] / (4 * a[5]);
  }
  for (const HeightWave& wave : this->Shape.waves)
  {
    bound +=
      wave.shape == WaveShape::Sine ? std::abs(wave.amplitude) : std::max(0.0, wave.amplitude);
  }
  return bound;
}

double HeightField::shortestWave() const
{
  double shortest = std::numeric_limits<double>::infinity();
  for (const HeightWave& wave : this->Shape.waves)
  {
    const double k = std::hypot(wave.p, wave.q);
    if (k > 0 && wave.amplitude != 0)
    {
      shortest = std::min(shortest, 2 * Pi / k);
    }
  }
  return shortest;
}

std::vector<double> HeightField::kinks(
  double x, double y, double ux, double uy, double t0, double t1, int most) const
{
  std::vector<double> at;
  for (const HeightWave& wave : this->Shape.waves)
  {
    const double speed = wave.p * ux + wave.q * uy;
    if (wave.shape == WaveShape::Sine || speed == 0)
    {
      continue;
    }
    const double start = (wave.p * x + wave.q * y + wave.r) / Pi;
    const double a = start + speed / Pi * t0;
    const double b = start + speed / Pi * t1;
    double n = std::floor(std::min(a, b)) + 1;
    for (int count = 0; n < std::max(a, b) && count < most; ++count, ++n)
    {
      at.push_back((n - start) * Pi / speed);
    }
  }
  std::sort(at.begin(), at.end());
  return at;
}

HeightFieldShape repeating(HeightFieldShape shape, double vx, double vy)
{
  const double square = vx * vx + vy * vy;
  if (!(square > 0) || !std::isfinite(square))
  {
    return shape;
  }
  for (HeightWave& wave : shape.waves)
  {
    const double period = wave.shape == WaveShape::Sine ? 2 * Pi : Pi;
    const double missing = (periods(wave, vx, vy) * period - (wave.p * vx + wave.q * vy)) / square;
    wave.p += missing * vx;
    wave.q += missing * vy;
  }
  return shape;
}

HeightFieldShape cycleFrame(
  HeightFieldShape shape, double vx, double vy, long long frame, long long frames)
{
  const long long of = std::max(1LL, frames);
  const double part = static_cast<double>((frame % of + of) % of) / static_cast<double>(of);
  for (HeightWave& wave : shape.waves)
  {
    const double period = wave.shape == WaveShape::Sine ? 2 * Pi : Pi;
    wave.r -= period * periods(wave, vx, vy) * part;
  }
  return shape;
}
}
