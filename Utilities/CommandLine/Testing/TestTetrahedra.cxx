// SPDX-License-Identifier: BSD-3-Clause
// The tetrahedra fill the grid: their volumes are positive and sum to its own.
#include "Tetrahedra.h"

#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStructuredGrid.h>
#include <vtkTetra.h>
#include <vtkUnstructuredGrid.h>

#include <gtest/gtest.h>

TEST(Tetrahedra, FillTheGrid)
{
  const int n[3] = { 5, 4, 3 };
  const vtkNew<vtkStructuredGrid> grid;
  const vtkNew<vtkPoints> points;
  const vtkNew<vtkDoubleArray> field;
  field->SetName("Field");
  for (int point = 0; point < n[0] * n[1] * n[2]; ++point)
  {
    const int i = point % n[0];
    const int j = point / n[0] % n[1];
    const int k = point / n[0] / n[1];
    // Sheared columns: the volume is that of the straight ones.
    points->InsertNextPoint(i, 2 * j, 3 * k + 0.25 * i);
    field->InsertNextValue(point);
  }
  grid->SetDimensions(n);
  grid->SetPoints(points);
  grid->GetPointData()->AddArray(field);

  const auto tetrahedra = nephoscope::program::tetrahedraOf(grid);
  EXPECT_EQ(tetrahedra->GetNumberOfCells(), 5 * 4 * 3 * 2);
  EXPECT_EQ(tetrahedra->GetPointData()->GetArray("Field"), field);
  double sum = 0;
  for (vtkIdType cell = 0; cell < tetrahedra->GetNumberOfCells(); ++cell)
  {
    double corners[4][3];
    for (int corner = 0; corner < 4; ++corner)
    {
      tetrahedra->GetPoint(tetrahedra->GetCell(cell)->GetPointId(corner), corners[corner]);
    }
    const double volume = vtkTetra::ComputeVolume(corners[0], corners[1], corners[2], corners[3]);
    EXPECT_GT(volume, 0.9) << "a sixth or a third of a box of 1 x 2 x 3";
    sum += volume;
  }
  EXPECT_NEAR(sum, 4 * 6 * 6, 1e-12 * 144);
}
