// SPDX-License-Identifier: BSD-3-Clause
#include "Fresnel.h"
#include "WaterWaves.h"

#include <gtest/gtest.h>

using nephoscope::fresnel;
using nephoscope::Vector3;
using nephoscope::WaterSlopes;
using nephoscope::WaterWaves;
using nephoscope::WaterWavesParameters;

namespace
{
const Vector3 None{ 0, 0, 0 };
}

TEST(WaterWaves, SlopesAreTheHeightsDerivatives)
{
  const WaterWaves sea;
  const double h = 1e-4;
  for (double x = -30; x < 30; x += 7.3)
  {
    const double y = 0.4 * x + 5;
    const WaterSlopes slopes = sea.slopes(x, y, None, None);
    EXPECT_NEAR(slopes.x, (sea.height(x + h, y) - sea.height(x - h, y)) / (2 * h), 1e-5);
    EXPECT_NEAR(slopes.y, (sea.height(x, y + h) - sea.height(x, y - h)) / (2 * h), 1e-5);
    EXPECT_EQ(slopes.xx, 0);
  }
}

TEST(WaterWaves, VarianceGoesFromWavesToRoughness)
{
  WaterWavesParameters parameters;
  parameters.windSpeed = 8;
  const WaterWaves sea(parameters);
  const double expected = 0.003 + 0.00512 * 8; // Cox and Munk
  for (double footprint : { 0.0, 0.5, 5.0, 500.0 })
  {
    double waves = 0;
    double rough = 0;
    const int n = 20000;
    for (int k = 0; k < n; ++k)
    {
      const WaterSlopes s =
        sea.slopes(13.7 * k, -7.1 * k, { footprint, 0, 0 }, { 0, footprint, 0 });
      waves += (s.x * s.x + s.y * s.y) / n;
      rough = s.xx + s.yy;
    }
    EXPECT_NEAR((waves + rough) / expected, 1, 0.02) << footprint;
    if (footprint > 100)
    {
      EXPECT_LT(waves, 1e-6);
    }
  }
}

TEST(WaterWaves, LongFootprintsSmoothAlongThemselves)
{
  WaterWavesParameters parameters;
  parameters.number = 1;
  parameters.longest = parameters.shortest = 10;
  for (std::uint32_t seed = 1; seed < 6; ++seed)
  {
    parameters.seed = seed;
    const WaterWaves sea(parameters);
    const WaterSlopes all = sea.slopes(1, 2, None, None);
    const Vector3 k = normalized(Vector3{ all.x, all.y, 0 });
    const Vector3 crest{ -k[1], k[0], 0 };
    EXPECT_NEAR(sea.slopes(1, 2, 100 * crest, None).x, all.x, 1e-9);
    EXPECT_NEAR(sea.slopes(1, 2, 100 * k, None).x, 0, 1e-9);
  }
}

TEST(WaterWaves, RepeatAfterThePeriod)
{
  WaterWavesParameters parameters;
  parameters.period = 12;
  const WaterWaves first(parameters);
  parameters.time = 12;
  const WaterWaves last(parameters);
  parameters.time = 5;
  const WaterWaves between(parameters);
  EXPECT_NEAR(last.height(3, 4), first.height(3, 4), 1e-8);
  EXPECT_GT(std::abs(between.height(3, 4) - first.height(3, 4)), 1e-3);
}

TEST(WaterSlopes, DensityIsNormalisedAboutTheMean)
{
  const WaterSlopes slopes{ 0.1, -0.05, 0.02, 0.006, 0.01 };
  double sum = 0;
  double mean = 0;
  const double d = 0.01;
  for (double x = -1; x < 1.2; x += d)
  {
    for (double y = -1; y < 1; y += d)
    {
      sum += slopes.density(x, y) * d * d;
      mean += slopes.density(x, y) * x * d * d;
    }
  }
  EXPECT_NEAR(sum, 1, 1e-6);
  EXPECT_NEAR(mean, 0.1, 1e-6);
  EXPECT_EQ(WaterSlopes().density(0, 0), 0);
}

TEST(Fresnel, HasItsKnownValues)
{
  EXPECT_NEAR(fresnel(1, 1.34), std::pow(0.34 / 2.34, 2), 1e-15);
  EXPECT_NEAR(fresnel(0, 1.34), 1, 1e-15);
  EXPECT_NEAR(fresnel(0.3, 1), 0, 1e-30);
  // At Brewster's angle, tan = n, one polarisation is gone; of the other ((n^2 - 1) / (n^2 + 1))^2 is reflected.
  const double n = 1.5;
  EXPECT_NEAR(fresnel(1 / std::sqrt(1 + n * n), n), 0.5 * std::pow(1.25 / 3.25, 2), 1e-15);
}
