// SPDX-License-Identifier: BSD-3-Clause
// Orders of cells, against pairs known in closed form, all pairs along rays, and cycles found by brute force.
#include "ColumnTetrahedra.h"
#include "RayGaps.h"
#include "VisibilityOrder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>

using namespace nephoscope;

namespace
{
constexpr int Width = 23;
constexpr int Height = 17;

/// A grid of cells between points place(a, b, c), a, b, c from 0 to 1; drawn where `keep` says so.
CellColumns columnsOf(
  const std::array<int, 3>& n, int parity,
  const std::function<Vector3(double, double, double)>& place,
  const std::function<bool(int)>& keep = [](int) { return true; })
{
  CellColumns columns;
  columns.resize(n[0], n[1], n[2]);
  columns.parity = parity;
  for (int j = 0; j < n[1]; ++j)
  {
    for (int i = 0; i < n[0]; ++i)
    {
      for (int k = 0; k < n[2]; ++k)
      {
        const std::size_t p = (static_cast<std::size_t>(j) * n[0] + i) * n[2] + k;
        columns.points[p] = place(i / (n[0] - 1.0), j / (n[1] - 1.0), k / (n[2] - 1.0));
        columns.extinction[p] = 1;
      }
    }
  }
  for (std::size_t c = 0; c < columns.drawn.size(); ++c)
  {
    columns.drawn[c] = keep(static_cast<int>(c)) ? 1 : 0;
  }
  for (std::size_t column = 0; column < columns.numberOfColumns(); ++column)
  {
    columns.classify(column);
  }
  return columns;
}

Vector3 block(double a, double b, double c)
{
  return { 3 * a - 1.5, 2 * b - 1, c - 0.5 };
}
Vector3 warped(double a, double b, double c)
{
  return { 3 * a - 1.5 + 0.15 * std::sin(5 * b + 3 * c), 2 * b - 1 + 0.12 * std::sin(4 * a + c),
    c - 0.5 + 0.08 * std::sin(6 * a + 5 * b) };
}
/// The outside of the block turned about its upright axis, the more the higher: the walls round it lean one way.
Vector3 twisted(double a, double b, double c)
{
  const double turn = 0.8 * c;
  const double x = 2 * a - 1;
  const double y = 2 * b - 1;
  return { x * std::cos(turn) - y * std::sin(turn), x * std::sin(turn) + y * std::cos(turn), c };
}

/// A whole shell over hills; the seam closes in place only and the poles are single points.
Vector3 globe(double a, double b, double c)
{
  constexpr double Pi = 3.14159265358979323846;
  const double longitude = 2 * Pi * (a < 1 ? a : 0);
  const double latitude = Pi * (b - 0.5);
  const double across = b == 0 || b == 1 ? 0 : std::cos(latitude);
  const double r =
    1 + 0.15 * c + 0.03 * (1 - c) * across * std::sin(3 * longitude) * std::sin(2 * latitude);
  return { r * across * std::cos(longitude), r * across * std::sin(longitude),
    r * std::sin(latitude) };
}

struct NumberedCell
{
  std::uint32_t number;
  std::array<std::size_t, 4> points;
};

/// The tetrahedra of a grid, put in order for a camera.
struct Ordered
{
  std::vector<NumberedCell> drawn;
  VisibilityOrder order;
  std::vector<std::size_t> rank;

