// SPDX-License-Identifier: BSD-3-Clause
#include "CarriedField.h"

#include <algorithm>
#include <limits>

namespace nephoscope
{
namespace
{
/// Sums over the points of a stencil that are finite.
struct Reading
{
  double sum = 0;
  double weight = 0;
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
  bool whole = true;
};

Reading readPoints(
  const float* field, std::size_t columns, const ColumnStencil& across, const LevelStencil& up)
{
  Reading reading;
  for (int l = 0; l < up.count; ++l)
  {
    const float* const level = field + columns * (up.first + l);
    for (int n = 0; n < across.count; ++n)
    {
      const double value = level[across.column[n]];
      const double weight = up.weight[l] * across.weight[n];
      if (!std::isfinite(value))
      {
        reading.whole = reading.whole && weight == 0;
      }
      else if (weight != 0)
      {
        reading.sum += weight * value;
        reading.weight += weight;
        reading.least = std::min(reading.least, value);
        reading.most = std::max(reading.most, value);
      }
    }
  }
  return reading;
}
}

FieldStencil fieldStencil(
  const ColumnGrid& grid, int levels, const Parcel& parcel, Interpolation interpolation)
{
  FieldStencil stencil;
  grid.locate(parcel.position, Interpolation::Linear, stencil.across);
  stencil.up = levelStencil(parcel.level, levels, Interpolation::Linear);
  if (interpolation == Interpolation::Cubic)
  {
    grid.locate(parcel.position, interpolation, stencil.acrossCubic);
    stencil.upCubic = levelStencil(parcel.level, levels, interpolation);
  }
  return stencil;
}

double readField(const float* field, std::size_t columns, const FieldStencil& stencil)
{
  const Reading linear = readPoints(field, columns, stencil.across, stencil.up);
  if (!(linear.weight > 0))
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  double value = linear.sum / linear.weight;
  if (stencil.acrossCubic.count > 0 && linear.whole)
  {
    const Reading cubic = readPoints(field, columns, stencil.acrossCubic, stencil.upCubic);
    value = cubic.whole ? cubic.sum : value;
  }
  return std::min(std::max(value, linear.least), linear.most);
}

CarriedStencils carriedStencils(const WindPair& wind, const TrajectoryScheme& scheme,
  Interpolation interpolation, int i, int j, int k, double at)
{
  CarriedStencils stencils;
  for (int end = 0; end < 2; ++end)
  {
    stencils.end[end] = fieldStencil(
      *wind.grid, wind.levels, followFromPoint(wind, scheme, i, j, k, at, end), interpolation);
  }
  return stencils;
}

double carriedValue(
  const float* const field[2], std::size_t columns, const CarriedStencils& stencils, double at)
{
  const double before = readField(field[0], columns, stencils.end[0]);
  const double after = readField(field[1], columns, stencils.end[1]);
  if (std::isnan(before) || std::isnan(after))
  {
    return std::isnan(before) ? after : before;
  }
  return before + at * (after - before);
}
}
