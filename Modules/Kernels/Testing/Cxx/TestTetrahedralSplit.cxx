// SPDX-License-Identifier: BSD-3-Clause
#include "TetrahedralSplit.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <utility>

using nephoscope::splitParity;
using nephoscope::TetrahedralSplit;
using nephoscope::TetrahedronVertices;

namespace
{
using Point = std::array<double, 3>;
using GridPoint = std::array<int, 3>;

Point unitCube(int v)
{
  return { double(v & 1), double(v >> 1 & 1), double(v >> 2 & 1) };
}

/// det(b - a, c - a, d - a) / 6
double signedVolume(const Point& a, const Point& b, const Point& c, const Point& d)
{
  double m[3][3];
  for (int x = 0; x < 3; ++x)
  {
    m[0][x] = b[x] - a[x];
    m[1][x] = c[x] - a[x];
    m[2][x] = d[x] - a[x];
  }
  return (m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])) /
    6;
}

GridPoint gridPoint(int i, int j, int k, int v)
{
  return { i + (v & 1), j + (v >> 1 & 1), k + (v >> 2 & 1) };
}
}

TEST(TetrahedralSplit, VolumesArePositiveAndSumToTheCell)
{
  for (const auto& split : TetrahedralSplit)
  {
    double sum = 0;
    for (const TetrahedronVertices& t : split)
    {
      const double v = signedVolume(unitCube(t[0]), unitCube(t[1]), unitCube(t[2]), unitCube(t[3]));
      EXPECT_NEAR(v, &t == split.data() ? 1 / 3.0 : 1 / 6.0, 1e-15);
      sum += v;
    }
    EXPECT_NEAR(sum, 1, 1e-15);
  }
}

TEST(TetrahedralSplit, CoversTheCellOnce)
{
  // A random point lies in exactly one tetrahedron (its four sub-volumes are all positive).
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(0, 1);
  for (const auto& split : TetrahedralSplit)
  {
    for (int n = 0; n < 1000; ++n)
    {
      const Point p = { u(random), u(random), u(random) };
      int inside = 0;
      for (const TetrahedronVertices& t : split)
      {
        Point x[4];
        for (int c = 0; c < 4; ++c)
        {
          x[c] = unitCube(t[c]);
        }
        inside += signedVolume(p, x[1], x[2], x[3]) > 0 && signedVolume(x[0], p, x[2], x[3]) > 0 &&
          signedVolume(x[0], x[1], p, x[3]) > 0 && signedVolume(x[0], x[1], x[2], p) > 0;
      }
      EXPECT_EQ(inside, 1);
    }
  }
}

TEST(TetrahedralSplit, NeighboursShareEveryInnerTriangle)
{
  // On a 4 x 3 x 5 block each triangle occurs twice, or once on the block's surface: the faces' diagonals agree.
  const int n[3] = { 4, 3, 5 };
  std::map<std::set<GridPoint>, int> triangles;
  for (int k = 0; k < n[2]; ++k)
  {
    for (int j = 0; j < n[1]; ++j)
    {
      for (int i = 0; i < n[0]; ++i)
      {
        for (const TetrahedronVertices& t : TetrahedralSplit[splitParity(i, j, k)])
        {
          for (int left = 0; left < 4; ++left)
          {
            std::set<GridPoint> triangle;
            for (int c = 0; c < 4; ++c)
            {
              if (c != left)
              {
                triangle.insert(gridPoint(i, j, k, t[c]));
              }
            }
            ++triangles[triangle];
          }
        }
      }
    }
  }
  for (const auto& [triangle, count] : triangles)
  {
    bool outer = false;
    for (int axis = 0; axis < 3; ++axis)
    {
      bool low = true;
      bool high = true;
      for (const GridPoint& p : triangle)
      {
        low = low && p[axis] == 0;
        high = high && p[axis] == n[axis];
      }
      outer = outer || low || high;
    }
    EXPECT_EQ(count, outer ? 1 : 2);
  }
}

TEST(TetrahedralSplit, DiagonalsJoinEvenGridPoints)
{
  for (int parity = 0; parity < 2; ++parity)
  {
    for (const TetrahedronVertices& t : TetrahedralSplit[parity])
    {
      for (int a = 0; a < 4; ++a)
      {
        for (int b = a + 1; b < 4; ++b)
        {
          const GridPoint p = gridPoint(parity, 0, 0, t[a]);
          const GridPoint q = gridPoint(parity, 0, 0, t[b]);
          const int steps = std::abs(p[0] - q[0]) + std::abs(p[1] - q[1]) + std::abs(p[2] - q[2]);
          EXPECT_TRUE(steps == 1 || (steps == 2 && splitParity(p[0], p[1], p[2]) == 0));
        }
      }
    }
  }
}