  Ordered(const CellColumns& columns, const Camera& camera, bool gaps = true)
  {
    ColumnTetrahedra tetrahedra(columns);
    std::vector<std::uint32_t> all(columns.numberOfColumns());
    std::iota(all.begin(), all.end(), 0);
    const std::size_t count = tetrahedra.number(all);
    RayGaps rays(RaySpace(camera), Width, Height);
    rays.reset({ 0, 0, Width, Height });
    std::vector<CellRelations> relations(2);
    std::vector<double> distance(count, 0);
    for (const std::uint32_t column : all)
    {
      tetrahedra.relate(column, ViewPoint(camera), relations[0]);
      for (int k = columns.first[column]; k < columns.last[column]; ++k)
      {
        for (int t = 0; tetrahedra.isDrawn(column, k) && t < 5; ++t)
        {
          const std::uint32_t number = tetrahedra.number(column, k, t);
          const auto points = tetrahedra.points(column, k, t);
          this->drawn.push_back({ number, points });
          distance[number] = ViewPoint(camera).depth(tetrahedra.middle(column, k, t));
          if (gaps && tetrahedra.isAtGap(column, k, t))
          {
            rays.add(number,
              { columns.points[points[0]], columns.points[points[1]], columns.points[points[2]],
                columns.points[points[3]] });
          }
        }
      }
    }
    rays.relate(relations[1]);
    this->order = visibilityOrder(count, relations, distance);
    this->rank.assign(count, count);
    for (std::size_t r = 0; r < this->order.cells.size(); ++r)
    {
      this->rank[this->order.cells[r]] = r;
    }
  }
};

/// Where a ray enters and leaves a tetrahedron, from barycentric coordinates.
bool meets(const Ray& ray, const Vector3 (&p)[4], double& from, double& to)
{
  from = 0;
  to = std::numeric_limits<double>::infinity();
  for (int n = 0; n < 4; ++n)
  {
    const Vector3& a = p[(n + 1) % 4];
    const Vector3 normal = cross(p[(n + 2) % 4] - a, p[(n + 3) % 4] - a);
    const double height = dot(normal, p[n] - a);
    if (height == 0)
    {
      return false;
    }
    const double at = dot(normal, ray.origin - a) / height;
    const double rate = dot(normal, ray.direction) / height;
    if (rate > 0)
    {
      from = std::max(from, -at / rate);
    }
    else if (rate < 0)
    {
      to = std::min(to, -at / rate);
    }
  }
  return to - from > 1e-9;
}

/// Pairs that a pixel's ray meets one after the other and that are not in that order.
int wrongPairs(const CellColumns& columns, const Camera& camera, const Ordered& ordered, int& pairs)
{
  int wrong = 0;
  pairs = 0;
  for (int pixel = 0; pixel < Width * Height; ++pixel)
  {
    const int row = pixel / Width;
    const Ray ray = camera.ray(pixel % Width + 0.5, row + 0.5);
    std::vector<std::pair<double, std::size_t>> met;
    for (const NumberedCell& cell : ordered.drawn)
    {
      const Vector3 p[4] = { columns.points[cell.points[0]], columns.points[cell.points[1]],
        columns.points[cell.points[2]], columns.points[cell.points[3]] };
      double from = 0;
      double to = 0;
      if (meets(ray, p, from, to))
      {
        met.emplace_back(0.5 * (from + to), ordered.rank[cell.number]);
      }
    }
    std::sort(met.begin(), met.end());
    for (std::size_t m = 1; m < met.size(); ++m)
    {
      wrong += met[m - 1].second < met[m].second ? 0 : 1;
      ++pairs;
    }
  }
  return wrong;
}

void expectEachOnce(const VisibilityOrder& order, std::size_t count)
{
  std::vector<std::uint32_t> sorted = order.cells;
  std::sort(sorted.begin(), sorted.end());
  ASSERT_EQ(sorted.size(), count);
  for (std::uint32_t n = 0; n < count; ++n)
  {
    EXPECT_EQ(sorted[n], n);
  }
}

Camera lookFrom(const Vector3& eye, const Vector3& target = { 0, 0, 0 })
{
  return Camera::perspective(eye, target, { 0.1, 0.2, 1 }, 35, Width, Height);
}

std::vector<Camera> camerasAround()
{
  std::vector<Camera> cameras;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(-1, 1);
  for (int n = 0; n < 12; ++n)
  {
    const Vector3 from = { part(random), part(random), part(random) };
    cameras.push_back(lookFrom((5 / length(from)) * from));
    cameras.push_back(Camera::parallel(3 * from, { 0, 0, 0 }, { 0.1, 0.2, 1 }, 1.4, Width, Height));
  }
  cameras.push_back(lookFrom({ 0.31, 0.22, 0.13 }, { 1.2, 0.4, 0.3 })); // inside
  return cameras;
}

/// Strongly connected components of more than one cell, from which cells can be reached from which.
struct BruteForce
{
  std::vector<std::vector<bool>> reaches;
  std::size_t cycles = 0;
  std::size_t cellsInCycles = 0;

