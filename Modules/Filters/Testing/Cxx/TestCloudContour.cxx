// SPDX-License-Identifier: BSD-3-Clause
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

namespace
{
constexpr double Pi = 3.14159265358979323846;

Vector operator-(const Vector& a, const Vector& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}
double dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

Vector pointOf(vtkDataSet* data, vtkIdType id)
{
  Vector x;
  data->GetPoint(id, x.data());
  return x;
}

/// A structured grid of given extent whose points map (i, j, k) to space; double points.
vtkSmartPointer<vtkStructuredGrid> structuredGrid(
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

void addField(vtkDataSet* data, const Function& f)
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
vtkSmartPointer<vtkImageData> randomImage(const std::array<int, 3>& n, bool closed, unsigned seed)
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

vtkSmartPointer<vtkPolyData> contourOf(vtkDataSet* data, double value)
{
  vtkNew<vtkCloudContour> contour;
  contour->SetInputData(data);
  contour->SetValue(0, value);
  contour->Update();
  return contour->GetOutput();
}

/// Directed edges of all triangles with how often they occur.
std::map<std::pair<vtkIdType, vtkIdType>, int> directedEdges(vtkPolyData* surface)
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
std::vector<std::pair<vtkIdType, vtkIdType>> openEdges(vtkPolyData* surface)
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

double areaOf(vtkPolyData* surface)
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

/// The same field on the tetrahedra of the structured grid.
vtkSmartPointer<vtkUnstructuredGrid> tetrahedraOf(vtkImageData* image)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
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
vtkSmartPointer<vtkStructuredGrid> globe(const std::array<int, 3>& n)
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

void expectSame(vtkPolyData* a, vtkPolyData* b)
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
}

TEST(CloudContour, ClosedRandomSurfacesAreWatertight)
{
  // Rows shorter and longer than a machine word; a quarter of the values equal the contour value.
  for (const std::array<int, 3>& n :
    { std::array<int, 3>{ 9, 8, 7 }, { 64, 5, 4 }, { 65, 6, 5 }, { 131, 4, 6 } })
  {
    for (double value : { 0.1, 0.15, 0.2, 0.25 })
    {
      auto surface = contourOf(randomImage(n, true, 5), float(value));
      EXPECT_GT(surface->GetNumberOfCells(), 100);
      EXPECT_TRUE(openEdges(surface).empty()) << n[0] << ' ' << value;
    }
  }
}

TEST(CloudContour, SurfacesEndOnlyAtTheBoundary)
{
  const std::array<int, 3> n = { 70, 6, 5 };
  auto surface = contourOf(randomImage(n, false, 6), 0.2F);
  const auto open = openEdges(surface);
  EXPECT_GT(open.size(), 100U);
  for (const auto& [a, b] : open)
  {
    const Vector x = pointOf(surface, a);
    const Vector y = pointOf(surface, b);
    bool boundary = false;
    for (int c = 0; c < 3; ++c)
    {
      boundary = boundary || (x[c] == 0 && y[c] == 0) || (x[c] == n[c] - 1 && y[c] == n[c] - 1);
    }
    EXPECT_TRUE(boundary);
  }
}

TEST(CloudContour, CellsWithoutValueAreLeftOutAndNothingElse)
{
  // NaN and infinite values, blanked points, blanked and duplicate cells, near the ends of machine words too.
  const std::array<int, 3> n = { 70, 9, 8 };
  auto image = randomImage(n, true, 7);
  auto* field = vtkFloatArray::SafeDownCast(image->GetPointData()->GetArray(0));
  std::set<std::array<int, 3>> leftOut;
  std::mt19937 random(8);
  const auto leaveOutAround = [&](int i, int j, int k)
  {
    for (int v = 0; v < 8; ++v)
    {
      leftOut.insert({ i - (v & 1), j - (v >> 1 & 1), k - (v >> 2) });
    }
  };
  image->AllocatePointGhostArray();
  image->AllocateCellGhostArray();
  for (int m = 0; m < 24; ++m)
  {
    const int i = m < 4 ? 62 + m : int(random() % n[0]);
    const int j = int(random() % n[1]);
    const int k = int(random() % n[2]);
    const vtkIdType point = i + n[0] * (j + n[1] * k);
    const vtkIdType cell = i + (n[0] - 1) * (j + (n[1] - 1) * k);
    if (m % 4 == 0)
    {
      field->SetValue(point, m % 8 == 0 ? NAN : INFINITY);
      leaveOutAround(i, j, k);
    }
    else if (m % 4 == 1)
    {
      image->GetPointGhostArray()->SetValue(point, vtkDataSetAttributes::HIDDENPOINT);
      leaveOutAround(i, j, k);
    }
    else if (i < n[0] - 1 && j < n[1] - 1 && k < n[2] - 1)
    {
      image->GetCellGhostArray()->SetValue(
        cell, m % 4 == 2 ? vtkDataSetAttributes::HIDDENCELL : vtkDataSetAttributes::DUPLICATECELL);
      leftOut.insert({ i, j, k });
    }
  }
  auto surface = contourOf(image, 0.2F);

  // Each triangle lies in a cell that counts.
  vtkNew<vtkIdList> ids;
  double area = 0;
  for (vtkIdType t = 0; t < surface->GetNumberOfCells(); ++t)
  {
    surface->GetCellPoints(t, ids);
    Vector centre = { 0, 0, 0 };
    for (int c = 0; c < 9; ++c)
    {
      const Vector x = pointOf(surface, ids->GetId(c / 3));
      EXPECT_TRUE(std::isfinite(x[c % 3]));
      centre[c % 3] += x[c % 3] / 3;
    }
    const std::array<int, 3> cell = { int(centre[0]), int(centre[1]), int(centre[2]) };
    const bool inside = centre[0] != cell[0] && centre[1] != cell[1] && centre[2] != cell[2];
    EXPECT_TRUE(!inside || leftOut.count(cell) == 0);
  }
  area = areaOf(surface);
  EXPECT_GT(area, 0);
  // Each open edge lies on a cell that is left out.
  for (const auto& [a, b] : openEdges(surface))
  {
    const Vector x = pointOf(surface, a);
    const Vector y = pointOf(surface, b);
    bool touches = false;
    for (const auto& cell : leftOut)
    {
      bool on = true;
      for (int c = 0; c < 3; ++c)
      {
        on = on && std::min(x[c], y[c]) >= cell[c] && std::max(x[c], y[c]) <= cell[c] + 1;
      }
      touches = touches || on;
    }
    EXPECT_TRUE(touches);
  }
  // Every vertex is used: none belongs to an edge of left-out cells only.
  std::set<vtkIdType> used;
  for (const auto& [edge, count] : directedEdges(surface))
  {
    used.insert(edge.first);
  }
  EXPECT_EQ(vtkIdType(used.size()), surface->GetNumberOfPoints());
}

TEST(CloudContour, TetrahedraGiveTheSameSurface)
{
  auto image = randomImage({ 12, 9, 7 }, true, 9);
  image->GetPointData()->GetArray(0)->SetComponent(500, 0, NAN);
  for (double value : { 0.05, 0.2, 0.27 })
  {
    auto lattice = contourOf(image, float(value));
    auto tetrahedra = tetrahedraOf(image);
    // A NaN takes out the hexahedron there, but only the tetrahedra that touch it here; so without.
    tetrahedra->GetPointData()->GetArray(0)->SetComponent(500, 0, 0);
    image->GetPointData()->GetArray(0)->SetComponent(500, 0, 0);
    lattice = contourOf(image, float(value));
    auto unstructured = contourOf(tetrahedra, float(value));
    EXPECT_EQ(lattice->GetNumberOfPoints(), unstructured->GetNumberOfPoints());
    EXPECT_EQ(lattice->GetNumberOfCells(), unstructured->GetNumberOfCells());
    EXPECT_NEAR(areaOf(lattice), areaOf(unstructured), 1e-9 * areaOf(lattice));
    EXPECT_TRUE(openEdges(unstructured).empty());
  }
}

TEST(CloudContour, SphereHasItsAreaToSecondOrder)
{
  double errors[2];
  for (int level = 0; level < 2; ++level)
  {
    const int m = 16 << level;
    vtkNew<vtkImageData> image;
    image->SetDimensions(m + 1, m + 2, m + 3);
    image->SetOrigin(-1, -1, -1);
    image->SetSpacing(2.0 / m, 2.0 / m, 2.0 / m);
    addField(image, [](const Vector& x) { return 1 - std::sqrt(dot(x, x)); });
    errors[level] = std::abs(areaOf(contourOf(image, 0.4F)) - 4 * Pi * 0.36);
  }
  EXPECT_GT(errors[0] / errors[1], 3.4);
  EXPECT_LT(errors[1], 0.02);
}

TEST(CloudContour, NormalsConvergeToTheGradientOnACurvedGridAndAgreeWithWinding)
{
  // A smooth, non-orthogonal, stretched map, once right-handed and once left-handed.
  const Function f = [](const Vector& x)
  { return 1 - (x[0] * x[0] + 2 * x[1] * x[1] + 3 * x[2] * x[2]); };
  for (int hand : { 1, -1 })
  {
    double worst[2] = { 0, 0 };
    for (int level = 0; level < 2; ++level)
    {
      const int m = 20 << level;
      auto grid = structuredGrid({ m + 1, m + 3, m - 1 },
        [m, hand](const Vector& p) -> Vector
        {
          const double u = 2 * p[0] / m - 1;
          const double v = 2 * p[1] / (m + 2) - 1;
          const double w = 2 * p[2] / (m - 2) - 1;
          return { u + 0.1 * std::sin(2 * v + w), v + 0.15 * u * u,
            hand * (w + 0.3 * w * w * w + 0.1 * u) };
        });
      addField(grid, f);
      auto surface = contourOf(grid, 0.5F);
      ASSERT_GT(surface->GetNumberOfCells(), 500);
      for (vtkIdType p = 0; p < surface->GetNumberOfPoints(); ++p)
      {
        const Vector x = pointOf(surface, p);
        const Vector g = { x[0], 2 * x[1], 3 * x[2] };
        Vector normal;
        surface->GetPointData()->GetNormals()->GetTuple(p, normal.data());
        EXPECT_NEAR(dot(normal, normal), 1, 1e-6);
        const double cosine = dot(normal, g) / std::sqrt(dot(g, g));
        worst[level] = std::max(worst[level], std::acos(std::min(cosine, 1.0)));
      }
      vtkNew<vtkIdList> ids;
      for (vtkIdType t = 0; t < surface->GetNumberOfCells(); ++t)
      {
        surface->GetCellPoints(t, ids);
        const Vector a = pointOf(surface, ids->GetId(0));
        const Vector face =
          cross(pointOf(surface, ids->GetId(1)) - a, pointOf(surface, ids->GetId(2)) - a);
        Vector normal;
        surface->GetPointData()->GetNormals()->GetTuple(ids->GetId(0), normal.data());
        EXPECT_GE(dot(face, normal), -1e-9 * std::sqrt(dot(face, face)));
      }
    }
    EXPECT_LT(worst[1], 0.02); // rad
    EXPECT_GT(worst[0] / worst[1], 3);
  }
}

TEST(CloudContour, NormalsOfTetrahedraPointOutOfTheCloud)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(19, 20, 21);
  image->SetOrigin(-9, -9, -9);
  addField(image, [](const Vector& x) { return 1 - std::sqrt(dot(x, x)) / 10; });
  auto surface = contourOf(tetrahedraOf(image), 0.4F);
  ASSERT_GT(surface->GetNumberOfPoints(), 500);
  for (vtkIdType p = 0; p < surface->GetNumberOfPoints(); ++p)
  {
    const Vector x = pointOf(surface, p);
    Vector normal;
    surface->GetPointData()->GetNormals()->GetTuple(p, normal.data());
    EXPECT_GT(dot(normal, x) / std::sqrt(dot(x, x)), 0.97);
  }
}

