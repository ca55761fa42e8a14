// SPDX-License-Identifier: BSD-3-Clause
#include "FitDensity.h"

#include "FitModel.h"

#include <ceres/jet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

using namespace nephoscope;
using testing::HasSubstr;

namespace
{
using Term = std::array<double, GaussianParts>;

std::vector<double> evenly(int points, double low, double high)
{
  std::vector<double> all;
  for (int i = 0; i < points; ++i)
  {
    all.push_back(low + (high - low) * i / (points - 1));
  }
  return all;
}

/// A sum of Gaussians at the points of a grid.
DensityGrid gridOf(
  const std::array<std::vector<double>, 3>& coordinates, const std::vector<Term>& terms)
{
  std::vector<double> values;
  for (const double z : coordinates[2])
  {
    for (const double y : coordinates[1])
    {
      for (const double x : coordinates[0])
      {
        const double place[] = { x, y, z };
        values.push_back(0);
        for (const Term& term : terms)
        {
          values.back() += gaussianDensity(term.data(), place);
        }
      }
    }
  }
  return { coordinates, values };
}

Term layer(double amplitude, double height, double width)
{
  return { amplitude, 0, 0, height, 0, 0, 0, 0, 0, 1 / width };
}

/// Cloud of even density from 1000 m to 1500 m, on levels of uneven distances.
DensityGrid evenCloud()
{
  const std::vector<double> z{ 0, 400, 800, 990, 1000, 1100, 1250, 1400, 1500, 1510, 2000, 3000 };
  std::vector<double> values;
  for (const double height : z)
  {
    values.push_back(height >= 1000 && height <= 1500 ? 0.02 : 0);
  }
  return { { { { 0 }, { 0 }, z } }, values };
}

const Fit& named(const std::vector<Fit>& fits, const std::string& name)
{
  static const Fit none;
  for (const Fit& fit : fits)
  {
    if (fit.name == name)
    {
      return fit;
    }
  }
  ADD_FAILURE() << "no fit " << name;
  return none;
}

std::string errorOf(const DensityGrid& grid, const DensityFitSettings& settings)
{
  try
  {
    fitDensity(grid, settings);
  }
  catch (const FitError& error)
  {
    return error.what();
  }
  return "no error";
}
}

// Of line integrals by the ten numbers of a term: Jets against central differences, ends finite and not, near and in tails.
TEST(FitDensity, DerivativesMeetDifferences)
{
  const Term pill{ 0.02, 100, -50, 900, 1.0 / 80, 0.006, -0.004, 1.0 / 150, 0.003, 1.0 / 40 };
  const double end = std::numeric_limits<double>::infinity();
  const DensityRay rays[] = { { { 80, -20, 930 }, { 0.6, 0, 0.8 }, -end, end },
    { { 80, -20, 930 }, { 0.6, -0.8, 0 }, 30, 90 }, { { 80, -20, 930 }, { 0, 1, 0 }, 150, end },
    { { 80, -20, 930 }, { 0, 1, 0 }, 10, 10.001 } };
  for (const DensityRay& ray : rays)
  {
    const auto kernel = [&ray](const double*, const auto* p)
    { return gaussianLineIntegral(p, ray); };
    double exact[GaussianParts];
    double differences[GaussianParts];
    const double value =
      differentiated<ceres::Jet<double, GaussianParts>>(kernel)(nullptr, pill.data(), exact);
    EXPECT_EQ(byDifferences(GaussianParts, kernel)(nullptr, pill.data(), differences), value);
    for (int i = 0; i < GaussianParts; ++i)
    {
      EXPECT_NEAR(exact[i], differences[i], 1e-6 * std::abs(exact[i]) + 1e-7 * value) << i;
    }
  }
}

// Two layers that overlap come back as two, with their heights and widths.
TEST(FitDensity, FindsTheLayersOfAColumn)
{
  const std::vector<Term> truth{ layer(0.02, 1500, 300), layer(0.03, 4000, 500) };
  const DensityGrid grid = gridOf({ { { 0 }, { 0 }, evenly(201, 0, 7000) } }, truth);
  const std::vector<Fit> fits = fitDensity(grid, { 0.002, 8 });
  ASSERT_EQ(fits.size(), 3U + 2U);
  const Fit& upper = named(fits, "Gaussian 1"); // of more mass
  ASSERT_EQ(upper.parameters.size(), 3U);
  EXPECT_NEAR(upper.value("z"), 4000, 2);
  EXPECT_NEAR(1 / upper.value("m22"), 500, 2);
  EXPECT_NEAR(upper.value("a"), 0.03, 1e-4);
  EXPECT_NEAR(named(fits, "Gaussian 2").value("z"), 1500, 2);
  EXPECT_LT(named(fits, "sum").heldOut.rms, 0.002);
  EXPECT_EQ(named(fits, "sum").heldOut.cases, 400);
  EXPECT_LT(named(fits, "density").heldOut.rms, 0.002);
  EXPECT_NEAR(named(fits, "mass").heldOut.bias, 0, 1e-3);
  EXPECT_EQ(whatIsWrong({ "density", "", fits }), "");
}

