// SPDX-License-Identifier: BSD-3-Clause
#include "WaterWaves.h"

#include "Exponential.h"
#include "Sine.h"
#include "WideLoops.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr double Gravity = 9.81; // m/s2

/// Numbers in [0, 1) that look drawn by lot: additive recurrence by irrational steps.
double lot(std::uint32_t seed, int n, double step)
{
  const double x = 0.5 + step * (n + 1) + 0.754877666 * seed;
  return x - std::floor(x);
}

/// The angle whose share of a cos^2 distribution over (-pi/2, pi/2) lies below it.
double angleOf(double share)
{
  double angle = 0;
  for (int n = 0; n < 40; ++n) // Newton's method on (angle + sin(2 angle) / 2) / pi + 1/2 = share
  {
    const double cosine = std::max(std::cos(angle), 0.05);
    angle -= (angle + 0.5 * std::sin(2 * angle) - Pi * (share - 0.5)) / (2 * cosine * cosine);
    angle = std::clamp(angle, -Pi / 2, Pi / 2);
  }
  return angle;
}
}

double WaterSlopes::density(double slopeX, double slopeY) const
{
  const double determinant = this->xx * this->yy - this->xy * this->xy;
  const double dx = slopeX - this->x;
  const double dy = slopeY - this->y;
  const double square =
    (this->yy * dx * dx - 2 * this->xy * dx * dy + this->xx * dy * dy) / determinant;
  return determinant > 0 ? std::exp(-square / 2) / (2 * Pi * std::sqrt(determinant)) : 0;
}

WaterWaves::WaterWaves(const WaterWavesParameters& p)
{
  const int number = std::max(p.number, 1);
  const double meanSquareSlope = p.windSpeed > 0 ? 0.003 + 0.00512 * p.windSpeed : 0;
  const double steepness = std::sqrt(2 * meanSquareSlope / number);
  const double downwind = std::atan2(p.wind[1], p.wind[0]);
  for (int n = 0; n < number; ++n)
  {
    // Between even steps of the logarithm, so that no two waves beat for long.
    const double share = (n + lot(p.seed, n, 0.6180339887)) / number;
    const double k = 2 * Pi / (p.longest * std::pow(p.shortest / p.longest, share));
    const double angle = downwind + angleOf(lot(p.seed, n, 0.4142135624));
    double frequency = std::sqrt(Gravity * k);
    if (p.period > 0)
    {
      frequency = std::round(frequency * p.period / (2 * Pi)) * 2 * Pi / p.period;
    }
    const double phase = 2 * Pi * lot(p.seed, n, 0.7320508076) - frequency * p.time;
    const int place = n % Group::Size;
    if (place == 0)
    {
      this->Groups.push_back({});
    }
    Group& group = this->Groups.back();
    group.kx[place] = k * std::cos(angle);
    group.ky[place] = k * std::sin(angle);
    group.amplitude[place] = steepness / k;
    group.phase[place] = phase;
  }
}

NEPHOSCOPE_WIDE WaterSlopes WaterWaves::slopes(
  double x, double y, const Vector3& along, const Vector3& across) const
{
  constexpr int Size = Group::Size;
  double sx[Size] = {}, sy[Size] = {}, sxx[Size] = {}, sxy[Size] = {}, syy[Size] = {};
  for (const Group& group : this->Groups)
  {
    for (int n = 0; n < Size; ++n)
    {
      const double kx = group.kx[n];
      const double ky = group.ky[n];
      const double amplitude = group.amplitude[n];
      const double a = kx * along[0] + ky * along[1];
      const double b = kx * across[0] + ky * across[1];
      const double weight = exponential(-9.0 / 32 * (a * a + b * b));
      const double cosine = sine(kx * x + ky * y + group.phase[n] + Pi / 2);
      sx[n] += weight * amplitude * kx * cosine;
      sy[n] += weight * amplitude * ky * cosine;
      const double variance = 0.5 * amplitude * amplitude * (1 - weight * weight);
      sxx[n] += variance * kx * kx;
      sxy[n] += variance * kx * ky;
      syy[n] += variance * ky * ky;
    }
  }
  const auto sum = [](const double* s) { return (s[0] + s[1]) + (s[2] + s[3]); };
  return { sum(sx), sum(sy), sum(sxx), sum(sxy), sum(syy) };
}

double WaterWaves::height(double x, double y) const
{
  double height = 0;
  for (const Group& group : this->Groups)
  {
    for (int n = 0; n < Group::Size; ++n)
    {
      height += group.amplitude[n] * sine(group.kx[n] * x + group.ky[n] * y + group.phase[n]);
    }
  }
  return height;
}
}