  BruteForce(std::size_t cells, const CellRelations& relations)
    : reaches(cells, std::vector<bool>(cells, false))
  {
    for (const CellRelation& r : relations)
    {
      this->reaches[r.before][r.after] = r.before != r.after;
    }
    for (std::size_t by = 0; by < cells; ++by)
    {
      for (std::size_t a = 0; a < cells; ++a)
      {
        for (std::size_t b = 0; b < cells; ++b)
        {
          this->reaches[a][b] =
            this->reaches[a][b] || (this->reaches[a][by] && this->reaches[by][b]);
        }
      }
    }
    for (std::size_t a = 0; a < cells; ++a)
    {
      std::size_t first = a; // of its component
      for (std::size_t b = 0; b < a; ++b)
      {
        first = this->together(a, b) ? std::min(first, b) : first;
      }
      this->cycles += this->reaches[a][a] && first == a ? 1 : 0;
      this->cellsInCycles += this->reaches[a][a] ? 1 : 0;
    }
  }
  bool together(std::size_t a, std::size_t b) const
  {
    return this->reaches[a][b] && this->reaches[b][a];
  }
};
}

TEST(VisibilityOrder, TwoTetrahedraAtAFaceByTheEyesSide)
{
  // The face is the triangle of the unit vectors; one tetrahedron reaches to the origin, the other to (1, 1, 1).
  const Vector3 x{ 1, 0, 0 };
  const Vector3 y{ 0, 1, 0 };
  const Vector3 z{ 0, 0, 1 };
  EXPECT_EQ(ViewPoint(lookFrom({ 3, 3, 3 })).side(x, y, z), 1);
  EXPECT_EQ(ViewPoint(lookFrom({ 3, 3, 3 })).side(x, z, y), -1);
  EXPECT_EQ(ViewPoint(lookFrom({ -3, 2, 1 })).side(x, y, z), -1);
  EXPECT_EQ(ViewPoint(lookFrom({ 3, -3, 1 })).side(x, y, z), 0); // in the plane
  EXPECT_EQ(ViewPoint(lookFrom({ 3, 3, 3 })).side(x, y, x), 0);  // no plane
  // Wherever a parallel camera stands, it sees from where it does not look.
  const auto toward = [](const Vector3& target) {
    return ViewPoint(Camera::parallel({ 0, 0, 0 }, target, { 0, 1, 0 }, 1, Width, Height));
  };
  EXPECT_EQ(toward({ -1, -1, -1 }).side(x, y, z), 1);
  EXPECT_EQ(toward({ 1, 2, 3 }).side(x, y, z), -1);
  EXPECT_EQ(toward({ 1, -1, 0 }).side(x, y, z), 0);
  const CellRelation nearer = { 1, 0 };
  EXPECT_EQ(
    visibilityOrder(2, { { nearer } }, { 0, 0 }).cells, (std::vector<std::uint32_t>{ 1, 0 }));
}

TEST(VisibilityOrder, ACubeOfFiveFromEachOfItsCorners)
{
  // From far out over the corner of an outer tetrahedron it comes first, then the one in the middle, then the other three;
  // from over the other corners three come before the middle and the one opposite after it.
  for (const int parity : { 0, 1 })
  {
    const CellColumns columns = columnsOf({ 2, 2, 2 }, parity,
      [](double a, double b, double c) {
        return Vector3{ a, b, c };
      });
    for (int corner = 0; corner < 8; ++corner)
    {
      const Vector3 eye = { 9.0 * (corner & 1) - 4, 9.0 * (corner >> 1 & 1) - 4.1,
        9.0 * (corner >> 2) - 4.2 };
      const Ordered ordered(columns, lookFrom(eye, { 0.5, 0.5, 0.5 }));
      expectEachOnce(ordered.order, 5);
      EXPECT_EQ(ordered.order.cycles, 0U);
      const auto& split = TetrahedralSplit[parity];
      const auto own = std::find_if(
        split.begin() + 1, split.end(), [corner](const auto& t) { return t[0] == corner; });
      const auto opposite = std::find_if(
        split.begin() + 1, split.end(), [corner](const auto& t) { return t[0] == 7 - corner; });
      if (own != split.end())
      {
        EXPECT_EQ(ordered.rank[own - split.begin()], 0U);
        EXPECT_EQ(ordered.rank[0], 1U);
      }
      else
      {
        ASSERT_NE(opposite, split.end());
        EXPECT_EQ(ordered.rank[0], 3U);
        EXPECT_EQ(ordered.rank[opposite - split.begin()], 4U);
      }
    }
  }
}

