// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file WholeData.h
 * @brief Whether a data set holds as many points and values as it claims, which VTK does not check.
 */
#ifndef WholeData_h
#define WholeData_h

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkPointData.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"
#include "vtkUnstructuredGrid.h"

#include <string>

namespace nephoscope
{
/// The points that the dimensions of a structured data set ask for; of another data set, those that it has.
inline vtkIdType claimedPoints(vtkDataSet* data)
{
  int n[3];
  if (auto* const curvilinear = vtkStructuredGrid::SafeDownCast(data))
  {
    curvilinear->GetDimensions(n);
    return static_cast<vtkIdType>(n[0]) * n[1] * n[2];
  }
  return data->GetNumberOfPoints();
}

/// Whether the axes of a rectilinear grid have its dimensions; true of other data sets.
inline bool axesAreWhole(vtkDataSet* data)
{
  auto* const grid = vtkRectilinearGrid::SafeDownCast(data);
  if (!grid)
  {
    return true;
  }
  int n[3];
  grid->GetDimensions(n);
  vtkDataArray* const axes[3] = { grid->GetXCoordinates(), grid->GetYCoordinates(),
    grid->GetZCoordinates() };
  bool whole = true;
  for (int c = 0; c < 3; ++c)
  {
    whole = whole && axes[c] && axes[c]->GetNumberOfTuples() == n[c];
  }
  return whole;
}

/// Whether every cell of an unstructured grid stands on points that there are; true of other data sets.
inline bool cornersExist(vtkDataSet* data)
{
  auto* const grid = vtkUnstructuredGrid::SafeDownCast(data);
  if (!grid || grid->GetNumberOfCells() == 0)
  {
    return true;
  }
  double range[2];
  grid->GetCells()->GetConnectivityArray()->GetRange(range);
  return range[0] >= 0 && range[1] < static_cast<double>(grid->GetNumberOfPoints());
}

/// What a data set lacks for being read by point index, as a sentence; empty if it is whole.
inline std::string whatIsMissing(vtkDataSet* data)
{
  const vtkIdType points = data->GetNumberOfPoints();
  if (points != claimedPoints(data) || !axesAreWhole(data))
  {
    return "The grid's coordinates do not fill its dimensions: it has " + std::to_string(points) +
      " points; give one for each place.";
  }
  if (!cornersExist(data))
  {
    return "The grid has cells on points that it does not have: its " + std::to_string(points) +
      " points are numbered from 0; correct the cells.";
  }
  vtkPointData* const arrays = data->GetPointData();
  for (int a = 0; a < arrays->GetNumberOfArrays(); ++a)
  {
    vtkAbstractArray* const array = arrays->GetAbstractArray(a);
    if (array->GetNumberOfTuples() < points)
    {
      return "Point array '" + std::string(array->GetName() ? array->GetName() : "(no name)") +
        "' has " + std::to_string(array->GetNumberOfTuples()) + " tuples for " +
        std::to_string(points) + " points; give one for each point.";
    }
  }
  return "";
}
}
#endif
