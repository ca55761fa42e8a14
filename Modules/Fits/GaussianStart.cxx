// SPDX-License-Identifier: BSD-3-Clause
#include "GaussianStart.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nephoscope
{
namespace
{
/// Points along an axis, by how many axes count.
constexpr int MostPoints[] = { 1, 257, 65, 41 };
constexpr double LeastWidth = 0.7; ///< of a step; narrower ones would fall between points

/// exp(-k^2 / 2 w^2) to three widths; 1 alone along an axis that does not count.
std::vector<double> tapsOf(double width)
{
  std::vector<double> taps{ 1 };
  for (int k = 1; k <= 3 * width; ++k)
  {
    taps.push_back(std::exp(-0.5 * k * k / (width * width)));
  }
  return taps;
}

double squaresOf(const std::vector<double>& taps)
{
  double sum = taps[0] * taps[0];
  for (std::size_t k = 1; k < taps.size(); ++k)
  {
    sum += 2 * taps[k] * taps[k];
  }
  return sum;
}

/// Widths to try along axes of so many points, in steps; 0 for none.
std::vector<double> widthsFor(int points, double widest)
{
  if (points == 1)
  {
    return { 0 };
  }
  std::vector<double> widths;
  for (double width = widest * (points - 1); width >= LeastWidth; width /= 2)
  {
    widths.push_back(width);
  }
  return widths.empty() ? std::vector<double>{ LeastWidth } : widths;
}
}

GaussianStart::GaussianStart(const DensityGrid& density)
  : Density(density)
{
  const int axes = density.varies(0) + density.varies(1) + density.varies(2);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (density.varies(axis))
    {
      const auto given = static_cast<int>(density.coordinates(axis).size());
      this->Points[axis] = std::clamp(given, 9, MostPoints[axes]);
      this->Step[axis] = (density.high(axis) - density.low(axis)) / (this->Points[axis] - 1);
    }
  }
  for (int i = 0; i < this->Points[0] * this->Points[1] * this->Points[2]; ++i)
  {
    this->Values.push_back(density.at(this->place(i).data()));
  }
}

std::array<double, 3> GaussianStart::place(int index) const
{
  const int point[] = { index % this->Points[0], index / this->Points[0] % this->Points[1],
    index / (this->Points[0] * this->Points[1]) };
  std::array<double, 3> at{};
  for (int axis = 0; axis < 3; ++axis)
  {
    // The last point is the grid's own end, without rounding.
    const bool last = point[axis] > 0 && point[axis] + 1 == this->Points[axis];
    at[axis] =
      last ? this->Density.high(axis) : this->Density.low(axis) + point[axis] * this->Step[axis];
  }
  return at;
}

std::vector<double> GaussianStart::residual(const std::vector<GaussianTerm>& terms) const
{
  std::vector<double> values = this->Values;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const std::array<double, 3> at = this->place(static_cast<int>(i));
    for (const GaussianTerm& term : terms)
    {
      values[i] -= gaussianDensity(term.data(), at.data());
    }
  }
  return values;
}

std::vector<double> GaussianStart::smoothed(
  const std::vector<double>& values, int axis, const std::vector<double>& taps) const
{
  if (taps.size() == 1)
  {
    return values;
  }
  std::ptrdiff_t stride = 1;
  for (int a = 0; a < axis; ++a)
  {
    stride *= this->Points[a];
  }
  const std::ptrdiff_t count = this->Points[axis];
  std::vector<double> sums(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(i) / stride % count;
    const double* const here = values.data() + i;
    double sum = taps[0] * here[0];
    for (std::ptrdiff_t k = 1; k < static_cast<std::ptrdiff_t>(taps.size()); ++k)
    {
      sum +=
        taps[k] * ((at >= k ? here[-k * stride] : 0) + (at + k < count ? here[k * stride] : 0));
    }
    sums[i] = sum;
  }
  return sums;
}

GaussianTerm GaussianStart::best(const std::vector<GaussianTerm>& terms, double widest) const
{
  const std::vector<double> left = this->residual(terms);
  GaussianTerm best{};
  double most = 0;
  for (const double across : widthsFor(std::max(this->Points[0], this->Points[1]), widest))
  {
    const std::vector<double> tapsX = tapsOf(this->Step[0] > 0 ? across : 0);
    const std::vector<double> tapsY = tapsOf(this->Step[1] > 0 ? across : 0);
    const std::vector<double> level = this->smoothed(this->smoothed(left, 0, tapsX), 1, tapsY);
    for (const double up : widthsFor(this->Points[2], widest))
    {
      const std::vector<double> tapsZ = tapsOf(up);
      const std::vector<double> product = this->smoothed(level, 2, tapsZ);
      const double squares = squaresOf(tapsX) * squaresOf(tapsY) * squaresOf(tapsZ);
      const auto top = std::max_element(product.begin(), product.end());
      if (*top > 0 && *top * *top / squares > most)
      {
        most = *top * *top / squares;
        const auto i = static_cast<int>(top - product.begin());
        const std::array<double, 3> at = this->place(i);
        const double widths[] = { across * this->Step[0], across * this->Step[1],
          up * this->Step[2] };
        const auto inverse = [&widths](int axis)
        { return widths[axis] > 0 ? 1 / widths[axis] : 0; };
        best = { *top / squares, at[0], at[1], at[2], inverse(0), 0, 0, inverse(1), 0, inverse(2) };
      }
    }
  }
  return best;
}

std::vector<std::size_t> GaussianStart::worstFirst(const std::vector<GaussianTerm>& terms) const
{
  const std::vector<double> left = this->residual(terms);
  std::vector<double> under(terms.size(), 0.0);
  for (std::size_t i = 0; i < left.size(); ++i)
  {
    const std::array<double, 3> at = this->place(static_cast<int>(i));
    for (std::size_t k = 0; k < terms.size(); ++k)
    {
      GaussianTerm weight = terms[k];
      weight[GaussianAmplitude] = 1;
      under[k] += left[i] * left[i] * gaussianDensity(weight.data(), at.data());
    }
  }
  std::vector<std::size_t> order(terms.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
    [&under](std::size_t a, std::size_t b) { return under[a] > under[b]; });
  return order;
}

std::vector<GaussianTerm> splitTerm(std::vector<GaussianTerm> terms, std::size_t which, int axis)
{
  GaussianTerm& one = terms[which];
  double unit[3] = { 0, 0, 0 };
  unit[axis] = 1;
  double u[3];
  gaussianShape(one.data(), unit, u);
  const double width = 1 / std::sqrt(gaussianDot(u, u));
  constexpr int Columns[3][3] = { { GaussianM00, GaussianM00, GaussianM00 },
    { GaussianM01, GaussianM11, GaussianM11 }, { GaussianM02, GaussianM12, GaussianM22 } };
  for (int row = 0; row <= axis; ++row)
  {
    one[Columns[axis][row]] *= 1.5;
  }
  GaussianTerm other = one;
  one[GaussianX + axis] -= 0.7 * width;
  other[GaussianX + axis] += 0.7 * width;
  terms.push_back(other);
  return terms;
}
}
