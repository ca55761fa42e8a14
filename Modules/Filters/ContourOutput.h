// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file ContourOutput.h
 * @brief The vtkPolyData of a contour while it is written: arrays of their final size, and the other arrays to interpolate.
 */
#ifndef ContourOutput_h
#define ContourOutput_h

#include "vtkAOSDataArrayTemplate.h"
#include "vtkArrayListTemplate.h"
#include "vtkBuffer.h"
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
/// The arrays that a contour makes.
struct ContourArrays
{
  vtkSmartPointer<vtkDataArray> Points;
  vtkSmartPointer<vtkFloatArray> Normals;
  vtkSmartPointer<vtkDataArray> Field;
  vtkSmartPointer<vtkDataArray> Connectivity;
  vtkSmartPointer<vtkDataArray> Offsets;
};

/// Its arrays start as those of the output before, whose memory is used again where nobody else holds them.
struct ContourOutput : ContourArrays
{
  explicit ContourOutput(const ContourArrays& before)
    : ContourArrays(before)
  {
  }
  ArrayList Others;
};

/// Whether another array shares this one's memory: a shallow copy does.
template <class T>
class SharedMemory : public vtkAOSDataArrayTemplate<T>
{
public:
  static bool isShared(vtkAOSDataArrayTemplate<T>& array)
  {
    return (array.*(&SharedMemory::Buffer))->GetReferenceCount() > 1;
  }
};

/// The array from before again, if nobody holds it or its memory but those two who pass it on, and the size is right within a
/// factor of two; else a new one.
template <class ArrayType>
vtkSmartPointer<ArrayType> sizedArray(vtkDataArray* before, int components, vtkIdType tuples)
{
  const vtkIdType size = components * tuples;
  auto* same = ArrayType::SafeDownCast(before);
  const bool fits = same && same->GetReferenceCount() <= 2 &&
    !SharedMemory<typename ArrayType::ValueType>::isShared(*same) && same->GetSize() >= size &&
    same->GetSize() / 2 <= size;
  auto array = fits ? vtkSmartPointer<ArrayType>(same) : vtkSmartPointer<ArrayType>::New();
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  array->Modified();
  return array;
}

inline vtkSmartPointer<vtkDataArray> sizedRealArray(
  bool isDouble, vtkDataArray* before, int components, vtkIdType tuples)
{
  if (isDouble)
  {
    return sizedArray<vtkDoubleArray>(before, components, tuples);
  }
  return sizedArray<vtkFloatArray>(before, components, tuples);
}

inline vtkSmartPointer<vtkDataArray> sizedIdArray(
  bool isLong, vtkDataArray* before, vtkIdType tuples)
{
  if (isLong)
  {
    return sizedArray<vtkTypeInt64Array>(before, 1, tuples);
  }
  return sizedArray<vtkTypeInt32Array>(before, 1, tuples);
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

  out.Points = sizedRealArray(doublePoints, out.Points, 3, vertices);
  out.Field = sizedRealArray(field->GetDataType() == VTK_DOUBLE, out.Field, 1, vertices);
  out.Field->SetName(field->GetName());
  attributes->SetScalars(out.Field);
  if (normals)
  {
    out.Normals = sizedArray<vtkFloatArray>(out.Normals, 3, vertices);
    out.Normals->SetName("Normals");
    attributes->SetNormals(out.Normals);
  }
  else
  {
    out.Normals = nullptr;
  }
  const bool isLong = 3 * triangles > std::numeric_limits<vtkTypeInt32>::max();
  out.Connectivity = sizedIdArray(isLong, out.Connectivity, 3 * triangles);
  out.Offsets = sizedIdArray(isLong, out.Offsets, triangles + 1);
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

inline void attach(const ContourOutput& out, vtkPolyData* output)
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
