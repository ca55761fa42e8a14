// SPDX-License-Identifier: BSD-3-Clause
#include "SceneView.h"

#include "Failure.h"

#include <CloudArrays.h>
#include <vtkCamera.h>
#include <vtkCloudGradedBackdrop.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>
#include <vtkStructuredGrid.h>

#include <algorithm>
#include <cmath>

namespace nephoscope::program
{
namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr double Troposphere = 16000; // m: what pictures of clouds show

double radians(double degrees)
{
  return degrees * Pi / 180;
}

Vector3 vectorOf(const Triple& triple)
{
  return { triple[0], triple[1], triple[2] };
}

double fieldValue(vtkFieldData* fields, const char* name, double fallback)
{
  vtkDataArray* const array = fields->GetArray(name);
  return array && array->GetNumberOfTuples() > 0 ? array->GetTuple1(0) : fallback;
}

double medianStep(vtkStructuredGrid* grid)
{
  int n[3];
  grid->GetDimensions(n);
  std::vector<double> steps;
  for (vtkIdType point = 0; point + n[0] < static_cast<vtkIdType>(n[0]) * n[1]; ++point)
  {
    Vector3 here;
    Vector3 north;
    grid->GetPoint(point, here.v);
    grid->GetPoint(point + n[0], north.v);
    steps.push_back(length(north - here));
  }
  if (steps.empty())
  {
    return 0;
  }
  std::nth_element(steps.begin(), steps.begin() + steps.size() / 2, steps.end());
  return steps[steps.size() / 2];
}

/// Whether a picture of the clouds should show a point.
class Cloudiness
{
public:
  explicit Cloudiness(vtkPointData* points)
    : Fraction(points->GetArray(arrays::CloudFraction))
    , Liquid(points->GetArray(arrays::LiquidWater))
    , Ice(points->GetArray(arrays::IceWater))
  {
  }

