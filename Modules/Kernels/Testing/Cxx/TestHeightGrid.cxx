// SPDX-License-Identifier: BSD-3-Clause
#include "CloudShadow.h"
#include "FractalNoise.h"
#include "HeightGrid.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

using nephoscope::CloudShadow;
using nephoscope::FractalHills;
using nephoscope::gradientNoise;
using nephoscope::GridFrame;
using nephoscope::GridPyramid;
using nephoscope::HeightGrid;
using nephoscope::Noise;
using nephoscope::NoiseOctaves;
using nephoscope::Ray;
using nephoscope::Vector3;

namespace
{
constexpr double Infinity = std::numeric_limits<double>::infinity();
const GridFrame Frame{ -3, 2, 0.5, 0.75, 14, 9 };

template <class Function>
GridPyramid gridOf(const GridFrame& frame, Function function)
{
  std::vector<float> values;
  for (int j = 0; j < frame.ny; ++j)
  {
    for (int i = 0; i < frame.nx; ++i)
    {
      values.push_back(
        static_cast<float>(function(frame.x0 + i * frame.dx, frame.y0 + j * frame.dy)));
    }
  }
  return { frame, std::move(values) };
}

double heightOf(const FractalHills& hills, double x, double y)
{
  float height;
  hills.row(x, y, 1, 1, &height);
  return height;
}

double slanted(double x, double y)
{
  return 1 + 0.25 * x - 0.5 * y;
}
}

TEST(GridPyramid, LinearFunctionsStayAtEveryFootprint)
{
  const GridPyramid grid = gridOf({ -8, 4, 0.5, 0.25, 64, 32 }, slanted);
  for (double footprint : { 0.0, 0.3, 0.7, 1.5 })
  {
    EXPECT_NEAR(grid.value(7.3, 7.9, footprint), slanted(7.3, 7.9), 1e-5) << footprint;
    EXPECT_NEAR(grid.slopes(7.3, 7.9, footprint).x, 0.25, 1e-5) << footprint;
    EXPECT_NEAR(grid.slopes(7.3, 7.9, footprint).y, -0.5, 1e-5) << footprint;
  }
}

TEST(GridPyramid, WidestFootprintIsTheMean)
{
  const GridPyramid grid =
    gridOf({ 0, 0, 1, 1, 32, 16 }, [](double x, double y) { return std::sin(9 * x) + y; });
  double mean = 0;
  for (int j = 0; j < 16; ++j)
  {
    for (int i = 0; i < 32; ++i)
    {
      mean += grid.at(i, j) / 512.0;
    }
  }
  EXPECT_NEAR(grid.value(5, 5, 1e9), mean, 1e-5);
  EXPECT_NEAR(grid.mean(), mean, 1e-12);
  EXPECT_EQ(GridPyramid().mean(), 0);
}

TEST(GridPyramid, EdgeGoesOnAndWhatIsNotFiniteIsZero)
{
  const GridPyramid grid({ 0, 0, 1, 1, 2, 2 }, { 1, 2, std::nanf(""), 4 });
  EXPECT_EQ(grid.value(-50, -50), 1);
  EXPECT_EQ(grid.value(1e300, -1e300), 2);
  EXPECT_EQ(grid.value(0, 1), 0);
  EXPECT_EQ(grid.value(Infinity, 0), 0);
  EXPECT_EQ(grid.value(0.5, 0), 1.5);
  EXPECT_FALSE(grid.contains(1.01, 0.5));
  EXPECT_TRUE(GridPyramid({ 0, 0, 1, 1, 3, 2 }, { 1 }).empty());
  EXPECT_EQ(GridPyramid().value(1, 2), 0);
}

TEST(HeightGrid, SlantedPlaneIsHitWhereItIs)
{
  const HeightGrid ground(gridOf(Frame, slanted));
  for (const Vector3& direction : { Vector3{ 0, 0, -1 }, Vector3{ 0.3, 0.2, -1 },
         Vector3{ -0.2, 0.1, -0.7 }, Vector3{ 0, 0.4, -1 } })
  {
    const Ray ray{ { 0.3, 4.4, 6 }, normalized(direction) };
    const Vector3& d = ray.direction;
    const double distance = (6 - slanted(0.3, 4.4)) / (0.25 * d[0] - 0.5 * d[1] - d[2]);
    EXPECT_NEAR(ground.intersect(ray, Infinity), distance, 1e-6);
    EXPECT_EQ(ground.intersect(ray, 0.9 * distance), Infinity);
  }
  EXPECT_EQ(ground.intersect({ { 0, 4, 6 }, { 0, 0, 1 } }, Infinity), Infinity);
  EXPECT_EQ(ground.intersect({ { 90, 4, 6 }, { 0, 0, -1 } }, Infinity), Infinity);
  EXPECT_EQ(ground.intersect({ { 0.3, 4.4, -6 }, { 0, 0, 1 } }, Infinity), 0) << "below the ground";
  EXPECT_EQ(HeightGrid().intersect({ { 0, 0, 1 }, { 0, 0, -1 } }, Infinity), Infinity);
}

