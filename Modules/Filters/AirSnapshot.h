// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file AirSnapshot.h
 * @brief The wind and the heights of a structured grid at one time, in the form that the trajectory kernels take.
 */
#ifndef AirSnapshot_h
#define AirSnapshot_h

#include "AirGrid.h"

#include <utility>
#include <vector>

namespace nephoscope
{
/// Wind and heights of one time at the own points. Values that are not finite are read as 0 (calm).
struct AirSnapshot
{
  double time = 0;               ///< s
  std::vector<float> velocity;   ///< along the level's horizontal, Cartesian, 3 a point, m/s
  std::vector<float> upward;     ///< m/s
  std::vector<float> height;     ///< m
  std::vector<WindMeasure> rows; ///< of each whole row of each level
};
/// Throws GridError where Wind or Height is missing or the grid is another than `air` describes; of several processes in all.
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

/**
 * Two snapshots, which have to outlive it, as an interval, with the motion through the levels at both ends. Of several processes each has
 * what air may come from to its points, and all have to make it together.
 */
class AirInterval
{
public:
  /// @param reach how far air may come, in units of how far the strongest wind carries it
  AirInterval(
    const AirGrid& air, const AirSnapshot& begin, const AirSnapshot& end, double reach = 1);
  AirInterval(const AirInterval&) = delete;
  AirInterval& operator=(const AirInterval&) = delete;
  const AirMotion& motion() const { return this->Motion; }
  /// The columns that it has.
  const Neighborhood& about() const { return this->About; }
  /// Schemes with as many substeps as the interval's wind needs for a tolerance in metres.
  RowSchemes schemes(Integrator integrator, Interpolation interpolation, double tolerance) const;

private:
  struct ColumnProfile;
  void setLevelVelocity(const AirGrid& air, std::size_t column, ColumnProfile& profile);

  const AirSnapshot* Ends[2];
  Neighborhood About;
  AirMotion Motion;
  NearbyValues Velocity[2];
  NearbyValues Height[2];
  std::vector<float> OwnLevelVelocity[2];
  NearbyValues LevelVelocity[2];
};

/// The strain rate, 1/s, that a share of a wind's grid points, those of all processes, do not exceed: the largest rate of stretching
/// along the levels.
double strainOfShare(const AirGrid& air, const AirSnapshot& snapshot, double share);
}
#endif
