// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file DensityGrid.h
 * @brief Density given at the points of a rectilinear grid, and its exact integral along rays.
 *
 * Between points it is interpolated linearly along each axis, outside the grid it is 0. Along an axis with one point it is the
 * same everywhere: a column has points along z alone.
 *
 * Along a ray the interpolant is a cubic in each cell, which two places of Gauss and Legendre integrate exactly.
 * Cost: O(nx + ny + nz) of a line integral.
 * @sa GaussianDensity.h, the same for sums of Gaussians; TestDensityGrid.cxx
 */
#ifndef DensityGrid_h
#define DensityGrid_h

#include "GaussianDensity.h"

#include <array>
#include <string>
#include <vector>

namespace nephoscope
{
class DensityGrid
{
public:
  /// @param coordinates of the points along x, y and z, m
  /// @param values 1/m, x fastest
  DensityGrid(std::array<std::vector<double>, 3> coordinates, std::vector<double> values);

  /// What is wrong with it: coordinates that do not ascend, values of another number, negative or not finite. One line, or none.
  std::string whatIsWrong() const;

  /// Whether density varies along an axis, 0 to 2.
  bool varies(int axis) const { return this->Coordinates[axis].size() > 1; }
  double low(int axis) const { return this->Coordinates[axis].front(); }
  double high(int axis) const { return this->Coordinates[axis].back(); }
  const std::vector<double>& coordinates(int axis) const { return this->Coordinates[axis]; }
  const std::vector<double>& values() const { return this->Values; }

  /// Linear between points. @pre nothing is wrong, as of all below
  double at(const double place[3]) const;
  /// Optical depth along a ray; a ray that never leaves the grid has to be finite.
  double lineIntegral(const DensityRay& ray) const;
  /// Integral over the axes along which it varies.
  double mass() const;

private:
  /// Of a stretch within one cell.
  double cellIntegral(const DensityRay& ray, double from, double to) const;

  std::array<std::vector<double>, 3> Coordinates;
  std::vector<double> Values;
};
}
#endif
