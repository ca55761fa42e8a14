// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file BrickSampler.h
 * @brief Means over voxels of a field that is linear in tetrahedra: one brick of 8 x 8 x 8 voxels at a time.
 *
 * Each voxel has n_x n_y n_z samples on a lattice about its centre. A tetrahedron gives its linear field to the samples that lie in
 * it, its faces included, so that neighbours leave none out; a sample on a face has the same value from both. A voxel's mean is
 * the sum over its samples, those in no tetrahedron counting as 0, divided by their number: for a density, the mass in the
 * voxel over its volume. The error falls as the samples' distance over the cells' thickness; who needs the mass of a
 * tetrahedron exactly has linearMass.
 *
 * The last quantities may be asked for as means over those samples alone that were met (a wind). A sample's quantities lie side by side,
 * with a 1 if it was met, so that they are found and added as vectors.
 *
 * Cost: some 100 ns a tetrahedron, a few ns a sample. One object a thread.
 * @sa TestBrickSampler.cxx, TetrahedralSplit.h
 */
#ifndef BrickSampler_h
#define BrickSampler_h

#include "Vector3.h"

#include <array>
#include <vector>

namespace nephoscope
{
/// Voxel (i, j, k) is the box about origin + (i, j, k) spacing.
struct VoxelFrame
{
  Vector3 origin{ 0, 0, 0 };  ///< scene units
  Vector3 spacing{ 1, 1, 1 }; ///< scene units, > 0
};

/// The integral over a tetrahedron of what is linear in it: volume times the mean of the corners' values.
double linearMass(const std::array<Vector3, 4>& corners, const std::array<double, 4>& values);

class BrickSampler
{
public:
  static constexpr int Edge = 8;
  static constexpr int Volume = Edge * Edge * Edge;
  static constexpr int MostQuantities = 7;

  /// @param samples along a voxel's edges, 1 to 16 each; @param quantities 1 to 7; @param amongMet how many of them, the last ones, are
  /// divided by the samples that were met, not by all
  BrickSampler(
    const VoxelFrame& frame, const std::array<int, 3>& samples, int quantities, int amongMet = 0);

  /// Begin the brick whose first voxel this is.
  void begin(const std::array<int, 3>& firstVoxel);

  /// @param values of the corners: values[4 q + corner]. A tetrahedron without volume is nothing.
  void add(const std::array<Vector3, 4>& corners, const double* values);

  /// The voxels' means: means[512 quantity + voxel], x fastest.
  void average(float* means) const;

private:
  static constexpr int Few = 4;  ///< lanes of a sample
  static constexpr int Many = 8; ///< for more quantities
  struct Linear;
  void setValues(Linear& field, const int box[3][2], const double* values) const;
  template <int Lanes>
  void fill(const Linear& field, const int box[3][2]);
  template <int Lanes>
  void fillRow(const Linear& field, int y, int z, double low, double high);
  void fillFew(const Linear& field, const int box[3][2]);
  void fillMany(const Linear& field, const int box[3][2]);
  template <int Lanes>
  void averageLanes(float* means) const;
  int lanes() const { return this->Quantities < Few ? Few : Many; }

  VoxelFrame Frame;
  std::array<int, 3> Samples;
  std::array<int, 3> Count; ///< samples along the brick
  int Quantities;
  int AmongMet;
  Vector3 First{ 0, 0, 0 }; ///< place of sample (0, 0, 0)
  Vector3 Step{ 0, 0, 0 };
  std::vector<float> Values; ///< [z][y][x][quantity, then whether it was met, then nothing]
};
}
#endif
