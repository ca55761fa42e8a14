// SPDX-License-Identifier: BSD-3-Clause
#include "DensityGrid.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace nephoscope
{
namespace
{
/// Where a coordinate lies: the point below, and how far it is to the next.
struct Spot
{
  std::size_t point;
  double share; ///< 0..1
};

Spot spotOf(const std::vector<double>& coordinates, double x)
{
  if (coordinates.size() == 1)
  {
    return { 0, 0 };
  }
  const auto above = std::upper_bound(coordinates.begin() + 1, coordinates.end() - 1, x);
  const auto k = static_cast<std::size_t>(above - coordinates.begin()) - 1;
  const double share = (x - coordinates[k]) / (coordinates[k + 1] - coordinates[k]);
  return { k, std::clamp(share, 0.0, 1.0) };
}

/// The part of a point's neighbourhood that is its own: half the distance to its neighbours; 1 without any.
double widthOf(const std::vector<double>& coordinates, std::size_t point)
{
  if (coordinates.size() == 1)
  {
    return 1;
  }
  const double low = point > 0 ? coordinates[point - 1] : coordinates[point];
  const double high = point + 1 < coordinates.size() ? coordinates[point + 1] : coordinates[point];
  return 0.5 * (high - low);
}
}

DensityGrid::DensityGrid(std::array<std::vector<double>, 3> coordinates, std::vector<double> values)
  : Coordinates(std::move(coordinates))
  , Values(std::move(values))
{
}

std::string DensityGrid::whatIsWrong() const
{
  const char* const names[] = { "x", "y", "z" };
  std::size_t points = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::vector<double>& all = this->Coordinates[axis];
    const auto turn = std::adjacent_find(
      all.begin(), all.end(), [](double a, double b) { return !(a < b) || !std::isfinite(b - a); });
    if (all.empty() || turn != all.end() || !std::isfinite(all.front()))
    {
      return std::string("the coordinates along ") + names[axis] + " do not ascend";
    }
    points *= all.size();
  }
  if (points != this->Values.size())
  {
    return std::to_string(this->Values.size()) + " densities were given for " +
      std::to_string(points) + " points";
  }
  const auto bad = std::find_if(this->Values.begin(), this->Values.end(),
    [](double value) { return !(value >= 0) || !std::isfinite(value); });
  if (bad == this->Values.end())
  {
    return "";
  }
  std::ostringstream text;
  text << "the density of point " << bad - this->Values.begin() << " is " << *bad
       << "; none may be negative or infinite or no number";
  return text.str();
}

double DensityGrid::at(const double place[3]) const
{
  Spot spots[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const double x = place[axis];
    if (this->varies(axis) && !(x >= this->low(axis) && x <= this->high(axis)))
    {
      return 0;
    }
    spots[axis] = spotOf(this->Coordinates[axis], x);
  }
  const std::size_t nx = this->Coordinates[0].size();
  const std::size_t ny = this->Coordinates[1].size();
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner)
  {
    double weight = 1;
    std::size_t index[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::size_t up = corner >> axis & 1U;
      index[axis] = spots[axis].point + up;
      weight *= up ? spots[axis].share : 1 - spots[axis].share;
    }
    if (weight > 0)
    {
      sum += weight * this->Values[index[0] + nx * (index[1] + ny * index[2])];
    }
  }
  return sum;
}

double DensityGrid::cellIntegral(const DensityRay& ray, double from, double to) const
{
  const double half = 0.5 * (to - from);
  double sum = 0;
  for (const double root : { -0.57735026918962576, 0.57735026918962576 })
  {
    const double t = from + half * (1 + root);
    const double place[] = { ray.origin[0] + t * ray.direction[0],
      ray.origin[1] + t * ray.direction[1], ray.origin[2] + t * ray.direction[2] };
    sum += half * this->at(place);
  }
  return sum;
}

double DensityGrid::lineIntegral(const DensityRay& ray) const
{
  double from = ray.from;
  double to = ray.to;
  std::vector<double> cuts;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!this->varies(axis))
    {
      continue;
    }
    const double o = ray.origin[axis];
    const double d = ray.direction[axis];
    if (d == 0)
    {
      if (!(o >= this->low(axis) && o <= this->high(axis)))
      {
        return 0;
      }
      continue;
    }
    const double t0 = (this->low(axis) - o) / d;
    const double t1 = (this->high(axis) - o) / d;
    from = std::max(from, std::min(t0, t1));
    to = std::min(to, std::max(t0, t1));
    for (const double x : this->Coordinates[axis])
    {
      cuts.push_back((x - o) / d);
    }
  }
  if (!(from < to))
  {
    return 0;
  }
  cuts.push_back(from);
  cuts.push_back(to);
  std::sort(cuts.begin(), cuts.end());
  double sum = 0;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
  {
    const double a = std::clamp(cuts[i], from, to);
    const double b = std::clamp(cuts[i + 1], from, to);
    sum += a < b ? this->cellIntegral(ray, a, b) : 0;
  }
  return sum;
}

double DensityGrid::mass() const
{
  double sum = 0;
  std::size_t i = 0;
  for (std::size_t z = 0; z < this->Coordinates[2].size(); ++z)
  {
    for (std::size_t y = 0; y < this->Coordinates[1].size(); ++y)
    {
      const double area = widthOf(this->Coordinates[1], y) * widthOf(this->Coordinates[2], z);
      for (std::size_t x = 0; x < this->Coordinates[0].size(); ++x, ++i)
      {
        sum += area * widthOf(this->Coordinates[0], x) * this->Values[i];
      }
    }
  }
  return sum;
}
}
