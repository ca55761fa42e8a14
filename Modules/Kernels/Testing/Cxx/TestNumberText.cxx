// SPDX-License-Identifier: BSD-3-Clause
#include "NumberText.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using nephoscope::numberText;

TEST(NumberText, SaysWhatTheNumberIs)
{
  EXPECT_EQ(numberText(0.15), "0.15");
  EXPECT_EQ(numberText(static_cast<double>(0.15F)), "0.15") << "not 0.150000006";
  EXPECT_EQ(numberText(30000), "30000");
  EXPECT_EQ(numberText(1e-7), "1e-07") << "not 0.000000";
  EXPECT_EQ(numberText(-0.5, 1), "-0.5");
  EXPECT_EQ(numberText(1136073600, 10), "1136073600");
  EXPECT_EQ(numberText(std::nan("")), "nan");
}

TEST(NumberText, HasRoomForTheLongest)
{
  EXPECT_EQ(std::stod(numberText(-std::numeric_limits<double>::max(), 17)),
    -std::numeric_limits<double>::max());
  EXPECT_EQ(std::stod(numberText(std::nextafter(-1e-300, 0), 17)), std::nextafter(-1e-300, 0));
}
