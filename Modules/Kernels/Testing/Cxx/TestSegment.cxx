// SPDX-License-Identifier: BSD-3-Clause
#include "Segment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using nephoscope::composite;
using nephoscope::Opaque;
using nephoscope::PixelLight;
using nephoscope::Segment;

namespace
{
/// A uniform medium that glows with `source`: L = source (1 - exp(-tau)).
Segment uniform(double near, double far, float tau, float source)
{
  const float light = source * static_cast<float>(-std::expm1(-tau));
  return { near, far, { tau, tau, tau }, { light, light, light } };
}

Segment surface(double distance, float opacity, float colour)
{
  const float tau = -std::log1p(-opacity);
  return { distance, distance, { tau, tau, tau },
    { opacity * colour, opacity * colour, opacity * colour } };
}

PixelLight compositeOf(std::vector<Segment> segments)
{
  return composite(segments);
}
}

TEST(Segment, NothingLetsAllThrough)
{
  const PixelLight light = compositeOf({});
  EXPECT_EQ(light.radiance[0], 0);
  EXPECT_EQ(light.transmittance[2], 1);
  EXPECT_TRUE(std::isinf(light.depth));
}

TEST(Segment, SurfacesCompositeByMaxEquation1InAnyOrderOfArrival)
{
  // 0.4 * 1 + 0.6 * (0.5 * 0.2): front surface opacity 0.4 white, behind it opacity 0.5 grey 0.2.
  for (bool swap : { false, true })
  {
    std::vector<Segment> segments = { surface(1, 0.4F, 1), surface(2, 0.5F, 0.2F) };
    if (swap)
    {
      std::swap(segments[0], segments[1]);
    }
    const PixelLight light = composite(segments);
    EXPECT_NEAR(light.radiance[1], 0.46, 1e-7);
    EXPECT_NEAR(light.transmittance[1], 0.3, 1e-7);
    EXPECT_EQ(light.depth, 2); // 0.6 after the first, 0.3 after the second
  }
}

TEST(Segment, OpaqueSurfaceHidesWhatLiesBehind)
{
  Segment ground{ 5, 5, { Opaque, Opaque, Opaque }, { 0.25F, 0.5F, 0.75F } };
  const PixelLight light = compositeOf({ uniform(6, 7, 3, 9), ground });
  EXPECT_EQ(light.radiance[0], 0.25F);
  EXPECT_EQ(light.radiance[2], 0.75F);
  EXPECT_EQ(light.transmittance[0], 0);
  EXPECT_EQ(light.depth, 5);
}

TEST(Segment, SurfaceInsideAVolumeSplitsIt)
{
  // By hand: volume [0, 4] tau 2 source 0.5; surface at 1 opacity 0.25 colour 0.8.
  const double before = std::exp(-0.5);
  const double behind = std::exp(-1.5);
  const double expected = 0.5 * (1 - before) + before * (0.25 * 0.8 + 0.75 * (0.5 * (1 - behind)));
  const PixelLight light = compositeOf({ uniform(0, 4, 2, 0.5F), surface(1, 0.25F, 0.8F) });
  EXPECT_NEAR(light.radiance[0], expected, 1e-7);
  EXPECT_NEAR(light.transmittance[0], 0.75 * std::exp(-2.0), 1e-7);
}

TEST(Segment, SurfaceInsideALinearMediumSplitsItWhereItsOpticalDepthIs)
{
  // Extinction from 0.2 at 10 to 1.0 at 12, source 1: 0.2 + 0.2 = 0.4 up to 11, where a surface lets half through.
  Segment medium = uniform(10, 12, 1.2F, 1);
  medium.skew = (1.0F - 0.2F) / (1.0F + 0.2F);
  const PixelLight light = compositeOf({ medium, surface(11, 0.5F, 3) });
  const double before = std::exp(-0.4);
  EXPECT_NEAR(light.radiance[0], 1 - before + before * (1.5 + 0.5 * (1 - std::exp(-0.8))), 1e-6);
  EXPECT_NEAR(light.transmittance[0], 0.5 * std::exp(-1.2), 1e-7);
}

