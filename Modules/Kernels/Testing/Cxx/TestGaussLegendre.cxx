// SPDX-License-Identifier: BSD-3-Clause
#include "GaussLegendre.h"

#include <gtest/gtest.h>

#include <cmath>

using nephoscope::gaussLegendre;
using nephoscope::gaussLegendrePanels;

// n places integrate powers up to 2 n - 1 exactly, and not the next.
TEST(GaussLegendre, IsExactToItsDegree)
{
  for (const int n : { 1, 2, 5, 16 })
  {
    for (int power = 0; power <= 2 * n; ++power)
    {
      double sum = 0;
      for (const auto& point : gaussLegendre(n, 0, 1))
      {
        sum += point.weight * std::pow(point.x, power);
      }
      const double error = std::abs(sum * (power + 1) - 1);
      if (power < 2 * n)
      {
        EXPECT_LT(error, 1e-14) << n << " places, power " << power;
      }
      else if (n < 10)
      {
        EXPECT_GT(error, 1e-6) << n << " places, power " << power;
      }
    }
  }
}

// The places of 5 points from Abramowitz and Stegun, table 25.4; on another interval they are scaled.
TEST(GaussLegendre, HasThePublishedPlaces)
{
  const auto points = gaussLegendre(5, 3, 7);
  EXPECT_NEAR(points[4].x, 5 + 2 * 0.906179845938664, 1e-14);
  EXPECT_NEAR(points[3].x, 5 + 2 * 0.538469310105683, 1e-14);
  EXPECT_NEAR(points[2].x, 5, 1e-14);
  EXPECT_NEAR(points[4].weight, 2 * 0.236926885056189, 1e-14);
  EXPECT_LT(points[0].x, points[1].x);
}

// Doubling the panels of n places divides the error by 2^(2 n).
TEST(GaussLegendre, PanelsShowTheirOrder)
{
  const auto error = [](int panels)
  {
    double sum = 0;
    for (const auto& point : gaussLegendrePanels(panels, 2, 0, 3))
    {
      sum += point.weight * std::exp(-point.x);
    }
    return std::abs(sum - (1 - std::exp(-3.0)));
  };
  EXPECT_NEAR(std::log2(error(4) / error(8)), 4, 0.1);
  EXPECT_NEAR(std::log2(error(8) / error(16)), 4, 0.05);
}

TEST(GaussLegendre, HoldsForManyPlaces)
{
  double sum = 0;
  for (const auto& point : gaussLegendre(1000, -1, 1))
  {
    EXPECT_GT(point.weight, 0);
    sum += point.weight * std::cos(100 * point.x);
  }
  EXPECT_NEAR(sum, std::sin(100.0) / 50, 1e-13);
}
