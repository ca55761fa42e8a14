// SPDX-License-Identifier: BSD-3-Clause
#include "Exponential.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using nephoscope::exponential;
using nephoscope::exponentialFloat;

TEST(Exponential, AgreesWithTheLibraryInDoublePrecision)
{
  for (int n = -700000; n <= 700000; n += 7)
  {
    const double x = 1e-3 * n;
    const double truth = std::exp(x);
    ASSERT_NEAR(exponential(x), truth, 1e-13 * truth) << x;
  }
  EXPECT_EQ(exponential(0), 1);
}

TEST(Exponential, AgreesWithTheLibraryInSinglePrecision)
{
  for (int n = -86990; n <= 87000; n += 7)
  {
    const float x = 1e-3F * static_cast<float>(n);
    const double truth = std::exp(static_cast<double>(x));
    ASSERT_NEAR(static_cast<double>(exponentialFloat(x)), truth, 3e-7 * truth) << x;
  }
  EXPECT_EQ(exponentialFloat(0.0F), 1.0F);
}

TEST(Exponential, NearNothingStaysPositiveAndFinite)
{
  EXPECT_EQ(exponential(-1e9), exponential(-700));
  EXPECT_EQ(exponentialFloat(-1e9F), exponentialFloat(-87.0F));
  EXPECT_EQ(exponentialFloat(-INFINITY), exponentialFloat(-87.0F));
  EXPECT_GT(exponentialFloat(-87.0F), 1.1e-38F);
}
}
