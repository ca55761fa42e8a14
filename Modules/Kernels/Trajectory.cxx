// SPDX-License-Identifier: BSD-3-Clause
#include "Trajectory.h"

#include <algorithm>

namespace nephoscope
{
namespace
{
/// Velocity of a parcel: dx/dt in units of the position, ds/dt.
struct Motion
{
  Vector3 across{ 0, 0, 0 };
  double up = 0;
};

/**
 * Velocity at a parcel. A stage of a Runge-Kutta step may lie off the sphere; there the wind is that of the direction,
 * scaled with the distance, which makes a rotation linear and every motion one along the sphere.
 */
Motion motionAt(const WindPair& wind, Interpolation interpolation, const Parcel& parcel, double at)
{
  const bool sphere = wind.grid->isSphere();
  const Vector3 place = sphere ? normalized(parcel.position) : parcel.position;
  ColumnStencil across;
  wind.grid->locate(place, interpolation, across);
  const LevelStencil up = levelStencil(parcel.level, wind.levels, interpolation);
  const std::size_t columns = static_cast<std::size_t>(wind.grid->columns()) * wind.grid->rows();
  const double share[2] = { 1 - at, at };
  Motion motion;
  for (int time = 0; time < 2; ++time)
  {
    if (share[time] == 0)
    {
      continue;
    }
    double v[3];
    read(wind.velocity[time], columns, across, up, v);
    motion.across = motion.across + share[time] * Vector3{ v[0], v[1], v[2] };
    if (wind.levelVelocity[time])
    {
      double c[1];
      read(wind.levelVelocity[time], columns, across, up, c);
      motion.up += share[time] * c[0];
    }
  }
  if (sphere)
  {
    motion.across = motion.across - dot(motion.across, place) * place;
    motion.across = (length(parcel.position) / wind.radius) * motion.across;
  }
  const bool finite = std::isfinite(dot(motion.across, motion.across)) && std::isfinite(motion.up);
  return finite ? motion : Motion{};
}

Parcel moved(const Parcel& parcel, const Motion& motion, double seconds, int levels)
{
  return { parcel.position + seconds * motion.across,
    std::min(std::max(parcel.level + seconds * motion.up, 0.0), levels - 1.0) };
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
  const int substeps =
    std::max(static_cast<int>(std::ceil(std::abs(to - from) * scheme.substeps - 1e-9)), 1);
  const double step = (to - from) / substeps;
  const double seconds = step * wind.seconds;
  const auto motion = [&wind, &scheme](const Parcel& p, double at)
  { return motionAt(wind, scheme.interpolation, p, at); };
  for (int n = 0; n < substeps; ++n)
  {
    const double at = from + n * step;
    const Motion k1 = motion(parcel, at);
    const Motion k2 = motion(moved(parcel, k1, seconds / 2, wind.levels), at + step / 2);
    Motion mean = k2;
    if (scheme.integrator == Integrator::RungeKutta4)
    {
      const Motion k3 = motion(moved(parcel, k2, seconds / 2, wind.levels), at + step / 2);
      const Motion k4 = motion(moved(parcel, k3, seconds, wind.levels), at + step);
      mean.across = (1.0 / 6) * (k1.across + 2 * k2.across + 2 * k3.across + k4.across);
      mean.up = (k1.up + 2 * k2.up + 2 * k3.up + k4.up) / 6;
    }
    parcel = moved(parcel, mean, seconds, wind.levels);
    if (wind.grid->isSphere())
    {
      parcel.position = normalized(parcel.position);
    }
  }
  return parcel;
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

void measureWind(const ColumnGrid& grid, int levels, double radius, const float* velocity,
  double& speed, double& strain)
{
  const int nx = grid.columns();
  const int ny = grid.rows();
  const double scale = grid.isSphere() ? radius : 1;
  const auto at = [=](int i, int j, int k)
  {
    const float* const v =
      velocity + 3 * (i + static_cast<std::size_t>(nx) * (j + static_cast<std::size_t>(ny) * k));
    return Vector3{ v[0], v[1], v[2] };
  };
  speed = 0;
  strain = 0;
  const auto compare = [&](int i0, int j0, int i1, int j1)
  {
    const double apart = length(grid.position(i1, j1) - grid.position(i0, j0));
    const double distance = scale * apart;
    // The columns of a pole's row coincide, but for rounding.
    for (int k = 0; k < levels && apart > (grid.isSphere() ? 1e-9 : 0); ++k)
    {
      const double rate = length(at(i1, j1, k) - at(i0, j0, k)) / distance;
      strain = rate > strain ? rate : strain; // NaN compares false
    }
  };
  for (int j = 0; j < ny; ++j)
  {
    for (int i = 0; i < nx; ++i)
    {
      for (int k = 0; k < levels; ++k)
      {
        const double here = length(at(i, j, k));
        speed = here > speed ? here : speed;
      }
      if (i + 1 < nx)
      {
        compare(i, j, i + 1, j);
      }
      if (j + 1 < ny)
      {
        compare(i, j, i, j + 1);
      }
    }
  }
}
}
