// SPDX-License-Identifier: BSD-3-Clause
#include "DensityGrid.h"
#include "GaussLegendre.h"
#include "GaussianDensity.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

using namespace nephoscope;

namespace
{
using Term = std::array<double, GaussianParts>;

constexpr double Endless = std::numeric_limits<double>::infinity();

/// A slanted pill: three different widths, none along an axis.
constexpr Term Pill{ 0.02, 100, -50, 900, 1.0 / 80, 0.006, -0.004, 1.0 / 150, 0.003, 1.0 / 40 };
constexpr Term Ball{ 0.01, 0, 0, 0, 0.01, 0, 0, 0.01, 0, 0.01 };
constexpr Term Layer{ 0.01, 0, 0, 500, 0, 0, 0, 0, 0, 0.01 };

DensityRay rayOf(std::array<double, 3> origin, std::array<double, 3> along, double from, double to)
{
  const double norm = std::hypot(along[0], along[1], along[2]);
  return { { origin[0], origin[1], origin[2] },
    { along[0] / norm, along[1] / norm, along[2] / norm }, from, to };
}

double byQuadrature(const Term& term, const DensityRay& ray, double from, double to)
{
  double sum = 0;
  for (const QuadraturePoint& t : gaussLegendrePanels(400, 8, from, to))
  {
    const double place[] = { ray.origin[0] + t.x * ray.direction[0],
      ray.origin[1] + t.x * ray.direction[1], ray.origin[2] + t.x * ray.direction[2] };
    sum += t.weight * gaussianDensity(term.data(), place);
  }
  return sum;
}
}

// Stretches that begin and end before, in and behind a slanted pill; those of tails keep their digits.
TEST(GaussianDensity, IsIntegratedInClosedForm)
{
  for (const std::array<double, 3>& along : { std::array<double, 3>{ 1, 0, 0 },
         std::array<double, 3>{ 0, 0, -1 }, std::array<double, 3>{ 2, -3, 1 } })
  {
    for (const double from : { -700.0, -60.0, 0.0, 30.0, 350.0 })
    {
      for (const double to : { from + 0.01, from + 20, from + 700 })
      {
        const DensityRay ray = rayOf({ 80, -20, 930 }, along, from, to);
        const double truth = byQuadrature(Pill, ray, from, to);
        EXPECT_NEAR(gaussianLineIntegral(Pill.data(), ray), truth, 1e-10 * truth + 1e-300)
          << along[0] << ' ' << from << ' ' << to;
      }
    }
  }
}

// Through a ball's centre all the way: a sqrt(2 pi) s; half the way, half of it. Beside it by one s: exp(-1/2) of it.
TEST(GaussianDensity, KnowsItsWholeAndItsHalf)
{
  const double whole = 0.01 * std::sqrt(2 * 3.14159265358979323846) * 100;
  const std::array<double, 3> along{ 1, 2, -2 };
  EXPECT_NEAR(
    gaussianLineIntegral(Ball.data(), rayOf({ 0, 0, 0 }, along, -Endless, Endless)), whole, 1e-14);
  EXPECT_NEAR(
    gaussianLineIntegral(Ball.data(), rayOf({ 0, 0, 0 }, along, 0, Endless)), whole / 2, 1e-14);
  EXPECT_NEAR(
    gaussianLineIntegral(Ball.data(), rayOf({ 0, 0, 0 }, along, -Endless, 0)), whole / 2, 1e-14);
  const DensityRay beside = rayOf({ 100, 0, 0 }, { 0, 1, 0 }, -Endless, Endless);
  EXPECT_NEAR(gaussianLineIntegral(Ball.data(), beside), whole * std::exp(-0.5), 1e-14);
  EXPECT_EQ(gaussianLineIntegral(Ball.data(), rayOf({ 0, 0, 0 }, along, 5, 5)), 0);
}

// From a million metres away, and a million metres past it: 12 digits of the whole, and nothing, never NaN.
TEST(GaussianDensity, IsSeenFromFarAway)
{
  const DensityRay far = rayOf({ -1e6, 0, 0 }, { 1, 0, 0 }, 0, Endless);
  EXPECT_NEAR(gaussianLineIntegral(Ball.data(), far) / 2.5066282746310002, 1, 1e-12);
  EXPECT_EQ(gaussianLineIntegral(Ball.data(), rayOf({ 1e6, 0, 0 }, { 1, 0, 0 }, 0, Endless)), 0);
  EXPECT_EQ(gaussianLineIntegral(Ball.data(), rayOf({ 0, 1e8, 0 }, { 1, 0, 0 }, 0, 1e9)), 0);
  // Nine widths out and on: a tail of 1.1e-19, of which erf by itself has no digit.
  const DensityRay tail = rayOf({ 900, 0, 0 }, { 1, 0, 0 }, 0, Endless);
  EXPECT_NEAR(gaussianLineIntegral(Ball.data(), tail) / (2.5066282746310002 * 1.12858840595384e-19),
    1, 1e-12);
}

