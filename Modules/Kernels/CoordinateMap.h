// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file CoordinateMap.h
 * @brief Coordinates that move with the air: where a parcel was at a reference time, and how far that map is stretched.
 *
 * On the grid's points at time b the map is
 *
 *     C_b(x) = P_a(x_a) + D_a(x_a)          D_b(x) = C_b(x) - P_b(x)
 *
 * with x_a the place at time a of the parcel that is at x at time b (Trajectory.h), P_a(x) the place itself in metres with the
 * heights of time a, and D_a the displacement that the map had at time a: zero where it begins. Interpolating the displacement
 * instead of C makes calm air exact and errors small where little has moved (semi-Lagrangian, Staniforth and Cote 1991).
 */
#ifndef CoordinateMap_h
#define CoordinateMap_h

#include "Trajectory.h"

namespace nephoscope
{
/// Between two times: the wind, the heights of the levels, and how heights count as lengths.
struct AirMotion
{
  WindPair wind;
  const float* height[2] = {}; ///< at t0 and t1, m, one a point
  double heightScale = 1;      ///< metres of place per metre of height

  std::size_t columns() const { return this->wind.columns(); } ///< in a level of the arrays
};

/// P: on the sphere (R + s z) direction, in the plane (x, y, s z); m.
Vector3 placeOf(const AirMotion& air, const Vector3& position, double height);

/// P of a point of the grid at a fraction of the interval.
Vector3 placeOfPoint(const AirMotion& air, int i, int j, int k, double at);

/// Where the air of a point was, and how fields are read there.
struct Departure
{
  Vector3 place; ///< P_a(x_a), m
  PointStencil stencil;
  bool known = true; ///< false if it led through air that is not held: then the place means nothing
};

/// Of the air that is at a point of the grid at fraction `to`, at fraction `from`. One for all maps that are carried from there.
void depart(const AirMotion& air, const TrajectoryScheme& scheme, int i, int j, int k, double from,
  double to, Departure& departure);

/**
 * @brief C where a departure leads to, from the map there.
 * @param displacement D at the departure's time, 3 floats a point, m; null where the map begins then
 */
Vector3 carriedCoordinates(const Departure& departure, const float* displacement);

/// The slope of the level surfaces about a column, and what it does to the air.
class ColumnSlope
{
public:
  ColumnSlope(const AirMotion& air, int i, int j);

  /**
   * @brief What moves the air through the level surfaces at level k: w - dz/dt|s - v . grad_s z, m/s.
   * @param time 0 or 1, the end of the interval; w the upward wind there, m/s
   * The slope is by central differences, one-sided at edges; at a pole row and on a single row or column it counts as level.
   */
  double motionThroughLevels(const AirMotion& air, int time, int k, double w) const;

private:
  std::size_t Column;
  std::array<std::size_t, 4> Beside; // columns to the west, east, south, north
  bool Flat = true;
  // v . grad z = (v . A)(z_east - z_west) + (v . B)(z_north - z_south)
  Vector3 A{ 0, 0, 0 };
  Vector3 B{ 0, 0, 0 };
};

/// How a map of coordinates stretches its surroundings: singular values of its gradient along a level surface.
struct Stretch
{
  double largest = 1;
  double smallest = 1;
};
/// @param coordinates C, 3 floats a point; without heights in `air` they are taken to lie on the sphere. Cells without width (pole rows) and single rows or columns give 1, 1.
Stretch stretchAt(const AirMotion& air, const float* coordinates, int i, int j, int k);
}
#endif
