// SPDX-License-Identifier: BSD-3-Clause
#include "GaussLegendre.h"
#include "PhaseFunction.h"

#include <gtest/gtest.h>

#include <cmath>

using nephoscope::draine;
using nephoscope::gaussLegendre;
using nephoscope::henyeyGreenstein;

namespace
{
constexpr double Pi = 3.14159265358979323846;
}

// 1 over all directions. The mean cosine of Henyey and Greenstein's is g; of Draine's g (1 + alpha (3 + 2 g^2)/5) /
// (1 + alpha (1 + 2 g^2)/3), Draine 2003 eq. 6.
TEST(PhaseFunction, IsNormalisedAndHasItsMeanCosine)
{
  for (const double g : { -0.9, -0.3, 0.0, 0.5, 0.95 })
  {
    for (const double alpha : { 0.0, 1.0, 50.0 })
    {
      double total = 0;
      double forward = 0;
      for (const auto& mu : gaussLegendre(400, -1, 1))
      {
        const double p = 2 * Pi * mu.weight * draine(g, alpha, mu.x);
        total += p;
        forward += p * mu.x;
      }
      EXPECT_NEAR(total, 1, 1e-9) << g << ", " << alpha;
      const double mean = g * (1 + alpha * (3 + 2 * g * g) / 5) / (1 + alpha * (1 + 2 * g * g) / 3);
      EXPECT_NEAR(forward, mean, 1e-9) << g << ", " << alpha;
    }
  }
}

// A positive g throws light forward; g = 0 is the same everywhere, alpha = 1 then Rayleigh's.
TEST(PhaseFunction, PointsForward)
{
  EXPECT_GT(henyeyGreenstein(0.8, 1), 100 * henyeyGreenstein(0.8, -1));
  EXPECT_DOUBLE_EQ(henyeyGreenstein(0.0, 0.3), 1 / (4 * Pi));
  EXPECT_DOUBLE_EQ(draine(0.0, 1.0, 0.5), 3 / (16 * Pi) * 1.25);
  EXPECT_DOUBLE_EQ(draine(0.4, 0.0, 0.5), henyeyGreenstein(0.4, 0.5));
}

// At the ends of g there is nothing to give but 0.
TEST(PhaseFunction, IsFiniteAtItsEnds)
{
  EXPECT_EQ(henyeyGreenstein(1.0, 1), 0);
  EXPECT_EQ(henyeyGreenstein(-1.0, -1), 0);
  EXPECT_EQ(henyeyGreenstein(1.5, 0), 0);
  EXPECT_TRUE(std::isfinite(henyeyGreenstein(1 - 1e-15, 1)));
}
