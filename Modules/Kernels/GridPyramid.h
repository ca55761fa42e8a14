// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file GridPyramid.h
 * @brief Numbers on a horizontal grid, to be looked up at any place as finely as a pixel sees them.
 *
 * Level 0 is the grid, bilinear between its points. Each further level holds the means of 2 x 2 samples of the one before, so
 * that a sample of level l is about 2^l spacings wide; a footprint takes the two levels about its own width, linearly mixed. (Where a level has an odd
 * number of samples, its last counts twice.)
 * Beyond the grid its edge goes on. Numbers that are not finite are read as 0.
 *
 * @sa HeightGrid.h, CloudShadow.h, TestHeightGrid.cxx
 */
#ifndef GridPyramid_h
#define GridPyramid_h

#include <vector>

namespace nephoscope
{
/// Where a grid's points lie: (x0 + i dx, y0 + j dy).
struct GridFrame
{
  double x0 = 0; ///< scene units
  double y0 = 0;
  double dx = 1; ///< > 0
  double dy = 1; ///< > 0
  int nx = 0;    ///< points
  int ny = 0;
};

class GridPyramid
{
public:
  GridPyramid() = default;
  /// @param values nx ny numbers, x fastest
  GridPyramid(const GridFrame& frame, std::vector<float> values);

  bool empty() const { return this->Levels.empty(); }
  const GridFrame& frame() const { return this->Frame; }
  bool contains(double x, double y) const;

  /// The mean about a place over a footprint, scene units; 0 is the grid's own bilinear value. An empty one has 0.
  double value(double x, double y, double footprint = 0) const;

  /// The slopes d/dx and d/dy of value, by differences over a sample's width to either side.
  struct Slopes
  {
    double x;
    double y;
  };
  Slopes slopes(double x, double y, double footprint = 0) const;

  /// Of all points alike; 0 if there are none.
  double mean() const;

  /// A point of the grid itself.
  float at(int i, int j) const { return this->Levels[0].at(i, j); }

private:
  struct Level
  {
    int nx;
    int ny;
    std::vector<float> values;
    float at(int i, int j) const
    {
      return this->values[static_cast<std::size_t>(j) * this->nx + i];
    }
  };
  static Level halved(const Level& fine);
  double valueOf(int level, double u, double v) const;
  double levelOf(double footprint) const;

  GridFrame Frame;
  std::vector<Level> Levels;
};
}
#endif
