// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file FileAxes.h
 * @brief Which way each dimension of a file runs, and the grid that a variable lies on.
 */
#ifndef FileAxes_h
#define FileAxes_h

#include "NetCDFFile.h"

#include <cstddef>
#include <string>
#include <vector>

namespace nephoscope
{
enum class Axis
{
  None,
  Time,
  Vertical,
  Y,
  X,
  Column ///< horizontal places in a list
};

/// The dimensions of the grid. -1: the grid does not have it.
struct GridAxes
{
  int time = -1;
  int z = -1;
  int y = -1;
  int x = -1;
  std::size_t nz = 1;
  std::size_t ny = 1;
  std::size_t nx = 1;
  bool flipX = false; ///< the file runs against the grid, which is east, north, up
  bool flipY = false;
  bool flipZ = false;
  bool periodic = false; ///< x goes round the globe
};

class FileAxes
{
public:
  explicit FileAxes(const NetCDFFile& file);

  Axis of(int dimension) const
  {
    return dimension < 0 ? Axis::None : this->Axes[static_cast<std::size_t>(dimension)];
  }
  /// The dimension of the variable along an axis, or -1.
  int dimensionAlong(const FileVariable& variable, Axis axis) const;
  /// For a variable whose dimensions are not all known: the last ones become Vertical, Y, X. Says what it took for what.
  std::string guess(const FileVariable& variable);
  void set(int dimension, Axis axis) { this->Axes[static_cast<std::size_t>(dimension)] = axis; }

private:
  const NetCDFFile& File;
  std::vector<Axis> Axes;
};

/// The coordinate variable of a dimension: one-dimensional and of its name; nullptr if there is none.
const FileVariable* coordinateVariable(const NetCDFFile& file, int dimension);
}
#endif
