// SPDX-License-Identifier: BSD-3-Clause
#include "PieceOfWhole.h"

#include "ColumnBlocks.h"
#include "LatticeGrid.h"

#include "vtkAlgorithm.h"
#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"

#include <numeric>

namespace nephoscope
{
namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

/// Numbers in the whole grid of the points (cells = 0) or cells (cells = 1) of an extent that may go on beyond the ends of a ring.
void listSources(const PointExtent& whole, const PointExtent& extent, int cells, vtkIdList* ids)
{
  const vtkIdType columns = whole[1] - whole[0] + 1 - cells;
  const vtkIdType rows = whole[3] - whole[2] + 1 - cells;
  for (int k = extent[4]; k <= extent[5] - cells; ++k)
  {
    for (int j = extent[2]; j <= extent[3] - cells; ++j)
    {
      const vtkIdType row = columns * (j - whole[2] + rows * (k - whole[4]));
      for (int i = extent[0]; i <= extent[1] - cells; ++i)
      {
        ids->InsertNextId(row + ringColumn(whole, i, cells));
      }
    }
  }
}

void copyListed(vtkDataSetAttributes* from, vtkDataSetAttributes* to, vtkIdList* ids)
{
  to->CopyGlobalIdsOn();
  to->CopyAllOn();
  to->CopyAllocate(from, ids->GetNumberOfIds());
  vtkNew<vtkIdList> places;
  places->SetNumberOfIds(ids->GetNumberOfIds());
  std::iota(places->begin(), places->end(), vtkIdType(0));
  to->CopyData(from, ids, places);
}

/// The part of a curvilinear grid in an extent.
void cutGrid(vtkStructuredGrid* grid, const PointExtent& whole, const PointExtent& extent)
{
  vtkNew<vtkIdList> points;
  vtkNew<vtkIdList> cells;
  listSources(whole, extent, 0, points);
  listSources(whole, extent, 1, cells);
  vtkNew<vtkStructuredGrid> part;
  part->SetExtent(const_cast<int*>(extent.data()));
  vtkNew<vtkPoints> places;
  places->SetDataType(grid->GetPoints()->GetDataType());
  places->SetNumberOfPoints(points->GetNumberOfIds());
  grid->GetPoints()->GetData()->GetTuples(points, places->GetData());
  part->SetPoints(places);
  copyListed(grid->GetPointData(), part->GetPointData(), points);
  copyListed(grid->GetCellData(), part->GetCellData(), cells);
  part->SetFieldData(grid->GetFieldData());
  grid->ShallowCopy(part);
}

bool isRing(vtkStructuredGrid* grid)
{
  int n[3];
  grid->GetDimensions(n);
  return closesOnItself(latticeShape(grid),
    [grid, &n](int i, int j, int k)
    {
      Vector3 x;
      grid->GetPoint(i + n[0] * (j + static_cast<vtkIdType>(n[1]) * k), x.v);
      return x;
    });
}

void mark(vtkUnsignedCharArray* ghosts, vtkIdType id, int flag)
{
  ghosts->SetValue(id, static_cast<unsigned char>(ghosts->GetValue(id) | flag));
}

void markGhosts(vtkDataSet* data, const PointExtent& extent, const PointExtent& block)
{
  auto* const points =
    data->GetPointGhostArray() ? data->GetPointGhostArray() : data->AllocatePointGhostArray();
  auto* const cells =
    data->GetCellGhostArray() ? data->GetCellGhostArray() : data->AllocateCellGhostArray();
  markOutside(extent, block, 0,
    [points](vtkIdType id) { mark(points, id, vtkDataSetAttributes::DUPLICATEPOINT); });
  markOutside(extent, block, 1,
    [cells](vtkIdType id) { mark(cells, id, vtkDataSetAttributes::DUPLICATECELL); });
}
}

void askForWhole(vtkInformation* input)
{
  input->Set(Pipeline::UPDATE_EXTENT(), input->Get(Pipeline::WHOLE_EXTENT()), 6);
  input->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
  input->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
  input->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
}

bool askForPiece(vtkInformation* input, vtkInformation* output, int ghosts)
{
  askForWhole(input);
  const bool gives = input->Has(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST()) != 0;
  if (gives)
  {
    input->CopyEntry(output, Pipeline::UPDATE_PIECE_NUMBER());
    input->CopyEntry(output, Pipeline::UPDATE_NUMBER_OF_PIECES());
    input->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), ghosts);
  }
  return gives;
}

void cutPiece(vtkDataSet* output, vtkInformation* information)
{
  const int pieces = information->Get(Pipeline::UPDATE_NUMBER_OF_PIECES());
  if (pieces < 2 || output->GetNumberOfPoints() == 0)
  {
    return;
  }
  PointExtent whole;
  output->GetInformation()->Get(vtkDataObject::DATA_EXTENT(), whole.data());
  PointExtent block;
  if (!columnBlock(whole, information->Get(Pipeline::UPDATE_PIECE_NUMBER()), pieces, block))
  {
    output->Initialize();
    return;
  }
  auto* const grid = vtkStructuredGrid::SafeDownCast(output);
  const PointExtent extent = withGhosts(whole, block,
    information->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS()), grid && isRing(grid));
  grid ? cutGrid(grid, whole, extent) : output->Crop(extent.data());
  if (extent != block)
  {
    markGhosts(output, extent, block);
  }
}
}