TEST(HeightGrid, NothingIsHitBeforeTheFirstHit)
{
  std::mt19937 lots(7);
  std::uniform_real_distribution<double> lot(-1, 1);
  const HeightGrid ground(gridOf(Frame, [&](double, double) { return lot(lots); }));
  int hits = 0;
  for (int n = 0; n < 400; ++n)
  {
    const Ray ray{ { 4 * lot(lots), 5 + 4 * lot(lots), 1.5 + lot(lots) * 0.4 },
      normalized(Vector3{ lot(lots), lot(lots), 0.3 * lot(lots) - 0.2 }) };
    const double hit = ground.intersect(ray, 30);
    hits += hit < 30 ? 1 : 0;
    for (int step = 0; step < 3000; ++step)
    {
      const double t = step * 0.01;
      const Vector3 at = ray.origin + t * ray.direction;
      const double above = at[2] - ground.heights().value(at[0], at[1]);
      if (t < hit - 1e-6 && ground.heights().contains(at[0], at[1]))
      {
        ASSERT_GT(above, -1e-6) << n << ' ' << t;
      }
    }
    if (hit < 30)
    {
      const Vector3 at = ray.origin + hit * ray.direction;
      ASSERT_LT(at[2] - ground.heights().value(at[0], at[1]), 1e-6) << n;
    }
  }
  EXPECT_GT(hits, 60);
  EXPECT_LT(hits, 380);
}

// Many blocks of several sizes, the last of them incomplete: the first hit is that of the nearest of all patches, each with a grid
// of its own.
TEST(HeightGrid, BlocksLeaveNoPatchOut)
{
  const GridFrame frame{ 3, -20, 0.5, 1.25, 74, 41 };
  std::mt19937 lots(11);
  std::uniform_real_distribution<double> lot(-1, 1);
  const GridPyramid heights = gridOf(frame,
    [&](double x, double y)
    { return 0.3 * lot(lots) + 4 * std::exp(-0.02 * ((x - 25) * (x - 25) + y * y)); });
  const HeightGrid ground(heights);
  std::vector<HeightGrid> patches;
  for (int j = 0; j + 1 < frame.ny; ++j)
  {
    for (int i = 0; i + 1 < frame.nx; ++i)
    {
      patches.emplace_back(
        GridPyramid({ frame.x0 + i * frame.dx, frame.y0 + j * frame.dy, frame.dx, frame.dy, 2, 2 },
          { heights.at(i, j), heights.at(i + 1, j), heights.at(i, j + 1),
            heights.at(i + 1, j + 1) }));
    }
  }
  int hits = 0;
  for (int n = 0; n < 300; ++n)
  {
    const Ray ray{ { 21 + 24 * lot(lots), 5 + 30 * lot(lots), 2.5 + 2 * lot(lots) },
      normalized(Vector3{ lot(lots), lot(lots), 0.1 * lot(lots) }) };
    double first = Infinity;
    for (const HeightGrid& patch : patches)
    {
      first = std::min(first, patch.intersect(ray, 60));
    }
    hits += first < 60 ? 1 : 0;
    const double hit = ground.intersect(ray, 60);
    ASSERT_TRUE(hit == first || std::abs(hit - first) < 1e-9) << n << ' ' << hit << ' ' << first;
  }
  EXPECT_GT(hits, 40);
  EXPECT_LT(hits, 260);
}

TEST(HeightGrid, RaysAlongGridLinesHit)
{
  const HeightGrid ground(gridOf(Frame, [](double, double) { return 2.0; }));
  for (int i = 0; i < Frame.nx; ++i)
  {
    const double x = Frame.x0 + i * Frame.dx;
    EXPECT_NEAR(ground.intersect({ { x, -1, 5 }, normalized(Vector3{ 0, 1, -0.6 }) }, Infinity),
      5 * std::hypot(1, 0.6), 1e-9)
      << i;
  }
}

