// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file AirSnapshot.h
 * @brief The wind and the heights of a structured grid at one time, in the form that the trajectory kernels take.
 */
#ifndef AirSnapshot_h
#define AirSnapshot_h

#include "CoordinateMap.h"

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

class vtkStructuredGrid;

namespace nephoscope
{
/// What makes a grid unusable for trajectories; what() is the one line that says so.
class GridError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// What stays the same at all times: where the columns stand and what a metre of height is in the scene.
struct AirGrid
{
  ColumnGrid columns;
  int levels = 1;
  double radius = 6371229; ///< m; of a Globe its PlanetRadius
  double heightScale = 1;  ///< metres of place per metre of height
  bool sphere = false;     ///< Globe or Map
  bool globe = false;      ///< points and winds are Cartesian already

  std::size_t points() const
  {
    return static_cast<std::size_t>(this->columns.columns()) * this->columns.rows() * this->levels;
  }
};

/**
 * The columns of a grid by its field data Geometry (Globe, Map or Local; without it Local): lines of equal i and j have to lie along
 * meridians and parallels, or along x and y, to a twentieth of their spacing. A Map whose numbers all lie within
 * 720 x 90 is in degrees. Throws GridError.
 */
AirGrid airGridOf(vtkStructuredGrid* grid);

/// Wind and heights of one time. Values that are not finite are read as 0 (calm).
struct AirSnapshot
{
  double time = 0;               ///< s
  std::vector<float> velocity;   ///< along the level's horizontal, Cartesian, 3 a point, m/s
  std::vector<float> upward;     ///< m/s
  std::vector<float> height;     ///< m
  std::vector<WindMeasure> rows; ///< of each row of each level
};
/// Throws GridError where Wind or Height is missing or the grid is another than `air` describes.
AirSnapshot airSnapshotOf(const AirGrid& air, vtkStructuredGrid* grid, double time);

/// How trajectories are computed that end in each row of each level.
class RowSchemes
{
public:
  RowSchemes() = default;
  RowSchemes(const TrajectoryScheme& common, int rows, std::vector<unsigned char> substeps)
    : Common(common)
    , Rows(rows)
    , Substeps(std::move(substeps))
  {
  }
  TrajectoryScheme at(int j, int k) const
  {
    TrajectoryScheme scheme = this->Common;
    scheme.substeps = this->Substeps[j + this->Rows * k];
    return scheme;
  }
  int mostSubsteps() const;

private:
  TrajectoryScheme Common;
  int Rows = 0;
  std::vector<unsigned char> Substeps;
};

/// Two snapshots, which have to outlive it, as an interval, with the motion through the levels at both ends.
class AirInterval
{
public:
  AirInterval(const AirGrid& air, const AirSnapshot& begin, const AirSnapshot& end);
  const AirMotion& motion() const { return this->Motion; }
  /// Schemes with as many substeps as the interval's wind needs for a tolerance in metres.
  RowSchemes schemes(Integrator integrator, Interpolation interpolation, double tolerance) const;

private:
  void setLevelVelocity(int j);

  const AirSnapshot* Ends[2];
  AirMotion Motion;
  std::vector<float> LevelVelocity[2];
};

/// The strain rate, 1/s, that a share of a wind's grid points do not exceed: the largest rate of stretching along the levels.
double strainOfShare(const AirGrid& air, const AirSnapshot& snapshot, double share);
}
#endif