// Whatever is seen from wherever: along each ray, each tetrahedron is before the next.
TEST(VisibilityOrder, EachRayMeetsTheCellsInOrder)
{
  for (const auto& place : { block, warped })
  {
    const CellColumns columns = columnsOf({ 6, 5, 4 }, 1, place);
    for (const Camera& camera : camerasAround())
    {
      const Ordered ordered(columns, camera);
      expectEachOnce(ordered.order, 5 * columns.drawn.size());
      EXPECT_EQ(ordered.order.cycles, 0U);
      int pairs = 0;
      EXPECT_EQ(wrongPairs(columns, camera, ordered, pairs), 0);
      EXPECT_GT(pairs, 300);
    }
  }
}

// With cells left out, what lies on both sides of a gap shares no face; without the gaps' relations the order is wrong.
TEST(VisibilityOrder, GapsAreOrderedByTheRaysThatCrossThem)
{
  std::mt19937 random(3);
  const CellColumns columns =
    columnsOf({ 7, 6, 5 }, 0, warped, [&random](int) { return random() % 3 == 0; });
  int wrongWithout = 0;
  for (const Camera& camera : camerasAround())
  {
    const Ordered ordered(columns, camera);
    EXPECT_EQ(ordered.order.cycles, 0U);
    int pairs = 0;
    EXPECT_EQ(wrongPairs(columns, camera, ordered, pairs), 0);
    EXPECT_GT(pairs, 100);
    wrongWithout += wrongPairs(columns, camera, Ordered(columns, camera, false), pairs);
  }
  EXPECT_GT(wrongWithout, 100);
}

// Curved levels leave the inside of a globe open, between its near side and its far one.
TEST(VisibilityOrder, AGlobeIsOrderedThroughItsInside)
{
  std::mt19937 random(5);
  const CellColumns columns =
    columnsOf({ 17, 10, 4 }, 0, globe, [&random](int) { return random() % 3 > 0; });
  for (const Camera& camera : camerasAround())
  {
    const Ordered ordered(columns, camera);
    EXPECT_EQ(ordered.order.cycles, 0U);
    int pairs = 0;
    EXPECT_EQ(wrongPairs(columns, camera, ordered, pairs), 0);
    EXPECT_GT(pairs, 100);
  }
}

// A left-handed grid, and levels that lie on each other: cells without volume pass the order on.
TEST(VisibilityOrder, LeftHandedAndFlatCellsChangeNothing)
{
  const auto mirrored = [](double a, double b, double c) { return warped(1 - a, b, c); };
  const auto flat = [](double a, double b, double c)
  { return block(a, b, c > 0.3 && c < 0.7 ? 0.25 : c); };
  for (const std::function<Vector3(double, double, double)>& place :
    { std::function<Vector3(double, double, double)>(mirrored),
      std::function<Vector3(double, double, double)>(flat) })
  {
    const CellColumns columns = columnsOf({ 6, 5, 4 }, 0, place);
    for (const Camera& camera : camerasAround())
    {
      const Ordered ordered(columns, camera);
      EXPECT_EQ(ordered.order.cycles, 0U);
      int pairs = 0;
      EXPECT_EQ(wrongPairs(columns, camera, ordered, pairs), 0);
    }
  }
}

// Three tetrahedra over the sides of a triangle, each before the next at one end and behind the last at the other.
TEST(VisibilityOrder, ThreeTetrahedraInACycleAreEachTakenOnce)
{
  const Camera above =
    Camera::perspective({ 0, 0, 5 }, { 0, 0, 0 }, { 0, 1, 0 }, 40, Width, Height);
  RayGaps rays(RaySpace(above), Width, Height);
  rays.reset({ 0, 0, Width, Height });
  constexpr double Third = 2.0943951023931953;
  for (std::uint32_t n = 0; n < 3; ++n)
  {
    const Vector3 a{ std::cos(Third * n), std::sin(Third * n), 0 };
    const Vector3 b{ std::cos(Third * (n + 1)), std::sin(Third * (n + 1)), 0 };
    const Vector3 out = 0.2 * normalized(a + b);
    const Vector3 from = a - 0.3 * (b - a);
    const Vector3 to = b + 0.3 * (b - a) + Vector3{ 0, 0, 0.8 }; // it rises
    rays.add(n, { from - out, from + out, to - out, to + out + Vector3{ 0, 0, 0.05 } });
  }
  CellRelations relations;
  rays.relate(relations);
  ASSERT_EQ(relations.size(), 3U);
  for (const CellRelation& r : relations)
  {
    EXPECT_EQ(r.after, (r.before + 1) % 3);
  }
  const VisibilityOrder order = visibilityOrder(3, { relations }, { 0.3, 0.1, 0.2 });
  EXPECT_EQ(order.cycles, 1U);
  EXPECT_EQ(order.cellsInCycles, 3U);
  EXPECT_EQ(order.cells, (std::vector<std::uint32_t>{ 1, 2, 0 })); // the nearest, then as they were
}

