// SPDX-License-Identifier: BSD-3-Clause
// The surface against that of vtkContour3DLinearGrid, on the very tetrahedra.
#include "ContourTesting.h"

#include "vtkContour3DLinearGrid.h"
#include "vtkStaticPointLocator.h"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace
{
vtkSmartPointer<vtkPolyData> peerOf(vtkUnstructuredGrid* tetrahedra, double value)
{
  vtkNew<vtkContour3DLinearGrid> contour;
  contour->SetInputData(tetrahedra);
  contour->SetValue(0, value);
  contour->MergePointsOn();
  contour->InterpolateAttributesOff();
  contour->Update();
  return vtkPolyData::SafeDownCast(contour->GetOutput());
}

/// Undirected edges, with how many triangles have them.
std::map<std::pair<vtkIdType, vtkIdType>, int> edgesOf(vtkPolyData* surface)
{
  std::map<std::pair<vtkIdType, vtkIdType>, int> edges;
  for (const auto& [edge, count] : directedEdges(surface))
  {
    edges[std::minmax(edge.first, edge.second)] += count;
  }
  return edges;
}

struct Topology
{
  vtkIdType triangles;
  vtkIdType euler;
  vtkIdType boundary;
};

Topology topologyOf(vtkPolyData* surface)
{
  const auto edges = edgesOf(surface);
  const auto isBoundary = [](const auto& edge) { return edge.second == 1; };
  return { surface->GetNumberOfCells(),
    surface->GetNumberOfPoints() - vtkIdType(edges.size()) + surface->GetNumberOfCells(),
    vtkIdType(std::count_if(edges.begin(), edges.end(), isBoundary)) };
}

using Corners = std::set<vtkIdType>;

/// The peer's points as ids of ours: each within 1e-6, and no two the same.
std::vector<vtkIdType> matched(vtkPolyData* ours, vtkPolyData* peer)
{
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(ours);
  locator->BuildLocator();
  std::vector<vtkIdType> ids;
  std::set<vtkIdType> taken;
  for (vtkIdType p = 0; p < peer->GetNumberOfPoints(); ++p)
  {
    const Vector x = pointOf(peer, p);
    ids.push_back(locator->FindClosestPoint(x.data()));
    const Vector d = pointOf(ours, ids.back()) - x;
    EXPECT_LT(std::sqrt(dot(d, d)), 1e-6);
    EXPECT_TRUE(taken.insert(ids.back()).second);
  }
  return ids;
}

std::set<Corners> trianglesOf(vtkPolyData* surface, const std::vector<vtkIdType>& names)
{
  std::set<Corners> triangles;
  vtkNew<vtkIdList> ids;
  for (vtkIdType t = 0; t < surface->GetNumberOfCells(); ++t)
  {
    surface->GetCellPoints(t, ids);
    triangles.insert({ names[ids->GetId(0)], names[ids->GetId(1)], names[ids->GetId(2)] });
  }
  return triangles;
}

std::set<Corners> without(const std::set<Corners>& all, const std::set<Corners>& others)
{
  std::set<Corners> left;
  std::set_difference(
    all.begin(), all.end(), others.begin(), others.end(), std::inserter(left, left.end()));
  return left;
}

/// The four corners of each two triangles that share an edge which the other surface has not.
std::set<Corners> quadrilaterals(
  const std::set<Corners>& triangles, const std::set<Corners>& otherTriangles)
{
  const auto edgesOfTriangles = [](const std::set<Corners>& all)
  {
    std::map<Corners, Corners> edges; // with the corners of their triangles
    for (const Corners& triangle : all)
    {
      for (vtkIdType opposite : triangle)
      {
        Corners edge = triangle;
        edge.erase(opposite);
        edges[edge].insert(triangle.begin(), triangle.end());
      }
    }
    return edges;
  };
  const auto others = edgesOfTriangles(otherTriangles);
  std::set<Corners> result;
  for (const auto& [edge, corners] : edgesOfTriangles(triangles))
  {
    if (others.count(edge) == 0)
    {
      result.insert(corners);
    }
  }
  return result;
}

/// A sum of waves in double precision: no value equals a contour value. In steps it is -3, -1, 1 or 3.
void addWaves(vtkDataSet* data, bool inSteps)
{
  vtkNew<vtkDoubleArray> field;
  field->SetName(nephoscope::arrays::CloudFraction);
  for (vtkIdType id = 0; id < data->GetNumberOfPoints(); ++id)
  {
    const Vector x = pointOf(data, id);
    const double f = std::sin(7.3 * x[0] + 2 * x[1]) + std::sin(9.1 * x[1] - 3 * x[2]) +
      std::cos(8.7 * x[2] + 4 * x[0]);
    field->InsertNextValue(inSteps ? std::copysign(std::abs(f) > 0.8 ? 3 : 1, f) : f);
  }
  data->GetPointData()->SetScalars(field);
}

/// A stretched, sheared grid of double points that does not close on itself.
vtkSmartPointer<vtkStructuredGrid> curvedGrid(const std::array<int, 3>& n, bool inSteps)
{
  auto grid = structuredGrid(n,
    [&n](const Vector& p) -> Vector
    {
      const double u = p[0] / (n[0] - 1);
      const double v = p[1] / (n[1] - 1);
      const double w = p[2] / (n[2] - 1);
      return { u + 0.1 * std::sin(2 * v + w), v + 0.15 * u * u, w + 0.3 * w * w + 0.1 * u };
    });
  addWaves(grid, inSteps);
  return grid;
}

void expectSameTopology(vtkPolyData* ours, vtkPolyData* peer)
{
  const Topology a = topologyOf(ours);
  const Topology b = topologyOf(peer);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.euler, b.euler);
  EXPECT_EQ(a.boundary, b.boundary);
  EXPECT_GT(a.boundary, 10);
}

