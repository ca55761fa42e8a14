// SPDX-License-Identifier: BSD-3-Clause
// Where contouring is known to fail. The naive result is that of VTK's filters.
#include "TestPicture.h"

#include "CloudArrays.h"
#include "TetrahedralSplit.h"
#include "vtkCellArray.h"
#include "vtkCloudContour.h"
#include "vtkContour3DLinearGrid.h"
#include "vtkContourFilter.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStructuredGrid.h"
#include "vtkUnstructuredGrid.h"

#include <cmath>
#include <limits>
#include <map>
#include <random>

namespace nephoscope
{
namespace stability
{
namespace
{
constexpr double Value = 0.25;

vtkSmartPointer<vtkUnstructuredGrid> tetrahedraOf(vtkStructuredGrid* grid)
{
  int n[3];
  grid->GetDimensions(n);
  auto tetrahedra = vtkSmartPointer<vtkUnstructuredGrid>::New();
  tetrahedra->SetPoints(grid->GetPoints());
  tetrahedra->GetPointData()->ShallowCopy(grid->GetPointData());
  tetrahedra->Allocate();
  for (int k = 0; k + 1 < n[2]; ++k)
  {
    for (int j = 0; j + 1 < n[1]; ++j)
    {
      for (int i = 0; i + 1 < n[0]; ++i)
      {
        for (const TetrahedronVertices& t : TetrahedralSplit[splitParity(i, j, k)])
        {
          vtkIdType ids[4];
          for (int c = 0; c < 4; ++c)
          {
            ids[c] = i + (t[c] & 1) +
              static_cast<vtkIdType>(n[0]) * (j + (t[c] >> 1 & 1) + n[1] * (k + (t[c] >> 2)));
          }
          tetrahedra->InsertNextCell(VTK_TETRA, 4, ids);
        }
      }
    }
  }
  return tetrahedra;
}

vtkSmartPointer<vtkPolyData> ours(vtkStructuredGrid* grid)
{
  vtkNew<vtkCloudContour> contour;
  contour->SetInputData(grid);
  contour->SetValue(0, Value);
  contour->Update();
  return contour->GetOutput();
}

vtkSmartPointer<vtkPolyData> linearGrid(vtkStructuredGrid* grid)
{
  vtkNew<vtkContour3DLinearGrid> contour;
  contour->SetInputData(tetrahedraOf(grid));
  contour->SetValue(0, Value);
  contour->SetMergePoints(true);
  contour->SetComputeNormals(true);
  contour->Update();
  return vtkPolyData::SafeDownCast(contour->GetOutputDataObject(0));
}

vtkSmartPointer<vtkPolyData> templates(vtkStructuredGrid* grid)
{
  vtkNew<vtkContourFilter> contour;
  contour->SetInputData(grid);
  contour->SetValue(0, Value);
  contour->ComputeNormalsOn();
  contour->Update();
  return contour->GetOutput();
}

template <class F>
void forEachTriangle(vtkPolyData* surface, F&& f)
{
  vtkNew<vtkIdList> ids;
  for (vtkIdType t = 0; t < surface->GetPolys()->GetNumberOfCells(); ++t)
  {
    surface->GetPolys()->GetCellAtId(t, ids);
    f(ids->GetId(0), ids->GetId(1), ids->GetId(2));
  }
}

/// Edges that are not shared by exactly two triangles.
int openEdges(vtkPolyData* surface)
{
  std::map<std::pair<vtkIdType, vtkIdType>, int> uses;
  forEachTriangle(surface,
    [&uses](vtkIdType a, vtkIdType b, vtkIdType c)
    {
      ++uses[std::minmax(a, b)];
      ++uses[std::minmax(b, c)];
      ++uses[std::minmax(c, a)];
    });
  int open = 0;
  for (const auto& use : uses)
  {
    open += use.second == 2 ? 0 : 1;
  }
  return open;
}

int notFinite(vtkDataArray* array)
{
  int count = 0;
  for (vtkIdType t = 0; array && t < array->GetNumberOfTuples(); ++t)
  {
    double sum = 0;
    for (int c = 0; c < array->GetNumberOfComponents(); ++c)
    {
      sum += array->GetComponent(t, c);
    }
    count += std::isfinite(sum) ? 0 : 1;
  }
  return count;
}

int pointsNotFinite(vtkPolyData* surface)
{
  return surface->GetNumberOfPoints() > 0 ? notFinite(surface->GetPoints()->GetData()) : 0;
}

Vector3 pointOf(vtkPolyData* surface, vtkIdType id)
{
  Vector3 x{};
  surface->GetPoint(id, x.v);
  return x;
}

bool onRim(const std::array<int, 3>& n, int i, int j, int k)
{
  return i == 0 || j == 0 || k == 0 || i == n[0] - 1 || j == n[1] - 1 || k == n[2] - 1;
}

Vector3 box(double a, double b, double c)
{
  return { 3 * a, 2 * b, c };
}

/// Random values of `choices`, 0 at the rim so that every surface is closed.
vtkSmartPointer<vtkStructuredGrid> closedRandom(const std::vector<double>& choices)
{
  const std::array<int, 3> n{ 14, 11, 9 };
  std::mt19937 random(5);
  return makeGrid(n, box,
    [&](int i, int j, int k)
    { return onRim(n, i, j, k) ? 0 : choices[random() % choices.size()]; });
}

const StabilityRegistration equal({ "contour", "values equal to the contour value",
  "closed: no edge that two triangles do not share",
  []
  {
    const auto grid = closedRandom({ 0, Value, Value, 1 });
    const int open = openEdges(ours(grid));
    return Outcome{ std::to_string(openEdges(templates(grid))) + " open edges",
      std::to_string(open) + " open edges", open == 0 };
  } });

const StabilityRegistration saddles({ "contour", "random fields: every case and every saddle",
  "closed: no edge that two triangles do not share",
  []
  {
    const auto grid = closedRandom({ 0, 0.1, 0.2, 0.3, 0.7, 1 });
    const int open = openEdges(ours(grid));
    return Outcome{ std::to_string(openEdges(templates(grid))) + " open edges",
      std::to_string(open) + " open edges", open == 0 };
  } });

const StabilityRegistration strange({ "contour", "values NaN and infinite",
  "no point that is not finite; cells at such values are left out",
  []
  {
    const auto grid = closedRandom({ 0, 1, 0.6, 0.1, std::numeric_limits<double>::quiet_NaN(),
      std::numeric_limits<double>::infinity() });
    const auto surface = ours(grid);
    const int bad = pointsNotFinite(surface);
    return Outcome{ std::to_string(pointsNotFinite(linearGrid(grid))) + " points not finite",
      std::to_string(bad) + " points not finite", bad == 0 && surface->GetNumberOfPolys() > 0 };
  } });

/// Normals that are not unit vectors, NaN among them.
int notUnit(vtkPolyData* surface)
{
  vtkDataArray* const normals = surface->GetPointData()->GetNormals();
  int bad = 0;
  for (vtkIdType p = 0; normals && p < normals->GetNumberOfTuples(); ++p)
  {
    Vector3 n{};
    normals->GetTuple(p, n.v);
    bad += std::abs(length(n) - 1) < 1e-4 ? 0 : 1;
  }
  return bad;
}

/// Density falling from the middle of the box.
double hill(int i, int j, int k)
{
  return 1.2 - 0.03 * ((i - 7) * (i - 7) + (j - 5) * (j - 5) + 2 * (k - 4) * (k - 4));
}

const StabilityRegistration flat(
  { "contour", "cells without volume: two levels in one place", "every normal of length 1",
    []
    {
      const auto grid = makeGrid(
        { 15, 11, 9 },
        [](double a, double b, double c) { return box(a, b, c > 0.4 && c < 0.7 ? 0.5 : c); }, hill);
      const auto surface = ours(grid);
      const int bad = notUnit(surface);
      return Outcome{ std::to_string(notUnit(templates(grid))) + " normals not of length 1",
        std::to_string(bad) + " normals not of length 1",
        bad == 0 && surface->GetNumberOfPolys() > 0 };
    } });

/// Triangles with area whose winding points to the hill's middle, to higher values.
int turnedInward(vtkPolyData* surface)
{
  int count = 0;
  const Vector3 middle = box(0.5, 0.5, 0.5);
  forEachTriangle(surface,
    [&](vtkIdType a, vtkIdType b, vtkIdType c)
    {
      const Vector3 x = pointOf(surface, a);
      const Vector3 normal = cross(pointOf(surface, b) - x, pointOf(surface, c) - x);
      count += dot(normal, x - middle) < 0 ? 1 : 0;
    });
  return count;
}

const StabilityRegistration inverted({ "contour", "a left-handed grid: every cell inverted",
  "every triangle wound to be seen from outside",
  []
  {
    const auto grid = makeGrid(
      { 15, 11, 9 }, [](double a, double b, double c) { return box(1 - a, b, c); }, hill);
    const auto surface = ours(grid);
    const int bad = turnedInward(surface);
    return Outcome{ std::to_string(turnedInward(linearGrid(grid))) + " triangles inside out",
      std::to_string(bad) + " triangles inside out", bad == 0 && surface->GetNumberOfPolys() > 0 };
  } });

const StabilityRegistration seam(
  { "contour", "a globe's seam, closed in place only", "no open edge at the seam",
    []
    {
      constexpr double Pi = 3.14159265358979323846;
      const auto grid = makeGrid(
        { 25, 11, 5 },
        [](double a, double b, double c)
        {
          const double longitude = 2 * Pi * a;
          const double latitude = 2.6 * (b - 0.5);
          const double r = 1 + 0.2 * c;
          return Vector3{ r * std::cos(latitude) * std::cos(longitude),
            r * std::cos(latitude) * std::sin(longitude), r * std::sin(latitude) };
        },
        [](int i, int j, int k)
        {
          return j == 0 || j == 10 || k == 0 || k == 4
            ? 0
            : 0.5 + 0.5 * std::cos(4 * Pi * (i % 24) / 24) * std::cos(0.4 * (j - 5));
        });
      const int open = openEdges(ours(grid));
      return Outcome{ std::to_string(openEdges(linearGrid(grid))) + " open edges",
        std::to_string(open) + " open edges", open == 0 };
    } });

const StabilityRegistration metres({ "contour", "metres of the Earth in float: layers 150 m thick",
  "heights of a contour at constant height within 1 m (a float's step is 0.5 m)",
  []
  {
    constexpr double Radius = 6371000;
    const auto grid = makeGrid(
      { 12, 9, 21 },
      [](double a, double b, double c)
      {
        const double longitude = 0.4 + 0.02 * a;
        const double latitude = 0.7 + 0.015 * b;
        const double r = Radius + 3000 * c;
        return Vector3{ r * std::cos(latitude) * std::cos(longitude),
          r * std::cos(latitude) * std::sin(longitude), r * std::sin(latitude) };
      },
      [](int, int, int k) { return k / 20.0; }, true);
    const auto largest = [](vtkPolyData* surface)
    {
      double error = surface->GetNumberOfPoints() > 0 ? 0 : 1e9;
      for (vtkIdType p = 0; p < surface->GetNumberOfPoints(); ++p)
      {
        error = std::max(error, std::abs(length(pointOf(surface, p)) - Radius - 3000 * Value));
      }
      return error;
    };
    const double error = largest(ours(grid));
    return Outcome{ figure("error", largest(templates(grid))) + " m", figure("error", error) + " m",
      error < 1 };
  } });
}
}
}