// Two slanted pills in a box that is not a cube come back as two; line integrals, densities and mass are right.
TEST(FitDensity, FindsTheBlobsOfAVolume)
{
  const std::vector<Term> truth{ { 0.02, -300, 100, 900, 1.0 / 200, 0.003, -0.002, 1.0 / 250, 0.002,
                                   1.0 / 90 },
    { 0.03, 400, -200, 1100, 1.0 / 150, 0, 0, 1.0 / 150, 0, 1.0 / 120 } };
  const DensityGrid grid =
    gridOf({ { evenly(49, -1200, 1200), evenly(41, -1000, 1000), evenly(45, 400, 1600) } }, truth);
  const std::vector<Fit> fits = fitDensity(grid, { 0.01, 8 });
  EXPECT_EQ(fits.size(), 3U + 2U);
  const std::array<double, GaussianParts> first = gaussianOf(named(fits, "Gaussian 1"));
  EXPECT_NEAR(first[GaussianX], -300, 5);
  EXPECT_NEAR(first[GaussianY], 100, 5);
  EXPECT_NEAR(first[GaussianZ], 900, 5);
  EXPECT_LT(named(fits, "sum").heldOut.rms, 0.01);
  EXPECT_LT(named(fits, "density").heldOut.rms, 0.02);
  EXPECT_NEAR(named(fits, "mass").heldOut.bias, 0, 0.01);
}

// Sharp edges: the smaller the tolerance, the more Gaussians, none of which can be left out.
TEST(FitDensity, TakesAsManyAsTheToleranceAsksFor)
{
  std::size_t before = 0;
  for (const double tolerance : { 0.2, 0.02, 0.005 })
  {
    const std::vector<Fit> fits = fitDensity(evenCloud(), { tolerance, 16 });
    const std::size_t count = fits.size() - 3;
    EXPECT_GT(count, before) << tolerance;
    EXPECT_LE(named(fits, "sum").heldOut.rms, tolerance);
    EXPECT_THAT(errorOf(evenCloud(), { tolerance, static_cast<int>(count) - 1 }),
      HasSubstr(count > 1 ? "is not met" : "the number of Gaussians"));
    before = count;
  }
}

TEST(FitDensity, GivesTheSameBitsAgain)
{
  const std::vector<Fit> once = fitDensity(evenCloud(), { 0.02, 16 });
  const std::vector<Fit> again = fitDensity(evenCloud(), { 0.02, 16 });
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i)
  {
    EXPECT_EQ(once[i].covariance, again[i].covariance);
    EXPECT_EQ(once[i].heldOut.rms, again[i].heldOut.rms);
  }
}

TEST(FitDensity, SaysWhatIsWrong)
{
  EXPECT_THAT(errorOf(evenCloud(), { 1e-4, 2 }),
    HasSubstr("density: the tolerance 0.0001 is not met; 2 Gaussians reach 0.0"));
  const DensityGrid none({ { { 0 }, { 0 }, { 0, 1, 2 } } }, { 0, 0, 0 });
  EXPECT_EQ(errorOf(none, {}), "density: it is 0 everywhere; there is nothing to put Gaussians to");
  const DensityGrid negative({ { { 0 }, { 0 }, { 0, 1, 2 } } }, { 0, -1, 0 });
  EXPECT_THAT(errorOf(negative, {}), HasSubstr("the density of point 1 is -1"));
  const DensityGrid point({ { { 0 }, { 0 }, { 0 } } }, { 1 });
  EXPECT_THAT(errorOf(point, {}), HasSubstr("it has but one point"));
  EXPECT_THAT(errorOf(evenCloud(), { 0, 2 }), HasSubstr("the tolerance has to be above 0"));
  EXPECT_THAT(errorOf(evenCloud(), { std::nan(""), 2 }), HasSubstr("tolerance has to be above"));
  EXPECT_THAT(errorOf(evenCloud(), { 0.1, 0 }), HasSubstr("has to be 1 to 100"));
}

// The end of the work that progress asks for comes with an error, as the tolerance is not met.
TEST(FitDensity, CanBeEnded)
{
  int calls = 0;
  const auto once = [&calls](double) { return ++calls < 1; };
  EXPECT_THROW(fitDensity(evenCloud(), { 0.005, 16 }, once), FitError);
  EXPECT_EQ(calls, 1);
}
