// SPDX-License-Identifier: BSD-3-Clause
#include "Tetrahedra.h"

#include <TetrahedralSplit.h>
#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStructuredGrid.h>
#include <vtkUnstructuredGrid.h>

namespace nephoscope::program
{
namespace
{
void addCell(vtkCellArray* cells, const int dimensions[3], int i, int j, int k)
{
  for (const TetrahedronVertices& tetrahedron : TetrahedralSplit[splitParity(i, j, k)])
  {
    cells->InsertNextCell(4);
    for (const int v : tetrahedron)
    {
      const vtkIdType row =
        j + (v >> 1 & 1) + static_cast<vtkIdType>(k + (v >> 2 & 1)) * dimensions[1];
      cells->InsertCellPoint(i + (v & 1) + row * dimensions[0]);
    }
  }
}
}

vtkSmartPointer<vtkUnstructuredGrid> tetrahedraOf(vtkStructuredGrid* grid)
{
  int dimensions[3];
  grid->GetDimensions(dimensions);
  const vtkNew<vtkCellArray> cells;
  cells->AllocateExact(5 * grid->GetNumberOfCells(), 20 * grid->GetNumberOfCells());
  for (int k = 0; k + 1 < dimensions[2]; ++k)
  {
    for (int j = 0; j + 1 < dimensions[1]; ++j)
    {
      for (int i = 0; i + 1 < dimensions[0]; ++i)
      {
        addCell(cells, dimensions, i, j, k);
      }
    }
  }
  auto tetrahedra = vtkSmartPointer<vtkUnstructuredGrid>::New();
  tetrahedra->SetPoints(grid->GetPoints());
  tetrahedra->SetCells(VTK_TETRA, cells);
  tetrahedra->GetPointData()->ShallowCopy(grid->GetPointData());
  tetrahedra->GetFieldData()->ShallowCopy(grid->GetFieldData());
  return tetrahedra;
}
}
