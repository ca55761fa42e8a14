// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Trajectory.h
 * @brief Where air came from: backward trajectories through a gridded wind, on the sphere or in a plane.
 *
 *     dx/dt = v(x, s, t)      ds/dt = c(x, s, t)                                                 x(t1) = where it is
 *
 * x is the horizontal position (ColumnGrid), s the level as a real number, 0 the first; so a parcel stays on its level
 * surface, whatever that surface's height, where c = 0. On the sphere x is a unit vector and v, in Cartesian components,
 * moves it by v / R; after each stage it is put back on the sphere, so that no latitude is special. Between the two given
 * times v and c are linear in time; forward (t1 < t0) and backward alike.
 *
 * c comes from the vertical wind w = dz/dt by c = (w - dz/dt|s - v . grad_s z) / (dz/ds), see levelVelocity.
 *
 * Order: RungeKutta2 (midpoint) 2, RungeKutta4 (the classical one) 4 in the step, as long as the wind as it is interpolated
 * is smooth: piecewise linear wind limits both to about 2, cubic to about 4. Stable for any step: no position leaves the
 * grid; steps are divided until the estimated error is below a tolerance (substepsFor, substepsOfRows).
 *
 * @sa ColumnGrid, vtkCloudTextureAdvection, TestTrajectory.cxx
 */
#ifndef Trajectory_h
#define Trajectory_h

