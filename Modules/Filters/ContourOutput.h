// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file ContourOutput.h
 * @brief The vtkPolyData of a contour while it is written: arrays of their final size, and the other arrays to interpolate.
 */
#ifndef ContourOutput_h
#define ContourOutput_h

#include "vtkArrayListTemplate.h"
#include "vtkCellArray.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"

#include <limits>

namespace nephoscope
{
struct ContourOutput
{
  vtkSmartPointer<vtkDataArray> Points;
  vtkSmartPointer<vtkFloatArray> Normals;
  vtkSmartPointer<vtkDataArray> Field;
  vtkSmartPointer<vtkDataArray> Connectivity;
  vtkSmartPointer<vtkDataArray> Offsets;
  ArrayList Others;
};

template <class ArrayType>
vtkSmartPointer<ArrayType> newArray(int components, vtkIdType tuples)
{
  auto array = vtkSmartPointer<ArrayType>::New();
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}

inline vtkSmartPointer<vtkDataArray> newRealArray(bool isDouble, int components, vtkIdType tuples)
{
  if (isDouble)
  {
    return newArray<vtkDoubleArray>(components, tuples);
  }
  return newArray<vtkFloatArray>(components, tuples);
}

inline vtkSmartPointer<vtkDataArray> newIdArray(bool isLong, vtkIdType tuples)
{
  if (isLong)
  {
    return newArray<vtkTypeInt64Array>(1, tuples);
  }
  return newArray<vtkTypeInt32Array>(1, tuples);
}

inline void allocate(ContourOutput& out, vtkDataSet* input, vtkPolyData* output,
  vtkDataArray* field, bool doublePoints, bool normals, vtkIdType vertices, vtkIdType triangles)
{
  vtkPointData* in = input->GetPointData();
  vtkPointData* attributes = output->GetPointData();
  attributes->CopyNormalsOff();
  attributes->CopyFieldOff(vtkDataSetAttributes::GhostArrayName());
  if (field->GetName())
  {
    attributes->CopyFieldOff(field->GetName());
  }
  attributes->InterpolateAllocate(in, vertices);
  out.Others.ExcludeArray(field);
  out.Others.AddArrays(vertices, in, attributes);

  out.Points = newRealArray(doublePoints, 3, vertices);
  out.Field = newRealArray(field->GetDataType() == VTK_DOUBLE, 1, vertices);
  out.Field->SetName(field->GetName());
  attributes->SetScalars(out.Field);
  if (normals)
  {
    out.Normals = newArray<vtkFloatArray>(3, vertices);
    out.Normals->SetName("Normals");
    attributes->SetNormals(out.Normals);
  }
  const bool isLong = 3 * triangles > std::numeric_limits<vtkTypeInt32>::max();
  out.Connectivity = newIdArray(isLong, 3 * triangles);
  out.Offsets = newIdArray(isLong, triangles + 1);
}

/// Calls write(connectivity, offsets) with pointers of the right type.
template <class F>
void withIds(ContourOutput& out, F&& write)
{
  if (auto* small = vtkTypeInt32Array::SafeDownCast(out.Connectivity))
  {
    write(small->GetPointer(0), vtkTypeInt32Array::SafeDownCast(out.Offsets)->GetPointer(0));
  }
  else
  {
    write(vtkTypeInt64Array::SafeDownCast(out.Connectivity)->GetPointer(0),
      vtkTypeInt64Array::SafeDownCast(out.Offsets)->GetPointer(0));
  }
}

inline void attach(ContourOutput& out, vtkPolyData* output)
{
  const vtkIdType triangles = out.Offsets->GetNumberOfTuples() - 1;
  out.Offsets->SetComponent(triangles, 0, static_cast<double>(3 * triangles));
  vtkNew<vtkPoints> points;
  points->SetData(out.Points);
  output->SetPoints(points);
  vtkNew<vtkCellArray> cells;
  cells->SetData(out.Offsets, out.Connectivity);
  output->SetPolys(cells);
}

template <class T>
struct ArrayOf;
template <>
struct ArrayOf<float>
{
  using Type = vtkFloatArray;
};
template <>
struct ArrayOf<double>
{
  using Type = vtkDoubleArray;
};
}
#endif
