// SPDX-License-Identifier: BSD-3-Clause
#include "Optics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace nephoscope;

TEST(Optics, ExtinctionIsTheCrossSectionOfTheDropletsOfAVolume)
{
  // N droplets of radius r in a cubic metre: N pi r^2 Q against the water's mass N 4/3 pi r^3 rho.
  const double r = 7e-6;
  const double n = 2e8;
  const double pi = std::acos(-1.0);
  const double air = 0.8;
  const double q = n * 4 / 3 * pi * r * r * r * LiquidWaterDensity / air;
  EXPECT_NEAR(condensateExtinctionPerMeter(q, air, { 1.9, r, LiquidWaterDensity }),
    1.9 * n * pi * r * r, 1e-12);
}

TEST(Optics, AirDensityIsThatOfTheStandardAtmosphere)
{
  // US Standard Atmosphere 1976, table 1, geopotential height.
  EXPECT_NEAR(standardAirDensity(0), 1.2250, 1e-4);
  EXPECT_NEAR(standardAirDensity(5000), 0.73612, 1e-4);
  EXPECT_NEAR(standardAirDensity(11000), 0.36392, 1e-4);
  EXPECT_NEAR(airDensity(101325, 288.15), 1.2250, 1e-4);
}

TEST(Optics, UnusableExtinctionsHaveADefinedAnswer)
{
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(usableExtinction(-2), 0);
  EXPECT_EQ(usableExtinction(-infinity), 0);
  EXPECT_EQ(usableExtinction(infinity), DensestExtinction);
  EXPECT_EQ(usableExtinction(1e300), DensestExtinction);
  EXPECT_TRUE(std::isnan(usableExtinction(std::nan(""))));
  EXPECT_EQ(usableExtinction(0.25), 0.25F);
}
