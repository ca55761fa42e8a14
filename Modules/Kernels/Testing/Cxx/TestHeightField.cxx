// SPDX-License-Identifier: BSD-3-Clause
#include "Cumulus.h"
#include "HeightField.h"
#include "HeightFieldShadow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

using namespace nephoscope;

namespace
{
HeightFieldShape mixedShape()
{
  HeightFieldShape shape;
  shape.polynomial = { 12, 0.01, -0.02, -2e-6, 1e-6, -3e-6 };
  shape.waves = { { 40, 0.006, 0.011, 0.3 }, { -25, 0.009, 0.004, 1.1, WaveShape::Absolute },
    { 14, -0.013, 0.007, 0.2, WaveShape::Root } };
  return shape;
}

/// The worst difference between a gradient and central differences of the value, over places without a kink nearby.
template <class Gradient>
double gradientError(const Gradient& at)
{
  double worst = 0;
  for (double x = -310; x < 900; x += 173.3)
  {
    for (double y = -90; y < 1700; y += 91.7)
    {
      const double step = 1e-4;
      const HeightGradient here = at(x, y);
      const double dx = (at(x + step, y).value - at(x - step, y).value) / (2 * step);
      const double dy = (at(x, y + step).value - at(x, y - step).value) / (2 * step);
      worst = std::max({ worst, std::abs(here.x - dx) / (1 + std::abs(dx)),
        std::abs(here.y - dy) / (1 + std::abs(dy)) });
    }
  }
  return worst;
}
}

// Gradients of F, g and h meet central differences, whose own error is some 1e-7 of the third derivative.
TEST(HeightField, GradientsMeetDifferences)
{
  const HeightField field(mixedShape());
  EXPECT_LT(gradientError([&](double x, double y) { return field.gradient(x, y); }), 1e-6);
  EXPECT_LT(
    gradientError([&](double x, double y) { return field.top(field.gradient(x, y)); }), 1e-6);
  EXPECT_LT(
    gradientError([&](double x, double y) { return field.bottom(field.gradient(x, y)); }), 1e-6);
}

// g and h are those of Max 1986 section 2, odd in F, with the bottom above -D; inside() is above 0 exactly between them.
TEST(HeightField, SurfacesAreThePapers)
{
  const HeightField field(mixedShape());
  for (const double f : { -80.0, -3.0, -1e-9, 0.0, 1e-12, 0.4, 20.0, 1e3, 1e6 })
  {
    const double t = std::pow(std::abs(f) + 20, 2);
    const double g = std::copysign(std::sqrt(t - 400), f);
    EXPECT_NEAR(field.top(f), g, 1e-6 + 1e-12 * std::abs(g));
    EXPECT_NEAR(field.bottom(f), -60 * g / std::sqrt(t + 400), 1e-6);
    EXPECT_GE(field.bottom(f), -60);
    for (const double zeta : { -61.0, -59.0, -30.0, -1e-7, 1e-7, 17.0, 400.0 })
    {
      EXPECT_EQ(field.inside(f, zeta) > 0, field.bottom(f) < zeta && zeta < field.top(f) && f > 0)
        << "F " << f << ", zeta " << zeta;
    }
  }
}

// Without roundness the edge is sharp: g = F, and the bottom is flat at -D.
TEST(HeightField, IsSharpWithoutRoundness)
{
  HeightFieldShape shape = mixedShape();
  shape.c = 0;
  const HeightField field(shape);
  EXPECT_EQ(field.top(7.5), 7.5);
  EXPECT_EQ(field.bottom(7.5), -60);
  EXPECT_EQ(field.bottom(0), 0);
  EXPECT_FALSE(field.inside(0, 0) > 0);
  EXPECT_GT(field.inside(1e-3, -59.9), 0);
  const HeightGradient edge = field.bottom(HeightGradient{ 0, 1, 1 });
  EXPECT_EQ(edge.x, 0);
}