TEST(CloudShadow, LiesWhereTheRayTowardsTheSunMeetsThePlane)
{
  const CloudShadow shadow{ gridOf({ 0, 0, 1, 1, 11, 6 }, [](double x, double) { return x / 10; }),
    100 };
  const Vector3 toward = normalized(Vector3{ 3, 0, 300 });
  EXPECT_NEAR(shadow.at({ 4, 2, 0 }, toward), 0.5, 1e-6);
  EXPECT_NEAR(shadow.at({ 4, 2, 50 }, toward), 0.45, 1e-6);
  EXPECT_EQ(shadow.at({ 4, 2, 101 }, toward), 1) << "above the clouds";
  EXPECT_EQ(shadow.at({ 4, 2, 0 }, { 1, 0, 0 }), 1) << "the sun is level";
  EXPECT_EQ(shadow.at({ 40, 2, 0 }, toward), 1) << "no clouds there";
  const CloudShadow going{ shadow.transmittance, 100, 0.3 };
  EXPECT_EQ(going.at({ 40, 2, 0 }, toward), 0.3);
  EXPECT_EQ(CloudShadow().at({ 0, 0, 0 }, toward), 1);
}

TEST(FractalNoise, DerivativesMeetFiniteDifferences)
{
  const double h = 1e-6;
  const NoiseOctaves sum{ 3, 5, 0.6, 4 };
  for (double x = -2.9; x < 3; x += 0.37)
  {
    for (double y = -1.3; y < 2; y += 0.41)
    {
      const Noise noise = gradientNoise(x, y, 9);
      EXPECT_NEAR(noise.dx,
        (gradientNoise(x + h, y, 9).value - gradientNoise(x - h, y, 9).value) / (2 * h), 1e-7);
      EXPECT_NEAR(noise.dy,
        (gradientNoise(x, y + h, 9).value - gradientNoise(x, y - h, 9).value) / (2 * h), 1e-7);
      EXPECT_NEAR(
        sum(x, y, 0.2).dx, (sum(x + h, y, 0.2).value - sum(x - h, y, 0.2).value) / (2 * h), 1e-6);
    }
  }
}

TEST(FractalNoise, IsWithinItsBoundsAndZeroAtLatticePoints)
{
  double mean = 0;
  double square = 0;
  for (int n = 0; n < 40000; ++n)
  {
    const double value = gradientNoise(0.317 * n, -0.123 * n, 2).value;
    ASSERT_LE(std::abs(value), 1);
    mean += value / 40000;
    square += value * value / 40000;
  }
  EXPECT_NEAR(mean, 0, 0.02);
  EXPECT_GT(square, 0.05);
  EXPECT_EQ(gradientNoise(5, -7, 2).value, 0);
  EXPECT_NE(gradientNoise(0.4, 0.3, 1).value, gradientNoise(0.4, 0.3, 2).value);
}

TEST(FractalNoise, OctavesFadeBeforeTheyAreFinerThanTwoFootprints)
{
  const NoiseOctaves all{ 8, 4, 0.5, 1 };
  const NoiseOctaves first{ 8, 1, 0.5, 1 };
  EXPECT_EQ(all(1.1, 2.3, 2).value, first(1.1, 2.3).value);
  EXPECT_EQ(all(1.1, 2.3, 4).value, 0);
  EXPECT_EQ(all(1.1, 2.3, 0.25).value, all(1.1, 2.3).value);
  EXPECT_EQ(all.value(1.1, 2.3, 1), all(1.1, 2.3, 1).value);
}

TEST(FractalHills, AreTheSameEverywhereAndReachTheirRelief)
{
  const FractalHills hills;
  double least = 1e9;
  double most = -1e9;
  for (int n = 0; n < 20000; ++n)
  {
    const double height = heightOf(hills, 211.0 * n, -97.0 * n);
    least = std::min(least, height);
    most = std::max(most, height);
  }
  EXPECT_LT(most - least, 1.3 * hills.relief);
  EXPECT_GT(most - least, 0.8 * hills.relief);
  FractalHills higher = hills;
  higher.mean += 25;
  EXPECT_NEAR(heightOf(higher, 777, 333), heightOf(hills, 777, 333) + 25, 1e-3);
}

TEST(FractalHills, RowsAreThoseOfTheirPlaces)
{
  const FractalHills hills;
  float row[37];
  hills.row(-400, 250, 30, 37, row);
  for (int n = 0; n < 37; ++n)
  {
    EXPECT_EQ(row[n], heightOf(hills, -400 + 30 * n, 250)) << n;
  }
  // One octave is noise of half the wavelength, laid flatter by its own slope.
  FractalHills one = hills;
  one.octaves = 1;
  const Noise noise = gradientNoise(2 * 700 / one.wavelength, 2 * -900 / one.wavelength, one.seed);
  EXPECT_NEAR(heightOf(one, 700, -900),
    one.mean +
      0.5 * one.relief * noise.value / (1 + one.wear * (noise.dx * noise.dx + noise.dy * noise.dy)),
    1e-3);
}
