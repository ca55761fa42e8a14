// SPDX-License-Identifier: BSD-3-Clause
#include "VerticalCoordinate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace nephoscope;

TEST(VerticalCoordinate, BothSpellingsOfHybridPressureAgree)
{
  // CAM6's level 19 of 32: hyam 0.1682300898, hybm 0.019677, at three surface pressures.
  for (double ps : { 52000.0, 101325.0, 104000.0 })
  {
    const double expected = 0.1682300898 * 1e5 + 0.019677 * ps;
    EXPECT_NEAR(hybridPressure(0.1682300898, 1e5, 0.019677, ps), expected, 1e-12 * expected);
    EXPECT_NEAR(hybridPressure(16823.00898, 0.019677, ps), expected, 1e-12 * expected);
  }
}

TEST(VerticalCoordinate, SigmaRunsFromTopToSurface)
{
  EXPECT_EQ(sigmaPressure(0, 5000, 101325), 5000);
  EXPECT_EQ(sigmaPressure(1, 5000, 101325), 101325);
  EXPECT_EQ(sigmaPressure(0.5, 0, 100000), 50000);
}

TEST(VerticalCoordinate, LnPressureFallsByAFactorOfEPerUnit)
{
  EXPECT_EQ(lnPressure(1e5, 0), 1e5);
  EXPECT_NEAR(lnPressure(1e5, 1) * std::exp(1.0), 1e5, 1e-9);
}

TEST(VerticalCoordinate, HeightCoordinatesReduceToTheirTerms)
{
  EXPECT_EQ(hybridHeight(20, 0.9977, 0), 20);
  EXPECT_DOUBLE_EQ(hybridHeight(20, 0.5, 400), 220);
  EXPECT_EQ(sleveHeight(1, 30000, 0, 500, 0, 200), 30000);
  EXPECT_EQ(sleveHeight(0, 30000, 1, 500, 1, 200), 700);
}

TEST(VerticalCoordinate, SleveWithHyperbolicDecayJoinsGroundAndTop)
{
  // Schaer et al. 2002 eq. 9: b_i = sinh((ztop - Z)/s_i) / sinh(ztop/s_i), a = Z/ztop; levels must not cross.
  const double ztop = 30000;
  double below = -1;
  for (int k = 0; k <= 60; ++k)
  {
    const double level = ztop * k / 60;
    const double b1 = std::sinh((ztop - level) / 15000) / std::sinh(ztop / 15000);
    const double b2 = std::sinh((ztop - level) / 2500) / std::sinh(ztop / 2500);
    const double z = sleveHeight(level / ztop, ztop, b1, 1200, b2, -300);
    EXPECT_GT(z, below);
    below = z;
    if (k == 0)
    {
      EXPECT_NEAR(z, 900, 1e-9);
    }
  }
  EXPECT_NEAR(below, ztop, 1e-9);
}

TEST(VerticalCoordinate, VapourLightensAir)
{
  EXPECT_EQ(virtualTemperature(300, 0), 300);
  EXPECT_NEAR(virtualTemperature(300, 0.02), 300 * (1 + 0.608 * 0.02), 0.005); // 0.608: textbooks
}

TEST(VerticalCoordinate, PotentialTemperatureIsTemperatureAt1000hPa)
{
  EXPECT_DOUBLE_EQ(temperatureOfPotential(290, 1e5), 290);
  EXPECT_NEAR(temperatureOfPotential(300, 5e4), 300 * std::pow(0.5, 0.285714), 1e-3);
}

namespace
{
/// Height at the top of `n` layers spaced in ln p from ps to ps/e^2, Tv = T0 (p/ps)^x: z = Rd T0 (1 - (p/ps)^x) / (g x).
double hypsometricError(std::size_t n)
{
  const double x = 0.19;
  const double ps = 101325;
  std::vector<double> p(n + 1);
  std::vector<double> tv(n + 1);
  std::vector<double> z(n + 1);
  for (std::size_t k = 0; k <= n; ++k)
  {
    p[k] = ps * std::exp(-2.0 * static_cast<double>(k) / static_cast<double>(n));
    tv[k] = 288 * std::pow(p[k] / ps, x);
  }
  hypsometricHeights(n + 1, p.data(), tv.data(), ps, 0, z.data());
  const double exact = DryAirGasConstant * 288 * (1 - std::exp(-2 * x)) / (StandardGravity * x);
  return std::abs(z[n] - exact);
}
}

TEST(HypsometricHeights, IsothermalIsExact)
{
  const double p[] = { 100000, 70000, 5000, 100 };
  const double tv[] = { 250, 250, 250, 250 };
  double z[4];
  hypsometricHeights(4, p, tv, 98000, 123, z);
  for (int k = 0; k < 4; ++k)
  {
    EXPECT_NEAR(
      z[k], 123 + DryAirGasConstant * 250 / StandardGravity * std::log(98000 / p[k]), 1e-8);
  }
  EXPECT_LT(z[0], 123); // under the ground
}

