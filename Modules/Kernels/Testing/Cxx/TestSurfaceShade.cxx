// SPDX-License-Identifier: BSD-3-Clause
#include "DisplayTransfer.h"
#include "SurfaceShade.h"

#include <gtest/gtest.h>

#include <limits>

using nephoscope::SurfaceShade;
using nephoscope::Vector3;

TEST(SurfaceShade, FollowsGardnersEquation8)
{
  SurfaceShade shade;
  shade.towardSun = { 0, 0, 1 };
  shade.ambient = 0.2;
  shade.texture = 0.3;
  shade.specular = 0.25;
  shade.specularPower = 2;
  // n . l = 0.6 and the mirrored ray along (0.96, 0, -0.28); the eye at 60 degrees to it.
  const Vector3 normal{ 0.8, 0, 0.6 };
  const Vector3 mirrored{ 0.96, 0, -0.28 };
  const Vector3 towardEye =
    0.5 * mirrored + std::sqrt(0.75) * Vector3{ 0, 1, 0 }; // r . v = 1/2, squared 1/4
  const double expected = 0.8 * (0.7 * (0.75 * 0.6 + 0.25 * 0.25) + 0.3 * 0.9) + 0.2;
  EXPECT_NEAR(shade(normal, towardEye, 0.9)[1], expected, 1e-6);
}

TEST(SurfaceShade, ColoursOfSunAndSkyAreKeptApart)
{
  SurfaceShade shade;
  shade.ambient = 0.25;
  shade.color = { 1, 0.5, 0.25 };
  shade.sun = { 1, 0.9, 0.8 };
  shade.sky = { 0.4, 0.6, 1 };
  const auto lit = shade({ 0, 0, 1 }, { 0, 0, 1 });
  const auto shadow = shade({ 0, 0, -1 }, { 0, 0, 1 });
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(shadow[c], shade.color[c] * 0.25 * shade.sky[c], 1e-6);
    EXPECT_NEAR(lit[c] - shadow[c], shade.color[c] * 0.75 * shade.sun[c], 1e-6);
  }
}

TEST(SurfaceShade, WrapMovesTheTerminatorAndKeepsTheSunlitPole)
{
  SurfaceShade shade;
  shade.wrap = 0.5;
  EXPECT_NEAR(shade({ 0, 0, 1 }, { 0, 0, 1 })[0], 1, 1e-6);
  EXPECT_NEAR(shade({ 1, 0, 0 }, { 0, 0, 1 })[0], 1.0 / 3, 1e-6);
  const double dark = std::sqrt(0.75);
  EXPECT_NEAR(shade({ dark, 0, -0.5 }, { 0, 0, 1 })[0], 0, 1e-6);
  EXPECT_EQ(shade({ 0, 0, -1 }, { 0, 0, 1 })[0], 0);
}

TEST(DisplayTransfer, IsTheStandardsAtItsKneeAndEnds)
{
  EXPECT_EQ(nephoscope::srgb(0), 0);
  EXPECT_DOUBLE_EQ(nephoscope::srgb(1), 1);
  EXPECT_EQ(nephoscope::srgb(7), 1);
  EXPECT_EQ(nephoscope::srgb(-1), 0);
  EXPECT_EQ(nephoscope::srgb(std::numeric_limits<double>::quiet_NaN()), 0);
  EXPECT_EQ(nephoscope::srgb(std::numeric_limits<double>::infinity()), 1);
  EXPECT_EQ(nephoscope::srgb(0.0031308), 12.92 * 0.0031308);
  // The standard's constants are rounded: the branches meet to 3e-8.
  EXPECT_NEAR(nephoscope::srgb(0.0031308 * (1 + 1e-12)), 0.04045, 1e-6);
  EXPECT_NEAR(nephoscope::srgb(0.0031308 * (1 + 1e-12)), nephoscope::srgb(0.0031308), 3e-8);
  EXPECT_NEAR(nephoscope::srgb(0.214041), 0.5, 1e-6);
  EXPECT_EQ(nephoscope::srgb8(0.21586), 128);
}

TEST(DisplayTransfer, InverseReturnsEach8BitLevel)
{
  for (int level = 0; level < 256; ++level)
  {
    EXPECT_EQ(nephoscope::srgb8(nephoscope::linearOfSrgb(level / 255.0)), level);
  }
}

TEST(DisplayTransfer, ShoulderIsSmoothAndStaysBelowOne)
{
  EXPECT_EQ(nephoscope::shoulder(5, 0), 5);
  EXPECT_EQ(nephoscope::shoulder(0.7, 0.3), 0.7);
  const double h = 1e-6;
  const double slope =
    (nephoscope::shoulder(0.7 + h, 0.3) - nephoscope::shoulder(0.7 - h, 0.3)) / (2 * h);
  EXPECT_NEAR(slope, 1, 1e-5);
  EXPECT_LT(nephoscope::shoulder(3, 0.3), 1);
  EXPECT_GT(nephoscope::shoulder(3, 0.3), nephoscope::shoulder(2, 0.3));
}
