// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file HorizontalImage.h
 * @brief A small horizontal grid to give to bodies.
 */
#ifndef HorizontalImage_h
#define HorizontalImage_h

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

/// An image of one layer about the origin, 21 x 17 points 0.5 apart, at height z.
template <class Function>
vtkSmartPointer<vtkImageData> imageOf(const char* name, double z, Function function)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(21, 17, 1);
  image->SetSpacing(0.5, 0.5, 1);
  image->SetOrigin(-5, -4, z);
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  for (vtkIdType point = 0; point < image->GetNumberOfPoints(); ++point)
  {
    double at[3];
    image->GetPoint(point, at);
    array->InsertNextValue(static_cast<float>(function(at[0], at[1])));
  }
  image->GetPointData()->AddArray(array);
  return image;
}
#endif
