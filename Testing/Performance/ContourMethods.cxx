// SPDX-License-Identifier: BSD-3-Clause
// Contours of the shell at 15 % cloud fraction. Figures: triangles, points, area (in the units of the points), error (root mean
// square over the surface of the true cloud fraction minus 0.15).
#include "ShellCase.h"

#include "vtkCellArray.h"
#include "vtkCloudContour.h"
#include "vtkContour3DLinearGrid.h"
#include "vtkContourFilter.h"
#include "vtkFlyingEdges3D.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStructuredGrid.h"
#include "vtkUnstructuredGrid.h"

#include <cmath>

namespace nephoscope
{
namespace performance
{
namespace
{
/// How a method's points are turned into places: by the globe, or by the index image.
using PlaceOf = std::function<shell::Place(const Vector3&)>;

struct Triangle
{
  Vector3 corner[3];
  double area() const
  {
    return 0.5 *
      length(cross(this->corner[1] - this->corner[0], this->corner[2] - this->corner[0]));
  }
};

template <class F>
void forEachTriangle(vtkPolyData* surface, F&& f)
{
  vtkNew<vtkIdList> ids;
  vtkCellArray* const polys = surface->GetPolys();
  for (vtkIdType t = 0; t < polys->GetNumberOfCells(); ++t)
  {
    polys->GetCellAtId(t, ids);
    Triangle triangle{};
    for (int c = 0; c < 3; ++c)
    {
      surface->GetPoint(ids->GetId(c), triangle.corner[c].v);
    }
    f(triangle);
  }
}

/// Squared error of cloud fraction, mean of a triangle's corners and middle.
double squaredError(const Triangle& triangle, const PlaceOf& placeOf)
{
  const Vector3* const x = triangle.corner;
  double sum = 0;
  for (const Vector3& at : { x[0], x[1], x[2], (1.0 / 3) * (x[0] + x[1] + x[2]) })
  {
    const double d = shell::cloudFraction(placeOf(at)) - shell::ContourValue;
    sum += d * d / 4;
  }
  return sum;
}

Figures surfaceFigures(vtkPolyData* surface, const PlaceOf& placeOf)
{
  double area = 0;
  double weighted = 0;
  forEachTriangle(surface,
    [&](const Triangle& triangle)
    {
      area += triangle.area();
      weighted += triangle.area() * squaredError(triangle, placeOf);
    });
  return { { "triangles", static_cast<double>(surface->GetNumberOfPolys()) },
    { "points", static_cast<double>(surface->GetNumberOfPoints()) }, { "area", area },
    { "error", area > 0 ? std::sqrt(weighted / area) : 0 } };
}

/// Any contour filter: its data and its switches are set up by a function.
template <class Filter>
class ContourJob : public Job
{
public:
  ContourJob(vtkDataObject* data, PlaceOf placeOf, const std::function<void(Filter*)>& setUp)
    : InPlace(std::move(placeOf))
  {
    this->Contour->SetInputDataObject(data);
    this->Contour->SetValue(0, shell::ContourValue);
    setUp(this->Contour);
  }
  void run() override
  {
    this->Contour->Modified();
    this->Contour->Update();
  }
  Figures figures() override
  {
    return surfaceFigures(
      vtkPolyData::SafeDownCast(this->Contour->GetOutputDataObject(0)), this->InPlace);
  }

private:
  vtkNew<Filter> Contour;
  PlaceOf InPlace;
};

std::unique_ptr<Job> linearGrid(const Situation& situation, bool merge, bool normals)
{
  return std::make_unique<ContourJob<vtkContour3DLinearGrid>>(shell::tetrahedra(situation),
    shell::place,
    [=](vtkContour3DLinearGrid* filter)
    {
      filter->SetMergePoints(merge);
      filter->SetComputeNormals(normals);
      filter->SetInterpolateAttributes(false);
    });
}

std::unique_ptr<Job> cloudContour(const Situation& situation, bool normals)
{
  return std::make_unique<ContourJob<vtkCloudContour>>(shell::structuredGrid(situation),
    shell::place, [normals](vtkCloudContour* filter) { filter->SetComputeNormals(normals); });
}

const Registration ourContour(
  { "vtkCloudContour", "contour", { { "points", "merged" }, { "normals", "yes" } }, true, false, 0,
    [](const Situation& s) { return cloudContour(s, true); } });

const Registration ourContourWithoutNormals(
  { "vtkCloudContour", "contour", { { "points", "merged" }, { "normals", "no" } }, true, false, 0,
    [](const Situation& s) { return cloudContour(s, false); } });

const Registration linearGridMerged(
  { "vtkContour3DLinearGrid", "contour", { { "points", "merged" }, { "normals", "yes" } }, false,
    false, 0, [](const Situation& s) { return linearGrid(s, true, true); } });

const Registration linearGridMergedOnly(
  { "vtkContour3DLinearGrid", "contour", { { "points", "merged" }, { "normals", "no" } }, false,
    false, 0, [](const Situation& s) { return linearGrid(s, true, false); } });

const Registration linearGridSoup(
  { "vtkContour3DLinearGrid", "contour", { { "points", "soup" }, { "normals", "no" } }, false,
    false, 0, [](const Situation& s) { return linearGrid(s, false, false); } });

const Registration synchronizedTemplates({ "vtkContourFilter", "contour",
  { { "grid", "structured" }, { "normals", "no" } }, false, false, 0,
  [](const Situation& s)
  {
    return std::make_unique<ContourJob<vtkContourFilter>>(shell::structuredGrid(s), shell::place,
      [](vtkContourFilter* filter)
      {
        filter->ComputeNormalsOff();
        filter->ComputeScalarsOff();
      });
  } });

const Registration flyingEdges(
  { "vtkFlyingEdges3D", "contour", { { "grid", "image" }, { "normals", "yes" } }, false, false, 0,
    [](const Situation& s)
    {
      return std::make_unique<ContourJob<vtkFlyingEdges3D>>(
        shell::indexImage(s),
        [s](const Vector3& x) { return shell::placeOnGrid(s, x[0], x[1], x[2]); },
        [](vtkFlyingEdges3D* filter)
        {
          filter->ComputeNormalsOn();
          filter->ComputeScalarsOff();
        });
    } });
}
}
}
