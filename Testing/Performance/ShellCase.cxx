// SPDX-License-Identifier: BSD-3-Clause
#include "ShellCase.h"

#include "CloudArrays.h"
#include "TetrahedralSplit.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkStructuredGrid.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace performance
{
namespace shell
{
namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr double Eye[3] = { 2.2, -3.0, 1.4 };
constexpr double ViewAngle = 32; // degrees

struct Wave
{
  double amplitude, alongLongitude, alongLatitude, phase, perLevel;
};
constexpr Wave Waves[] = {
  { 0.55, 3, 4, 0.3, 1.1 },
  { 0.50, 5, -7, 1.7, -2.0 },
  { 0.45, 11, 9, 4.1, 2.6 },
  { 0.40, 17, -13, 2.2, -3.1 },
  { 0.35, 26, 21, 5.5, 3.5 },
  { 0.30, 37, -31, 0.9, -2.2 },
};

double terrain(double longitude, double latitude)
{
  const double ridge = std::cos(latitude) * std::sin(3 * longitude + 0.4) *
    std::sin(4 * latitude + 0.8) * std::cos(7 * longitude - 2 * latitude);
  return 0.25 * Top * std::max(0.0, ridge) * std::max(0.0, ridge);
}

template <class F>
vtkSmartPointer<vtkFloatArray> values(vtkIdType count, F&& value)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(arrays::CloudFraction);
  array->SetNumberOfValues(count);
  for (vtkIdType p = 0; p < count; ++p)
  {
    array->SetValue(p, static_cast<float>(value(p)));
  }
  return array;
}

Place gridPlace(const Situation& s, vtkIdType point)
{
  const vtkIdType nx = s.points[0];
  const vtkIdType ny = s.points[1];
  const vtkIdType i = point % nx;
  const vtkIdType j = point / nx % ny;
  const vtkIdType k = point / (nx * ny);
  return placeOnGrid(s, static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
}

vtkIdType numberOfPoints(const Situation& s)
{
  return static_cast<vtkIdType>(s.points[0]) * s.points[1] * s.points[2];
}

vtkSmartPointer<vtkFloatArray> gridValues(const Situation& s)
{
  return values(numberOfPoints(s), [&s](vtkIdType p) { return cloudFraction(gridPlace(s, p)); });
}

/// Trilinear in grid coordinates, 0 outside.
double interpolated(const Situation& s, vtkFloatArray* grid, const Place& place)
{
  const double at[3] = { place.longitude / (2 * Pi) * s.points[0],
    (place.latitude / Pi + 0.5) * s.points[1] - 0.5, place.eta * (s.points[2] - 1) };
  vtkIdType low[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    low[axis] = static_cast<vtkIdType>(std::floor(at[axis]));
    if (low[axis] < 0 || low[axis] + 1 >= s.points[axis])
    {
      return 0;
    }
  }
  double sum = 0;
  for (int v = 0; v < 8; ++v)
  {
    double weight = 1;
    vtkIdType corner[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      const int up = v >> axis & 1;
      const double part = at[axis] - static_cast<double>(low[axis]);
      weight *= up ? part : 1 - part;
      corner[axis] = low[axis] + up;
    }
    sum += weight * grid->GetValue(corner[0] + s.points[0] * (corner[1] + s.points[1] * corner[2]));
  }
  return sum;
}

vtkSmartPointer<vtkPoints> gridPoints(const Situation& s)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(s.doublePoints ? VTK_DOUBLE : VTK_FLOAT);
  points->SetNumberOfPoints(numberOfPoints(s));
  for (vtkIdType p = 0; p < points->GetNumberOfPoints(); ++p)
  {
    points->SetPoint(p, position(gridPlace(s, p)).v);
  }
  return points;
}
}

