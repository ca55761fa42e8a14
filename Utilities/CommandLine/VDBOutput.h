// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file VDBOutput.h
 * @brief A model's clouds as OpenVDB files: one, or one a time step.
 */
#ifndef VDBOutput_h
#define VDBOutput_h

#include "Scene.h"

namespace nephoscope::program
{
struct VDBOptions
{
  std::vector<double> voxel; ///< edges, scene units: none, one or three
  std::string grids;         ///< names with commas; empty: all
  bool half = false;
  double prune = 1e-5;
  std::optional<std::string> to; ///< last time step; without, one file of data.time
};

/// Write `output`, or with several steps output_0000.vdb and so on. @throw Failure
void writeVDB(const Data& data, const VDBOptions& options, const std::string& output);
}
#endif
