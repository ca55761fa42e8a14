// SPDX-License-Identifier: BSD-3-Clause
#include "CoordinateMap.h"

#include <algorithm>

namespace nephoscope
{
namespace
{
/// The columns about a column, one-sided at edges, and the differences of position across it, m along the level.
struct Surroundings
{
  std::size_t west; // places of the columns
  std::size_t east;
  std::size_t south;
  std::size_t north;
  Vector3 a; // from west to east
  Vector3 b; // from south to north

  Surroundings(const AirMotion& air, int i, int j)
  {
    const ColumnGrid& grid = *air.wind.grid;
    const int nx = grid.columns();
    int before = std::max(i - 1, 0);
    int after = std::min(i + 1, nx - 1);
    if (grid.isPeriodic())
    {
      const int period = grid.period();
      before = (i + period - 1) % period;
      after = (i + 1) % period;
    }
    const int below = std::max(j - 1, 0);
    const int above = std::min(j + 1, grid.rows() - 1);
    const double scale = grid.isSphere() ? air.wind.radius : 1;
    this->a = scale * (grid.position(after, j) - grid.position(before, j));
    this->b = scale * (grid.position(i, above) - grid.position(i, below));
    this->west = air.wind.point(before, j, 0);
    this->east = air.wind.point(after, j, 0);
    this->south = air.wind.point(i, below, 0);
    this->north = air.wind.point(i, above, 0);
  }

  double aa() const { return dot(this->a, this->a); }
  double ab() const { return dot(this->a, this->b); }
  double bb() const { return dot(this->b, this->b); }
  double determinant() const { return this->aa() * this->bb() - this->ab() * this->ab(); }
  /// Not where columns coincide, such as those of a pole's row but for rounding, nor where a and b are parallel.
  bool span() const
  {
    return this->aa() > 1e-12 * this->bb() && this->bb() > 1e-12 * this->aa() &&
      this->determinant() > 1e-12 * this->aa() * this->bb();
  }
};
}

Vector3 placeOf(const AirMotion& air, const Vector3& position, double height)
{
  const double up = air.heightScale * height;
  return air.wind.grid->isSphere() ? (air.wind.radius + up) * position
                                   : Vector3{ position[0], position[1], up };
}

Vector3 placeOfPoint(const AirMotion& air, int i, int j, int k, double at)
{
  const std::size_t point = air.wind.point(i, j, k);
  const double height = (1 - at) * air.height[0][point] + at * air.height[1][point];
  return placeOf(air, air.wind.grid->position(i, j), height);
}

void depart(const AirMotion& air, const TrajectoryScheme& scheme, int i, int j, int k, double from,
  double to, Departure& departure)
{
  if (from == to)
  {
    departure.place = placeOfPoint(air, i, j, k, to);
    departure.stencil.set(air.wind.point(i, j, k));
    departure.known = true;
    return;
  }
  const Parcel was = followFromPoint(air.wind, scheme, i, j, k, to, from);
  ColumnStencil across;
  air.wind.grid->locate(was.position, scheme.interpolation, across);
  departure.known = air.wind.held.find(across) && was.known;
  departure.stencil.set(
    air.columns(), across, levelStencil(was.level, air.wind.levels, scheme.interpolation));
  double height = 0;
  for (int time = 0; time < 2; ++time)
  {
    const double share = time == 0 ? 1 - from : from;
    if (share != 0)
    {
      double z[1];
      read(air.height[time], departure.stencil, z);
      height += share * z[0];
    }
  }
  departure.place = placeOf(air, was.position, height);
}

Vector3 carriedCoordinates(const Departure& departure, const float* displacement)
{
  if (!displacement)
  {
    return departure.place;
  }
  double moved[3];
  read(displacement, departure.stencil, moved);
  return departure.place + Vector3{ moved[0], moved[1], moved[2] };
}

ColumnSlope::ColumnSlope(const AirMotion& air, int i, int j)
  : Column(air.wind.point(i, j, 0))
{
  const Surroundings s(air, i, j);
  this->Beside = { s.west, s.east, s.south, s.north };
  this->Flat = !s.span();
  if (!this->Flat)
  {
    const double scale = 1 / s.determinant();
    this->A = scale * (s.bb() * s.a - s.ab() * s.b);
    this->B = scale * (s.aa() * s.b - s.ab() * s.a);
  }
}

double ColumnSlope::motionThroughLevels(const AirMotion& air, int time, int k, double w) const
{
  const std::size_t level = air.columns() * k;
  const std::size_t point = level + this->Column;
  double motion = w;
  if (air.wind.seconds != 0)
  {
    motion -= (static_cast<double>(air.height[1][point]) - air.height[0][point]) / air.wind.seconds;
  }
  if (this->Flat)
  {
    return motion;
  }
  const float* const v = air.wind.velocity[time] + 3 * point;
  const Vector3 wind{ v[0], v[1], v[2] };
  const float* const z = air.height[time] + level;
  const auto [west, east, south, north] = this->Beside;
  return motion - dot(wind, this->A) * (static_cast<double>(z[east]) - z[west]) -
    dot(wind, this->B) * (static_cast<double>(z[north]) - z[south]);
}

Stretch stretchAt(const AirMotion& air, const float* coordinates, int i, int j, int k)
{
  const Surroundings s(air, i, j);
  if (!s.span())
  {
    return {};
  }
  // Distances on the point's own level, which lies above the sphere by its scaled height.
  const std::size_t point = air.wind.point(i, j, k);
  const double above = air.wind.grid->isSphere() && air.height[0]
    ? 1 + air.heightScale * air.height[0][point] / air.wind.radius
    : 1;
  const float* const c = coordinates + 3 * air.columns() * k;
  const auto difference = [c](std::size_t from, std::size_t to)
  {
    return Vector3{ static_cast<double>(c[3 * to]) - c[3 * from],
      static_cast<double>(c[3 * to + 1]) - c[3 * from + 1],
      static_cast<double>(c[3 * to + 2]) - c[3 * from + 2] };
  };
  const Vector3 ca = difference(s.west, s.east);
  const Vector3 cb = difference(s.south, s.north);
  // The eigenvalues of G^-1 H, G and H the metrics of positions and of coordinates, are the squares.
  const double haa = dot(ca, ca);
  const double hab = dot(ca, cb);
  const double hbb = dot(cb, cb);
  const double half = 0.5 * (s.bb() * haa - 2 * s.ab() * hab + s.aa() * hbb) / s.determinant();
  const double product = std::max((haa * hbb - hab * hab) / s.determinant(), 0.0);
  const double root = std::sqrt(std::max(half * half - product, 0.0));
  const double large = half + root;
  const double small = large > 0 ? product / large : 0; // without cancellation
  return { std::sqrt(large) / above, std::sqrt(small) / above };
}
}
