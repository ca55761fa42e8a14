// SPDX-License-Identifier: BSD-3-Clause
// The view that is chosen for data shows all of them, whatever their shape and wherever the eye is put.
#include "SceneView.h"

#include <Camera.h>
#include <CloudArrays.h>
#include <vtkCamera.h>
#include <vtkCloudGradedBackdrop.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkStructuredGrid.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace nephoscope;
using namespace nephoscope::program;

namespace
{
constexpr double Degree = 3.14159265358979323846 / 180;
constexpr double Radius = 6371229;

void addField(vtkStructuredGrid* grid, const char* name, double value)
{
  const vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  grid->GetFieldData()->AddArray(array);
}

/// A box of nx x ny x 5 points, 4 km apart in height, or the same in longitude and latitude on a globe.
vtkSmartPointer<vtkStructuredGrid> gridOf(
  const char* geometry, const double x[2], const double y[2], double exaggeration)
{
  const int n[3] = { 24, 13, 6 };
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  const vtkNew<vtkPoints> points;
  const vtkNew<vtkFloatArray> heights;
  heights->SetName(arrays::Height);
  for (int k = 0; k < n[2]; ++k)
  {
    for (int j = 0; j < n[1]; ++j)
    {
      for (int i = 0; i < n[0]; ++i)
      {
        const double a = x[0] + (x[1] - x[0]) * i / (n[0] - 1);
        const double b = y[0] + (y[1] - y[0]) * j / (n[1] - 1);
        const double z = 4000.0 * k;
        const double r = Radius + exaggeration * z;
        heights->InsertNextValue(static_cast<float>(z));
        if (std::string(geometry) == "Globe")
        {
          points->InsertNextPoint(r * std::cos(b * Degree) * std::cos(a * Degree),
            r * std::cos(b * Degree) * std::sin(a * Degree), r * std::sin(b * Degree));
        }
        else
        {
          points->InsertNextPoint(a, b, exaggeration * z);
        }
      }
    }
  }
  grid->SetDimensions(n);
  grid->SetPoints(points);
  grid->GetPointData()->AddArray(heights);
  const vtkNew<vtkStringArray> name;
  name->SetName(arrays::Geometry);
  name->InsertNextValue(geometry);
  grid->GetFieldData()->AddArray(name);
  addField(grid, arrays::PlanetRadius, Radius);
  addField(grid, arrays::HeightScale, exaggeration);
  return grid;
}

Extent boxExtent(double exaggeration)
{
  const double x[2] = { 100e3, 580e3 };
  const double y[2] = { -50e3, 150e3 };
  return extentOf(gridOf("Local", x, y, exaggeration));
}

Extent globeExtent(double exaggeration)
{
  const double x[2] = { 0, 360 };
  const double y[2] = { -90, 90 };
  return extentOf(gridOf("Globe", x, y, exaggeration));
}

Vector3 positionOf(vtkCamera* camera)
{
  Vector3 position;
  camera->GetPosition(position.v);
  return position;
}

/// The largest share of the way from the picture's middle to its edge that a point takes; 1 is at the edge.
double reachOf(
  vtkCamera* camera, const std::vector<Vector3>& points, const std::array<int, 2>& size)
{
  Vector3 target;
  Vector3 up;
  camera->GetFocalPoint(target.v);
  camera->GetViewUp(up.v);
  const Camera pinhole =
    Camera::perspective(positionOf(camera), target, up, camera->GetViewAngle(), size[0], size[1]);
  double reach = 0;
  for (const Vector3& point : points)
  {
    const Projected seen = pinhole.project(point);
    EXPECT_GT(seen.depth, 0);
    reach =
      std::max({ reach, std::abs(2 * seen.x / size[0] - 1), std::abs(2 * seen.y / size[1] - 1) });
  }
  return reach;
}
}

TEST(Extent, MeasuresTheTroposphere)
{
  const Extent extent = boxExtent(3);
  EXPECT_EQ(extent.geometry, "Local");
  EXPECT_DOUBLE_EQ(extent.bounds[0], 100e3);
  EXPECT_DOUBLE_EQ(extent.bounds[3], 150e3);
  EXPECT_DOUBLE_EQ(extent.bounds[5], 3 * 16e3) << "what is over 16 km is not looked at";
  EXPECT_NEAR(extent.gridStep, 200e3 / 12, 1e-2) << "from south to north";
  EXPECT_DOUBLE_EQ(extent.heightScale, 3);
}

TEST(Extent, TellsAGlobeFromAPart)
{
  EXPECT_TRUE(globeExtent(1).global);
  const double x[2] = { 10, 40 };
  const double y[2] = { 30, 60 };
  const Extent part = extentOf(gridOf("Globe", x, y, 1));
  EXPECT_FALSE(part.global);
  EXPECT_NEAR(std::atan2(part.middle[1], part.middle[0]) / Degree, 25, 1);
  EXPECT_NEAR(std::asin(part.middle[2]) / Degree, 45, 3);
}

