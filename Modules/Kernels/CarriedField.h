// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file CarriedField.h
 * @brief A field between two times, carried along the wind from both of them.
 *
 *     f(x, t) = (1 - a) f_0(x_0) + a f_1(x_1)            a = (t - t_0) / (t_1 - t_0)
 *
 * with x_0 and x_1 the places, at t_0 and t_1, of the parcel that is at x at t (Trajectory.h). A cloud that moves with the air is
 * then in one place at each time, where blending f_0(x) with f_1(x) shows it twice.
 *
 * Bounds: each reading is linear, or cubic and clamped to the least and the greatest of the points that the linear one reads
 * (quasi-monotone, Bermejo and Staniforth 1992); so f has no extrema beyond those of both times.
 * Values that are not finite are left out and the weights of the others scaled up; if a time has none, the other counts alone.
 */
#ifndef CarriedField_h
#define CarriedField_h

#include "Trajectory.h"

namespace nephoscope
{
/// Where a field is read for a place: linearly and, if so wished, with the cubic.
struct FieldStencil
{
  ColumnStencil across;
  LevelStencil up;
  ColumnStencil acrossCubic; ///< count 0: linear only
  LevelStencil upCubic;
};

FieldStencil fieldStencil(
  const ColumnGrid& grid, int levels, const Parcel& parcel, Interpolation interpolation);

/// NaN where all that it reads is not finite. @param columns number of columns in a level
double readField(const float* field, std::size_t columns, const FieldStencil& stencil);

/// Where the parcel that is at a point of the grid at fraction `at` of the interval is read from at both of its ends.
struct CarriedStencils
{
  FieldStencil end[2];
};
CarriedStencils carriedStencils(const WindPair& wind, const TrajectoryScheme& scheme,
  Interpolation interpolation, int i, int j, int k, double at);

/// f at fraction `at`; NaN where neither time has a finite value.
double carriedValue(
  const float* const field[2], std::size_t columns, const CarriedStencils& stencils, double at);
}
#endif
