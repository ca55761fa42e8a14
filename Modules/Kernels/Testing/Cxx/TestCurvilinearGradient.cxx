// SPDX-License-Identifier: BSD-3-Clause
#include "CurvilinearGradient.h"

#include <gtest/gtest.h>

using nephoscope::curvilinearGradient;
using nephoscope::Vector3;

TEST(CurvilinearGradient, IsExactForLinearFieldsInAnySkewCell)
{
  const Vector3 gradient = { 0.3, -2, 5 };
  for (double thickness : { 1.0, 1e-3, 1e-5 })
  {
    const std::array<Vector3, 3> x = { { { 2, 0.1, 0.3 }, { -0.4, 1, 0.2 },
      { 0.1 * thickness, 0.2 * thickness, thickness } } };
    const Vector3 g =
      curvilinearGradient(x, { dot(x[0], gradient), dot(x[1], gradient), dot(x[2], gradient) });
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(g[c], gradient[c], 1e-9) << thickness;
    }
  }
}

TEST(CurvilinearGradient, CollapsedDirectionsLeaveTheRest)
{
  // At a pole the steps along i have no length, or one of rounding's size; on one line two steps agree.
  const Vector3 y = { 0, 2, 0 };
  const Vector3 z = { 0, 0, 3 };
  for (const Vector3& none : { Vector3{ 0, 0, 0 }, Vector3{ 1e-12, 0, 0 } })
  {
    const Vector3 g = curvilinearGradient({ none, y, z }, { 1e-3, 4, 9 });
    EXPECT_EQ(g[0], 0);
    EXPECT_NEAR(g[1], 2, 1e-5);
    EXPECT_NEAR(g[2], 3, 1e-5);
  }
  const Vector3 line = curvilinearGradient({ y, y, z }, { 4, 4, 9 });
  EXPECT_NEAR(line[1], 2, 1e-5);
  EXPECT_NEAR(line[2], 3, 1e-5);
  const Vector3 point =
    curvilinearGradient({ { { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0 } } }, { 1, 1, 1 });
  EXPECT_EQ(dot(point, point), 0);
}
