// SPDX-License-Identifier: BSD-3-Clause
#include "TetrahedronRays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace nephoscope;

namespace
{
/// A piece with the densities at its ends.
struct Met : RayPiece
{
  double nearDensity;
  double farDensity;
};

template <bool Parallel>
bool meetOne(const TetrahedronRays& t, double u, double v, Met& met)
{
  bool found = false;
  t.meetRow<Parallel>(&u, 1, v,
    [&](int, const RayPiece& piece)
    {
      found = piece.nearDepth < piece.farDepth;
      met = { piece, t.density<Parallel>(u, v, piece.nearDepth),
        t.density<Parallel>(u, v, piece.farDepth) };
    });
  return found;
}

/// The piece of the ray of a pixel, and whether there is one.
bool meet(const TetrahedronRays& t, bool parallel, double u, double v, Met& piece)
{
  return parallel ? meetOne<true>(t, u, v, piece) : meetOne<false>(t, u, v, piece);
}

bool set(TetrahedronRays& t, const Vector3 (&q)[4], const float (&s)[4], bool parallel)
{
  return t.set({ &q[0], &q[1], &q[2], &q[3] }, s, parallel);
}
}

TEST(TetrahedronRays, CornerOfACubeInClosedForm)
{
  // The corner at (0, 0, 5) with edges of 4, 4 and 2; the density is linear: 1 at the corner, 3, 5 and 9 at the others.
  const Vector3 q[4] = { { 0, 0, 5 }, { 4, 0, 5 }, { 0, 4, 5 }, { 0, 0, 7 } };
  TetrahedronRays t;
  Met piece;
  ASSERT_TRUE(set(t, q, { 1, 3, 5, 9 }, true));
  ASSERT_TRUE(meet(t, true, 1, 1, piece));
  EXPECT_DOUBLE_EQ(piece.nearDepth, 5);
  EXPECT_DOUBLE_EQ(piece.farDepth, 6);
  EXPECT_DOUBLE_EQ(piece.nearDensity, 1 + 0.5 + 1);
  EXPECT_DOUBLE_EQ(piece.farDensity, 1 + 0.5 + 1 + 4);
  EXPECT_FALSE(meet(t, true, 3, 3, piece));
  // In perspective the ray (0.2 z, 0.2 z, z): x/4 + y/4 + (z-5)/2 = 1 at z = 3.5/0.6.
  ASSERT_TRUE(set(t, q, { 1, 3, 5, 9 }, false));
  ASSERT_TRUE(meet(t, false, 0.2, 0.2, piece));
  const double far = 3.5 / 0.6;
  EXPECT_DOUBLE_EQ(piece.nearDepth, 5);
  EXPECT_DOUBLE_EQ(piece.farDepth, far);
  EXPECT_DOUBLE_EQ(piece.nearDensity, 1 + 0.5 + 1);
  EXPECT_NEAR(piece.farDensity, 1 + 0.1 * far + 0.2 * far + 4 * (far - 5), 1e-12);
}

TEST(TetrahedronRays, TheEyeInsideSeesFromDepthZero)
{
  const Vector3 q[4] = { { -1, -1, -1 }, { 3, -1, -1 }, { -1, 3, -1 }, { -1, -1, 3 } };
  for (const bool parallel : { false, true })
  {
    TetrahedronRays t;
    Met piece;
    ASSERT_TRUE(set(t, q, { 2, 2, 2, 2 }, parallel));
    ASSERT_TRUE(meet(t, parallel, 0, 0, piece));
    EXPECT_EQ(piece.nearDepth, 0);
    EXPECT_DOUBLE_EQ(piece.farDepth, 1);
    EXPECT_EQ(piece.nearDensity, 2);
  }
}

TEST(TetrahedronRays, FlatOrFarBehindIsNothing)
{
  TetrahedronRays t;
  for (const bool parallel : { false, true })
  {
    EXPECT_FALSE(
      set(t, { { 0, 0, 5 }, { 1, 0, 5 }, { 0, 1, 5 }, { 1, 1, 5 } }, { 1, 1, 1, 1 }, parallel));
    EXPECT_FALSE(
      set(t, { { 0, 0, 5 }, { 1, 0, 5 }, { 2, 0, 5 }, { 1, 1, 7 } }, { 1, 1, 1, 1 }, parallel));
    EXPECT_FALSE(
      set(t, { { 0, 0, -5 }, { 1, 0, -5 }, { 0, 1, -5 }, { 0, 0, -7 } }, { 1, 1, 1, 1 }, parallel));
    EXPECT_FALSE(
      set(t, { { 0, 0, NAN }, { 1, 0, 5 }, { 0, 1, 5 }, { 0, 0, 7 } }, { 1, 1, 1, 1 }, parallel));
  }
}

TEST(TetrahedronRays, SliversStayWithinTheirVertices)
{
  // Flat to within rounding: whatever is found is finite and within the bounds.
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-1, 1);
  int met = 0;
  for (int trial = 0; trial < 200000; ++trial)
  {
    const bool parallel = trial & 1;
    const double flat = std::pow(10.0, -(trial % 40));
    Vector3 q[4];
    for (Vector3& p : q)
    {
      const double z = 2 + 0.3 * place(random);
      const double x = place(random);
      p = { x, 0.3 * x + 0.2 * z + flat * place(random), z };
    }
    TetrahedronRays t;
    Met piece;
    if (!set(t, q, { 1, 2, 4, 8 }, parallel))
    {
      continue;
    }
    const double u = 0.5 * place(random);
    // A ray near the plane.
    const double v = parallel ? 0.3 * u + 0.4 : 0.3 * u + 0.2;
    if (meet(t, parallel, u, v + 0.1 * flat * place(random), piece))
    {
      ++met;
      EXPECT_GE(piece.nearDepth, 1.7);
      EXPECT_LE(piece.farDepth, 2.3);
      EXPECT_GE(std::min(piece.nearDensity, piece.farDensity), 1);
      EXPECT_LE(std::max(piece.nearDensity, piece.farDensity), 8);
    }
  }
  EXPECT_GT(met, 1000);
}