TEST(Segment, OverlappingUniformMediaMixExactly)
{
  // [0,2] sigma 1 source 1 and [1,3] sigma 3 source 0: between 1 and 2 sigma 4, source 1/4.
  const double t01 = std::exp(-1.0);
  const double t12 = std::exp(-4.0);
  const double expected = (1 - t01) + t01 * 0.25 * (1 - t12);
  const PixelLight light = compositeOf({ uniform(1, 3, 6, 0), uniform(0, 2, 2, 1) });
  EXPECT_NEAR(light.radiance[0], expected, 1e-7);
  EXPECT_NEAR(light.transmittance[0], std::exp(-8.0), 1e-9);
}

TEST(Segment, SplittingASegmentChangesNothing)
{
  // A clear segment inside forces the split.
  for (float tau : { 0.0F, 1e-12F, 1e-6F, 0.1F, 1.0F, 30.0F, 1e6F })
  {
    const Segment whole = uniform(1, 3, tau, 2);
    const PixelLight plain = compositeOf({ whole });
    const PixelLight split = compositeOf({ whole, uniform(1.3, 2.1, 0, 0) });
    EXPECT_NEAR(split.radiance[0], plain.radiance[0], 4e-7 * plain.radiance[0]) << tau;
    EXPECT_NEAR(split.transmittance[0], plain.transmittance[0], 1e-7) << tau;
  }
}

TEST(Segment, GlowWithoutExtinctionAddsUp)
{
  Segment glow{ 0, 2, { 0, 0, 0 }, { 3, 3, 3 } };
  const PixelLight light = compositeOf({ glow, uniform(0.5, 1.0, 0, 0), surface(1.5, 0.5F, 0) });
  EXPECT_NEAR(light.radiance[0], 3 * 0.75 + 0.5 * 3 * 0.25, 1e-6);
}

TEST(Segment, EyeInsideASegmentCutsOffThePartBehind)
{
  const PixelLight light = compositeOf({ uniform(-1, 1, 2, 1) });
  EXPECT_NEAR(light.transmittance[0], std::exp(-1.0), 1e-7);
  EXPECT_NEAR(light.radiance[0], 1 - std::exp(-1.0), 1e-7);
  EXPECT_EQ(compositeOf({ uniform(-3, -1, 2, 1), surface(-1, 0.5F, 1) }).transmittance[0], 1);
}

TEST(Segment, InfinitelyDenseLengthActsAsASurface)
{
  Segment wall{ 2, 4, { Opaque, Opaque, Opaque }, { 1, 1, 1 } };
  const PixelLight light = compositeOf({ wall, uniform(1, 3, 2, 0) });
  EXPECT_NEAR(light.radiance[0], std::exp(-1.0), 1e-6);
  EXPECT_EQ(light.transmittance[0], 0);
}

TEST(Segment, UnusableSegmentsAreDropped)
{
  const double nan = std::nan("");
  const float nanf = std::nanf("");
  const PixelLight light = compositeOf({ { nan, 1, {}, {} }, { 0, nan, { 1, 1, 1 }, {} },
    { 0, 1, { nanf, 0, 0 }, {} }, { 0, 1, { -1, 0, 0 }, {} }, { 2, 1, { 1, 1, 1 }, {} },
    { 0, 1, {}, { nanf, 0, 0 } }, surface(1, 0.5F, 1) });
  EXPECT_NEAR(light.radiance[0], 0.5, 1e-7);
  EXPECT_NEAR(light.transmittance[0], 0.5, 1e-7);
}

TEST(Segment, ManyOverlapsAgreeWithFineSlices)
{
  // 200 random uniform segments against slices between all their ends.
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0, 10);
  std::vector<Segment> segments;
  std::vector<double> ends;
  std::vector<double> sources;
  for (int i = 0; i < 200; ++i)
  {
    const double a = place(random);
    const double b = place(random);
    sources.push_back(place(random) / 10);
    segments.push_back(uniform(std::min(a, b), std::max(a, b),
      static_cast<float>(place(random) / 100), static_cast<float>(sources.back())));
    ends.insert(ends.end(), { a, b });
  }
  std::sort(ends.begin(), ends.end());
  double radiance = 0;
  double transmittance = 1;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k)
  {
    double sigma = 0;
    double emission = 0;
    for (std::size_t i = 0; i < segments.size(); ++i)
    {
      const Segment& s = segments[i];
      if (s.nearEnd <= ends[k] && s.farEnd >= ends[k + 1])
      {
        const double own = s.opticalDepth[0] / (s.farEnd - s.nearEnd);
        sigma += own;
        emission += own * sources[i];
      }
    }
    const double t = std::exp(-sigma * (ends[k + 1] - ends[k]));
    radiance += sigma > 0 ? transmittance * emission / sigma * (1 - t) : 0;
    transmittance *= t;
  }
  const PixelLight light = composite(segments);
  EXPECT_NEAR(light.radiance[0], radiance, 1e-6);
  EXPECT_NEAR(light.transmittance[0], transmittance, 1e-7);
}

