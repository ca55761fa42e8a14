// SPDX-License-Identifier: BSD-3-Clause
#include "DeepTile.h"

#include <gtest/gtest.h>

#include <cmath>

using nephoscope::DeepTile;
using nephoscope::Opaque;
using nephoscope::PixelLight;

TEST(DeepTile, EachPixelGetsItsOwnSegmentsInDepthOrder)
{
  DeepTile tile;
  std::vector<PixelLight> light;
  for (int again = 0; again < 2; ++again)
  {
    tile.reset({ 10, 20, 3, 2 });
    const float half = std::log(2.0F);
    tile.add(12, 21, { 4, 4, { half, half, half }, { 1, 1, 1 } });
    tile.add(10, 20, { 1, 1, { half, half, half }, { 3, 3, 3 } });
    tile.add(12, 21, { 2, 2, { half, half, half }, { 8, 8, 8 } });
    EXPECT_EQ(tile.numberOfSegments(), 3U);
    tile.composite(light);
    ASSERT_EQ(light.size(), 6U);
    EXPECT_FLOAT_EQ(light[0].radiance[0], 3);
    EXPECT_FLOAT_EQ(light[1].radiance[0], 0);
    EXPECT_FLOAT_EQ(light[5].radiance[0], 8.5F);
    EXPECT_FLOAT_EQ(light[5].transmittance[0], 0.25F);
  }
}

TEST(DeepTile, HiddenSegmentsAreNotKept)
{
  DeepTile tile;
  tile.reset({ 0, 0, 2, 1 });
  EXPECT_TRUE(std::isinf(tile.opaqueAt(1, 0)));
  tile.add(1, 0, { 5.1, 5.1, { Opaque, Opaque, Opaque }, { 1, 0, 0 } });
  EXPECT_GE(tile.opaqueAt(1, 0), 5.1);
  EXPECT_NEAR(tile.opaqueAt(1, 0), 5.1, 1e-6);
  tile.add(1, 0, { 6, 7, { 1, 1, 1 }, { 1, 1, 1 } });
  EXPECT_EQ(tile.numberOfSegments(), 1U);
  tile.add(1, 0, { 4, 7, { 1, 1, 1 }, { 0, 0, 0 } });
  EXPECT_EQ(tile.numberOfSegments(), 2U);
  EXPECT_TRUE(std::isinf(tile.opaqueAt(0, 0)));
}
