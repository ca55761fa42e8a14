// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file VDBFile.h
 * @brief A .vdb file as bricks.
 */
#ifndef VDBFile_h
#define VDBFile_h

#include "VoxelGrid.h"

namespace nephoscope
{
struct VDBReadResult
{
  VoxelGrid grid;
  std::vector<std::string> warnings;
};

/**
 * Read one grid: float or double scalars, or float vectors. Level sets become fog, with a warning. Only the bytes of that grid are
 * read, and reading past them is an error; memory before maximumVoxels is checked is at most some 40 times theirs.
 * @param name empty: "density", else the first that can be read
 * @param maximumVoxels active ones, tiles counted by their volume and bricks by 512
 * @throw VDBError for what cannot be read, with the remedy
 */
VDBReadResult readVDB(const std::string& path, const std::string& name, double maximumVoxels);
}
#endif
