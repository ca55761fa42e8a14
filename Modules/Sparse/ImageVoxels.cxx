// SPDX-License-Identifier: BSD-3-Clause
#include "CloudArrays.h"
#include "StructuredVoxels.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
/// Row by row: from (i, j, k) of the extent to the scene.
std::array<double, 16> matrixOf(vtkImageData* image)
{
  std::array<double, 16> m{};
  std::copy_n(image->GetIndexToPhysicalMatrix()->GetData(), 16, m.begin());
  return m;
}

/// One array's voxels of a brick, [component][voxel].
void fillBrick(vtkImageData* image, vtkDataArray* array, const std::array<int, 3>& first,
  double cut, std::vector<float>& values)
{
  int extent[6];
  image->GetExtent(extent);
  std::fill(values.begin(), values.end(), 0.0F);
  for (std::size_t v = 0; v < VoxelGrid::Volume; ++v)
  {
    int at[3] = { first[0] + static_cast<int>(v % 8), first[1] + static_cast<int>(v / 8 % 8),
      first[2] + static_cast<int>(v / 64) };
    bool inside = true;
    for (int c = 0; c < 3; ++c)
    {
      inside = inside && at[c] >= extent[2 * c] && at[c] <= extent[2 * c + 1];
    }
    if (!inside)
    {
      continue;
    }
    const vtkIdType point = image->ComputePointId(at);
    for (int c = 0; c < array->GetNumberOfComponents(); ++c)
    {
      const auto value = static_cast<float>(array->GetComponent(point, c));
      const bool keep = std::isfinite(value) && static_cast<double>(std::abs(value)) > cut;
      values[static_cast<std::size_t>(c) * VoxelGrid::Volume + v] = keep ? value : 0.0F;
    }
  }
}

double cutOf(vtkDataArray* array, double tolerance)
{
  double largest = 0;
  for (int c = 0; c < array->GetNumberOfComponents(); ++c)
  {
    const double* const range = array->GetFiniteRange(c);
    largest = std::max({ largest, std::abs(range[0]), std::abs(range[1]) });
  }
  return tolerance * largest;
}

FogGrid gridOf(vtkImageData* image, vtkDataArray* array, double tolerance)
{
  int e[6];
  image->GetExtent(e);
  const auto floor8 = [](int i) { return i - ((i % 8) + 8) % 8; };
  const auto bricksAlong = [&e, &floor8](int c)
  { return static_cast<std::size_t>((floor8(e[2 * c + 1]) - floor8(e[2 * c])) / 8 + 1); };
  FogGrid made(gridNameOf(array->GetName()), array->GetNumberOfComponents(),
    bricksAlong(0) * bricksAlong(1) * bricksAlong(2));
  made.indexToWorld = matrixOf(image);
  made.tolerance = cutOf(array, tolerance);
  made.metadata.numbers["pruning_tolerance"] = made.tolerance;
  std::vector<float> values(
    VoxelGrid::Volume * static_cast<std::size_t>(array->GetNumberOfComponents()));
  std::size_t place = 0;
  std::array<int, 3> at{};
  for (at[2] = floor8(e[4]); at[2] <= e[5]; at[2] += VoxelGrid::Edge)
  {
    for (at[1] = floor8(e[2]); at[1] <= e[3]; at[1] += VoxelGrid::Edge)
    {
      for (at[0] = floor8(e[0]); at[0] <= e[1]; at[0] += VoxelGrid::Edge)
      {
        fillBrick(image, array, at, made.tolerance, values);
        made.put(place++, at, values.data());
      }
    }
  }
  return made;
}
}

std::string gridNameOf(const std::string& arrayName)
{
  return arrayName == arrays::Extinction ? "density"
    : arrayName == arrays::LiquidWater   ? "liquid"
    : arrayName == arrays::IceWater      ? "ice"
    : arrayName == arrays::Wind          ? "wind"
                                         : arrayName;
}

std::vector<FogGrid> voxelsOf(vtkImageData* image, const VoxelOrder& order)
{
  std::vector<FogGrid> grids;
  vtkPointData* const points = image->GetPointData();
  std::string names;
  for (int a = 0; a < points->GetNumberOfArrays(); ++a)
  {
    vtkDataArray* const array = points->GetArray(a);
    if (!array || !array->GetName() || array->GetNumberOfTuples() != image->GetNumberOfPoints() ||
      (array->GetNumberOfComponents() != 1 && array->GetNumberOfComponents() != 3))
    {
      continue;
    }
    const std::string name = gridNameOf(array->GetName());
    names += (names.empty() ? "" : ", ") + name;
    if (order.names.empty() ||
      std::find(order.names.begin(), order.names.end(), name) != order.names.end())
    {
      grids.push_back(gridOf(image, array, order.tolerance));
    }
  }
  if (grids.empty() || (!order.names.empty() && grids.size() < order.names.size()))
  {
    throw VDBError("The image does not have all the point arrays that are wanted; it has " +
      (names.empty() ? "none of 1 or 3 components" : names));
  }
  return grids;
}
}