  bool at(vtkIdType point) const
  {
    return exceeds(this->Fraction, point, 0.05) || exceeds(this->Liquid, point, 1e-6) ||
      exceeds(this->Ice, point, 1e-6);
  }

private:
  static bool exceeds(vtkDataArray* array, vtkIdType point, double value)
  {
    return array && array->GetTuple1(point) > value;
  }
  vtkDataArray* Fraction;
  vtkDataArray* Liquid;
  vtkDataArray* Ice;
};

/// Points of the troposphere, some thousand a layer at most; those in cloud if `cloudy`.
std::vector<Vector3> hullOf(vtkStructuredGrid* grid, bool cloudy)
{
  int n[3];
  grid->GetDimensions(n);
  vtkDataArray* const height = grid->GetPointData()->GetArray(arrays::Height);
  const Cloudiness cloud(grid->GetPointData());
  std::vector<Vector3> hull;
  const int stride[2] = { std::max(1, (n[0] - 1) / 64), std::max(1, (n[1] - 1) / 64) };
  for (int k = 0; k < n[2]; ++k)
  {
    for (int j = 0; j < n[1]; j += stride[1])
    {
      for (int i = 0; i < n[0]; i += stride[0])
      {
        const vtkIdType point = i + n[0] * (j + static_cast<vtkIdType>(n[1]) * k);
        if ((!height || height->GetTuple1(point) <= Troposphere) && (!cloudy || cloud.at(point)))
        {
          hull.emplace_back();
          grid->GetPoint(point, hull.back().v);
        }
      }
    }
  }
  return hull;
}

/// Least and greatest x, y, z.
void boundsOf(const std::vector<Vector3>& points, double bounds[6])
{
  for (int axis = 0; axis < 3; ++axis)
  {
    bounds[2 * axis] = points.empty() ? 0 : points[0][axis];
    bounds[2 * axis + 1] = bounds[2 * axis];
    for (const Vector3& point : points)
    {
      bounds[2 * axis] = std::min(bounds[2 * axis], point[axis]);
      bounds[2 * axis + 1] = std::max(bounds[2 * axis + 1], point[axis]);
    }
  }
}

/// Where a camera looks from: unit vectors of its picture.
struct Frame
{
  Vector3 forward;
  Vector3 right;
  Vector3 up;
};

Frame frameOf(const Vector3& towardEye, const Vector3& viewUp)
{
  Frame frame;
  frame.forward = -1 * normalized(towardEye);
  frame.right = normalized(cross(frame.forward, viewUp));
  frame.up = cross(frame.right, frame.forward);
  return frame;
}

/// The least distance from the target from which all points are in a picture of these half angles' tangents.
double fittingDistance(const std::vector<Vector3>& points, const Vector3& target,
  const Frame& frame, double tangentAcross, double tangentUp)
{
  double distance = 0;
  for (const Vector3& point : points)
  {
    const Vector3 d = point - target;
    const double beyond = dot(d, frame.forward);
    distance = std::max({ distance, std::abs(dot(d, frame.right)) / tangentAcross - beyond,
      std::abs(dot(d, frame.up)) / tangentUp - beyond });
  }
  return distance;
}

Vector3 directionOf(double longitude, double latitude)
{
  return { std::cos(radians(latitude)) * std::cos(radians(longitude)),
    std::cos(radians(latitude)) * std::sin(radians(longitude)), std::sin(radians(latitude)) };
}

/// From the target to the eye, unit.
Vector3 towardEyeOf(const CameraView& view, const Extent& extent)
{
  if (!extent.isGlobe())
  {
    const double bearing = radians(view.bearing.value_or(150));
    const double elevation = radians(view.elevation.value_or(15));
    return { std::cos(elevation) * std::sin(bearing), std::cos(elevation) * std::cos(bearing),
      std::sin(elevation) };
  }
  // A whole globe is seen over the Atlantic, a part from above.
  const double longitude =
    extent.global ? -35 : std::atan2(extent.middle[1], extent.middle[0]) * 180 / Pi;
  const double latitude =
    extent.global ? 20 : std::asin(std::clamp(extent.middle[2], -1.0, 1.0)) * 180 / Pi;
  return directionOf(view.longitude.value_or(longitude), view.latitude.value_or(latitude));
}

/// What is up in a picture of this line of sight. @throw UsageFailure if that is no direction across the line
Vector3 upAcross(const CameraView& view, const Vector3& towardEye)
{
  if (!(length(towardEye) > 0))
  {
    throw UsageFailure("camera: the eye stands in the 'target'; move 'position' or 'target'");
  }
  const Vector3 up = view.up ? vectorOf(*view.up) : Vector3{ 0, 0, 1 };
  if (length(cross(up, towardEye)) > 1e-6 * length(up) * length(towardEye))
  {
    return up;
  }
  if (view.up)
  {
    throw UsageFailure("camera: 'up' lies along the line of sight; choose a direction across it");
  }
  return { 0, 1, 0 }; // straight down: north is up
}

/// Where the eye of the default or of the given distance stands.
Vector3 eyeOf(const CameraView& view, const Extent& extent, const Vector3& target,
  const Vector3& towardEye, const Frame& frame, const std::array<int, 2>& size)
{
  constexpr double margin = 1.06;
  const double tangentUp = std::tan(radians(view.viewAngle / 2)) / margin;
  const double tangentAcross = tangentUp * size[0] / size[1];
  if (extent.isGlobe())
  {
    const double shell = extent.planetRadius + extent.heightScale * Troposphere;
    const double all = shell / std::sin(std::atan(std::min(tangentUp, tangentAcross)));
    const double near = extent.planetRadius +
      fittingDistance(
        extent.hull, extent.planetRadius * towardEye, frame, tangentAcross, tangentUp);
    const double fitting = extent.global ? all : std::min(all, near);
    return view.distance ? *view.distance * extent.planetRadius * towardEye : fitting * towardEye;
  }
  const double fitting = fittingDistance(extent.hull, target, frame, tangentAcross, tangentUp);
  return target + view.distance.value_or(1) * fitting * towardEye;
}
}