// Walls that all lean one way round the axis that is looked along: a cycle of cells that share faces.
TEST(VisibilityOrder, ATwistedGridHasACycleSeenAlongItsAxis)
{
  const CellColumns columns = columnsOf({ 4, 4, 2 }, 0, twisted);
  const Camera above = Camera::parallel({ 0, 0, 5 }, { 0, 0, 0 }, { 0, 1, 0 }, 1.5, Width, Height);
  const Ordered ordered(columns, above);
  EXPECT_GE(ordered.order.cycles, 1U);
  EXPECT_GE(ordered.order.cellsInCycles, 8U);
  expectEachOnce(ordered.order, 5 * columns.drawn.size());
  int pairs = 0;
  const int wrong = wrongPairs(columns, above, ordered, pairs);
  EXPECT_GT(wrong, 0);
  EXPECT_LT(wrong, pairs / 10);
  const Ordered aside(columns, lookFrom({ 6, 1, 0.5 }, { 0, 0, 0.5 }));
  EXPECT_EQ(aside.order.cycles, 0U);
}

TEST(VisibilityOrder, CyclesAreThoseOfBruteForceAndOnlyTheirRelationsAreBroken)
{
  std::mt19937 random(11);
  for (int round = 0; round < 200; ++round)
  {
    const std::size_t cells = 3 + random() % 12;
    CellRelations relations;
    std::vector<double> distance(cells);
    for (std::size_t n = 0; n < cells + cells / 3; ++n)
    {
      relations.push_back({ static_cast<std::uint32_t>(random() % cells),
        static_cast<std::uint32_t>(random() % cells) });
    }
    for (double& d : distance)
    {
      d = random() % 5;
    }
    const CellRelations half(relations.begin(), relations.begin() + relations.size() / 2);
    const CellRelations rest(relations.begin() + relations.size() / 2, relations.end());
    const VisibilityOrder order = visibilityOrder(cells, { half, rest }, distance);
    const BruteForce truth(cells, relations);
    EXPECT_EQ(order.cycles, truth.cycles);
    EXPECT_EQ(order.cellsInCycles, truth.cellsInCycles);
    expectEachOnce(order, cells);
    std::vector<std::size_t> rank(cells);
    for (std::size_t r = 0; r < cells; ++r)
    {
      rank[order.cells[r]] = r;
    }
    for (const CellRelation& r : relations)
    {
      EXPECT_TRUE(
        r.before == r.after || truth.together(r.before, r.after) || rank[r.before] < rank[r.after]);
    }
  }
}

TEST(VisibilityOrder, OfNothingAndOfAMillionInARow)
{
  EXPECT_TRUE(visibilityOrder(0, {}, {}).cells.empty());
  // Backwards, with the last before the first: one cycle, deeper than a program's stack.
  constexpr std::uint32_t Count = 1000000;
  CellRelations relations;
  for (std::uint32_t n = 0; n < Count; ++n)
  {
    relations.push_back({ n, (n + Count - 1) % Count });
  }
  std::vector<double> distance(Count, 1);
  distance[500] = 0;
  const VisibilityOrder order = visibilityOrder(Count, { relations }, distance);
  EXPECT_EQ(order.cycles, 1U);
  ASSERT_EQ(order.cells.size(), Count);
  EXPECT_EQ(order.cells[0], 500U);
  EXPECT_EQ(order.cells[501], Count - 1);
}

TEST(VisibilityOrder, DistancesAloneKeepEqualOnesInOrder)
{
  EXPECT_EQ(distanceOrder({ 3, 1, 2, 1, -4 }), (std::vector<std::uint32_t>{ 4, 1, 3, 2, 0 }));
}
