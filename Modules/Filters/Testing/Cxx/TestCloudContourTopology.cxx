// SPDX-License-Identifier: BSD-3-Clause
#include "ContourTesting.h"

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
    auto tetrahedra = tetrahedraOf(image.Get());
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
  for (vtkIdType row = 0; row < vtkIdType(17) * 9; ++row)
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