TEST(Exaggeration, MakesTheTroposphereAQuarterOfTheWidth)
{
  Extent globe = globeExtent(1);
  EXPECT_DOUBLE_EQ(exaggerationOf(globe), 40); // its rows are far apart
  globe.gridStep = 3e5;
  EXPECT_DOUBLE_EQ(exaggerationOf(globe), 10);
  EXPECT_DOUBLE_EQ(exaggerationOf(boxExtent(1)), 7.5); // 480 km / (4 * 16 km)
  const double x[2] = { 0, 6e3 };
  EXPECT_DOUBLE_EQ(exaggerationOf(extentOf(gridOf("Local", x, x, 1))), 1) << "never flattened";
}

TEST(CameraView, ShowsAllTheDataAndNoMore)
{
  for (const std::array<int, 2> size :
    { std::array<int, 2>{ 640, 480 }, std::array<int, 2>{ 300, 900 } })
  {
    for (const double elevation : { 0.0, 25.0, 60.0, 90.0 })
    {
      for (const double bearing : { -45.0, 155.0 })
      {
        CameraView view;
        view.elevation = elevation;
        view.bearing = bearing;
        const Extent extent = boxExtent(3);
        // A margin of 6 per cent: the outermost point is at 1 / 1.06 of the way.
        EXPECT_NEAR(reachOf(cameraOf(view, extent, size), extent.hull, size), 1 / 1.06, 1e-9)
          << "elevation " << elevation;
      }
    }
  }
}

TEST(CameraView, ShowsTheWholeGlobe)
{
  const Extent extent = globeExtent(30);
  const std::array<int, 2> size{ 640, 480 };
  const auto camera = cameraOf({}, extent, size);
  // The sphere at 16 km touches the margin: sin of its apparent radius is shell / distance.
  const double shell = Radius + 30 * 16e3;
  const double apparent = std::asin(shell / length(positionOf(camera)));
  EXPECT_NEAR(std::tan(apparent), std::tan(15 * Degree) / 1.06, 1e-12);
}

TEST(CameraView, BearingIsTheCompassDirectionOfTheEye)
{
  CameraView view;
  view.bearing = 90;
  view.elevation = 0;
  const Extent extent = boxExtent(1);
  const Vector3 offset = positionOf(cameraOf(view, extent, { 4, 3 })) - extent.middle;
  EXPECT_GT(offset[0], 0) << "east";
  EXPECT_NEAR(offset[1] / offset[0], 0, 1e-12);
  EXPECT_NEAR(offset[2] / offset[0], 0, 1e-12);
}

TEST(CameraView, StandsOverTheLongitudeAndLatitude)
{
  CameraView view;
  view.longitude = 90;
  view.latitude = 30;
  view.distance = 4;
  const Vector3 eye = positionOf(cameraOf(view, globeExtent(1), { 4, 3 }));
  EXPECT_NEAR(eye[0], 0, 1e-6);
  EXPECT_NEAR(eye[1], 4 * Radius * std::cos(30 * Degree), 1e-6);
  EXPECT_NEAR(eye[2], 2 * Radius, 1e-6);
}

TEST(CameraView, AnExplicitEyeWins)
{
  CameraView view;
  view.position = Triple{ 1, 2, 3 };
  view.target = Triple{ 4, 5, 6 };
  const auto camera = cameraOf(view, boxExtent(1), { 4, 3 });
  EXPECT_EQ(positionOf(camera)[2], 3);
  EXPECT_EQ(camera->GetFocalPoint()[0], 4);
}

TEST(Light, FallsFromAboveUnlessTold)
{
  const Extent extent = boxExtent(1);
  for (const double bearing : { 0.0, 100.0, 250.0 })
  {
    CameraView view;
    view.bearing = bearing;
    const Vector3 sun = towardSunOf({}, extent, cameraOf(view, extent, { 4, 3 }));
    EXPECT_NEAR(length(sun), 1, 1e-12);
    EXPECT_NEAR(sun[2], std::sin(35 * Degree), 1e-12);
  }
  Light light;
  light.towardSun = Triple{ 0, 3, 4 };
  EXPECT_DOUBLE_EQ(towardSunOf(light, extent, cameraOf({}, extent, { 4, 3 }))[1], 0.6);
}

TEST(Backdrop, IsSkyOverLandAndSpaceRoundAGlobe)
{
  EXPECT_LT(backdropOf({}, globeExtent(1))->GetZenith()[2], 0.01);
  EXPECT_GT(backdropOf({}, boxExtent(1))->GetZenith()[2], 0.3);
  Backdrop given;
  given.zenith = Triple{ 1, 2, 3 };
  EXPECT_EQ(backdropOf(given, boxExtent(1))->GetZenith()[2], 3);
}