Extent extentOf(vtkStructuredGrid* grid)
{
  Extent extent;
  vtkFieldData* const fields = grid->GetFieldData();
  auto* const geometry = vtkStringArray::SafeDownCast(fields->GetAbstractArray(arrays::Geometry));
  extent.geometry = geometry && geometry->GetNumberOfValues() > 0 ? geometry->GetValue(0) : "Map";
  extent.planetRadius = fieldValue(fields, arrays::PlanetRadius, 6371229);
  extent.heightScale = fieldValue(fields, arrays::HeightScale, 1);
  extent.gridStep = medianStep(grid);
  const std::vector<Vector3> all = hullOf(grid, false);
  boundsOf(all, extent.bounds);
  extent.hull = hullOf(grid, true);
  if (extent.hull.size() < 8)
  {
    extent.hull = all;
  }
  double shown[6];
  boundsOf(extent.hull, shown);
  extent.middle = { (shown[0] + shown[1]) / 2, (shown[2] + shown[3]) / 2,
    (shown[4] + shown[5]) / 2 };
  if (extent.isGlobe())
  {
    Vector3 sum{ 0, 0, 0 };
    for (const Vector3& point : all)
    {
      sum = sum + normalized(point);
    }
    extent.global = length(sum) < 0.3 * static_cast<double>(all.size());
    extent.middle = normalized(sum);
  }
  return extent;
}

double exaggerationOf(const Extent& extent)
{
  if (extent.isGlobe() && extent.global)
  {
    // Between the points of a coarse grid, faces sag below the sphere; clouds from a quarter of a kilometre up stay above.
    const double sag = extent.gridStep * extent.gridStep / (8 * extent.planetRadius);
    return std::round(std::clamp(sag / 250, 10.0, 40.0));
  }
  const double width = extent.isGlobe()
    ? extent.planetRadius
    : std::max(extent.bounds[1] - extent.bounds[0], extent.bounds[3] - extent.bounds[2]);
  const double metre = extent.heightScale;
  const double factor = std::clamp(width / (4 * Troposphere * metre), 1.0, 40.0);
  const double digit = factor < 10 ? 0.1 : 1;
  return std::round(factor / digit) * digit;
}

vtkSmartPointer<vtkCamera> cameraOf(
  const CameraView& view, const Extent& extent, const std::array<int, 2>& size)
{
  Vector3 up;
  Vector3 target = view.target ? vectorOf(*view.target)
    : extent.isGlobe()         ? Vector3{ 0, 0, 0 }
                               : extent.middle;
  Vector3 eye;
  if (view.position)
  {
    eye = vectorOf(*view.position);
    up = upAcross(view, eye - target);
  }
  else
  {
    const Vector3 towardEye = towardEyeOf(view, extent);
    up = upAcross(view, towardEye);
    eye = eyeOf(view, extent, target, towardEye, frameOf(towardEye, up), size);
    up = upAcross(view, eye - target);
  }
  auto camera = vtkSmartPointer<vtkCamera>::New();
  camera->SetPosition(eye.v);
  camera->SetFocalPoint(target.v);
  camera->SetViewUp(up.v);
  camera->SetViewAngle(view.viewAngle);
  return camera;
}

Vector3 towardSunOf(const Light& light, const Extent& extent, vtkCamera* camera)
{
  if (light.towardSun)
  {
    return normalized(vectorOf(*light.towardSun));
  }
  Vector3 eye;
  Vector3 target;
  Vector3 up;
  camera->GetPosition(eye.v);
  camera->GetFocalPoint(target.v);
  camera->GetViewUp(up.v);
  const Frame frame = frameOf(eye - target, up);
  if (extent.isGlobe())
  {
    return normalized(-0.45 * frame.forward + -0.7 * frame.right + 0.55 * frame.up);
  }
  // 35 degrees high, from the left and a little behind the eye.
  const Vector3 level = normalized(Vector3{
    -frame.right[0] - 0.5 * frame.forward[0], -frame.right[1] - 0.5 * frame.forward[1], 0 });
  return std::cos(radians(35)) * level + std::sin(radians(35)) * Vector3{ 0, 0, 1 };
}

vtkSmartPointer<vtkCloudGradedBackdrop> backdropOf(const Backdrop& backdrop, const Extent& extent)
{
  const Triple space{ 0.001, 0.0015, 0.003 };
  const bool globe = extent.isGlobe();
  auto graded = vtkSmartPointer<vtkCloudGradedBackdrop>::New();
  graded->SetZenith(backdrop.zenith.value_or(globe ? space : Triple{ 0.08, 0.19, 0.45 }).data());
  graded->SetHorizon(backdrop.horizon.value_or(globe ? space : Triple{ 0.42, 0.57, 0.8 }).data());
  graded->SetNadir(backdrop.nadir.value_or(globe ? space : Triple{ 0.02, 0.05, 0.1 }).data());
  return graded;
}
}