TEST(CloudContour, AllKindsOfGridAgree)
{
  auto image = randomImage({ 11, 7, 6 }, false, 10);
  image->SetSpacing(0.5, 0.25, 2);
  image->SetOrigin(3, -1, 0);
  vtkNew<vtkRectilinearGrid> rectilinear;
  rectilinear->SetDimensions(11, 7, 6);
  vtkNew<vtkDoubleArray> axes[3];
  for (int c = 0; c < 3; ++c)
  {
    for (int i = 0; i < image->GetDimensions()[c]; ++i)
    {
      axes[c]->InsertNextValue(image->GetOrigin()[c] + i * image->GetSpacing()[c]);
    }
  }
  rectilinear->SetXCoordinates(axes[0]);
  rectilinear->SetYCoordinates(axes[1]);
  rectilinear->SetZCoordinates(axes[2]);
  rectilinear->GetPointData()->ShallowCopy(image->GetPointData());
  vtkNew<vtkStructuredGrid> structured;
  structured->SetDimensions(11, 7, 6);
  vtkNew<vtkPoints> points; // float, and these coordinates are exact in it
  for (vtkIdType id = 0; id < image->GetNumberOfPoints(); ++id)
  {
    points->InsertNextPoint(image->GetPoint(id));
  }
  structured->SetPoints(points);
  structured->GetPointData()->ShallowCopy(image->GetPointData());
  auto expected = contourOf(image, 0.15F);
  EXPECT_GT(expected->GetNumberOfCells(), 100);
  expectSame(expected, contourOf(rectilinear, 0.15F));
  expectSame(expected, contourOf(structured, 0.15F));
}

