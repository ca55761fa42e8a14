// SPDX-License-Identifier: BSD-3-Clause
#include "LinearEmission.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using nephoscope::EmissionWeights;
using nephoscope::linearEmission;

namespace
{
/// The far end's weight by a fine march: exact transmittances, the colour of the middle of each step.
double marched(double tau, double skew)
{
  constexpr int Steps = 100000;
  // Steps crowd at the near end, where a thick stretch shines.
  const auto place = [](int n) { return std::pow(static_cast<long double>(n) / Steps, 3); };
  const auto depth = [tau, skew](long double x) { return tau * x * (1 + skew * (x - 1)); };
  long double sum = 0;
  for (int n = 0; n < Steps; ++n)
  {
    const long double a = depth(place(n));
    const long double b = depth(place(n + 1));
    sum += 0.5L * (place(n) + place(n + 1)) * std::exp(-a) * -std::expm1(a - b);
  }
  return static_cast<double>(sum);
}
}

// The weights agree with a march of 100,000 steps: within 1e-8, and for thin stretches within a millionth of themselves.
TEST(LinearEmission, IsThatOfAFineMarch)
{
  for (const double tau : { 1e-9, 0.0099, 0.0101, 0.199, 0.201, 0.99, 1.99, 7.5, 19.9, 20.1, 1e6 })
  {
    for (const double skew : { -1.0, -0.7, 1e-7, 0.3, 1.0 })
    {
      const EmissionWeights weights = linearEmission(tau, skew);
      const double truth = marched(tau, skew);
      EXPECT_NEAR(weights.farEnd, truth, std::min(1e-8, 1e-6 * tau))
        << "tau " << tau << ", skew " << skew;
      EXPECT_DOUBLE_EQ(weights.nearEnd + weights.farEnd, -std::expm1(-tau));
      EXPECT_GE(weights.nearEnd, 0);
      EXPECT_GE(weights.farEnd, 0);
    }
  }
}

// Uniform extinction has a closed form: w1 = (1 - exp(-tau)) / tau - exp(-tau).
TEST(LinearEmission, IsTheClosedFormWhereExtinctionIsUniform)
{
  for (const double tau : { 0.01, 0.5, 2.0, 11.0, 40.0 })
  {
    EXPECT_NEAR(linearEmission(tau, 0).farEnd, -std::expm1(-tau) / tau - std::exp(-tau), 1e-8);
  }
}

// Nothing shines where nothing is; of a solid only the near end shows.
TEST(LinearEmission, HasTheLimitsOfNothingAndOfASolid)
{
  EXPECT_EQ(linearEmission(0, 0.5).nearEnd, 0);
  EXPECT_EQ(linearEmission(0, 0.5).farEnd, 0);
  for (const double tau : { 1e25, 1e35, std::numeric_limits<double>::infinity() })
  {
    EXPECT_NEAR(linearEmission(tau, 1).nearEnd, 1, 1e-8);
    EXPECT_NEAR(linearEmission(tau, 1).farEnd, 0, 1e-8);
  }
}