// A layer is the same everywhere along it: the vertical depth over the sine of the elevation; level rays see one density.
TEST(GaussianDensity, CanBeALayer)
{
  const double vertical = 2.5066282746310002;
  EXPECT_NEAR(
    gaussianLineIntegral(Layer.data(), rayOf({ 9e5, 3, 0 }, { 3, 0, 4 }, -Endless, Endless)),
    vertical / 0.8, 1e-12);
  EXPECT_NEAR(gaussianLineIntegral(Layer.data(), rayOf({ 0, 0, 600 }, { 1, 1, 0 }, -10, 5000)),
    5010 * 0.01 * std::exp(-0.5), 1e-12);
  EXPECT_EQ(
    gaussianLineIntegral(Layer.data(), rayOf({ 0, 0, 600 }, { 1, 1, 0 }, 0, Endless)), Endless);
  EXPECT_EQ(gaussianLineIntegral(Layer.data(), rayOf({ 0, 0, 1e7 }, { 1, 1, 0 }, 0, Endless)), 0);
  EXPECT_NEAR(gaussianMass(Layer.data()), vertical, 1e-14);
}

// Mass is that of line integrals over a plane: a pill's by a sum over rays.
TEST(GaussianDensity, HasTheMassOfItsRays)
{
  double sum = 0;
  for (const QuadraturePoint& x : gaussLegendrePanels(60, 4, -900, 1100))
  {
    for (const QuadraturePoint& y : gaussLegendrePanels(60, 4, -1050, 950))
    {
      sum += x.weight * y.weight *
        gaussianLineIntegral(Pill.data(), rayOf({ x.x, y.x, 0 }, { 0, 0, 1 }, -Endless, Endless));
    }
  }
  EXPECT_NEAR(gaussianMass(Pill.data()) / sum, 1, 1e-9);
}

namespace
{
/// 3 x 4 x 2 points of x y z-like density with uneven distances.
DensityGrid sampleGrid()
{
  const std::array<std::vector<double>, 3> coordinates{ { { 0, 1, 4 }, { -2, 0, 1, 7 },
    { 10, 30 } } };
  std::vector<double> values;
  for (const double z : coordinates[2])
  {
    for (const double y : coordinates[1])
    {
      for (const double x : coordinates[0])
      {
        values.push_back((1 + x) * (3 + y) * z);
      }
    }
  }
  return { coordinates, values };
}
}

// What is linear along each axis comes back everywhere; its integral along a slanted ray by an independent quadrature.
TEST(DensityGrid, InterpolatesAndIntegrates)
{
  const DensityGrid grid = sampleGrid();
  EXPECT_EQ(grid.whatIsWrong(), "");
  const double place[] = { 2.5, 3, 17 };
  EXPECT_NEAR(grid.at(place), 3.5 * 6 * 17, 1e-11);
  const double outside[] = { 4.1, 3, 17 };
  EXPECT_EQ(grid.at(outside), 0);
  const DensityRay ray = rayOf({ 0.5, -1, 12 }, { 1, 2, 5 }, -Endless, Endless);
  double truth = 0;
  // it enters through z = 10 and leaves through x = 4
  const double norm = std::sqrt(30.0);
  for (const QuadraturePoint& t : gaussLegendre(3, -0.4 * norm, 3.5 * norm))
  {
    truth += t.weight * (1.5 + t.x / norm) * (2 + 2 * t.x / norm) * (12 + 5 * t.x / norm);
  }
  EXPECT_NEAR(grid.lineIntegral(ray) / truth, 1, 1e-13);
  EXPECT_EQ(grid.lineIntegral(rayOf({ 5, 0, 12 }, { 0, 1, 0 }, -Endless, Endless)), 0);
  // mass: (x + x^2 / 2) (3 y + y^2 / 2) z^2 / 2 between the ends
  EXPECT_NEAR(grid.mass(), 12 * (27 + 24.5 - 2) * 400, 1e-9);
}

// Along an axis with one point it goes on without end.
TEST(DensityGrid, CanBeAColumn)
{
  const DensityGrid column({ { { 0 }, { 0 }, { 0, 100, 400 } } }, { 0, 0.02, 0 });
  EXPECT_EQ(column.whatIsWrong(), "");
  EXPECT_NEAR(column.mass(), 4, 1e-12);
  EXPECT_NEAR(
    column.lineIntegral(rayOf({ 1e5, -3, 900 }, { 0.6, 0, -0.8 }, 0, Endless)), 4 / 0.8, 1e-12);
  EXPECT_NEAR(column.lineIntegral(rayOf({ 0, 0, 100 }, { 0, 0, 1 }, 0, 150)), 0.015 * 150, 1e-12);
}

TEST(DensityGrid, SaysWhatIsWrong)
{
  const auto wrong = [](std::vector<double> z, std::vector<double> values) {
    return DensityGrid({ { { 0 }, { 0 }, std::move(z) } }, std::move(values)).whatIsWrong();
  };
  EXPECT_EQ(wrong({ 0, 1, 1 }, { 1, 1, 1 }), "the coordinates along z do not ascend");
  EXPECT_EQ(wrong({}, {}), "the coordinates along z do not ascend");
  EXPECT_EQ(wrong({ 0, 1 }, { 1 }), "1 densities were given for 2 points");
  EXPECT_EQ(wrong({ 0, 1 }, { 1, -2 }),
    "the density of point 1 is -2; none may be negative or infinite or no number");
  EXPECT_NE(wrong({ 0, 1 }, { std::nan(""), 1 }).find("point 0 is"), std::string::npos);
}
