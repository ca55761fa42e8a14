// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file StructuredColumns.h
 * @brief A structured data set as columns of cells (nephoscope::CellColumns).
 */
#ifndef StructuredColumns_h
#define StructuredColumns_h

#include "CellColumns.h"
#include "TetrahedralSplit.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkRectilinearGrid.h"
#include "vtkSMPTools.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"

#include <array>
#include <cmath>

/// The extent of whatever has one.
inline bool extentOf(vtkDataSet* grid, int extent[6])
{
  if (auto* const curvilinear = vtkStructuredGrid::SafeDownCast(grid))
  {
    curvilinear->GetExtent(extent);
  }
  else if (auto* const rectilinear = vtkRectilinearGrid::SafeDownCast(grid))
  {
    rectilinear->GetExtent(extent);
  }
  else if (auto* const image = vtkImageData::SafeDownCast(grid))
  {
    image->GetExtent(extent);
  }
  else
  {
    return false;
  }
  return true;
}

inline std::array<int, 3> pointsIn(const int extent[6])
{
  return { extent[1] - extent[0] + 1, extent[3] - extent[2] + 1, extent[5] - extent[4] + 1 };
}

/// Copies one row of columns' points, each line's next to each other.
template <class Extinction>
void copyPoints(nephoscope::CellColumns& columns, vtkDataSet* grid, const Extinction& extinction,
  vtkUnsignedCharArray* ghosts, vtkIdType row)
{
  for (int k = 0; k < columns.nz; ++k)
  {
    for (int i = 0; i < columns.nx; ++i)
    {
      const vtkIdType from = (static_cast<vtkIdType>(k) * columns.ny + row) * columns.nx + i;
      const std::size_t to = (static_cast<std::size_t>(row) * columns.nx + i) * columns.nz + k;
      grid->GetPoint(from, columns.points[to].v);
      const bool hidden = ghosts && (ghosts->GetValue(from) & vtkDataSetAttributes::HIDDENPOINT);
      columns.extinction[to] = hidden ? std::nanf("") : extinction(from);
    }
  }
}

/// Marks the cells that are blanked or another piece's.
inline void markHidden(
  nephoscope::CellColumns& columns, vtkUnsignedCharArray* ghosts, vtkIdType column)
{
  const vtkIdType levels = columns.nz - 1;
  const auto all = static_cast<vtkIdType>(columns.numberOfColumns());
  for (vtkIdType k = 0; k < levels; ++k)
  {
    columns.drawn[column * levels + k] =
      (ghosts->GetValue(k * all + column) &
        (vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::DUPLICATECELL |
          vtkDataSetAttributes::REFINEDCELL))
      ? 0
      : 1;
  }
}

/// Read a grid of two points at least along each axis; extinction(point) is per scene unit. Colours are not touched.
template <class Extinction>
void fillColumns(nephoscope::CellColumns& columns, vtkDataSet* grid, const int extent[6],
  const Extinction& extinction)
{
  const std::array<int, 3> size = pointsIn(extent);
  columns.resize(size[0], size[1], size[2]);
  columns.parity = nephoscope::splitParity(extent[0], extent[2], extent[4]);
  vtkUnsignedCharArray* const pointGhosts = grid->GetPointGhostArray();
  vtkUnsignedCharArray* const ghosts = grid->GetCellGhostArray();
  vtkSMPTools::For(0, columns.ny, 1,
    [&columns, grid, &extinction, pointGhosts](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType row = begin; row < end; ++row)
      {
        copyPoints(columns, grid, extinction, pointGhosts, row);
      }
    });
  vtkSMPTools::For(0, static_cast<vtkIdType>(columns.numberOfColumns()), 256,
    [&columns, ghosts](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType column = begin; column < end; ++column)
      {
        if (ghosts)
        {
          markHidden(columns, ghosts, column);
        }
        columns.classify(column);
      }
    });
}
#endif
