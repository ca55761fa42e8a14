// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file PointQuantities.h
 * @brief What is to be written of a grid, from the point arrays that it has.
 */
#ifndef PointQuantities_h
#define PointQuantities_h

#include "StructuredVoxels.h"

namespace nephoscope
{
/// A scalar of the points, >= 0, or the wind.
struct Quantity
{
  std::string name;
  std::string units;
  int components = 1;
  std::vector<float> values;
};

/**
 * The extinction, water contents and wind of each point as far as their arrays are there: density first, wind last. A missing value is
 * NaN, but 0 in the wind.
 * @throw VDBError for arrays of wrong shape, and if what the order names is not among them
 */
std::vector<Quantity> quantitiesOf(vtkStructuredGrid* grid, const VoxelOrder& order);
}
#endif