#include "ColumnGrid.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace nephoscope
{
enum class Integrator
{
  RungeKutta2,
  RungeKutta4
};

/// Which columns of a grid the arrays of values hold, and where in each level: all of them in order, or some, each at its place.
struct HeldColumns
{
  const int* place =
    nullptr; ///< of each column of the grid, negative where it is not held; null: all in order
  std::size_t count = 0; ///< of columns held, if not all

  std::size_t at(std::size_t column) const
  {
    return this->place ? static_cast<std::size_t>(this->place[column]) : column;
  }
  /// Make places of a stencil's columns. False where one is not held: then it has the first place.
  bool find(ColumnStencil& stencil) const
  {
    bool held = true;
    for (int n = 0; this->place && n < stencil.count; ++n)
    {
      const int place = this->place[stencil.column[n]];
      held = held && place >= 0;
      stencil.column[n] = std::max(place, 0);
    }
    return held;
  }
};

/// Wind at two times on a grid of levels. Arrays are borrowed; where what is read from them is not finite, the air is at rest.
struct WindPair
{
  const ColumnGrid* grid = nullptr;
  HeldColumns held; ///< by all arrays
  int levels = 1;
  double radius = 6371229; ///< of the sphere, m; not used in a plane
  const float* velocity
    [2] = {}; ///< at t0 and t1: 3 components a point, Cartesian, m/s; no component along the level's vertical
  const float* levelVelocity[2] = {}; ///< levels per second at t0 and t1, or null: none
  double seconds = 0;                 ///< t1 - t0

  /// Columns in a level of the arrays.
  std::size_t columns() const
  {
    return this->held.place ? this->held.count
                            : static_cast<std::size_t>(this->grid->columns()) * this->grid->rows();
  }
  /// Where the value of a point that is held stands.
  std::size_t point(int i, int j, int k) const
  {
    return this->held.at(i + static_cast<std::size_t>(this->grid->columns()) * j) +
      this->columns() * k;
  }
};

/// A parcel of air.
struct Parcel
{
  Vector3 position;  ///< unit vector, or metres in the plane
  double level = 0;  ///< 0 .. levels - 1
  bool known = true; ///< false if it met wind that is not held, which counts as calm
};

/// How a trajectory is computed.
struct TrajectoryScheme
{
  Integrator integrator = Integrator::RungeKutta2;
  Interpolation interpolation = Interpolation::Linear;
  int substeps = 1; ///< of the whole interval, >= 1; a part of it has as many as its share
};

/// The levels that a real level number is read from, and their weights, which sum to 1.
struct LevelStencil
{
  int first = 0;
  int count = 1;
  std::array<double, 4> weight{ 1, 0, 0, 0 };
};

/// Levels are equally spaced in their number; a level beyond the ends is read at the end; cubic needs four levels.
LevelStencil levelStencil(double level, int levels, Interpolation interpolation);

/// The points of a grid that a place is read from, and their weights, which sum to 1.
struct PointStencil
{
  int count = 0;
  std::array<std::size_t, 64> point;
  std::array<double, 64> weight;

  /// @param columns number of columns in a level
  void set(std::size_t columns, const ColumnStencil& across, const LevelStencil& up)
  {
    this->count = 0;
    for (int l = 0; l < up.count; ++l)
    {
      for (int n = 0; n < across.count; ++n, ++this->count)
      {
        this->point[this->count] = columns * (up.first + l) + across.column[n];
        this->weight[this->count] = up.weight[l] * across.weight[n];
      }
    }
  }
  void set(std::size_t only)
  {
    this->count = 1;
    this->point[0] = only;
    this->weight[0] = 1;
  }
};

/// Value of a field of interleaved components.
template <int Components>
void read(const float* field, const PointStencil& stencil, double (&value)[Components])
{
  double sum[Components] = {};
  for (int n = 0; n < stencil.count; ++n)
  {
    const float* const at = field + Components * stencil.point[n];
    for (int c = 0; c < Components; ++c)
    {
      sum[c] += stencil.weight[n] * at[c];
    }
  }
  std::copy(sum, sum + Components, value);
}

/**
 * @brief Follow a parcel from one time fraction of the pair to another.
 * @param from, to fractions of the interval: 0 is t0, 1 is t1; from > to goes backward in time
 * Postcondition: finite for finite input; level within 0 .. levels - 1; a unit vector on the sphere.
 * Cost: an evaluation of the wind at both times each stage: 2 (RungeKutta2) or 4 a substep.
 */
Parcel follow(
  const WindPair& wind, const TrajectoryScheme& scheme, Parcel parcel, double from, double to);

/// The same from a point of the grid, whose wind is read without a search.
Parcel followFromPoint(const WindPair& wind, const TrajectoryScheme& scheme, int i, int j, int k,
  double from, double to);

/**
 * @brief Number of substeps that keeps the estimated error of a trajectory below a tolerance.
 *
 * With speed V and strain rate L (largest change of wind per length), one of n substeps of a step h = L dt / n has the local
 * error C V (dt / n) h^p, the whole C V dt h^p; p = 2, C = 1/6 for RungeKutta2, p = 4, C = 1/120 for RungeKutta4.
 * @param tolerance m, > 0
 * @return 1 to 64
 */
int substepsFor(
  Integrator integrator, double seconds, double speed, double strain, double tolerance);

/**
 * @brief Velocity across levels, levels per second, of one column: c = (w - dz/dt|s - v . grad_s z) / (dz/ds).
 *
 * @param n levels, @param height z of the column's levels, m, @param following what moves with the level surfaces at each level:
 * w - dz/dt|s - v . grad_s z, m/s
 * Where levels fold or coincide (dz/ds of the other sign than the column's, or below a metre a level) the air stays on
 * its level: c = 0. One level: 0.
 */
void levelVelocity(int n, const double* height, const double* following, double* velocity);

/// The largest speed [m/s] and strain rate [1/s] of a wind: differences of neighbours over their distance.
struct WindMeasure
{
  double speed = 0;
  double strain = 0;
  void include(const WindMeasure& other);
};

/// Of row j of level k, differences with row j + 1 included. Values that are not finite are left out.
WindMeasure measureRow(const ColumnGrid& grid, double radius, const float* velocity, int j, int k);

/**
 * @brief Substeps for each row of each level (j + rows * k), from the wind that a parcel that ends there may have met.
 *
 * That is the wind of the rows that are within reach at the largest speed of its level and the two beside it, in these levels. So a storm,
 * or the short way between meridians next to a pole, does not make all trajectories dear.
 * @param measures of each row of each level; the larger of both times
 * @param tolerance m, > 0, see substepsFor
 */
std::vector<unsigned char> substepsOfRows(const ColumnGrid& grid, int levels, double radius,
  const std::vector<WindMeasure>& measures, Integrator integrator, double seconds,
  double tolerance);
}
#endif
