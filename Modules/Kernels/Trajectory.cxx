// SPDX-License-Identifier: BSD-3-Clause
#include "Trajectory.h"

#include <algorithm>
#include <limits>

namespace nephoscope
{
namespace
{
/// Velocity of a parcel: dx/dt in units of the position, ds/dt.
struct Motion
{
  Vector3 across{ 0, 0, 0 };
  double up = 0;
  bool known = true;
};

/// The wind at a fraction of the interval. On one of its ends the other end's wind, which may be no number, is not read.
Motion readMotion(const WindPair& wind, double at, const PointStencil& stencil)
{
  const double share[2] = { 1 - at, at };
  const int time[2] = { share[0] == 0 ? 1 : 0, share[1] == 0 ? 0 : 1 };
  const float* const velocity[2] = { wind.velocity[time[0]], wind.velocity[time[1]] };
  Motion motion;
  for (int n = 0; n < stencil.count; ++n)
  {
    const float* const v0 = velocity[0] + 3 * stencil.point[n];
    const float* const v1 = velocity[1] + 3 * stencil.point[n];
    for (int c = 0; c < 3; ++c)
    {
      motion.across[c] += stencil.weight[n] * (share[0] * v0[c] + share[1] * v1[c]);
    }
  }
  const float* const up[2] = { wind.levelVelocity[time[0]], wind.levelVelocity[time[1]] };
  for (int n = 0; n < stencil.count && up[0] && up[1]; ++n)
  {
    motion.up +=
      stencil.weight[n] * (share[0] * up[0][stencil.point[n]] + share[1] * up[1][stencil.point[n]]);
  }
  return motion;
}

/**
 * What a wind does to a position. A stage of a Runge-Kutta step may lie off the sphere; there the wind is that of the direction,
 * scaled with the distance, which makes a rotation linear and every motion one along the sphere.
 */
Motion alongSurface(const WindPair& wind, Motion motion, const Vector3& place, double distance)
{
  if (wind.grid->isSphere())
  {
    motion.across = motion.across - dot(motion.across, place) * place;
    motion.across = (distance / wind.radius) * motion.across;
  }
  const bool finite = std::isfinite(dot(motion.across, motion.across)) && std::isfinite(motion.up);
  return finite ? motion : Motion{};
}

/// Velocity at a parcel.
Motion motionAt(const WindPair& wind, Interpolation interpolation, const Parcel& parcel, double at)
{
  const double distance = wind.grid->isSphere() ? length(parcel.position) : 1;
  const Vector3 place = distance > 0 ? (1 / distance) * parcel.position : parcel.position;
  ColumnStencil across;
  wind.grid->locate(place, interpolation, across);
  if (!wind.held.find(across) || !parcel.known)
  {
    return { { 0, 0, 0 }, 0, false };
  }
  PointStencil stencil;
  stencil.set(wind.columns(), across, levelStencil(parcel.level, wind.levels, interpolation));
  return alongSurface(wind, readMotion(wind, at, stencil), place, distance);
}

/// Velocity at a point of the grid.
Motion motionAtPoint(const WindPair& wind, int i, int j, int k, double at)
{
  PointStencil stencil;
  stencil.set(wind.point(i, j, k));
  return alongSurface(wind, readMotion(wind, at, stencil), wind.grid->position(i, j), 1);
}

Parcel moved(const Parcel& parcel, const Motion& motion, double seconds, int levels)
{
  return { parcel.position + seconds * motion.across,
    std::min(std::max(parcel.level + seconds * motion.up, 0.0), levels - 1.0),
    parcel.known && motion.known };
}

/// Follow a parcel whose motion at the beginning is known.
Parcel followAfter(const WindPair& wind, const TrajectoryScheme& scheme, Motion first,
  Parcel parcel, double from, double to)
{
  const int substeps =
    std::max(static_cast<int>(std::ceil(std::abs(to - from) * scheme.substeps - 1e-9)), 1);
  const double step = (to - from) / substeps;
  const double seconds = step * wind.seconds;
  const auto motion = [&wind, &scheme](const Parcel& p, double at)
  { return motionAt(wind, scheme.interpolation, p, at); };
  for (int n = 0; n < substeps; ++n)
  {
    const double at = from + n * step;
    const Motion k1 = n == 0 ? first : motion(parcel, at);
    const Motion k2 = motion(moved(parcel, k1, seconds / 2, wind.levels), at + step / 2);
    Motion mean = k2;
    if (scheme.integrator == Integrator::RungeKutta4)
    {
      const Motion k3 = motion(moved(parcel, k2, seconds / 2, wind.levels), at + step / 2);
      const Motion k4 = motion(moved(parcel, k3, seconds, wind.levels), at + step);
      mean.across = (1.0 / 6) * (k1.across + 2 * k2.across + 2 * k3.across + k4.across);
      mean.up = (k1.up + 2 * k2.up + 2 * k3.up + k4.up) / 6;
      mean.known = k4.known;
    }
    parcel = moved(parcel, mean, seconds, wind.levels);
    if (wind.grid->isSphere())
    {
      parcel.position = normalized(parcel.position);
    }
  }
  return parcel;
}
}

LevelStencil levelStencil(double level, int levels, Interpolation interpolation)
{
  LevelStencil stencil;
  if (levels < 2)
  {
    return stencil;
  }
  level = std::min(std::max(level, 0.0), levels - 1.0);
  const int below = std::min(static_cast<int>(level), levels - 2);
  if (interpolation == Interpolation::Linear || levels < 4)
  {
    stencil.first = below;
    stencil.count = 2;
    stencil.weight = { 1 - (level - below), level - below, 0, 0 };
    return stencil;
  }
  stencil.first = std::min(std::max(below - 1, 0), levels - 4);
  stencil.count = 4;
  const double t = level - stencil.first;
  stencil.weight = { -(t - 1) * (t - 2) * (t - 3) / 6, t * (t - 2) * (t - 3) / 2,
    -t * (t - 1) * (t - 3) / 2, t * (t - 1) * (t - 2) / 6 };
  return stencil;
}

Parcel follow(
  const WindPair& wind, const TrajectoryScheme& scheme, Parcel parcel, double from, double to)
{
  return followAfter(
    wind, scheme, motionAt(wind, scheme.interpolation, parcel, from), parcel, from, to);
}

Parcel followFromPoint(
  const WindPair& wind, const TrajectoryScheme& scheme, int i, int j, int k, double from, double to)
{
  return followAfter(wind, scheme, motionAtPoint(wind, i, j, k, from),
    { wind.grid->position(i, j), static_cast<double>(k) }, from, to);
}

int substepsFor(
  Integrator integrator, double seconds, double speed, double strain, double tolerance)
{
  constexpr double Most = 64;
  const bool second = integrator == Integrator::RungeKutta2;
  const double way = std::abs(seconds) * speed * (second ? 1.0 / 6 : 1.0 / 120);
  const double ratio = second ? std::sqrt(way / tolerance) : std::sqrt(std::sqrt(way / tolerance));
  const double n = std::ceil(std::abs(seconds) * strain * ratio);
  return n >= 1 ? static_cast<int>(std::min(n, Most)) : 1;
}

void levelVelocity(int n, const double* height, const double* following, double* velocity)
{
  constexpr double Thinnest = 1; // m a level
  const double sense = n > 1 && height[n - 1] < height[0] ? -1 : 1;
  for (int k = 0; k < n; ++k)
  {
    const int below = std::max(k - 1, 0);
    const int above = std::min(k + 1, n - 1);
    const double thickness = above > below ? (height[above] - height[below]) / (above - below) : 0;
    velocity[k] =
      sense * thickness >= Thinnest && std::isfinite(following[k]) ? following[k] / thickness : 0;
  }
}

void WindMeasure::include(const WindMeasure& other)
{
  this->speed = std::max(this->speed, other.speed);
  this->strain = std::max(this->strain, other.strain);
}

WindMeasure measureRow(const ColumnGrid& grid, double radius, const float* velocity, int j, int k)
{
  const int nx = grid.columns();
  const int ny = grid.rows();
  const double scale = grid.isSphere() ? radius : 1;
  const double nearest = grid.isSphere() ? 1e-9 : 0; // at a pole columns coincide but for rounding
  const float* const level = velocity + 3 * static_cast<std::size_t>(nx) * ny * k;
  const auto at = [level, nx](int i, int row)
  {
    const float* const v = level + 3 * (i + static_cast<std::size_t>(nx) * row);
    return Vector3{ v[0], v[1], v[2] };
  };
  double speed2 = 0;
  double strain2 = 0;
  const auto compare = [&](int i, int i1, int j1)
  {
    const Vector3 apart = grid.position(i1, j1) - grid.position(i, j);
    const Vector3 change = at(i1, j1) - at(i, j);
    const double distance2 = dot(apart, apart);
    const double change2 = dot(change, change);
    // Not a number compares false; there is rarely something to divide.
    if (distance2 > nearest * nearest && change2 > strain2 * distance2)
    {
      strain2 = change2 / distance2;
    }
  };
  for (int i = 0; i < nx; ++i)
  {
    const double here = dot(at(i, j), at(i, j));
    speed2 = here > speed2 ? here : speed2;
    if (i + 1 < nx)
    {
      compare(i, i + 1, j);
    }
    if (j + 1 < ny)
    {
      compare(i, i, j + 1);
    }
  }
  return { std::sqrt(speed2), std::sqrt(strain2) / scale };
}

std::vector<unsigned char> substepsOfRows(const ColumnGrid& grid, int levels, double radius,
  const std::vector<WindMeasure>& measures, Integrator integrator, double seconds, double tolerance)
{
  const int ny = grid.rows();
  double spacing = std::numeric_limits<double>::infinity();
  for (int j = 0; j + 1 < ny; ++j)
  {
    spacing = std::min(spacing, length(grid.position(0, j + 1) - grid.position(0, j)));
  }
  spacing *= grid.isSphere() ? radius : 1;
  std::vector<unsigned char> substeps(measures.size());
  for (int k = 0; k < levels; ++k)
  {
    const int lowest = std::max(k - 1, 0);
    const int highest = std::min(k + 1, levels - 1);
    std::vector<WindMeasure> row(ny);
    double fastest = 0;
    for (int n = lowest * ny; n < (highest + 1) * ny; ++n)
    {
      row[n % ny].include(measures[n]);
      fastest = std::max(fastest, measures[n].speed);
    }
    const double far = std::ceil(fastest * std::abs(seconds) / spacing);
    const int reach = far < ny ? static_cast<int>(far) : ny;
    for (int j = 0; j < ny; ++j)
    {
      WindMeasure met;
      for (int n = std::max(j - reach - 1, 0); n <= std::min(j + reach, ny - 1); ++n)
      {
        met.include(row[n]);
      }
      substeps[j + ny * k] = static_cast<unsigned char>(
        substepsFor(integrator, seconds, met.speed, met.strain, tolerance));
    }
  }
  return substeps;
}
}
