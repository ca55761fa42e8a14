// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file HorizontalGrid.h
 * @brief Where the columns of a file lie: longitudes and latitudes, or a plane in metres.
 */
#ifndef HorizontalGrid_h
#define HorizontalGrid_h

#include "CloudFile.h"
#include "Projection.h"

#include <memory>
#include <string>
#include <vector>

namespace nephoscope
{
/// Columns in the order of the grid: i east, j north, index j nx + i.
class HorizontalGrid
{
public:
  /// Also settles in file.Grid which way x and y run and whether x goes round.
  /// @throws ReadError
  explicit HorizontalGrid(CloudFile& file);

  std::vector<double>
    Longitude; ///< degrees, without jumps along i; empty for a plane without projection
  std::vector<double> Latitude; ///< degrees
  std::vector<double> X;        ///< m; empty unless the file has axes of a plane
  std::vector<double> Y;
  double Radius = MeanEarthRadius; ///< of the planet, m
  bool Global = false;             ///< goes round in longitude and over most latitudes
  bool Plain = false;              ///< longitude-latitude axes: Map is its natural geometry
  bool SouthPole = false;          ///< a row at the pole would close the globe
  bool NorthPole = false;
  std::unique_ptr<Projection> Plane; ///< the file's own, nullptr if it has none

  bool hasPlaces() const { return !this->Longitude.empty(); }

private:
  using Values = std::vector<double>;
  void findProjection(CloudFile& file);
  bool layPlain(CloudFile& file);
  bool layColumns(CloudFile& file);
  bool layPlane(CloudFile& file);
  bool layCurvilinear(CloudFile& file);
  void findSeamAndPoles(CloudFile& file, const Values& longitude, const Values& latitude);
  void check(const CloudFile& file) const;
};
}
#endif