TEST(CloudContour, ExtentsThatAreOffsetKeepTheSplitOfTheWholeGrid)
{
  // A piece that starts at an odd index yields the triangles that the whole has there.
  const auto map = [](const Vector& p) { return p; };
  auto whole = structuredGrid({ 12, 7, 6 }, map);
  const Function f = [](const Vector& x) { return std::sin(x[0] * 1.3 + x[1] * x[2]); };
  addField(whole, f);
  double parts = 0;
  for (int part = 0; part < 2; ++part)
  {
    const int start = part * 5;
    auto piece = structuredGrid(
      { part == 0 ? 6 : 7, 7, 6 },
      [start](const Vector& p) -> Vector {
        return { p[0] + start, p[1], p[2] };
      },
      start);
    addField(piece, f);
    parts += areaOf(contourOf(piece, 0.1F));
  }
  const double area = areaOf(contourOf(whole, 0.1F));
  EXPECT_NEAR(parts, area, 1e-9 * area);
}

TEST(CloudContour, GlobeIsClosedAtTheSeam)
{
  // A cloud at every longitude: a shell that ends only at the lowest and highest latitudes.
  const Function f = [](const Vector& x)
  {
    const double r = std::sqrt(dot(x, x));
    return 0.3 - std::abs(r - 1.25) + 0.05 * std::sin(5 * std::atan2(x[1], x[0]) + 3 * x[2]);
  };
  auto grid = globe({ 41, 17, 9 });
  addField(grid, f);
  auto* field = grid->GetPointData()->GetArray(0);
  for (vtkIdType row = 0; row < 17 * 9; ++row)
  {
    field->SetComponent(row * 41 + 40, 0, field->GetComponent(row * 41, 0));
  }
  auto surface = contourOf(grid, 0.15F);
  const auto open = openEdges(surface);
  EXPECT_GT(open.size(), 40U);
  for (const auto& [a, b] : open)
  {
    const Vector x = pointOf(surface, a);
    EXPECT_NEAR(std::abs(x[2]) / std::sqrt(dot(x, x)), std::sin(1.3), 1e-3);
  }
  // Normals are right at the seam too.
  for (vtkIdType p = 0; p < surface->GetNumberOfPoints(); ++p)
  {
    const Vector x = pointOf(surface, p);
    Vector normal;
    surface->GetPointData()->GetNormals()->GetTuple(p, normal.data());
    Vector gradient;
    for (int c = 0; c < 3; ++c)
    {
      Vector step = { 0, 0, 0 };
      step[c] = -1e-4;
      gradient[c] = (f(x - step) - f({ x[0] + step[0], x[1] + step[1], x[2] + step[2] })) / 2e-4;
    }
    const bool atTheCut = x[0] < 0 && std::abs(x[1]) < 1e-3; // of atan2
    EXPECT_TRUE(atTheCut || dot(normal, gradient) < -0.97 * std::sqrt(dot(gradient, gradient)))
      << x[0] << ' ' << x[1] << ' ' << x[2];
  }
}