/// A tetrahedron with two corners inside is cut in a quadrilateral: its halves may differ, nothing else.
void expectSameTriangles(vtkPolyData* ours, vtkPolyData* peer)
{
  ASSERT_EQ(ours->GetNumberOfPoints(), peer->GetNumberOfPoints());
  std::vector<vtkIdType> own(ours->GetNumberOfPoints());
  std::iota(own.begin(), own.end(), 0);
  const auto oursAsSet = trianglesOf(ours, own);
  const auto peerAsSet = trianglesOf(peer, matched(ours, peer));
  EXPECT_EQ(vtkIdType(oursAsSet.size()), ours->GetNumberOfCells());
  const auto oursOnly = without(oursAsSet, peerAsSet);
  const auto peerOnly = without(peerAsSet, oursAsSet);
  EXPECT_LT(oursOnly.size(), oursAsSet.size() / 3);
  EXPECT_EQ(oursOnly.size(), peerOnly.size());
  const auto halved = quadrilaterals(oursOnly, peerOnly);
  EXPECT_EQ(halved, quadrilaterals(peerOnly, oursOnly));
  EXPECT_EQ(2 * halved.size(), oursOnly.size());
}

void compare(const std::array<int, 3>& n, bool inSteps, double value, double areaTolerance)
{
  SCOPED_TRACE(::testing::Message() << n[0] << " points along i, value " << value);
  auto grid = curvedGrid(n, inSteps);
  auto ours = contourOf(grid, value);
  auto peer = peerOf(tetrahedraOf(grid.Get(), VTK_DOUBLE), value);
  ASSERT_GT(peer->GetNumberOfCells(), 500);
  EXPECT_NEAR(areaOf(ours) / areaOf(peer), 1, areaTolerance);
  expectSameTopology(ours, peer);
  expectSameTriangles(ours, peer);
}
}

TEST(CloudContourPeer, SameSurfaceAsTheLinearGridContour)
{
  for (const std::array<int, 3>& n :
    { std::array<int, 3>{ 40, 17, 13 }, { 131, 11, 6 }, { 64, 9, 8 } })
  {
    // In steps vertices lie at quarters and halves of their edges, where the peer is exact; elsewhere it rounds that part to float.
    compare(n, true, 0, 1e-9);
    for (double value : { -0.7, 0.05, 1.1 })
    {
      compare(n, false, value, 1e-8);
    }
  }
}
