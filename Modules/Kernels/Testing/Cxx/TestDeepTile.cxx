// SPDX-License-Identifier: BSD-3-Clause
#include "DeepTile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

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

namespace
{
using nephoscope::Segment;

/// A medium of many pieces in the wrong order, and the same as segments.
struct Medium
{
  std::vector<Segment> segments;

  Medium(DeepTile& tile, const std::vector<nephoscope::RGB>& sources, unsigned seed)
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> part(0, 1);
    std::vector<int> order(60);
    for (int i = 0; i < 60; ++i)
    {
      order[i] = i;
    }
    std::shuffle(order.begin(), order.end(), random);
    for (const int i : order)
    {
      const nephoscope::RGB& source = sources[i % sources.size()];
      const float tau = 0.1F * part(random);
      const float skew = 2 * part(random) - 1;
      const float light = -std::expm1(-tau);
      this->segments.push_back({ 5 + 0.5 * i, 5.5 + 0.5 * i, { tau, tau, tau },
        { light * source[0], light * source[1], light * source[2] }, skew });
      tile.addPiece(1, 0, tile.addSource(source), 5 + 0.5 * i, 0.5F, tau, skew);
    }
  }
};

void expectSame(PixelLight a, PixelLight b)
{
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(a.radiance[c], b.radiance[c], 1e-6);
    EXPECT_NEAR(a.transmittance[c], b.transmittance[c], 1e-6);
  }
}
}

TEST(DeepTile, PiecesOfMediaAreSegmentsInLessSpace)
{
  const std::vector<Segment> others = { { 17.1, 17.1, { 0.2F, 0.1F, 0.3F }, { 1, 0, 0 } },
    { 9.8, 9.8, { 0.5F, 0.5F, 0.5F }, { 0, 2, 0 } }, { 1, 1, { 1, 1, 1 }, { 0, 0, 3 } },
    { 9.8, 9.8, { 0.1F, 0.1F, 0.1F }, { 0, 0, 5 } }, { 8, 20, { 1, 1, 1 }, { 0.5F, 0.5F, 0.5F } } };
  std::vector<PixelLight> light;
  for (std::size_t number = 0; number <= others.size(); ++number)
  {
    for (std::size_t sources = 1; sources <= 2; ++sources)
    {
      DeepTile tile;
      tile.reset({ 0, 0, 2, 1 });
      const std::vector<nephoscope::RGB> both = { { 1, 0.5F, 0.25F }, { 0.2F, 0.7F, 3 } };
      Medium medium(tile, { both.begin(), both.begin() + static_cast<int>(sources) }, 17);
      for (std::size_t s = 0; s < number; ++s)
      {
        tile.add(1, 0, others[s]);
        medium.segments.push_back(others[s]);
      }
      EXPECT_EQ(tile.numberOfSegments(), 60 + number);
      tile.composite(light);
      const PixelLight expected = nephoscope::composite(medium.segments);
      expectSame(light[1], expected);
      EXPECT_NEAR(
        light[1].depth, expected.depth, 0.25); // within its piece it is linear, and uniform there
    }
  }
}

TEST(DeepTile, DepthInPiecesOfMediaFollowsTheirLinearExtinction)
{
  DeepTile tile;
  tile.reset({ 0, 0, 1, 1 });
  const std::uint32_t white = tile.addSource({ 1, 1, 1 });
  EXPECT_EQ(tile.addSource({ 0, 1, 1 }), white + 1);
  EXPECT_EQ(tile.addSource({ 1, 1, 1 }), white);
  // Extinction a x from the eye on, 1000 pieces of it: a d^2 / 2 = ln 2.
  const double a = 0.03;
  for (int i = 999; i >= 0; --i)
  {
    const double x = 0.02 * i;
    tile.addPiece(0, 0, white, x, 0.02F, static_cast<float>(a * 0.02 * (x + 0.01)),
      static_cast<float>(0.01 / (x + 0.01)));
  }
  std::vector<PixelLight> light;
  tile.composite(light);
  EXPECT_NEAR(light[0].depth, std::sqrt(2 * std::log(2.0) / a), 1e-5);
  EXPECT_NEAR(light[0].transmittance[0], std::exp(-a * 200), 1e-6);
}

TEST(DeepTile, SumsOnlyWhereNothingNeedsAnOrder)
{
  DeepTile tile;
  const auto starts = [&tile](bool last, bool depth, float before)
  {
    tile.reset({ 3, 4, 5, 2 });
    tile.setDepthWanted(depth);
    tile.add(4, 5, { 1, 1, { before, before, before }, { 7, 7, 7 } });
    if (last)
    {
      tile.setLast();
    }
    return tile.startSum(tile.addSource({ 1, 2, 3 }));
  };
  EXPECT_FALSE(starts(false, false, Opaque));
  EXPECT_FALSE(starts(true, true, Opaque));
  EXPECT_FALSE(starts(true, false, 0.5F));
  ASSERT_TRUE(starts(true, false, Opaque));
  EXPECT_TRUE(tile.isSum());
  *tile.opticalDepths(4, 5) += std::log(2.0);
  *tile.opticalDepths(7, 4) += std::log(4.0);
  tile.countSummed(2);
  EXPECT_EQ(tile.numberOfSegments(), 3U);
  std::vector<PixelLight> light;
  tile.composite(light);
  const float expected[10][2] = { { 0, 1 }, { 0, 1 }, { 0, 1 }, { 0, 1 }, { 1.5F, 0.25F }, { 0, 1 },
    { 0.5F * 2 + 0.5F * 7, 0 }, { 0, 1 }, { 0, 1 }, { 0, 1 } };
  for (std::size_t n = 0; n < 10; ++n)
  {
    EXPECT_FLOAT_EQ(light[n].radiance[1], expected[n][0]);
    EXPECT_FLOAT_EQ(light[n].transmittance[1], expected[n][1]);
    EXPECT_TRUE(std::isinf(light[n].depth));
  }
}

