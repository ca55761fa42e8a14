// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleMesh.h"

#include "CloudArrays.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"

namespace nephoscope
{
namespace
{
/// Copy the tuples of an array with the right number of components; else leave the target empty.
template <class Tuple, class Store>
void copyTuples(
  vtkDataArray* array, vtkIdType number, int components, std::vector<Tuple>& to, const Store& store)
{
  to.clear();
  if (!array || array->GetNumberOfComponents() != components || array->GetNumberOfTuples() < number)
  {
    return;
  }
  to.resize(static_cast<std::size_t>(number));
  vtkSMPTools::For(0, number,
    [array, &to, &store](vtkIdType begin, vtkIdType end)
    {
      double tuple[3];
      for (vtkIdType i = begin; i < end; ++i)
      {
        array->GetTuple(i, tuple);
        store(to[static_cast<std::size_t>(i)], tuple);
      }
    });
}

void storeVector(Vector3& to, const double from[3])
{
  to = { from[0], from[1], from[2] };
}
void storeNormal(std::array<float, 3>& to, const double from[3])
{
  to = { static_cast<float>(from[0]), static_cast<float>(from[1]), static_cast<float>(from[2]) };
}
void storeNumber(float& to, const double from[3])
{
  to = static_cast<float>(from[0]);
}

void copyTriangles(
  vtkCellArray* polygons, vtkIdType points, std::vector<TriangleMesh::Corners>& triangles)
{
  triangles.clear();
  triangles.reserve(static_cast<std::size_t>(polygons->GetNumberOfCells()));
  const auto exists = [points](vtkIdType id) { return id >= 0 && id < points; };
  for (vtkIdType cell = 0; cell < polygons->GetNumberOfCells(); ++cell)
  {
    vtkIdType size;
    const vtkIdType* ids;
    polygons->GetCellAtId(cell, size, ids);
    for (vtkIdType i = 2; i < size; ++i)
    {
      if (exists(ids[0]) && exists(ids[i - 1]) && exists(ids[i]))
      {
        triangles.push_back({ static_cast<std::uint32_t>(ids[0]),
          static_cast<std::uint32_t>(ids[i - 1]), static_cast<std::uint32_t>(ids[i]) });
      }
    }
  }
}
}

void TriangleMesh::assign(vtkPolyData* data)
{
  const vtkIdType number = data->GetNumberOfPoints();
  vtkPointData* const attributes = data->GetPointData();
  copyTuples(data->GetPoints() ? data->GetPoints()->GetData() : nullptr, number, 3, this->points,
    storeVector);
  copyTriangles(data->GetPolys(), number, this->triangles);
  copyTuples(attributes->GetNormals(), number, 3, this->normals, storeNormal);
  copyTuples(
    attributes->GetArray(arrays::TextureCoordinates), number, 3, this->texturePoints, storeVector);
  vtkDataArray* const weights = data->GetFieldData()->GetArray(arrays::TextureWeights);
  const bool fades = !this->texturePoints.empty() && weights && weights->GetNumberOfValues() == 2;
  this->textureWeight = fades ? weights->GetVariantValue(0).ToDouble() : 1;
  copyTuples(fades ? attributes->GetArray(arrays::OtherTextureCoordinates) : nullptr, number, 3,
    this->otherTexturePoints, storeVector);
  copyTuples(attributes->GetArray(arrays::Opacity), number, 1, this->opacities, storeNumber);
}
}