TEST(CloudContour, SaysWhenTheSeamCannotBeClosed)
{
  auto grid = globe({ 40, 9, 5 });
  addField(grid, [](const Vector& x) { return x[2]; });
  vtkNew<vtkCloudContour> contour;
  contour->SetInputData(grid);
  EXPECT_NE(errorTextOf(contour).find("odd number of cells (39)"), std::string::npos);
}

TEST(CloudContour, InterpolatesArraysAndKeepsValuesApart)
{
  // Linear arrays are reproduced exactly; several values follow one another.
  auto image = randomImage({ 10, 9, 8 }, false, 11);
  vtkNew<vtkFloatArray> linear;
  linear->SetName("Linear");
  linear->SetNumberOfComponents(2);
  vtkNew<vtkIntArray> integers;
  integers->SetName("Integers");
  for (vtkIdType id = 0; id < image->GetNumberOfPoints(); ++id)
  {
    const Vector x = pointOf(image, id);
    linear->InsertNextTuple2(x[0] + 10 * x[1], x[2]);
    integers->InsertNextValue(int(x[0]));
  }
  image->GetPointData()->AddArray(linear);
  image->GetPointData()->AddArray(integers);
  vtkNew<vtkCloudContour> contour;
  contour->SetInputData(image);
  contour->GenerateValues(2, 0.05, 0.25);
  contour->Update();
  vtkPolyData* surface = contour->GetOutput();
  auto first = contourOf(image, 0.05);
  auto second = contourOf(image, 0.25);
  EXPECT_EQ(surface->GetNumberOfCells(), first->GetNumberOfCells() + second->GetNumberOfCells());
  ASSERT_EQ(surface->GetNumberOfPoints(), first->GetNumberOfPoints() + second->GetNumberOfPoints());
  vtkPointData* data = surface->GetPointData();
  for (vtkIdType p = 0; p < surface->GetNumberOfPoints(); ++p)
  {
    const Vector x = pointOf(surface, p);
    EXPECT_NEAR(data->GetArray("Linear")->GetComponent(p, 0), x[0] + 10 * x[1], 1e-4);
    EXPECT_NEAR(data->GetArray("Linear")->GetComponent(p, 1), x[2], 1e-5);
    EXPECT_NEAR(data->GetArray("Integers")->GetComponent(p, 0), x[0], 1e-5);
    EXPECT_EQ(data->GetArray("CloudFraction")->GetComponent(p, 0),
      p < first->GetNumberOfPoints() ? 0.05F : 0.25F);
  }
}

