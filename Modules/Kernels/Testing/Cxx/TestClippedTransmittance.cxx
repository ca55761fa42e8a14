// SPDX-License-Identifier: BSD-3-Clause
#include "ClippedTransmittance.h"

#include <gtest/gtest.h>

#include <cmath>

// Max's sexp and its relatives: 1 at 0, 1/4 at 1, 0 from 2 on; 1e6 is no trouble.
TEST(ClippedTransmittance, IsSexpAndClipped)
{
  const auto error = [](double k, double x)
  { return std::abs(nephoscope::clippedPower(2, 1.0, k, x) - std::exp(-x)); };
  EXPECT_NEAR(error(1, 1.594), 0.16190, 5e-6); // the table's largest errors, and where
  EXPECT_NEAR(error(1, 2), 0.13534, 5e-6);
  EXPECT_NEAR(error(0.71172, 2.48), 0.0699, 5e-5);
  EXPECT_NEAR(error(2.0 / 3, 0.649), 0.0916, 5e-5);
  EXPECT_EQ(nephoscope::clippedPower(2, 1.0, 1.0, 0), 1);
  EXPECT_EQ(nephoscope::clippedPower(2, 1.0, 1.0, 1), 0.25);
  EXPECT_EQ(nephoscope::clippedPower(2, 1.0, 1.0, 2), 0);
  EXPECT_EQ(nephoscope::clippedPower(2, 1.0, 1.0, 1e6), 0);
  const double c[] = { 1, -1, 0.1 };
  EXPECT_NEAR(nephoscope::clippedPolynomial(2, c, 0.5, 3), 0.525, 1e-15);
  EXPECT_EQ(nephoscope::clippedPolynomial(2, c, 2, 3), 0);    // -0.6
  EXPECT_EQ(nephoscope::clippedPolynomial(2, c, 1e6, 3), 0);  // past its end
  EXPECT_EQ(nephoscope::clippedPolynomial(2, c, 20, 30), 21); // not its business
}
