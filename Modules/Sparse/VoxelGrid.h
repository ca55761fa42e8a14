// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file VoxelGrid.h
 * @brief A sparse grid of voxels between a file and VTK: bricks of 8 x 8 x 8, where they lie, and what is said of them.
 */
#ifndef VoxelGrid_h
#define VoxelGrid_h

#include "vtkSMPTools.h"

#include <array>
#include <cstddef>
#include <exception>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace nephoscope
{
/// What is wrong with a file or with what is to be written: one line for the user.
class VDBError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Texts and numbers by name.
struct VoxelMetadata
{
  std::map<std::string, std::string> texts;
  std::map<std::string, double> numbers;
};

struct VoxelGrid
{
  static constexpr int Edge = 8;                            ///< voxels along a brick
  static constexpr std::size_t Volume = Edge * Edge * Edge; ///< voxels of a brick

  std::string name;
  int components = 1; ///< 1 or 3
  /// Row by row: (x, y, z, 1) of the scene = matrix (i, j, k, 1); a voxel's centre has whole i, j, k.
  std::array<double, 16> indexToWorld{ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
  std::vector<std::array<int, 3>> bricks; ///< index of each one's first voxel, multiples of 8
  std::vector<float> values;              ///< [brick][k][j][i][component]
  VoxelMetadata metadata;

  std::size_t floatsPerBrick() const { return Volume * static_cast<std::size_t>(components); }
};

/// Calls work(grid) for each of several grids at once. What the first of them throws is thrown when all are done.
template <class Work>
void forEachGrid(std::size_t grids, const Work& work)
{
  std::vector<std::exception_ptr> thrown(grids);
  vtkSMPTools::For(0, static_cast<vtkIdType>(grids), 1,
    [&work, &thrown](vtkIdType begin, vtkIdType end)
    {
      for (auto g = static_cast<std::size_t>(begin); g < static_cast<std::size_t>(end); ++g)
      {
        try
        {
          work(g);
        }
        catch (...)
        {
          thrown[g] = std::current_exception();
        }
      }
    });
  for (const std::exception_ptr& error : thrown)
  {
    if (error)
    {
      std::rethrow_exception(error);
    }
  }
}
}
#endif
