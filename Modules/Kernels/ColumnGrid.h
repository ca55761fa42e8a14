// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file ColumnGrid.h
 * @brief Where the columns of a grid stand, on a sphere or in a plane, and which of them a position is read from.
 *
 * A position is a Vector3: a direction (unit vector) on the sphere, metres (x, y, 0) in the plane. Fields on the sphere
 * are read in Cartesian components, so that the poles and the date line are ordinary places: a stencil that reaches over
 * a pole goes on in the rows of the opposite meridian.
 *
 * Column (i, j) of the grid has number i + columns() * j, as the points of one level of a vtkStructuredGrid.
 */
#ifndef ColumnGrid_h
#define ColumnGrid_h

#include "Vector3.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace nephoscope
{
/// How a field is read between the columns: bilinear, or by the cubic through four points each way (Lagrange).
enum class Interpolation
{
  Linear, ///< second order, bounded by its neighbours
  Cubic   ///< fourth order on smooth fields, may overshoot
};

/// The columns that a position is read from, and their weights, which sum to 1.
struct ColumnStencil
{
  int count = 0;
  std::array<int, 16> column;
  std::array<double, 16> weight;
};

class ColumnGrid
{
public:
  ColumnGrid() = default;
  /**
   * Rows of latitude and columns of longitude, radians, each strictly monotonic, at least one each. Longitudes that span
   * the circle, with or without a closing column, are periodic; rows that come within 1.5 spacings of a pole go over it.
   */
  static ColumnGrid sphere(std::vector<double> longitudes, std::vector<double> latitudes);
  /// Rows of y and columns of x, metres, each strictly monotonic, at least one each.
  static ColumnGrid plane(std::vector<double> x, std::vector<double> y);

  bool isSphere() const { return this->Sphere; }
  bool isPeriodic() const { return this->Periodic; }
  /// Columns that differ, where the grid goes round: one fewer than columns() if the first comes again at the end.
  int period() const { return this->Period; }
  int columns() const { return static_cast<int>(this->X.Values.size()); }
  int rows() const { return static_cast<int>(this->Y.Values.size()); }
  /// Longitudes or x of the columns and latitudes or y of the rows, radians or metres.
  const std::vector<double>& columnCoordinates() const { return this->X.Values; }
  const std::vector<double>& rowCoordinates() const { return this->Y.Values; }

  /// The position of a column. Cost: three multiplications.
  Vector3 position(int i, int j) const
  {
    return this->Sphere ? Vector3{ this->RowDirections[j][0] * this->ColumnDirections[i][0],
      this->RowDirections[j][0] * this->ColumnDirections[i][1], this->RowDirections[j][1] }
                        : Vector3{ this->X.Values[i], this->Y.Values[j], 0 };
  }

  /**
   * @brief Where to read a field for a position.
   * Outside a grid that does not go round, the nearest place of its edge is read. With fewer than four rows or columns,
   * cubic is linear in that direction.
   * Cost: about 10 ns linear, 50 ns cubic, and two arc tangents on the sphere. Thread-safe, allocation-free.
   */
  void locate(const Vector3& position, Interpolation interpolation, ColumnStencil& stencil) const;

  /// The smallest distance of neighbouring columns, radians or metres, not counting rows within 10 degrees of a pole.
  double smallestSpacing() const;

private:
  /// One axis, always stored with its own order; Guess finds intervals in constant time.
  struct Axis
  {
    std::vector<double> Values;
    std::vector<double> Rising;  // the same, in rising order
    std::vector<double> Inverse; // 1 / length of each interval, with the one that closes a circle
    std::vector<int> Guess;
    double First = 0;
    double Scale = 0;
    bool Descending = false;

    void set(std::vector<double> values);
    /// k with value k <= at <= value k+1 in rising order, 0 <= k <= n - 2.
    int interval(double at) const
    {
      const int last = static_cast<int>(this->Rising.size()) - 2;
      const double bin = std::min(std::max((at - this->First) * this->Scale, 0.0), last + 1.0);
      int k = this->Guess[static_cast<int>(bin)];
      while (k > 0 && this->Rising[k] > at)
      {
        --k;
      }
      while (k < last && this->Rising[k + 1] <= at)
      {
        ++k;
      }
      return k;
    }
    double rising(int k) const { return this->Rising[k]; }
  };
  struct Nodes
  {
    int count;
    std::array<int, 4> index; // in rising order; rows may lie beyond the ends of the axis
    std::array<double, 4> weight;
  };

  /// The column or row before a place and after it, in the grid's own order, and the share of the one after.
  struct Between
  {
    int before;
    int after;
    double share;
  };

  bool isBeyondRows(double y) const
  {
    return (y < this->Y.Rising.front() && this->overSouth()) ||
      (y > this->Y.Rising.back() && this->overNorth());
  }
  Between betweenColumns(double x) const;
  Between betweenRows(double y) const;
  /// Interval of the columns that a longitude or x lies in, which is put into the circle or the range.
  int columnInterval(double& x) const;
  Nodes nodesOfLongitude(double longitude, Interpolation interpolation) const;
  Nodes nodesOfRow(double y, Interpolation interpolation) const;
  double rowValue(int risingIndex) const;
  bool overSouth() const { return this->Poles[0]; }
  bool overNorth() const { return this->Poles[1]; }

  Axis X;
  Axis Y;
  std::vector<std::array<double, 2>> ColumnDirections; // cosine, sine of each longitude
  std::vector<std::array<double, 2>> RowDirections;    // and latitude
  bool Sphere = false;
  bool Periodic = false;
  int Period = 0;                               // columns that differ, where periodic
  std::array<bool, 2> Poles{ false, false };    // stencils go over the south, the north pole
  std::array<bool, 2> PoleRows{ false, false }; // the outermost row is the pole itself
};
}
#endif
