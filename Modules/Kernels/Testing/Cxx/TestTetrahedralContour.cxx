// SPDX-License-Identifier: BSD-3-Clause
#include "TetrahedralContour.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

using nephoscope::contourCase;
using nephoscope::ContourCase;
using nephoscope::ContourLevel;
using nephoscope::edgeEnds;
using nephoscope::Index;
using nephoscope::LatticeShape;

namespace
{
void runPasses(ContourLevel& level, const LatticeShape& shape, const std::vector<float>& values)
{
  for (Index row = 0; row < shape.rows(); ++row)
  {
    level.classify(row, values.data() + row * shape.n[0], 0.5F);
  }
  for (Index row = 0; row < shape.rows(); ++row)
  {
    level.countRow(row);
  }
  level.accumulate();
}
}

TEST(ContourCase, EdgesJoinACornerInsideWithOneOutside)
{
  for (int parity = 0; parity < 2; ++parity)
  {
    for (unsigned inside = 0; inside < 256; ++inside)
    {
      const ContourCase& c = contourCase(parity, inside);
      for (int e = 0; e < c.edges; ++e)
      {
        const int owner = c.edge[e].owner;
        const int ownerParity = (parity + owner + (owner >> 1) + (owner >> 2)) & 1;
        const auto ends = edgeEnds(c.edge[e].slot, ownerParity);
        EXPECT_NE(inside >> (owner + ends[0]) & 1, inside >> (owner + ends[1]) & 1);
      }
    }
  }
}

TEST(ContourCase, ComplementsHaveTheSameTrianglesTurnedRound)
{
  for (int parity = 0; parity < 2; ++parity)
  {
    for (unsigned inside = 0; inside < 256; ++inside)
    {
      const ContourCase& c = contourCase(parity, inside);
      EXPECT_EQ(c.triangles, contourCase(parity, 255 ^ inside).triangles);
      EXPECT_EQ(c.edges, contourCase(parity, 255 ^ inside).edges);
      EXPECT_EQ(c.triangles == 0, inside == 0 || inside == 255);
    }
  }
}

TEST(ContourCase, OneCornerIsCutOffByAsManyTrianglesAsTetrahedraMeetThere)
{
  // A corner of the middle tetrahedron is in it and in three others; the rest are in one.
  for (int parity = 0; parity < 2; ++parity)
  {
    for (int v = 0; v < 8; ++v)
    {
      const int cornerParity = (parity + v + (v >> 1) + (v >> 2)) & 1;
      EXPECT_EQ(contourCase(parity, 1U << v).triangles, cornerParity == 0 ? 4 : 1);
    }
  }
}

TEST(ContourLevel, VerticesAreNumberedOnceEachAndTrianglesUseThemAll)
{
  for (bool closed : { false, true })
  {
    LatticeShape shape;
    shape.n = { 131, 5, 4 };
    shape.closed = closed;
    std::mt19937 random(4);
    std::vector<float> values(131 * 5 * 4);
    for (float& v : values)
    {
      v = float(random() % 3) / 2; // 0, 0.5 (on the contour), 1
    }
    ContourLevel level(shape, nullptr);
    runPasses(level, shape, values);
    std::set<Index> vertices;
    std::set<Index> used;
    Index triangles = 0;
    for (Index row = 0; row < shape.rows(); ++row)
    {
      EXPECT_EQ(level.firstTriangle(row), triangles);
      level.forEachEdge(row,
        [&](Index id, int i, int)
        {
          EXPECT_TRUE(vertices.insert(id).second);
          EXPECT_LT(i, closed ? 130 : 131);
        });
      level.forEachTriangle(row,
        [&](Index a, Index b, Index c)
        {
          used.insert({ a, b, c });
          ++triangles;
        });
    }
    EXPECT_EQ(triangles, level.numberOfTriangles());
    EXPECT_EQ(Index(vertices.size()), level.numberOfVertices());
    EXPECT_EQ(*vertices.rbegin(), level.numberOfVertices() - 1);
    EXPECT_EQ(used, vertices);
  }
}

TEST(ContourLevel, EulersFormulaHoldsForABall)
{
  // One point inside, at even and odd places: a closed surface has V - E + F = 2, and E = 3 F / 2.
  for (int i : { 1, 2, 63, 64 })
  {
    LatticeShape shape;
    shape.n = { 67, 5, 5 };
    std::vector<float> values(67 * 25, 0.0F);
    values[i + 67 * (2 + 5 * 2)] = 1;
    ContourLevel level(shape, nullptr);
    runPasses(level, shape, values);
    EXPECT_EQ(2 * level.numberOfVertices() - level.numberOfTriangles(), 4);
    EXPECT_EQ(level.numberOfVertices(), i % 2 == 0 ? 18 : 6);
  }
}
