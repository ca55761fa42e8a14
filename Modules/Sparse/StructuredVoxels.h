// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file StructuredVoxels.h
 * @brief Cloud fields of a VTK grid as sparse voxels.
 */
#ifndef StructuredVoxels_h
#define StructuredVoxels_h

#include "FogGrid.h"

class vtkImageData;
class vtkStructuredGrid;

namespace nephoscope
{
/// What to make of a grid.
struct VoxelOrder
{
  std::array<double, 3> voxelSize{ 1, 1, 1 }; ///< scene units, > 0
  std::vector<std::string> names; ///< of density, liquid, ice, wind; empty: all that there are
  double tolerance = 1e-5;     ///< share of the largest value up to which a voxel counts as empty
  double maximumVoxels = 2e8;  ///< candidates, beyond which the order is refused
  double liquidRadius = 10e-6; ///< m
  double iceRadius = 30e-6;    ///< m
  double fullCoverExtinction = 0.15e-3; ///< 1/m, where there is only a cloud fraction
};

/**
 * The cells of a curvilinear grid as voxels: means over each voxel of the field that is linear in the cells' tetrahedra
 * (BrickSampler), then multiplied by one number that makes the total that of the tetrahedra.
 * @throw VDBError for what cannot be done; an empty result if progress said stop
 */
std::vector<FogGrid> voxelsOf(
  vtkStructuredGrid* grid, const VoxelOrder& order, const VoxelProgress& progress);

/// The points of an image as voxels, one each, unchanged: each point array of 1 or 3 components under the name it has in a file.
std::vector<FogGrid> voxelsOf(vtkImageData* image, const VoxelOrder& order);

/// The name in a file of a point array: density of Extinction, liquid of LiquidWater, ...; others keep theirs.
std::string gridNameOf(const std::string& arrayName);
}
#endif