TEST(HypsometricHeights, ConstantLapseRateConvergesAtSecondOrder)
{
  const double order = std::log2(hypsometricError(20) / hypsometricError(40));
  EXPECT_NEAR(order, 2, 0.05);
  EXPECT_LT(hypsometricError(40), 1); // m, of 13 km
}

TEST(StandardAtmosphere, PublishedValues)
{
  // US Standard Atmosphere 1976, table I: geopotential height, m; temperature, K; pressure, Pa.
  const double published[][3] = { { 0, 288.15, 101325 }, { 5000, 255.65, 54019.9 },
    { 11000, 216.65, 22632.06 }, { 20000, 216.65, 5474.889 }, { 32000, 228.65, 868.0187 },
    { 47000, 270.65, 110.9063 }, { 51000, 270.65, 66.93887 }, { 71000, 214.65, 3.956420 },
    { 84852, 186.946, 0.3733836 } };
  for (const auto& row : published)
  {
    EXPECT_NEAR(standardTemperature(row[0]), row[1], 1e-3) << row[0];
    EXPECT_NEAR(standardPressure(row[0]), row[2], 3e-6 * row[2]) << row[0];
    EXPECT_NEAR(standardHeight(row[2]), row[0], 0.05) << row[0];
  }
}

TEST(StandardAtmosphere, InverseIsExactAndMonotonicPastBothEnds)
{
  double above = 2e5;
  for (double z = -5000; z < 120000; z += 777)
  {
    const double p = standardPressure(z);
    EXPECT_LT(p, above);
    above = p;
    EXPECT_NEAR(standardHeight(p), z, 1e-5);
  }
  EXPECT_TRUE(std::isfinite(standardHeight(0)));
  EXPECT_TRUE(std::isfinite(standardPressure(1e9)));
  EXPECT_TRUE(std::isfinite(standardPressure(-1e6)));
}

TEST(Saturation, PublishedValues)
{
  // Murphy and Koop 2005 (Q. J. R. Meteorol. Soc. 131, 1539), tables C1 (ice) and C2 (liquid).
  const double ice[][2] = { { 150, 6.106e-6 }, { 180, 0.0053975 }, { 210, 0.70202 },
    { 240, 27.272 }, { 273.15, 611.154 }, { 273.16, 611.657 } };
  for (const auto& row : ice)
  {
    EXPECT_NEAR(saturationPressureIce(row[0]), row[1], 1e-4 * row[1]) << row[0];
  }
  const double water[][2] = { { 180, 0.011239 }, { 210, 1.2335 }, { 240, 37.667 },
    { 273.15, 611.213 }, { 273.16, 611.657 }, { 300, 3536.8 } };
  for (const auto& row : water)
  {
    EXPECT_NEAR(saturationPressureWater(row[0]), row[1], 1e-4 * row[1]) << row[0];
  }
}

TEST(Saturation, HumidityReachesOneWhereWaterBoils)
{
  EXPECT_EQ(saturationHumidity(700, 600), 1);
  EXPECT_NEAR(saturationHumidity(611.2, 101325), 0.00376, 1e-5);
}

TEST(XuRandall, FollowsEquation1)
{
  // By hand at RH 0.8, warm: q* from 1000 Pa of vapour at 900 hPa is set through q, T free of it.
  const double t = 285;
  const double p = 9e4;
  const double qs = saturationHumidity(saturationPressureWater(t), p);
  const double expected =
    std::pow(0.8, 0.25) * (1 - std::exp(-100 * 1e-4 / std::pow(0.2 * qs, 0.49)));
  EXPECT_NEAR(cloudFractionXuRandall(1e-4, 0, 0.8 * qs, t, p), expected, 1e-12);
}

TEST(XuRandall, Limits)
{
  const double qs = saturationHumidity(saturationPressureWater(285), 9e4);
  EXPECT_EQ(cloudFractionXuRandall(0, 0, qs, 285, 9e4), 0);
  EXPECT_EQ(cloudFractionXuRandall(-1e-9, 0, 2 * qs, 285, 9e4), 0);
  EXPECT_EQ(cloudFractionXuRandall(1e-6, 0, qs * 1.001, 285, 9e4), 1);
  EXPECT_EQ(cloudFractionXuRandall(1e-4, 0, 0, 285, 9e4), 0);
  double last = 0;
  for (double qc = 1e-9; qc < 1e-2; qc *= 3) // grows with condensate, never past 1
  {
    const double c = cloudFractionXuRandall(0.5 * qc, 0.5 * qc, 0.7 * qs, 285, 9e4);
    EXPECT_GE(c, last);
    EXPECT_LE(c, 1);
    last = c;
  }
  // Ice is saturated at less vapour: the same air is cloudier over ice.
  const double q = 0.6 * saturationHumidity(saturationPressureWater(235), 3e4);
  EXPECT_GT(
    cloudFractionXuRandall(0, 1e-5, q, 235, 3e4), cloudFractionXuRandall(1e-5, 0, q, 235, 3e4));
}