TEST(CloudContour, SameBitsForAnyNumberOfThreads)
{
  auto grid = globe({ 81, 67, 7 });
  std::mt19937 random(12);
  addField(grid, [&random](const Vector& x) { return x[0] + (random() % 100) / 100.0; });
  vtkSMPTools::Initialize(1);
  auto one = contourOf(grid, 0.3F);
  for (int threads : { 2, 4 })
  {
    vtkSMPTools::Initialize(threads);
    expectSame(one, contourOf(grid, 0.3F));
  }
  vtkSMPTools::Initialize();
}

TEST(CloudContour, ThinAndEmptyGridsGiveNothing)
{
  for (const std::array<int, 3>& n :
    { std::array<int, 3>{ 9, 8, 1 }, { 1, 8, 7 }, { 9, 1, 7 }, { 1, 1, 1 } })
  {
    auto surface = contourOf(randomImage(n, false, 13), 0.15F);
    EXPECT_EQ(surface->GetNumberOfCells(), 0);
  }
  vtkNew<vtkStructuredGrid> empty;
  EXPECT_EQ(contourOf(empty, 0.15F)->GetNumberOfCells(), 0);
  // Values past both ends of the range, and beyond a float.
  auto image = randomImage({ 5, 6, 7 }, false, 14);
  for (double value : { -1.0, 0.0, 0.31, 1e300, -1e300 })
  {
    EXPECT_EQ(contourOf(image, value)->GetNumberOfCells(), 0) << value;
  }
}

