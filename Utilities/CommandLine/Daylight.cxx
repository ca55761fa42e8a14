// SPDX-License-Identifier: BSD-3-Clause
#include "Daylight.h"

#include <CloudArrays.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStructuredGrid.h>

namespace nephoscope::program
{
vtkSmartPointer<vtkStructuredGrid> inDaylight(vtkStructuredGrid* grid, const SurfaceShade& shade)
{
  const vtkNew<vtkFloatArray> light;
  light->SetName(arrays::SourceColor);
  light->SetNumberOfComponents(3);
  light->SetNumberOfTuples(grid->GetNumberOfPoints());
  for (vtkIdType point = 0; point < grid->GetNumberOfPoints(); ++point)
  {
    Vector3 place;
    grid->GetPoint(point, place.v);
    const Vector3 vertical = normalized(place);
    light->SetTypedTuple(point, shade(vertical, vertical).data());
  }
  auto lit = vtkSmartPointer<vtkStructuredGrid>::New();
  lit->ShallowCopy(grid);
  lit->GetPointData()->AddArray(light);
  return lit;
}
}
