// SPDX-License-Identifier: BSD-3-Clause
#include "FitData.h"

#include "Failure.h"
#include "Messages.h"
#include "ModelFile.h"
#include "Progress.h"
#include "SceneBuilder.h"

#include <CloudArrays.h>
#include <Optics.h>
#include <vtkCloudHeightField.h>
#include <vtkCloudHeightFieldVolume.h>
#include <vtkCloudNetCDFReader.h>
#include <vtkCloudscape.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStructuredGrid.h>
#include <vtkXMLImageDataReader.h>

#include <cmath>
#include <filesystem>
#include <sstream>

namespace nephoscope::program
{
namespace
{
/// Extinction of a point of a grid, 1/m.
class PointExtinction
{
public:
  explicit PointExtinction(vtkStructuredGrid* grid)
    : Fraction(arrayOf(grid, arrays::CloudFraction))
    , Liquid(arrayOf(grid, arrays::LiquidWater))
    , Ice(arrayOf(grid, arrays::IceWater))
    , Height(arrayOf(grid, arrays::Height))
  {
  }

  const char* source() const
  {
    return this->Liquid || this->Ice ? "its condensate" : "0.2 per km times its cloud fraction";
  }

  double height(vtkIdType point) const { return this->Height->GetComponent(point, 0); }

  double operator()(vtkIdType point) const
  {
    if (!this->Liquid && !this->Ice)
    {
      return usableExtinction(2e-4 * this->Fraction->GetComponent(point, 0));
    }
    const double air = standardAirDensity(this->height(point));
    const Particles droplets;
    const Particles crystals{ 2, 30e-6, IceDensity };
    double sum = 0;
    sum += this->Liquid
      ? condensateExtinctionPerMeter(this->Liquid->GetComponent(point, 0), air, droplets)
      : 0;
    sum += this->Ice
      ? condensateExtinctionPerMeter(this->Ice->GetComponent(point, 0), air, crystals)
      : 0;
    return usableExtinction(sum);
  }

private:
  static vtkDataArray* arrayOf(vtkStructuredGrid* grid, const char* name)
  {
    return grid->GetPointData()->GetArray(name);
  }