TEST(CloudContour, ExtremeValuesAndFlatCellsStayFinite)
{
  // Doubles whose differences overflow, on cells of which some have no volume.
  auto grid = structuredGrid({ 7, 6, 5 },
    [](const Vector& p) -> Vector {
      return { p[0] * p[1], p[1], std::floor(p[2] / 2) };
    });
  vtkNew<vtkDoubleArray> field;
  field->SetName(nephoscope::arrays::CloudFraction);
  std::mt19937 random(15);
  for (vtkIdType id = 0; id < grid->GetNumberOfPoints(); ++id)
  {
    field->InsertNextValue(random() % 2 == 0 ? 1.5e308 : -1.5e308);
  }
  grid->GetPointData()->AddArray(field);
  auto surface = contourOf(grid, 0.5);
  EXPECT_GT(surface->GetNumberOfPoints(), 100);
  for (vtkIdType p = 0; p < surface->GetNumberOfPoints(); ++p)
  {
    Vector normal;
    surface->GetPointData()->GetNormals()->GetTuple(p, normal.data());
    const Vector x = pointOf(surface, p);
    EXPECT_TRUE(std::isfinite(x[0] + x[1] + x[2]));
    EXPECT_NEAR(dot(normal, normal), 1, 1e-5);
  }
}

TEST(CloudContour, SaysWhatIsWrong)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 4, 5);
  vtkNew<vtkFloatArray> wind;
  wind->SetName("Wind");
  wind->SetNumberOfComponents(3);
  wind->SetNumberOfTuples(60);
  wind->Fill(0);
  image->GetPointData()->AddArray(wind);
  vtkNew<vtkCloudContour> contour;
  contour->SetInputData(image);
  EXPECT_NE(errorTextOf(contour).find(
              "No point array 'CloudFraction' to contour; the input has: Wind. Choose one"),
    std::string::npos);
  contour->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Wind");
  EXPECT_NE(
    errorTextOf(contour).find("'Wind' has 3 components; a contour needs one"), std::string::npos);
  vtkNew<vtkCloudContour> notANumber;
  auto good = randomImage({ 3, 4, 5 }, false, 16);
  notANumber->SetInputData(good);
  notANumber->SetValue(0, std::nan(""));
  EXPECT_NE(errorTextOf(notANumber).find("is not finite; give a number"), std::string::npos);
  EXPECT_EQ(notANumber->GetOutput()->GetNumberOfCells(), 0);

  vtkNew<vtkUnstructuredGrid> voxel;
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(8);
  voxel->SetPoints(points);
  const vtkIdType ids[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
  voxel->InsertNextCell(VTK_VOXEL, 8, ids);
  addField(voxel, [](const Vector&) { return 0.0; });
  vtkNew<vtkCloudContour> mixed;
  mixed->SetInputData(voxel);
  EXPECT_NE(errorTextOf(mixed).find("vtkDataSetTriangleFilter makes tetrahedra of them"),
    std::string::npos);
}
