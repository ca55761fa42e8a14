// SPDX-License-Identifier: BSD-3-Clause
#include "HeightFieldMethods.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
/// A root of f between a and b, where it has opposite signs: bisection and secants in turns.
template <class F>
double root(const F& f, double a, double b)
{
  double atA = f(a);
  double atB = f(b);
  for (int n = 0; n < 200 && std::abs(b - a) > 1e-15 * (std::abs(a) + std::abs(b)); ++n)
  {
    double x = 0.5 * (a + b);
    if (n % 3 != 2 && atA != atB)
    {
      // Slightly past the secant's root, so that both ends close in.
      const double secant = (a * atB - b * atA) / (atB - atA);
      const double past = 1e-3 * std::abs(b - a) * (n % 3 == 0 ? 1 : -1);
      x = std::clamp(secant + past * (n > 6 ? 1e-9 : 1), std::min(a, b), std::max(a, b));
    }
    const double at = f(x);
    if ((at > 0) == (atB > 0))
    {
      b = x;
      atB = at;
    }
    else
    {
      a = x;
      atA = at;
    }
  }
  return 0.5 * (a + b);
}

/// Whether f is not above 0 at a and at b but may be between: it rises at a and falls at b.
template <class F>
bool peaks(const F& f, double a, double b)
{
  const double beside = 1e-4 * (b - a);
  const double atA = f(a);
  const double atB = f(b);
  return atA <= 0 && atB <= 0 && f(a + beside) > atA && f(b - beside) > atB;
}

/// The place of the maximum of f in [a, b], by golden section.
template <class F>
double peak(const F& f, double a, double b)
{
  constexpr double Golden = 0.6180339887498949;
  double c = b - Golden * (b - a);
  double d = a + Golden * (b - a);
  double atC = f(c);
  double atD = f(d);
  for (int n = 0; n < 60; ++n)
  {
    if (atC > atD)
    {
      b = d;
      d = c;
      atD = atC;
      c = b - Golden * (b - a);
      atC = f(c);
    }
    else
    {
      a = c;
      c = d;
      atC = atD;
      d = a + Golden * (b - a);
      atD = f(d);
    }
  }
  return 0.5 * (a + b);
}

/// The ends and cuts of the quadrature of [0, width].
std::vector<double> cuts(double width, double fading, const std::vector<double>& kinks)
{
  std::vector<double> all = kinks;
  for (double part = width / 8; part > 1e-6 * width; part /= 8)
  {
    all.push_back(part);
    all.push_back(width - part);
  }
  for (double reach = 1 / std::max(fading, 1e-300); reach < width; reach *= 4)
  {
    all.push_back(reach);
  }
  all.push_back(0);
  all.push_back(width);
  std::sort(all.begin(), all.end());
  return all;
}
}

void HeightFieldExact::run(const CloudSlice& slice)
{
  for (std::uint32_t ray = 0; ray < this->Slopes.size(); ++ray)
  {
    this->shineRay(slice, ray);
  }
}

void HeightFieldExact::shineRay(const CloudSlice& slice, std::uint32_t ray)
{
  const HeightFieldRay at(slice.z - this->PlaneHeight, this->Slopes[ray], this->Densities);
  const HeightFieldRange range = layerRange(at.eye, -this->Field.shape().depth,
    this->Field.top(std::max(0.0, this->Field.upperBound())), at.slope, at.slope,
    std::min(slice.far, this->endOf(ray)));
  const double width = range.last - range.first;
  if (!(width > 0))
  {
    return;
  }
  const auto inside = [&](double r)
  { return this->Field.inside(this->valueAt(slice, r), at.zeta(r)); };
  const double looks = std::clamp(std::ceil(64 * width / this->Field.shortestWave()), 256.0, 1e7);
  const auto place = [&](double n)
  { return n < looks ? range.first + width * n / looks : range.last; };
  double entered = inside(range.first) > 0 ? range.first : -1;
  bool seen = true;
  // Between two places there is at most one crossing.
  const auto look = [&](double from, double to)
  {
    if ((inside(from) > 0) == (inside(to) > 0))
    {
      return;
    }
    const double crossing = root(inside, from, to);
    if (entered < 0)
    {
      entered = crossing;
      return;
    }
    this->segment(slice, at, ray, entered, crossing);
    entered = -1;
    seen = this->Light->rays[ray].transmittance > 1e-14;
  };
  for (double n = 0; n < looks && seen; ++n)
  {
    const double from = place(n);
    const double to = place(n + 1);
    const double top = peaks(inside, from, to) ? peak(inside, from, to) : to;
    look(from, top);
    look(top, to);
  }
  if (entered >= 0 && seen)
  {
    this->segment(slice, at, ray, entered, range.last);
  }
}

void HeightFieldExact::segment(
  const CloudSlice& slice, const HeightFieldRay& at, std::uint32_t ray, double in, double out)
{
  // Distances are from the near end, lest its digits be lost where light fades within micrometres.
  const double width = std::min(out - in, 40 / std::max(at.view, 1e-300));
  const auto integrand = [&](double d)
  {
    const double r = in + d;
    const double top = this->Field.top(this->valueAt(slice, r));
    this->Light->largestSunArgument =
      std::max(this->Light->largestSunArgument, this->Densities.sun * top);
    return at.view * std::exp(-at.depth(top, r, r) - at.view * d);
  };
  const double fading = at.view + at.sun * (1 + std::abs(at.slope));
  std::vector<double> kinks =
    this->Field.kinks(slice.x, slice.y, slice.ux, slice.uy, in, in + width);
  for (double& kink : kinks)
  {
    kink -= in;
  }
  const std::vector<double> ends = cuts(width, fading, kinks);
  // No finer than what rounding leaves of the sun's path.
  const double noise = 1e-15 * at.sun * (1 + std::abs(at.slope)) * out;
  double light = 0;
  double error = 0;
  for (std::size_t i = 1; i < ends.size(); ++i)
  {
    // On [-1, 1], since Boost compares errors that are not yet scaled by the interval's length.
    const double half = 0.5 * (ends[i] - ends[i - 1]);
    const double middle = 0.5 * (ends[i] + ends[i - 1]);
    const auto scaled = [&](double x) { return half * integrand(middle + half * x); };
    double estimate = 0;
    light += boost::math::quadrature::gauss_kronrod<double, 15>::integrate(
      scaled, -1.0, 1.0, 12, std::max(noise, this->Settings.tolerance), &estimate);
    error += estimate;
  }
  this->add(ray, in, out, light, error);
}
}
