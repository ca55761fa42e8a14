// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file FieldReader.h
 * @brief Fields on a part of the grid, one time step: in the grid's order, in the role's units, at the centres of the boxes.
 */
#ifndef FieldReader_h
#define FieldReader_h

#include "CloudFile.h"

#include <cstddef>
#include <vector>

namespace nephoscope
{
/// Whole columns of the grid, in any order; a column may come twice (the seam).
struct Region
{
  std::size_t time = 0;
  std::vector<std::size_t> columns; ///< i, 0 .. nx-1
  std::vector<std::size_t> rows;    ///< j, 0 .. ny-1

  std::size_t layer() const { return this->columns.size() * this->rows.size(); }
};

/**
 * Reads and brings to the centres what is staggered: a dimension with one more place holds the boxes' faces, whose mean is
 * taken; along x and y, places that have coordinates are interpolated linearly. Missing values are NaN.
 * The order of the result is i fastest, then j, then k (0 lowest).
 */
class FieldReader
{
public:
  explicit FieldReader(const CloudFile& file)
    : File(file)
  {
  }
  std::vector<float> field(const RoleVariable& role, const Region& region) const;
  std::vector<double> surface(const RoleVariable& role, const Region& region) const;

private:
  /// value = (1 - weight) source[low] + weight source[high]
  struct Tap
  {
    std::size_t low;
    std::size_t high;
    double weight;
  };
  using Taps = std::vector<Tap>;
  /// A line of wanted places along one direction of the grid.
  struct Line
  {
    std::size_t axis;   ///< of the variable; its rank if it does not have this direction
    std::size_t stride; ///< in the values read
    Taps taps;
  };
  /// What is read of a variable.
  struct Block
  {
    std::vector<std::size_t> start;
    std::vector<std::size_t> count;
    Line lines[3]; ///< x, y, z
  };
  template <class T>
  std::vector<T> read(
    const RoleVariable& role, const Region& region, const std::vector<std::size_t>& levels) const;
  Block blockOf(const FileVariable& variable, const Region& region,
    const std::vector<std::size_t>& levels) const;
  /// Shrink the block to the places that the taps need.
  void fit(const FileVariable& variable, Block& block) const;
  Taps tapsAlong(int dimension, int own, std::size_t places, bool flip,
    const std::vector<std::size_t>& wanted, bool horizontal) const;
  bool tapByCoordinate(int dimension, int own, bool periodic, Taps& taps) const;

  const CloudFile& File;
};
}
#endif
