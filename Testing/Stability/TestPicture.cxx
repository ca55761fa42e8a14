// SPDX-License-Identifier: BSD-3-Clause
#include "TestPicture.h"

#include "CloudArrays.h"
#include "vtkCamera.h"
#include "vtkCloudCellVolume.h"
#include "vtkCloudscape.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkStructuredGrid.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace stability
{
namespace
{
constexpr Vector3 Up{ 0, 0, 1 };

vtkSmartPointer<vtkCamera> vtkCameraOf(const View& view)
{
  auto camera = vtkSmartPointer<vtkCamera>::New();
  camera->SetPosition(view.eye[0], view.eye[1], view.eye[2]);
  camera->SetFocalPoint(view.target[0], view.target[1], view.target[2]);
  camera->SetViewUp(Up[0], Up[1], Up[2]);
  camera->SetViewAngle(view.angle);
  camera->SetParallelProjection(view.halfHeight > 0);
  camera->SetParallelScale(view.halfHeight > 0 ? view.halfHeight : 1);
  return camera;
}

std::vector<RGB> colorsOf(vtkImageData* image, const char* name)
{
  vtkDataArray* const array = image->GetPointData()->GetArray(name);
  if (!array)
  {
    return {};
  }
  std::vector<RGB> colors(static_cast<std::size_t>(array->GetNumberOfTuples()));
  for (std::size_t p = 0; p < colors.size(); ++p)
  {
    for (int c = 0; c < 3; ++c)
    {
      colors[p][c] = static_cast<float>(array->GetComponent(static_cast<vtkIdType>(p), c));
    }
  }
  return colors;
}

vtkSmartPointer<vtkCloudscape> drawn(const Bodies& bodies, const View& view)
{
  auto scape = vtkSmartPointer<vtkCloudscape>::New();
  for (const auto& body : bodies)
  {
    scape->AddBody(body);
  }
  scape->SetCamera(vtkCameraOf(view));
  scape->SetSize(view.width, view.height);
  scape->Update();
  return scape;
}

double errorOf(double value, double truth)
{
  return std::isfinite(value) ? std::abs(value - truth) : 1;
}
}

Camera View::camera() const
{
  return this->halfHeight > 0
    ? Camera::parallel(this->eye, this->target, Up, this->halfHeight, this->width, this->height)
    : Camera::perspective(this->eye, this->target, Up, this->angle, this->width, this->height);
}

vtkSmartPointer<vtkStructuredGrid> makeGrid(const std::array<int, 3>& n,
  const std::function<Vector3(double, double, double)>& place,
  const std::function<double(int, int, int)>& density, bool floatPoints)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(floatPoints ? VTK_FLOAT : VTK_DOUBLE);
  vtkNew<vtkFloatArray> fraction;
  fraction->SetName(arrays::CloudFraction);
  for (int k = 0; k < n[2]; ++k)
  {
    for (int j = 0; j < n[1]; ++j)
    {
      for (int i = 0; i < n[0]; ++i)
      {
        points->InsertNextPoint(place(i / (n[0] - 1.0), j / (n[1] - 1.0), k / (n[2] - 1.0)).v);
        fraction->InsertNextValue(static_cast<float>(density(i, j, k)));
      }
    }
  }
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(n[0], n[1], n[2]);
  grid->SetPoints(points);
  grid->GetPointData()->SetScalars(fraction);
  return grid;
}

vtkSmartPointer<vtkCloudCellVolume> bodyOf(vtkStructuredGrid* grid, const RGB& color)
{
  auto body = vtkSmartPointer<vtkCloudCellVolume>::New();
  body->SetInputData(grid);
  body->SetFullCoverExtinction(1);
  body->SetColor(color[0], color[1], color[2]);
  return body;
}

Picture draw(const Bodies& bodies, const View& view)
{
  const auto scape = drawn(bodies, view);
  return { colorsOf(scape->GetOutput(), arrays::Radiance),
    colorsOf(scape->GetOutput(), arrays::Transmittance) };
}

long long countSegments(const Bodies& bodies, const View& view)
{
  return drawn(bodies, view)->GetNumberOfSegments();
}

Outcome compareWithExact(vtkStructuredGrid* grid, const View& view, Naive way, double tolerance)
{
  const Camera camera = view.camera();
  const Picture picture = draw({ bodyOf(grid) }, view);
  double ours = 0;
  double naive = 0;
  for (std::size_t p = 0; p < picture.transmittance.size(); ++p)
  {
    const int x = static_cast<int>(p) % view.width;
    const int y = static_cast<int>(p) / view.width;
    const double truth = std::exp(-exactOpticalDepth(grid, camera, x, y, 1e-9));
    ours = std::max(ours, errorOf(picture.transmittance[p][0], truth));
    naive = std::max(naive, errorOf(std::exp(-naiveOpticalDepth(grid, camera, x, y, way)), truth));
  }
  return { figure("error", naive), figure("error", ours),
    !picture.transmittance.empty() && ours <= tolerance };
}
}
}