// The kinks of a line are where the arguments of absolute values pass multiples of pi: F bends there and nowhere else.
TEST(HeightField, TellsItsKinks)
{
  const HeightField field(mixedShape());
  const double ux = 0.6;
  const double uy = 0.8;
  const std::vector<double> kinks = field.kinks(10, 20, ux, uy, 0, 2000);
  ASSERT_FALSE(kinks.empty());
  EXPECT_TRUE(std::is_sorted(kinks.begin(), kinks.end()));
  for (const double t : kinks)
  {
    const auto valueAt = [&](double s) { return field.value(10 + s * ux, 20 + s * uy); };
    const double bend = std::abs(valueAt(t + 1e-3) - 2 * valueAt(t) + valueAt(t - 1e-3));
    EXPECT_GT(bend, 1e-5) << "at " << t;
  }
  // 2000 m of the absolute wave: (0.009 0.6 + 0.004 0.8) 2000 / pi = 5.47 half waves; of the root: 0.0022 2000 / pi = 1.4.
  EXPECT_NEAR(static_cast<double>(kinks.size()), 5.47 + 1.4, 2);
}

// No value is above the bound, and the bound of a paraboloid is its summit.
TEST(HeightField, HasAnUpperBound)
{
  const HeightField field(mixedShape());
  for (double x = -3000; x < 3000; x += 130)
  {
    for (double y = -9000; y < 3000; y += 170)
    {
      EXPECT_LE(field.value(x, y), field.upperBound());
    }
  }
  HeightFieldShape dome;
  dome.polynomial = { 30 - 1e-6 * 200 * 200 - 2e-6 * 1800.0 * 1800, 4e-4, 7.2e-3, -1e-6, 0, -2e-6 };
  EXPECT_NEAR(HeightField(dome).upperBound(), 30, 1e-9);
  dome.polynomial = { 5, 0, 4, 0, 0, -2 };
  EXPECT_NEAR(HeightField(dome).upperBound(), 7, 1e-12);
  dome.polynomial = { 0, 1, 0, 0, 0, 0 };
  EXPECT_EQ(HeightField(dome).upperBound(), std::numeric_limits<double>::infinity());
}

// After a cycle the phases have the same bits; on the way the waves travel along the vector and keep their form.
TEST(HeightField, CyclesMoveEachRankToTheNext)
{
  const double vx = -40;
  const double vy = -1150;
  HeightFieldShape shape = repeating(mixedShape(), vx, vy);
  shape.polynomial = {};
  const int frames = 49;
  const HeightField start(shape);
  for (const int frame : { 0, 49, -98 })
  {
    const HeightFieldShape closed = cycleFrame(shape, vx, vy, frame, frames);
    for (std::size_t i = 0; i < shape.waves.size(); ++i)
    {
      EXPECT_EQ(closed.waves[i].r, shape.waves[i].r);
    }
  }
  const HeightField later(cycleFrame(shape, vx, vy, 13, frames));
  for (double x = -200; x < 500; x += 90)
  {
    const double y = 3 * x + 7;
    EXPECT_NEAR(later.value(x + vx * 13 / frames, y + vy * 13 / frames), start.value(x, y), 1e-4);
    EXPECT_NEAR(start.value(x + vx, y + vy), start.value(x, y), 1e-4);
  }
}

// Parameters that are not numbers do not come out again.
TEST(HeightField, HostileShapesGiveNumbers)
{
  HeightFieldShape shape;
  shape.polynomial[0] = std::numeric_limits<double>::quiet_NaN();
  shape.waves = { { 5, std::numeric_limits<double>::infinity(), 0, 1 } };
  shape.c = -3;
  shape.depth = 0;
  const HeightField field(shape);
  const HeightGradient top = field.top(field.gradient(3, 4));
  EXPECT_TRUE(std::isfinite(top.value) && std::isfinite(top.x) && std::isfinite(top.y));
  EXPECT_EQ(field.shape().c, 0);
  EXPECT_TRUE(std::isfinite(field.bottom(2.0)));
}

// Made-up clouds cover about the share of the sky that was asked for, and come back from their row of numbers.
TEST(HeightField, CumulusCoversItsShare)
{
  for (const double cover : { 0.2, 0.5, 0.8 })
  {
    Cumulus cumulus;
    cumulus.cover = cover;
    const HeightField field(cumulusShape(cumulus));
    int covered = 0;
    int all = 0;
    for (double x = 0; x < 60000; x += 317)
    {
      for (double y = 0; y < 40000; y += 291)
      {
        covered += field.value(x, y) > 0 ? 1 : 0;
        ++all;
      }
    }
    EXPECT_NEAR(1.0 * covered / all, cover, 0.05);
    const std::vector<double> numbers = numbersOf(field.shape(), 900);
    HeightFieldShape copy;
    double plane = 0;
    ASSERT_TRUE(shapeOf(numbers.data(), numbers.size(), copy, plane));
    EXPECT_EQ(plane, 900);
    EXPECT_EQ(numbersOf(copy, plane), numbers);
    EXPECT_FALSE(shapeOf(numbers.data(), numbers.size() - 1, copy, plane));
    EXPECT_FALSE(shapeOf(numbers.data(), 5, copy, plane));
  }
}