  vtkDataArray* Fraction;
  vtkDataArray* Liquid;
  vtkDataArray* Ice;
  vtkDataArray* Height;
};

Vector3 directionOf(double longitude, double latitude)
{
  const double east = vtkMath::RadiansFromDegrees(longitude);
  const double north = vtkMath::RadiansFromDegrees(latitude);
  return { std::cos(north) * std::cos(east), std::cos(north) * std::sin(east), std::sin(north) };
}

Vector3 directionOfPoint(vtkStructuredGrid* globe, vtkIdType point)
{
  double at[3];
  globe->GetPoint(point, at);
  return normalized(Vector3{ at[0], at[1], at[2] });
}

/// The column of a globe nearest to a direction. @param angle to it, radians
vtkIdType nearestColumn(vtkStructuredGrid* globe, const Vector3& direction, double& angle)
{
  int size[3];
  globe->GetDimensions(size);
  vtkIdType nearest = 0;
  double least = 4;
  for (vtkIdType column = 0; column < static_cast<vtkIdType>(size[0]) * size[1]; ++column)
  {
    const Vector3 between = directionOfPoint(globe, column) - direction;
    if (dot(between, between) < least)
    {
      least = dot(between, between);
      nearest = column;
    }
  }
  angle = 2 * std::asin(std::min(1.0, std::sqrt(least) / 2));
  return nearest;
}

/// The distance of the column's farther neighbour, radians.
double widthOfColumn(vtkStructuredGrid* globe, vtkIdType column)
{
  int size[3];
  globe->GetDimensions(size);
  const vtkIdType count = static_cast<vtkIdType>(size[0]) * size[1];
  double widest = 0;
  for (const vtkIdType step : { vtkIdType(1), static_cast<vtkIdType>(size[0]) })
  {
    const vtkIdType other =
      column + step < count ? column + step : std::max(vtkIdType(0), column - step);
    const Vector3 between = directionOfPoint(globe, other) - directionOfPoint(globe, column);
    widest = std::max(widest, length(between));
  }
  return widest;
}
}

DensityGrid columnOf(Data data, const std::array<double, 2>& place)
{
  data.geometry = "globe";
  const auto reader = openModelFile(data);
  const auto grid = readStep(reader, data.time, false);
  double angle = 0;
  const vtkIdType column = nearestColumn(grid, directionOf(place[0], place[1]), angle);
  const Vector3 at = directionOfPoint(grid, column);
  const double longitude = vtkMath::DegreesFromRadians(std::atan2(at[1], at[0]));
  const double latitude = vtkMath::DegreesFromRadians(std::asin(at[2]));
  std::ostringstream text;
  text << data.file << ": the column at longitude " << std::round(1e3 * longitude) / 1e3
       << ", latitude " << std::round(1e3 * latitude) / 1e3;
  int size[3];
  grid->GetDimensions(size);
  if (angle > 3 * widthOfColumn(grid, column))
  {
    throw Failure(text.str() + " is the nearest, and is not near; give a --column of its region");
  }
  const PointExtinction extinction(grid);
  note(text.str() + ", extinction by " + extinction.source());
  const vtkIdType layer = static_cast<vtkIdType>(size[0]) * size[1];
  std::vector<double> heights;
  std::vector<double> values;
  for (int k = 0; k < size[2]; ++k)
  {
    const vtkIdType point = column + k * layer;
    const double value = extinction(point);
    if (!std::isnan(value))
    {
      heights.push_back(extinction.height(point));
      values.push_back(value);
    }
  }
  return { { { { 0 }, { 0 }, heights } }, values };
}

namespace
{
/// The points of an image in a box, or all.
DensityGrid gridOf(vtkImageData* image, const std::optional<Box>& box, const std::string& name)
{
  vtkDataArray* const extinction = image->GetPointData()->GetArray(arrays::Extinction);
  if (!extinction || extinction->GetNumberOfComponents() != 1)
  {
    throw Failure(name + ": has no point array " + arrays::Extinction + " of one component, 1/m");
  }
  std::array<std::vector<double>, 3> coordinates;
  int extent[6];
  image->GetExtent(extent);
  int first[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    first[axis] = extent[2 * axis + 1] + 1;
    for (int i = extent[2 * axis]; i <= extent[2 * axis + 1]; ++i)
    {
      const double x = image->GetOrigin()[axis] + i * image->GetSpacing()[axis];
      if (!box || (x >= (*box)[2 * axis] && x <= (*box)[2 * axis + 1]))
      {
        first[axis] = std::min(first[axis], i);
        coordinates[axis].push_back(x);
      }
    }
    if (coordinates[axis].empty())
    {
      throw Failure(name + ": the box has no points of it; give another --box");
    }
  }
  std::vector<double> values;
  for (std::size_t k = 0; k < coordinates[2].size(); ++k)
  {
    for (std::size_t j = 0; j < coordinates[1].size(); ++j)
    {
      for (std::size_t i = 0; i < coordinates[0].size(); ++i)
      {
        int point[] = { first[0] + static_cast<int>(i), first[1] + static_cast<int>(j),
          first[2] + static_cast<int>(k) };
        values.push_back(extinction->GetComponent(image->ComputePointId(point), 0));
      }
    }
  }
  return { coordinates, values };
}
}

DensityGrid volumeOf(const std::string& path, const std::optional<Box>& box)
{
  std::error_code error;
  if (!std::filesystem::exists(path, error))
  {
    throw Failure(path + ": there is no such file");
  }
  const vtkNew<vtkXMLImageDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  Messages::throwIfError(path);
  return gridOf(reader->GetOutput(), box, path);
}

DensityGrid volumeOf(const Scene& scene, const Box& box, Progress& progress)
{
  const BuiltScene built = buildScene(scene, false, progress);
  for (int i = 0; i < built.scape->GetNumberOfBodies(); ++i)
  {
    auto* const clouds = vtkCloudHeightField::SafeDownCast(built.scape->GetBody(i));
    if (!clouds)
    {
      continue;
    }
    const vtkNew<vtkCloudHeightFieldVolume> voxels;
    voxels->SetInputConnection(clouds->GetInputConnection(0, 0));
    voxels->SetExtinction(clouds->GetViewExtinction());
    voxels->SetDimensions(49, 49, 33);
    voxels->SetBounds(box[0], box[1], box[2], box[3], box[4], box[5]);
    voxels->Update();
    Messages::throwIfError("--box");
    return gridOf(voxels->GetOutput(), std::nullopt, "--box");
  }
  throw Failure("the scene has no bodies of type heightField; take a volume from --data FILE.vti");
}
}
