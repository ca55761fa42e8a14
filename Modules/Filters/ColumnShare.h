// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file ColumnShare.h
 * @brief The columns of a grid divided among processes, what they find out together, and how values get from their owners to others.
 *
 * Process r has block r of nephoscope::columnBlock; the columns on a border between blocks belong to the one where they are not the
 * last. Without a controller one process has all columns, and nothing is sent or copied. Member functions that say "together" have to be
 * called by all processes.
 */
#ifndef ColumnShare_h
#define ColumnShare_h

#include "ColumnBlocks.h"
#include "ColumnReach.h"
#include "Trajectory.h"

#include "vtkMultiProcessController.h"
#include "vtkSmartPointer.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace nephoscope
{
/// What makes a grid unusable for trajectories; what() is the one line that says so.
class GridError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Together: whether something holds in all processes; without a controller, here.
bool everywhere(vtkMultiProcessController* controller, bool here);
/// Together: throws GridError in all processes if one of them has something wrong.
void require(vtkMultiProcessController* controller, const std::string& wrong);

class ColumnShare
{
public:
  ColumnShare() = default;
  /// One process has all of a grid.
  ColumnShare(int columns, int rows);
  /// @param whole extent of the grid; its first column and row count as 0
  ColumnShare(vtkMultiProcessController* controller, const PointExtent& whole);

  bool isDivided() const { return this->Controller != nullptr; }
  /// Columns and rows of the whole grid.
  int columns() const { return this->Size[0]; }
  int rows() const { return this->Size[1]; }
  /// The columns that belong to this process, in the order in which its arrays have them.
  const ColumnRectangle& own() const { return this->Own; }
  /// With the columns on its borders that belong to others.
  const ColumnRectangle& block() const { return this->Block; }
  int ownerOf(int column) const { return this->Owners[column]; }

  ///@{
  /// Together.
  void require(const std::string& wrong) const { nephoscope::require(this->Controller, wrong); }
  bool everywhere(bool here) const { return nephoscope::everywhere(this->Controller, here); }
  void largest(double* values, std::size_t count) const; ///< each of all processes; no NaN
  double largest(const std::vector<float>& values, double least) const;
  long long sum(long long value) const;
  /// The value that has as many smaller or equal ones before it as `before` says, among those of all processes, none negative.
  float ranked(std::vector<float> values, long long before) const;
  ///@}
  vtkMultiProcessController* controller() const { return this->Controller; } ///< null: not divided

private:
  int Size[2] = { 0, 0 };
  ColumnRectangle Own;
  ColumnRectangle Block;
  vtkSmartPointer<vtkMultiProcessController> Controller; // null: not divided
  std::vector<int> Owners;                               // of each column, if divided
};

/// Columns whose values a process wants to read: together with the others it finds out who sends what to whom.
class ColumnRequest
{
public:
  ColumnRequest() = default;
  /// @param share outlives this  @param columns any, in the order in which their values are to be
  ColumnRequest(const ColumnShare& share, const std::vector<int>& columns);

  /// Together. @param own values of the own columns, level after level  @return those of the columns asked for
  std::vector<float> fetch(const std::vector<float>& own, int levels, int components) const;

private:
  const ColumnShare* Share = nullptr;
  std::size_t Count = 0;
  std::vector<std::vector<int>> From; // of each rank: places in the result
  std::vector<std::vector<int>> To;   // of each rank: places among the own
};

/// Values about the own columns: of a grid that is not divided the very array, otherwise a copy with the others' values.
class NearbyValues
{
public:
  const float* data() const { return this->Borrowed ? this->Borrowed : this->Copied.data(); }

private:
  friend class Neighborhood;
  const float* Borrowed = nullptr;
  std::vector<float> Copied;
};

/// The columns that parcels from the own columns may meet within a distance.
class Neighborhood
{
public:
  /// Together, if divided. @param distance m; 0 for neighbours alone
  Neighborhood(const ColumnShare& share, const ColumnGrid& grid, double radius, double distance);

  /// What the arrays that gather() gives hold; for as long as this lives.
  HeldColumns held() const;
  /// Together. @param own values of the own columns, level after level; outlives the result
  NearbyValues gather(const std::vector<float>& own, int levels, int components) const;

private:
  bool IsDivided;
  std::size_t Count = 0;
  std::vector<int> Places; // of each column of the grid, -1 where it is not held
  ColumnRequest Request;
};
}
#endif
