// SPDX-License-Identifier: BSD-3-Clause
#ifndef ContourTesting_h
#define ContourTesting_h

// Grids to contour, and what can be asked of a surface.
#include "CloudArrays.h"
#include "ErrorText.h"
#include "TetrahedralSplit.h"
#include "vtkCloudContour.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkSMPTools.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <set>

using Vector = std::array<double, 3>;
using Function = std::function<double(const Vector&)>;

constexpr double Pi = 3.14159265358979323846;

inline Vector operator-(const Vector& a, const Vector& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}
inline double dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

inline Vector pointOf(vtkDataSet* data, vtkIdType id)
{
  Vector x;
  data->GetPoint(id, x.data());
  return x;
}

/// A structured grid of given extent whose points map (i, j, k) to space; double points.
inline vtkSmartPointer<vtkStructuredGrid> structuredGrid(
  const std::array<int, 3>& n, const std::function<Vector(const Vector&)>& map, int offset = 0)
{
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetExtent(offset, offset + n[0] - 1, 0, n[1] - 1, 0, n[2] - 1);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int k = 0; k < n[2]; ++k)
  {
    for (int j = 0; j < n[1]; ++j)
    {
      for (int i = 0; i < n[0]; ++i)
      {
        points->InsertNextPoint(map({ double(i), double(j), double(k) }).data());
      }
    }
  }
  grid->SetPoints(points);
  return grid;
}

inline void addField(vtkDataSet* data, const Function& f)
{
  vtkNew<vtkFloatArray> field;
  field->SetName(nephoscope::arrays::CloudFraction);
  for (vtkIdType id = 0; id < data->GetNumberOfPoints(); ++id)
  {
    field->InsertNextValue(float(f(pointOf(data, id))));
  }
  data->GetPointData()->AddArray(field);
}

/// Values from {0, 1, 2, 3} / 10 so that many equal the contour value 0.2; the outermost points are 0 if closed.
inline vtkSmartPointer<vtkImageData> randomImage(
  const std::array<int, 3>& n, bool closed, unsigned seed)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(n[0], n[1], n[2]);
  std::mt19937 random(seed);
  addField(image,
    [&](const Vector& x)
    {
      bool outermost = false;
      for (int c = 0; c < 3; ++c)
      {
        outermost = outermost || x[c] == 0 || x[c] == n[c] - 1;
      }
      const double value = (random() % 4) / 10.0;
      return closed && outermost ? 0.0 : value;
    });
  return image;
}

inline vtkSmartPointer<vtkPolyData> contourOf(vtkDataSet* data, double value)
{
  vtkNew<vtkCloudContour> contour;
  contour->SetInputData(data);
  contour->SetValue(0, value);
  contour->Update();
  return contour->GetOutput();
}

/// Directed edges of all triangles with how often they occur.
inline std::map<std::pair<vtkIdType, vtkIdType>, int> directedEdges(vtkPolyData* surface)
{
  std::map<std::pair<vtkIdType, vtkIdType>, int> edges;
  vtkNew<vtkIdList> ids;
  for (vtkIdType t = 0; t < surface->GetNumberOfCells(); ++t)
  {
    surface->GetCellPoints(t, ids);
    EXPECT_EQ(ids->GetNumberOfIds(), 3);
    for (int c = 0; c < 3; ++c)
    {
      ++edges[{ ids->GetId(c), ids->GetId((c + 1) % 3) }];
    }
  }
  return edges;
}

/// Each edge once in each direction: shared by exactly two triangles that wind alike. Returns the edges that are not.
inline std::vector<std::pair<vtkIdType, vtkIdType>> openEdges(vtkPolyData* surface)
{
  std::vector<std::pair<vtkIdType, vtkIdType>> open;
  const auto edges = directedEdges(surface);
  for (const auto& [edge, count] : edges)
  {
    EXPECT_EQ(count, 1);
    EXPECT_NE(edge.first, edge.second);
    if (edges.count({ edge.second, edge.first }) == 0)
    {
      open.push_back(edge);
    }
  }
  return open;
}

inline double areaOf(vtkPolyData* surface)
{
  double area = 0;
  vtkNew<vtkIdList> ids;
  for (vtkIdType t = 0; t < surface->GetNumberOfCells(); ++t)
  {
    surface->GetCellPoints(t, ids);
    const Vector a = pointOf(surface, ids->GetId(0));
    const Vector n =
      cross(pointOf(surface, ids->GetId(1)) - a, pointOf(surface, ids->GetId(2)) - a);
    area += std::sqrt(dot(n, n)) / 2;
  }
  return area;
}

/// The same field on the tetrahedra of the structured grid or image.
template <class Grid>
vtkSmartPointer<vtkUnstructuredGrid> tetrahedraOf(Grid* image, int precision = VTK_FLOAT)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(precision);
  for (vtkIdType id = 0; id < image->GetNumberOfPoints(); ++id)
  {
    points->InsertNextPoint(image->GetPoint(id));
  }
  grid->SetPoints(points);
  grid->GetPointData()->ShallowCopy(image->GetPointData());
  const int* n = image->GetDimensions();
  for (int k = 0; k + 1 < n[2]; ++k)
  {
    for (int j = 0; j + 1 < n[1]; ++j)
    {
      for (int i = 0; i + 1 < n[0]; ++i)
      {
        for (const auto& t : nephoscope::TetrahedralSplit[nephoscope::splitParity(i, j, k)])
        {
          vtkIdType ids[4];
          for (int c = 0; c < 4; ++c)
          {
            ids[c] =
              i + (t[c] & 1) + n[0] * (j + (t[c] >> 1 & 1) + vtkIdType(n[1]) * (k + (t[c] >> 2)));
          }
          grid->InsertNextCell(VTK_TETRA, 4, ids);
        }
      }
    }
  }
  return grid;
}

/// A globe: i round it, the last column on the first, j from south to north without the poles, k upwards.
inline vtkSmartPointer<vtkStructuredGrid> globe(const std::array<int, 3>& n)
{
  return structuredGrid(n,
    [n](const Vector& p) -> Vector
    {
      const double lon = 2 * Pi * (int(p[0]) % (n[0] - 1)) / (n[0] - 1);
      const double lat = 1.3 * (2 * p[1] / (n[1] - 1) - 1);
      const double r = 1 + 0.5 * p[2] / (n[2] - 1);
      return { r * std::cos(lat) * std::cos(lon), r * std::cos(lat) * std::sin(lon),
        r * std::sin(lat) };
    });
}

inline void expectSame(vtkPolyData* a, vtkPolyData* b)
{
  ASSERT_EQ(a->GetNumberOfPoints(), b->GetNumberOfPoints());
  ASSERT_EQ(a->GetNumberOfCells(), b->GetNumberOfCells());
  for (vtkIdType p = 0; p < a->GetNumberOfPoints(); ++p)
  {
    EXPECT_EQ(pointOf(a, p), pointOf(b, p));
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_EQ(a->GetPointData()->GetNormals()->GetComponent(p, c),
        b->GetPointData()->GetNormals()->GetComponent(p, c));
    }
  }
  EXPECT_EQ(directedEdges(a), directedEdges(b));
}
#endif