TEST(Segment, DepthIsWhereHalfIsLetThrough)
{
  EXPECT_NEAR(compositeOf({ uniform(10, 12, 2, 0) }).depth, 10 + std::log(2.0), 1e-6);
  EXPECT_TRUE(std::isinf(compositeOf({ uniform(10, 12, 0.5F, 0) }).depth));
  // Where what is let through is next to nothing, or is nothing as far as numbers go.
  for (const float tau : { 700.0F, 715.0F, 740.0F, 1e6F })
  {
    EXPECT_NEAR(compositeOf({ uniform(10, 12, tau, 0) }).depth, 10 + 2 * std::log(2.0) / tau, 1e-7);
  }
}

/// Extinction from 0 to 1 at the far end, over 2: the optical depth is x^2 / 4. Alone, and with another that falls as it rises.
TEST(Segment, DepthIsAfterLinearExtinction)
{
  Segment rising = uniform(10, 12, 1, 0);
  rising.skew = 1;
  EXPECT_NEAR(compositeOf({ rising }).depth, 10 + 2 * std::sqrt(std::log(2.0)), 1e-6);
  Segment falling = rising;
  falling.skew = -1;
  EXPECT_NEAR(compositeOf({ rising, falling }).depth, 10 + std::log(2.0), 1e-6);
  Segment earlier =
    uniform(9, 11, 1, 0); // of the half that is common: 0.5 x + 0.25 x^2 = ln 2 - 0.5
  EXPECT_NEAR(
    compositeOf({ rising, earlier }).depth, 10 - 1 + 2 * std::sqrt(std::log(2.0) - 0.25), 1e-6);
}

/// A medium that thins out to nothing and lets through half of the light, to the last bit, at its very end: how long it has to be for that
/// is found by halving.
TEST(Segment, DepthIsTheFarEndOfAMediumThatJustHidesHalf)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<float> opacity(0.01F, 0.45F);
  for (int n = 0; n < 300; ++n)
  {
    const Segment before = surface(0, opacity(random), 1);
    const auto depthFrom = [&before](double nearEnd)
    {
      Segment thinning = uniform(nearEnd, 2, 1, 0);
      thinning.skew = -1;
      return compositeOf({ before, thinning }).depth; // of what lies before the eye
    };
    double hidesHalf = 0;
    double hidesLess = -10;
    for (int halving = 0; halving < 60; ++halving)
    {
      const double middle = 0.5 * (hidesHalf + hidesLess);
      (std::isinf(depthFrom(middle)) ? hidesLess : hidesHalf) = middle;
    }
    ASSERT_TRUE(std::isinf(depthFrom(hidesLess)));
    EXPECT_NEAR(depthFrom(hidesHalf), 2, 1e-6) << n;
  }
}

TEST(PlaceOf, EndsAreMetThroughRounding)
{
  for (const double skew : { -1.0, std::nextafter(-1.0, -2.0), -0.3, 0.0, 1.0 })
  {
    EXPECT_EQ(nephoscope::placeOf(0, skew), 0) << skew;
    EXPECT_NEAR(nephoscope::placeOf(1, skew), 1, 1e-7) << skew;
    EXPECT_NEAR(nephoscope::placeOf(std::nextafter(1.0, 2.0), skew), 1, 1e-7) << skew;
  }
}

TEST(TransmittedMean, JoinsSeriesAndFormula)
{
  for (double x : { 0.0, 1e-12, 1e-6, 0.99e-5, 1.01e-5, 1e-3, 1.0, 700.0, 1e6 })
  {
    const double exact = x == 0 ? 1 : static_cast<double>(-std::expm1l(-(long double)x) / x);
    EXPECT_NEAR(nephoscope::transmittedMean(x), exact, 1e-15) << x;
  }
  EXPECT_EQ(nephoscope::transmittedMean(std::numeric_limits<double>::infinity()), 0);
}
