// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file ImageGrid.h
 * @brief The horizontal grids that bodies are given: a vtkImageData of one layer as kernels know it.
 */
#ifndef ImageGrid_h
#define ImageGrid_h

#include "CloudArrays.h"
#include "CloudShadow.h"
#include "GridPyramid.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <string>

/// Read a point array of a single layer, times `scale`. Returns what is wrong, or nothing.
inline std::string readGrid(
  vtkDataObject* data, const char* name, nephoscope::GridPyramid& grid, double& z, double scale = 1)
{
  auto* const image = vtkImageData::SafeDownCast(data);
  if (!image)
  {
    return "The input is no vtkImageData: connect one with the point array " + std::string(name) +
      ".";
  }
  const int* const n = image->GetDimensions();
  vtkDataArray* const array = image->GetPointData()->GetArray(name);
  if (!array || array->GetNumberOfComponents() != 1 || n[2] != 1 || n[0] < 2 || n[1] < 2)
  {
    return "The image of " + std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " +
      std::to_string(n[2]) + " points has to be one layer of at least 2 x 2 with a point array " +
      name + " of one component.";
  }
  const double* const spacing = image->GetSpacing();
  if (!(spacing[0] > 0 && spacing[1] > 0))
  {
    return "The image's spacing " + std::to_string(spacing[0]) + " x " +
      std::to_string(spacing[1]) + " has to be above 0.";
  }
  std::vector<float> values(static_cast<std::size_t>(array->GetNumberOfTuples()));
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = static_cast<float>(scale * array->GetComponent(static_cast<vtkIdType>(i), 0));
  }
  double first[3];
  image->GetPoint(0, first);
  grid = nephoscope::GridPyramid(
    { first[0], first[1], spacing[0], spacing[1], n[0], n[1] }, std::move(values));
  z = first[2];
  return {};
}

/// The clouds' shadow from an optional input; none is no clouds, and beyond the image they go on as they are in the mean.
/// Returns what is wrong, or nothing.
inline std::string readShadow(vtkDataObject* data, nephoscope::CloudShadow& shadow)
{
  shadow = {};
  if (!data)
  {
    return {};
  }
  std::string wrong =
    readGrid(data, nephoscope::arrays::SunTransmittance, shadow.transmittance, shadow.height);
  shadow.beyond = wrong.empty() ? shadow.transmittance.mean() : 1;
  return wrong;
}
#endif
