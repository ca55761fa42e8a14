// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file FogGrid.h
 * @brief Fog volumes in the making, and the .vdb file of them.
 */
#ifndef FogGrid_h
#define FogGrid_h

#include "VoxelGrid.h"

#include <functional>
#include <memory>

namespace nephoscope
{
/// Told how far the work is, 0 to 1, by the thread that asked for it; returns whether to go on.
using VoxelProgress = std::function<bool(double)>;

/**
 * A grid of a file that is to be written. Its bricks go straight to where OpenVDB has its voxels: they are held once. Threads may put in
 * bricks at once; what is made of them depends on their places alone.
 */
class FogGrid
{
public:
  /// @param components 1 or 3; @param places for bricks, which may stay empty
  FogGrid(const std::string& name, int components, std::size_t places);
  ~FogGrid();
  FogGrid(FogGrid&& other) noexcept;
  FogGrid& operator=(FogGrid&& other) noexcept;

  const std::string& name() const { return this->Name; }
  int components() const { return this->Components; }

  /// Put a brick at a place that is empty. @param origin index of its first voxel, multiples of 8; @param values
  /// [component][k][j][i], of which those that are 0 are no voxels. A brick without voxels is none.
  void put(std::size_t place, const std::array<int, 3>& origin, const float* values);

  std::size_t bricks() const;
  /// Voxels that are not 0.
  std::size_t voxels() const;
  /// Of all values of a grid of 1 component.
  double sum() const;
  void multiply(double factor);

  std::array<double, 16> indexToWorld; ///< as in VoxelGrid; at first the identity
  double tolerance = 0; ///< nodes whose values differ by no more become one tile in the file
  VoxelMetadata metadata;

  class Leaves; ///< OpenVDB's
  Leaves& leaves() { return *this->Made; }

private:
  std::string Name;
  int Components;
  std::vector<double> Sums; ///< [place]
  std::unique_ptr<Leaves> Made;
};

/**
 * Write grids, which are empty thereafter. They are compressed side by side, the largest first, and follow each other in the file as
 * given: memory is at most that of the grids and of the file.
 * @param path written directly; who needs a file whole or not at all renames it
 * @param half whether to write 16-bit floats
 * @return false if progress said stop, and the file is not whole
 * @throw VDBError if it cannot be written
 */
bool writeVDB(const std::string& path, std::vector<FogGrid>& grids, bool half,
  const VoxelMetadata& metadata, const VoxelProgress& progress);
}
#endif