double cloudFraction(const Place& place)
{
  double g = -1.2 * (place.eta - 0.45) * (place.eta - 0.45);
  for (const Wave& w : Waves)
  {
    g += w.amplitude *
      std::sin(w.alongLongitude * place.longitude + w.alongLatitude * place.latitude + w.phase +
        w.perLevel * place.eta);
  }
  const double t = std::clamp((g - 0.026) / 1.3, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

Vector3 position(const Place& place)
{
  const double h = terrain(place.longitude, place.latitude);
  const double r = 1 + h + (Top - h) * place.eta;
  return { r * std::cos(place.latitude) * std::cos(place.longitude),
    r * std::cos(place.latitude) * std::sin(place.longitude), r * std::sin(place.latitude) };
}

Place place(const Vector3& position)
{
  Place p{};
  p.longitude = std::atan2(position[1], position[0]);
  p.longitude += p.longitude < 0 ? 2 * Pi : 0;
  p.latitude = std::atan2(position[2], std::hypot(position[0], position[1]));
  const double h = terrain(p.longitude, p.latitude);
  p.eta = (length(position) - 1 - h) / (Top - h);
  return p;
}

Place placeOnGrid(const Situation& situation, double i, double j, double k)
{
  return { 2 * Pi * i / situation.points[0], Pi * ((j + 0.5) / situation.points[1] - 0.5),
    k / (situation.points[2] - 1) };
}

vtkSmartPointer<vtkStructuredGrid> structuredGrid(const Situation& situation)
{
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(situation.points.data());
  grid->SetPoints(gridPoints(situation));
  grid->GetPointData()->SetScalars(gridValues(situation));
  return grid;
}

vtkSmartPointer<vtkStructuredGrid> paintedGrid(const Situation& situation)
{
  auto grid = structuredGrid(situation);
  vtkNew<vtkFloatArray> source;
  source->SetName(arrays::SourceColor);
  source->SetNumberOfComponents(3);
  source->SetNumberOfTuples(grid->GetNumberOfPoints());
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    const double grey = sourceOf(grid->GetPointData()->GetScalars()->GetComponent(p, 0));
    source->SetTuple3(p, grey, grey, grey);
  }
  grid->GetPointData()->AddArray(source);
  return grid;
}

vtkSmartPointer<vtkUnstructuredGrid> tetrahedra(const Situation& situation)
{
  const vtkIdType nx = situation.points[0];
  const vtkIdType ny = situation.points[1];
  vtkNew<vtkIdTypeArray> corners;
  vtkNew<vtkIdTypeArray> offsets;
  corners->SetNumberOfValues(20 * situation.cells());
  offsets->SetNumberOfValues(5 * situation.cells() + 1);
  vtkIdType* corner = corners->GetPointer(0);
  for (vtkIdType k = 0; k + 1 < situation.points[2]; ++k)
  {
    for (vtkIdType j = 0; j + 1 < ny; ++j)
    {
      for (vtkIdType i = 0; i + 1 < nx; ++i)
      {
        for (const TetrahedronVertices& t : TetrahedralSplit[splitParity(i, j, k)])
        {
          for (const int v : t)
          {
            *corner++ = i + (v & 1) + nx * (j + (v >> 1 & 1) + ny * (k + (v >> 2)));
          }
        }
      }
    }
  }
  for (vtkIdType t = 0; t < offsets->GetNumberOfValues(); ++t)
  {
    offsets->SetValue(t, 4 * t);
  }
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, corners);
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(gridPoints(situation));
  grid->SetCells(VTK_TETRA, cells);
  grid->GetPointData()->SetScalars(gridValues(situation));
  return grid;
}

vtkSmartPointer<vtkImageData> indexImage(const Situation& situation)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(situation.points.data());
  image->GetPointData()->SetScalars(gridValues(situation));
  return image;
}

vtkSmartPointer<vtkImageData> resampledImage(const Situation& situation, int samples)
{
  const auto grid = gridValues(situation);
  const double spacing = 2 * (1 + Top) / (samples - 1);
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(samples, samples, samples);
  image->SetSpacing(spacing, spacing, spacing);
  image->SetOrigin(-1 - Top, -1 - Top, -1 - Top);
  image->GetPointData()->SetScalars(values(image->GetNumberOfPoints(),
    [&](vtkIdType p)
    {
      Vector3 x{};
      image->GetPoint(p, x.v);
      const double r = length(x);
      return r < 1 || r > 1 + Top ? 0.0 : interpolated(situation, grid, place(x));
    }));
  return image;
}

vtkSmartPointer<vtkCamera> vtkView()
{
  auto camera = vtkSmartPointer<vtkCamera>::New();
  camera->SetPosition(Eye[0], Eye[1], Eye[2]);
  camera->SetFocalPoint(0, 0, 0);
  camera->SetViewUp(0, 0, 1);
  camera->SetViewAngle(ViewAngle);
  camera->SetClippingRange(1, 8);
  return camera;
}

Camera view(const Situation& situation)
{
  return Camera::perspective({ Eye[0], Eye[1], Eye[2] }, { 0, 0, 0 }, { 0, 0, 1 }, ViewAngle,
    situation.pixels[0], situation.pixels[1]);
}
}
}
}