namespace
{
/// Adds every n-th of some segments and pieces of two sources, from the first-th on.
void addShare(DeepTile& tile, int first, int n, bool surfaces)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<float> share(0.1F, 1.0F);
  for (int i = 0; i < 60; ++i)
  {
    const float near = 10 * share(random);
    const float length = share(random);
    const float tau = 0.3F * share(random);
    const int x = 40 + i % 5;
    const int y = 7 + i / 5 % 2;
    if (i % n != first)
    {
      continue;
    }
    if (surfaces && i % 4 == 0)
    {
      tile.add(x, y, { near, near, { tau, 2 * tau, tau }, { tau, 0, 0.5F * tau } });
    }
    tile.addPiece(x, y,
      tile.addSource(
        i % 3 == 0 && surfaces ? nephoscope::RGB{ 1, 2, 3 } : nephoscope::RGB{ 4, 5, 6 }),
      near, length, tau, 0.2F);
  }
}

void expectSameLight(DeepTile& a, DeepTile& b)
{
  std::vector<PixelLight> light[2];
  a.composite(light[0]);
  b.composite(light[1]);
  ASSERT_EQ(light[0].size(), light[1].size());
  for (std::size_t p = 0; p < light[0].size(); ++p)
  {
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(light[0][p].radiance[c], light[1][p].radiance[c], 1e-6) << p;
      EXPECT_NEAR(light[0][p].transmittance[c], light[1][p].transmittance[c], 1e-6) << p;
    }
    EXPECT_TRUE(light[0][p].depth == light[1][p].depth ||
      std::abs(light[0][p].depth - light[1][p].depth) < 1e-5)
      << p;
  }
}
}

/// What three tiles packed is, put together, what one tile has of all.
TEST(DeepTile, PackedSharesMakeTheWhole)
{
  for (const bool surfaces : { false, true })
  {
    DeepTile whole;
    whole.reset({ 40, 7, 5, 2 });
    addShare(whole, 0, 1, surfaces);
    DeepTile together;
    together.reset({ 40, 7, 5, 2 });
    for (int share = 2; share >= 0; --share)
    {
      DeepTile part;
      part.reset({ 40, 7, 5, 2 });
      addShare(part, share, 3, surfaces);
      std::vector<char> bytes;
      part.pack(bytes);
      together.addPacked(bytes.data(), bytes.size());
    }
    EXPECT_EQ(together.numberOfSegments(), whole.numberOfSegments());
    expectSameLight(together, whole);
  }
}

/// Summed optical depths add up, behind them what is opaque and was known to all.
TEST(DeepTile, PackedSumsAddUp)
{
  const nephoscope::Segment wall{ 9, 9, { Opaque, Opaque, Opaque }, { 0.5F, 0.25F, 1 } };
  DeepTile together;
  together.reset({ 0, 0, 3, 2 });
  together.setDepthWanted(false);
  together.add(1, 1, wall);
  for (int share = 1; share <= 3; ++share)
  {
    DeepTile part;
    part.reset({ 0, 0, 3, 2 });
    part.setDepthWanted(false);
    part.add(1, 1, wall);
    part.keepLimitsOnly();
    EXPECT_EQ(part.numberOfSegments(), 0U);
    EXPECT_EQ(part.opaqueAt(1, 1), 9);
    part.setLast();
    ASSERT_TRUE(part.startSum(part.addSource({ 2, 4, 8 })));
    *part.opticalDepths(1, 1) += 0.1 * share;
    part.countSummed(1);
    std::vector<char> bytes;
    part.pack(bytes);
    together.addPacked(bytes.data(), bytes.size());
  }
  std::vector<PixelLight> light;
  together.composite(light);
  const double through = std::exp(-0.6);
  EXPECT_NEAR(light[4].radiance[0], (1 - through) * 2 + through * 0.5, 1e-6);
  EXPECT_NEAR(light[4].radiance[2], (1 - through) * 8 + through * 1, 1e-6);
  EXPECT_EQ(light[4].transmittance[1], 0);
  EXPECT_EQ(light[0].transmittance[0], 1);
}

/// A tile to which nothing was added packs nothing.
TEST(DeepTile, NothingIsPackedOfNothing)
{
  DeepTile tile;
  tile.reset({ 0, 0, 4, 4 });
  std::vector<char> bytes;
  tile.pack(bytes);
  EXPECT_TRUE(bytes.empty());
  tile.addPacked(bytes.data(), bytes.size());
  EXPECT_EQ(tile.numberOfSegments(), 0U);
}
