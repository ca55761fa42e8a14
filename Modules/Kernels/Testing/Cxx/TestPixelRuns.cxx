// SPDX-License-Identifier: BSD-3-Clause
// Pixels from what several parts of a scene have composited of their own are those of all segments together.
#include "DeepTile.h"
#include "PixelRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace
{
using nephoscope::DeepTile;
using nephoscope::PixelLight;
using nephoscope::PixelRequest;
using nephoscope::PixelRun;
using nephoscope::PixelRuns;
using nephoscope::Segment;

constexpr nephoscope::TileExtent Extent{ 40, 7, 7, 3 };
constexpr int Pixels = 21;
constexpr int Parts = 4;

/// Segments from 10 k to 10 k + 9.9 along each ray go to part (k + pixel) mod Parts, if parts are to follow one another; else to any.
struct Scene
{
  Scene(bool inOrder, unsigned seed)
  {
    for (DeepTile& part : this->Tiles)
    {
      part.reset(Extent);
    }
    this->Whole.reset(Extent);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> share(0.05F, 1.0F);
    for (int i = 0; i < 40 * Pixels; ++i)
    {
      const int pixel = i % Pixels;
      const int k = i / Pixels % Parts;
      const int slot = i / Pixels / Parts;
      const double near = 10 * k + slot + 0.3 * share(random);
      const float tau = 0.1F * share(random);
      const float length = share(random);
      const auto part =
        inOrder ? (k + pixel) % Parts : static_cast<int>(Parts * share(random) * 0.99F);
      for (DeepTile* tile : { &this->Tiles[part], &this->Whole })
      {
        add(*tile, pixel, near, length, tau, i);
      }
    }
  }

  static void add(DeepTile& tile, int pixel, double near, float length, float tau, int i)
  {
    const int x = Extent.x0 + pixel % Extent.width;
    const int y = Extent.y0 + pixel / Extent.width;
    if (i % 3 == 0)
    {
      const float opaque = i % 300 == 99 ? nephoscope::Opaque : 2 * tau;
      tile.add(x, y, { near, near, { opaque, opaque, opaque }, { tau, 0, 0.5F * tau } });
    }
    const auto source = tile.addSource(
      i % 5 == 0 ? nephoscope::RGB{ 0.1F, 0.2F, 0.3F } : nephoscope::RGB{ 0.4F, 0.5F, 0.6F });
    tile.addPiece(x, y, source, near, 0.5F + 0.1F * length, tau, 0.2F);
  }

  std::array<DeepTile, Parts> Tiles;
  DeepTile Whole;
};

/// What processes do: runs, what is asked about them, the answers.
struct Together
{
  explicit Together(Scene& scene)
  {
    std::array<std::vector<char>, Parts> kept;
    PixelRuns merger;
    merger.reset(Pixels);
    for (std::uint32_t part = 0; part < Parts; ++part)
    {
      std::vector<PixelRun> runs;
      scene.Tiles[part].runs(runs);
      scene.Tiles[part].pack(kept[part]);
      for (PixelRun& run : runs)
      {
        run.part = part;
        merger.add(run);
      }
    }
    this->Requests.resize(Parts);
    this->Overlapping = merger.merge(true, this->Light, this->Requests);
    this->Ask(kept);
  }

  void Ask(const std::array<std::vector<char>, Parts>& kept)
  {
    DeepTile mixed;
    mixed.reset(Extent);
    for (int part = 0; part < Parts; ++part)
    {
      DeepTile tile;
      tile.reset(Extent);
      std::vector<double> depths;
      std::vector<char> packed;
      tile.answer(kept[part].data(), kept[part].size(), this->Requests[part], depths, packed);
      auto depth = depths.begin();
      for (const PixelRequest& request : this->Requests[part])
      {
        if (!request.whole)
        {
          ASSERT_NE(depth, depths.end());
          this->Light[request.pixel].depth = *depth++;
          ++this->Depths;
        }
      }
      EXPECT_EQ(depth, depths.end());
      mixed.addPacked(packed.data(), packed.size());
    }
    std::vector<PixelLight> light;
    mixed.composite(light);
    for (const auto& requests : this->Requests)
    {
      for (const PixelRequest& request : requests)
      {
        this->Light[request.pixel] =
          request.whole ? light[request.pixel] : this->Light[request.pixel];
      }
    }
  }

  std::vector<PixelLight> Light;
  std::vector<std::vector<PixelRequest>> Requests;
  std::size_t Overlapping = 0;
  int Depths = 0;
};

void expectLightOf(DeepTile& whole, const std::vector<PixelLight>& light)
{
  std::vector<PixelLight> expected;
  whole.composite(expected);
  ASSERT_EQ(light.size(), expected.size());
  for (std::size_t p = 0; p < light.size(); ++p)
  {
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(light[p].radiance[c], expected[p].radiance[c], 5e-7) << p;
      EXPECT_NEAR(light[p].transmittance[c], expected[p].transmittance[c], 5e-7) << p;
    }
    EXPECT_TRUE(
      light[p].depth == expected[p].depth || std::abs(light[p].depth - expected[p].depth) < 2e-5)
      << p << ": " << light[p].depth << " for " << expected[p].depth;
  }
}
}

