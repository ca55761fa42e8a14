// SPDX-License-Identifier: BSD-3-Clause
#include "ArcTangent.h"

#include <gtest/gtest.h>

#include <limits>

namespace
{
using nephoscope::arcTangent;

constexpr double Pi = 3.14159265358979323846;
constexpr double Allowed = 1e-15;

TEST(ArcTangent, AgreesWithTheLibraryAllAround)
{
  for (const double size : { 1e-300, 1e-9, 1.0, 6371229.0, 1e300 })
  {
    for (int n = -99991; n <= 99991; ++n)
    {
      const double angle = n * (Pi / 100000);
      const double x = size * std::cos(angle);
      const double y = size * std::sin(angle);
      ASSERT_NEAR(arcTangent(y, x), std::atan2(y, x), Allowed) << size << " " << angle;
    }
  }
}

TEST(ArcTangent, IsExactInItsSmallAngles)
{
  for (double y = 1; y > 1e-300; y /= 7)
  {
    ASSERT_NEAR(arcTangent(y, 1) / std::atan2(y, 1), 1, Allowed) << y;
    ASSERT_EQ(arcTangent(-y, 1), -arcTangent(y, 1));
  }
}

TEST(ArcTangent, KnowsTheAxes)
{
  EXPECT_EQ(arcTangent(0, 3), 0);
  EXPECT_DOUBLE_EQ(arcTangent(3, 0), Pi / 2);
  EXPECT_DOUBLE_EQ(arcTangent(0, -3), Pi);
  EXPECT_DOUBLE_EQ(arcTangent(-3, 0), -Pi / 2);
  EXPECT_DOUBLE_EQ(arcTangent(-2, -2), -0.75 * Pi);
}

TEST(ArcTangent, IsZeroWithoutADirection)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(arcTangent(0, 0), 0);
  EXPECT_EQ(arcTangent(infinity, infinity), 0);
  EXPECT_EQ(arcTangent(nan, nan), 0);
}
}