// Waves of 4 pixels are as they are, those below 1.2 are gone but for their mean, and between they fall.
TEST(HeightField, WavesFadeInPixels)
{
  HeightFieldShape shape;
  shape.polynomial[0] = 3;
  shape.waves = { { 5, 0.03, 0.04, 0.4 }, { 2, 0.04, -0.03, 1, WaveShape::Absolute },
    { 1, 0.05, 0, 2, WaveShape::Root } };
  const HeightField field(shape);
  const double length = 2 * 3.14159265358979 / 0.05;
  EXPECT_DOUBLE_EQ(field.value(12, 34, length / 8.01), field.value(12, 34));
  EXPECT_DOUBLE_EQ(field.value(12, 34, length / 1.19), 3 + 2 * MeanAbsolute + MeanRoot);
  double last = 1;
  for (double x = 1.6; x < 5.2; x += 0.1)
  {
    EXPECT_LT(waveLeft(x), last);
    EXPECT_GT(waveLeft(x), 0);
    last = waveLeft(x);
  }
}

// The means of |sin| and sqrt |sin| by midpoints.
TEST(HeightField, MeansOfWavesAreTheirs)
{
  double absolute = 0;
  double root = 0;
  for (int n = 0; n < 100000; ++n)
  {
    const double s = std::sin(3.14159265358979 * (n + 0.5) / 100000);
    absolute += s / 100000;
    root += std::sqrt(s) / 100000;
  }
  EXPECT_NEAR(absolute, MeanAbsolute, 1e-9);
  EXPECT_NEAR(root, MeanRoot, 1e-7);
}

// The derivative of inside() along a line is that of differences, above and below the plane, inside and outside.
TEST(HeightField, InsidesSlopeIsItsDerivative)
{
  HeightFieldShape shape;
  shape.c = 7;
  shape.depth = 40;
  const HeightField field(shape);
  for (const double f : { -30.0, -3.0, 2.0, 50.0 })
  {
    for (const double zeta : { -35.0, -1.0, 4.0, 60.0 })
    {
      double value = 0;
      const double slope = field.insideSlope(f, 0.3, zeta, -0.7, value);
      EXPECT_DOUBLE_EQ(value, field.inside(f, zeta));
      const double step = 1e-5;
      const double rise = field.inside(f + 0.3 * step, zeta - 0.7 * step) -
        field.inside(f - 0.3 * step, zeta + 0.7 * step);
      EXPECT_NEAR(slope, rise / (2 * step), 1e-6 * (1 + std::abs(slope)));
    }
  }
}

// Turned phases against a sine for each place, in a row that no number of samples a block divides, far from the origin.
TEST(HeightFieldShadow, RowsAreThoseOfTheThickness)
{
  for (const double c : { 0.0, 40.0 })
  {
    HeightFieldShape shape = mixedShape();
    shape.polynomial = { 12, 0, 0, 0, 0, 0 };
    shape.c = c;
    const HeightField field(shape);
    constexpr double Extinction = 0.004;
    constexpr double X = 30000;
    constexpr double Spacing = 21;
    std::vector<float> row(5001);
    HeightFieldShadow shadow(field, Extinction);
    shadow.row(X, -700, Spacing, row.size(), row.data());
    int clouded = 0;
    for (std::size_t i = 0; i < row.size(); ++i)
    {
      const double f = field.value(X + static_cast<double>(i) * Spacing, -700);
      const double share = f > 0 ? std::exp(-Extinction * (field.top(f) - field.bottom(f))) : 1;
      // Where c is 0 the bottom is a step at F = 0.
      ASSERT_NEAR(row[i], share, std::abs(f) < 1e-9 ? 1 : 2e-7) << c << ' ' << i;
      clouded += f > 0 ? 1 : 0;
    }
    EXPECT_GT(clouded, 1000);
    EXPECT_LT(clouded, 4500);
  }
}