/// Each pixel's parts come in another order; no segment is asked for, some depths are.
TEST(PixelRuns, ThatFollowOneAnotherAreExact)
{
  for (const unsigned seed : { 1U, 2U, 3U })
  {
    Scene scene(true, seed);
    const Together together(scene);
    EXPECT_EQ(together.Overlapping, 0U);
    EXPECT_GT(together.Depths, 3);
    expectLightOf(scene.Whole, together.Light);
  }
}

/// Where segments of several parts interlock, all of them are asked for and mixed.
TEST(PixelRuns, ThatOverlapAreMixed)
{
  Scene scene(false, 4);
  const Together together(scene);
  EXPECT_EQ(together.Overlapping, static_cast<std::size_t>(Pixels));
  EXPECT_EQ(together.Depths, 0);
  expectLightOf(scene.Whole, together.Light);
}

namespace
{
PixelLight merged(std::initializer_list<PixelRun> runs, bool depthWanted,
  std::vector<std::vector<PixelRequest>>& requests, std::size_t& overlapping)
{
  PixelRuns merger;
  merger.reset(2);
  for (const PixelRun& run : runs)
  {
    merger.add(run);
  }
  requests.assign(3, {});
  std::vector<PixelLight> light;
  overlapping = merger.merge(depthWanted, light, requests);
  EXPECT_EQ(light.size(), 2U);
  EXPECT_EQ(light[0].transmittance[0], 1); // the pixel without runs
  return light[1];
}

PixelRun runOf(std::uint32_t part, double near, double far, float through, double depth)
{
  return { near, far, { { 1, 2, 3 }, { through, through, through }, depth }, 1, part };
}
}

/// The depth of the foremost run is its own; of another it is asked for, behind what is nearer; of a surface it is where that is.
TEST(PixelRuns, AskForDepthsThatTheyCannotKnow)
{
  std::vector<std::vector<PixelRequest>> requests;
  std::size_t overlapping = 0;
  const PixelRun thin = runOf(0, 1, 2, 0.75F, INFINITY);
  const PixelRun dense = runOf(1, 3, 5, 0.25F, 3.5);
  const PixelRun surface = runOf(2, 2, 2, 0.5F, 2);

  PixelLight light = merged({ dense, runOf(0, 6, 7, 0.1F, 6.5) }, true, requests, overlapping);
  EXPECT_EQ(light.depth, 3.5);
  EXPECT_TRUE(requests[0].empty() && requests[1].empty());

  light = merged({ dense, thin }, true, requests, overlapping);
  EXPECT_EQ(overlapping, 0U);
  EXPECT_FLOAT_EQ(light.radiance[1], 2 + 0.75F * 2);
  EXPECT_FLOAT_EQ(light.transmittance[1], 0.75F * 0.25F);
  EXPECT_TRUE(requests[0].empty());
  ASSERT_EQ(requests[1].size(), 1U);
  EXPECT_EQ(requests[1][0].pixel, 1U);
  EXPECT_EQ(requests[1][0].whole, 0U);
  EXPECT_EQ(requests[1][0].before[2], 0.75F);

  light = merged({ dense, surface, thin }, true, requests, overlapping);
  EXPECT_EQ(overlapping, 0U); // a run may end at a surface
  EXPECT_EQ(light.depth, 2);
  EXPECT_TRUE(requests[1].empty() && requests[2].empty());

  light = merged({ dense, thin }, false, requests, overlapping);
  EXPECT_TRUE(std::isinf(light.depth));
  EXPECT_TRUE(requests[1].empty());
}

TEST(PixelRuns, AskForAllThatOverlaps)
{
  std::vector<std::vector<PixelRequest>> requests;
  std::size_t overlapping = 0;
  const PixelLight light =
    merged({ runOf(0, 1, 9, 0.5F, 4), runOf(2, 3, 3, 0.5F, 3) }, true, requests, overlapping);
  EXPECT_EQ(overlapping, 1U);
  EXPECT_EQ(light.radiance[0], 0);
  for (const int part : { 0, 2 })
  {
    ASSERT_EQ(requests[part].size(), 1U);
    EXPECT_EQ(requests[part][0].whole, 1U);
  }
  EXPECT_TRUE(requests[1].empty());
}

/// Cells that meet overlap by the rounding of their lengths, in float: their runs do not.
TEST(PixelRuns, OfCellsThatMeetDoNotOverlap)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> face(2.0e7, 2.1e7); // m
  for (int i = 0; i < 1000; ++i)
  {
    std::array<double, 3> faces{ face(random), face(random), face(random) };
    std::sort(faces.begin(), faces.end());
    PixelRuns merger;
    merger.reset(1);
    for (std::uint32_t part = 0; part < 2; ++part)
    {
      DeepTile tile;
      tile.reset({ 0, 0, 1, 1 });
      tile.addPiece(0, 0, tile.addSource({ 1, 1, 1 }), faces[part],
        static_cast<float>(faces[part + 1] - faces[part]), 0.1F, 0);
      std::vector<PixelRun> runs;
      tile.runs(runs);
      runs.at(0).part = part;
      merger.add(runs[0]);
    }
    std::vector<PixelLight> light;
    std::vector<std::vector<PixelRequest>> requests(2);
    EXPECT_EQ(merger.merge(false, light, requests), 0U);
    EXPECT_NEAR(light[0].transmittance[0], std::exp(-0.2), 1e-6);
  }
}
