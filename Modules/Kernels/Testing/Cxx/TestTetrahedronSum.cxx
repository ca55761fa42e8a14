// SPDX-License-Identifier: BSD-3-Clause
#include "TetrahedronSum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

using namespace nephoscope;

namespace
{
/// A picture of 13 x 9 rays 0.1 apart about the axis, each with an end of what can be seen, and its sums.
struct Picture
{
  static constexpr int Width = 13;
  static constexpr int Height = 9;
  static constexpr int RowLength = Width + 3;
  std::vector<double> u, stretch, limitDepth, limitKey, sums;

  explicit Picture(bool parallel, std::mt19937& random)
    : stretch(RowLength * Height)
    , limitDepth(RowLength * Height)
    , limitKey(RowLength * Height)
    , sums(RowLength * Height, 0)
  {
    std::uniform_real_distribution<double> share(0, 1);
    for (int x = 0; x < RowLength; ++x)
    {
      this->u.push_back(0.1 * (x - 6) + 0.003);
    }
    for (int n = 0; n < RowLength * Height; ++n)
    {
      const bool outside = n % RowLength >= Width;
      this->stretch[n] = 1 + share(random);
      this->limitDepth[n] = outside ? 0 : n % 3 == 0 ? INFINITY : 4 * share(random);
      this->limitKey[n] = parallel ? this->limitDepth[n] : -1 / this->limitDepth[n];
      this->limitKey[n] = outside ? -INFINITY : this->limitKey[n];
    }
  }
};

/// What a ray meets, in its own words.
template <bool Parallel>
double opticalDepth(const TetrahedronRays& t, const Picture& picture, int x, int y)
{
  double tau = 0;
  const int n = y * Picture::RowLength + x;
  const double v = y; // rows are a unit apart
  t.meetRow<Parallel>(&picture.u[x], 1, v,
    [&](int, const RayPiece& piece)
    {
      const double far = std::min(piece.farDepth, picture.limitDepth[n]);
      const double sum = t.density<Parallel>(picture.u[x], v, piece.nearDepth) +
        t.density<Parallel>(picture.u[x], v, far);
      tau = std::max(0.0, 0.5 * (far - piece.nearDepth) * picture.stretch[n] * sum);
    });
  return tau;
}

/// Two tetrahedra, the second about the eye, in two overlapping rectangles that begin at odd pixels.
template <bool Parallel>
int compareSums(unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-1, 1);
  Picture picture(Parallel, random);
  std::vector<double> plain = picture.sums;
  std::vector<double> expected = picture.sums;
  std::size_t met = 0;
  std::size_t metPlainly = 0;
  for (int which = 0; which < 2; ++which)
  {
    Vector3 q[4];
    for (Vector3& p : q)
    {
      const double z = which + 1.2 * place(random) + 0.5;
      const double across = Parallel ? 1 : std::abs(z) + 0.2;
      p = { across * place(random), across * (4 + 6 * place(random)), z };
    }
    const float s[4] = { 1, 0, 3, static_cast<float>(2 + place(random)) };
    TetrahedronRays t;
    if (!t.set({ &q[0], &q[1], &q[2], &q[3] }, s, Parallel))
    {
      continue;
    }
    const int x0 = 1 + 2 * which;
    const int first = Picture::RowLength + x0;
    const RayRow rays{ &picture.u[x0], &picture.stretch[first], &picture.limitDepth[first],
      &picture.limitKey[first] };
    const int width = Picture::Width - x0;
    const int height = Picture::Height - 2;
    met += sumOpticalDepths(
      t, Parallel, rays, { &picture.sums[first], Picture::RowLength, width, height, 1 });
    metPlainly += sumOpticalDepthsPlainly(
      t, Parallel, rays, { &plain[first], Picture::RowLength, width, height, 1 });
    for (int n = 0; n < width * height; ++n)
    {
      const int x = x0 + n % width;
      const int y = 1 + n / width;
      expected[y * Picture::RowLength + x] += opticalDepth<Parallel>(t, picture, x, y);
    }
  }
  int some = 0;
  for (std::size_t n = 0; n < expected.size(); ++n)
  {
    EXPECT_NEAR(picture.sums[n], expected[n], 1e-9 * expected[n] + 1e-11) << "seed " << seed;
    EXPECT_EQ(picture.sums[n], plain[n]);
    some += expected[n] > 0 ? 1 : 0;
  }
  EXPECT_EQ(met, metPlainly);
  EXPECT_GE(met, static_cast<std::size_t>(some));
  return some;
}
}

TEST(TetrahedronSum, IsTheSumOfThePiecesOfEachRay)
{
  int some = 0;
  for (unsigned seed = 0; seed < 2000; ++seed)
  {
    some += compareSums<false>(seed);
    some += compareSums<true>(seed);
  }
  EXPECT_GT(some, 50000);
}
