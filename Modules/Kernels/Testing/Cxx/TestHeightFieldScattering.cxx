// SPDX-License-Identifier: BSD-3-Clause
#include "HeightFieldScattering.h"

#include "HeightFieldTesting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

using namespace nephoscope;
using nephoscope::testing::lightOf;
using nephoscope::testing::referenceShape;
using nephoscope::testing::slabShape;

namespace
{
/// The rows of a table of numbers after its comments and its line of names.
std::vector<std::vector<double>> readTable(const std::string& name)
{
  std::ifstream file(std::string(NEPHOSCOPE_SOURCE_DIR "/Testing/Reference/") + name);
  std::vector<std::vector<double>> rows;
  std::string line;
  bool isNamed = false;
  while (std::getline(file, line))
  {
    if (line[0] == '#')
    {
      continue;
    }
    std::istringstream cells(line);
    std::string cell;
    rows.emplace_back();
    while (isNamed && std::getline(cells, cell, ','))
    {
      rows.back().push_back(std::stod(cell));
    }
    isNamed = true;
  }
  rows.erase(rows.begin());
  return rows;
}

/// Light of a stretch whose optical depths to the sun at both ends are known and that is linear between.
double linearStretch(double view, double length, double sun0, double sun1)
{
  const double e0 = sun0;
  const double e1 = sun1 + view * length;
  return view * length * (e1 == e0 ? std::exp(-e0) : (std::exp(-e0) - std::exp(-e1)) / (e1 - e0));
}

/// Relative errors of a method against Exact where the optical depth along the ray is 0.1 to 20, ascending. Random-looking clouds
/// of seven waves, eyes below, in and above the layer, 24 rays each.
std::vector<double> errors(
  const std::string& method, double scale, const ScatteringSettings& settings = {})
{
  std::vector<double> all;
  const ScatteringDensities densities{ 0.0093 * scale, 0.0163 * scale, 0.0198 * scale };
  for (int cloud = 1; cloud <= 2; ++cloud)
  {
    HeightFieldShape shape = slabShape(20);
    for (int i = 0; i < 7; ++i)
    {
      const double k = 0.01 * std::pow(1.35, i);
      const double turn = 2.4 * i * i + 1.7 * cloud;
      shape.waves.push_back(
        { 40 * std::pow(0.75, i), k * std::cos(turn), k * std::sin(turn), 3.1 * i + cloud });
    }
    for (const double eye : { 0.0, 600.0, 310.0 })
    {
      std::vector<double> slopes;
      for (int i = 0; i < 24; ++i)
      {
        const double slope = 0.03 + 0.025 * i;
        slopes.push_back(eye == 0 ? slope : eye == 600 ? slope - 0.635 : slope - 0.3);
      }
      const CloudSlice slice{ 0, 0, eye, 0.6, 0.8, 15000 };
      SliceLight truth;
      SliceLight ours;
      const HeightField field(shape);
      HeightFieldScattering::make("Exact", field, 300, densities)->shine(slice, slopes, truth);
      HeightFieldScattering::make(method, field, 300, densities, settings)
        ->shine(slice, slopes, ours);
      for (std::size_t i = 0; i < slopes.size(); ++i)
      {
        const double depth =
          -std::log(truth.rays[i].transmittance) * densities.view / densities.behind;
        if (depth > 0.1 && depth < 20)
        {
          all.push_back(std::abs(ours.rays[i].light / truth.rays[i].light - 1));
        }
      }
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

double part(const std::vector<double>& sorted, double share)
{
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

const ScatteringDensities Paper;
const ScatteringDensities Physical = ScatteringDensities::physical(0.0163);
}

// The reference table, whose two columns are the paper's densities and one density, to 1e-7 of each figure.
TEST(HeightFieldScattering, ExactIsTheReferenceTable)
{
  const std::vector<std::vector<double>> rows = readTable("single_scattering_heightfield.csv");
  ASSERT_EQ(rows.size(), 32U);
  const HeightField field(referenceShape());
  for (const std::vector<double>& row : rows)
  {
    const double stretch = std::sqrt(1 + row[1] * row[1]); // r per y
    const CloudSlice slice{ 0, 0, 0, row[1] / stretch, 1 / stretch, 6000 * stretch };
    SliceLight light;
    const auto paper = HeightFieldScattering::make("Exact", field, row[0], Paper);
    paper->shine(slice, { row[2] / stretch }, light);
    EXPECT_EQ(light.segments.size(), static_cast<std::size_t>(row[3]));
    EXPECT_NEAR(light.segments.front().nearEnd / stretch, row[4], 1e-7 * row[4]);
    EXPECT_NEAR(light.segments.front().farEnd / stretch, row[5], 1e-7 * row[5]);
    EXPECT_NEAR(light.segments.back().farEnd / stretch, row[6], 1e-7 * row[6]);
    EXPECT_NEAR(light.rays[0].light, row[7], 1e-7 * row[7]);
    EXPECT_NEAR(light.rays[0].transmittance, row[8], 1e-7 * row[8]);
    EXPECT_LT(light.rays[0].error, 1e-7 * row[7]);
    const auto physical = HeightFieldScattering::make("Exact", field, row[0], Physical);
    physical->shine(slice, { row[2] / stretch }, light);
    EXPECT_NEAR(light.rays[0].light, row[9], 1e-7 * row[9]);
    EXPECT_NEAR(light.rays[0].transmittance, row[10], 1e-7 * row[10]);
    // The default is within a thousandth of it, except where a ray touches a cloud between two samples.
    EXPECT_NEAR(lightOf("Moments", referenceShape(), row[0], Paper, slice, row[2] / stretch).light,
      row[7], 1e-3 * row[7]);
  }
}

// A slab has a closed form for rays up, down and level, from below, above and within.
TEST(HeightFieldScattering, SlabsHaveTheirClosedForm)
{
  const HeightField slab(slabShape(50));
  const double g = slab.top(50);
  const double h = slab.bottom(50);
  const double plane = 300;
  ScatteringSettings small;
  small.pieceDepth = 0.25;
  for (const char* const method : { "Exact", "Moments" })
  {
    for (const double slope : { 0.05, 0.7, 30.0 })
    {
      const double length = (g - h) / slope;
      const double view = Paper.view * std::hypot(1, slope);
      const CloudSlice below{ 10, 20, 0, 0.6, 0.8, 50000 };
      const RayLight up = lightOf(method, slab.shape(), plane, Paper, below, slope, small);
      const double upward = linearStretch(view, length, Paper.sun * (g - h), 0);
      EXPECT_NEAR(up.light, upward, 1e-6 * upward) << method << ' ' << slope;
      EXPECT_NEAR(up.transmittance, std::exp(-Paper.behind / Paper.view * view * length), 1e-9);
      const CloudSlice above{ 10, 20, 2 * plane, 0.6, 0.8, 50000 };
      const RayLight down = lightOf(method, slab.shape(), plane, Paper, above, -slope, small);
      const double downward = linearStretch(view, length, 0, Paper.sun * (g - h));
      EXPECT_NEAR(down.light, downward, 1e-6 * downward) << method << ' ' << slope;
    }
    for (const double far : { 30.0, 40000.0 })
    {
      const CloudSlice within{ 10, 20, plane + 10, 0.6, 0.8, far };
      const double level = std::exp(-Paper.sun * (g - 10)) * -std::expm1(-Paper.view * far);
      EXPECT_NEAR(
        lightOf(method, slab.shape(), plane, Paper, within, 0, small).light, level, 1e-6 * level);
    }
  }
}

// Where delta = rhoB gamma - rhoA s is 0 or negative, nothing is divided by it.
TEST(HeightFieldScattering, FadingCanStandStill)
{
  const HeightField slab(slabShape(50));
  const double thickness = slab.top(50) - slab.bottom(50);
  for (const double sun : { 0.01 * std::sqrt(5.0) / 2, 0.03 })
  {
    const ScatteringDensities densities{ sun, 0.01, 0.01 };
    const double view = 0.01 * std::sqrt(5.0);
    const double truth = linearStretch(view, thickness / 2, sun * thickness, 0);
    for (const char* const method : { "Exact", "Moments" })
    {
      EXPECT_NEAR(
        lightOf(method, slab.shape(), 300, densities, CloudSlice{}, 2).light, truth, 1e-6 * truth);
    }
  }
}

// Looking at the sun through any depth tau J = tau exp(-tau); away from it J = (1 - exp(-2 tau)) / 2.
TEST(HeightFieldScattering, TowardsAndAwayFromTheSun)
{
  const HeightField field(referenceShape());
  const CloudSlice below{ 120, 700, 0, 0.6, 0.8, 50000 };
  const double f = field.value(120, 700);
  ASSERT_GT(f, 1);
  const double tau = 0.0163 * (field.top(f) - field.bottom(f));
  for (const char* const method : { "Exact", "Moments" })
  {
    const double vertical = std::numeric_limits<double>::infinity();
    const RayLight up = lightOf(method, referenceShape(), 300, Physical, below, vertical);
    EXPECT_NEAR(up.light, tau * std::exp(-tau), 1e-6) << method;
    EXPECT_NEAR(up.transmittance, std::exp(-tau), 1e-6) << method;
    const CloudSlice above{ 120, 700, 900, 0.6, 0.8, 50000 };
    const RayLight down = lightOf(method, referenceShape(), 300, Physical, above, -vertical);
    EXPECT_NEAR(down.light, -std::expm1(-2 * tau) / 2, 1e-6) << method;
  }
}

// The default: median error below 0.1 %, 95th percentile below 1 %, over optical depths 0.1 to 20 and densities a quarter to
// four times the paper's.
TEST(HeightFieldScattering, MomentsAreWithinTheirBounds)
{
  for (const double scale : { 0.25, 1.0, 4.0 })
  {
    const std::vector<double> all = errors("Moments", scale);
    ASSERT_GT(all.size(), 40U);
    EXPECT_LT(part(all, 0.5), 1e-3) << scale;
    EXPECT_LT(part(all, 0.95), 1e-2) << scale;
  }
}

// March is of first order (surfaces between its steps). Moments is of second order and better, for its ends are.
TEST(HeightFieldScattering, MethodsConverge)
{
  ScatteringSettings coarse;
  ScatteringSettings fine;
  coarse.step = 8;
  fine.step = 1;
  const double march = part(errors("March", 1, coarse), 0.5) / part(errors("March", 1, fine), 0.5);
  EXPECT_GT(std::log(march) / std::log(8.0), 0.8);
  coarse.samplesPerWave = 8;
  fine.samplesPerWave = 32;
  coarse.pieceDepth = fine.pieceDepth = 0.5;
  const double moments =
    part(errors("Moments", 1, coarse), 0.5) / part(errors("Moments", 1, fine), 0.5);
  EXPECT_GT(std::log(moments) / std::log(4.0), 1.7);
}

// Max's quadratics: right for thin clouds, and at his densities dark by a quarter to a third.
TEST(HeightFieldScattering, SexpIsDarkAsPrinted)
{
  ScatteringSettings fine;
  fine.samplesPerWave = 100;
  EXPECT_LT(part(errors("Sexp1986", 0.05, fine), 0.5), 0.05);
  const double atPaper = part(errors("Sexp1986", 1, fine), 0.5);
  EXPECT_GT(atPaper, 0.2);
  EXPECT_LT(atPaper, 0.45);
}

// With the constants that were fitted to other clouds Max's quadratics are off by half as much; with factors alone they are the ones of
// other densities, whose scattering is not.
TEST(HeightFieldScattering, SexpTakesFittedConstants)
{
  ScatteringSettings fine;
  fine.samplesPerWave = 100;
  const double atPaper = part(errors("Sexp1986", 1, fine), 0.5);
  fine.sunFactor = 0.709;
  fine.viewFactor = 0.864;
  fine.gain = 1.152;
  EXPECT_LT(part(errors("Sexp1986", 1, fine), 0.5), 0.5 * atPaper);

  const HeightField field(referenceShape());
  const CloudSlice slice{ 0, 0, 0, 0.371390676, 0.928476691, 6500 };
  const ScatteringDensities scaled{ 0.709 * Paper.sun, 0.864 * Paper.view, Paper.behind };
  SliceLight factors;
  SliceLight densities;
  HeightFieldScattering::make("Sexp1986", field, 300, Paper, fine)
    ->shine(slice, { 0.12, 0.16 }, factors);
  ScatteringSettings plain;
  plain.samplesPerWave = 100;
  HeightFieldScattering::make("Sexp1986", field, 300, scaled, plain)
    ->shine(slice, { 0.12, 0.16 }, densities);
  ASSERT_EQ(factors.segments.size(), densities.segments.size());
  ASSERT_FALSE(factors.segments.empty());
  for (std::size_t i = 0; i < factors.segments.size(); ++i)
  {
    const double expected = 1.152 / 0.864 * densities.segments[i].light;
    EXPECT_NEAR(factors.segments[i].light, expected, 1e-9 * std::abs(expected));
  }
}

// What the rays gain is what their segments give, from front to back, and what hides ends both.
TEST(HeightFieldScattering, SegmentsMakeTheRay)
{
  const HeightField field(referenceShape());
  const std::vector<double> slopes{ 0.08, 0.12, 0.16, 0.25 };
  const CloudSlice slice{ 0, 0, 0, 0.371390676, 0.928476691, 6500 };
  for (const std::string& method : HeightFieldScattering::names())
  {
    const auto scattering = HeightFieldScattering::make(method, field, 300, Paper);
    SliceLight light;
    scattering->shine(slice, slopes, light);
    std::vector<RayLight> sum(slopes.size());
    std::vector<double> last(slopes.size(), 0);
    for (const HeightFieldSegment& s : light.segments)
    {
      EXPECT_GE(s.nearEnd, last[s.ray]);
      EXPECT_GT(s.farEnd, s.nearEnd);
      last[s.ray] = s.farEnd;
      sum[s.ray].light += sum[s.ray].transmittance * s.light;
      sum[s.ray].transmittance *= std::exp(-s.opticalDepth);
    }
    for (std::size_t i = 0; i < slopes.size(); ++i)
    {
      EXPECT_DOUBLE_EQ(sum[i].light, light.rays[i].light);
      EXPECT_NEAR(sum[i].transmittance, light.rays[i].transmittance, 1e-12);
    }
  }
}

// Something opaque within a segment ends it; part() gives the same light without a table.
TEST(HeightFieldScattering, OpaqueThingsEndRays)
{
  const HeightField field(referenceShape());
  const CloudSlice slice{ 0, 0, 0, 0, 1, 6000 };
  const std::vector<double> slopes{ 0.16 };
  SliceLight whole;
  const auto exact = HeightFieldScattering::make("Exact", field, 300, Paper);
  exact->shine(slice, slopes, whole);
  const double in = whole.segments[0].nearEnd;
  const double end = in + 60;
  SliceLight truth;
  exact->shine(slice, slopes, truth, { end });
  ASSERT_EQ(truth.segments.size(), 1U);
  EXPECT_DOUBLE_EQ(truth.segments[0].farEnd, end);
  EXPECT_NEAR(
    exact->part(slice, slopes[0], in, end), truth.rays[0].light, 2e-3 * truth.rays[0].light);
  SliceLight ours;
  HeightFieldScattering::make("Moments", field, 300, Paper)->shine(slice, slopes, ours, { end });
  EXPECT_NEAR(ours.rays[0].light, truth.rays[0].light, 1e-3 * truth.rays[0].light);
  EXPECT_NEAR(ours.rays[0].transmittance, truth.rays[0].transmittance, 1e-5);
  HeightFieldScattering::make("Moments", field, 300, Paper)->shine(slice, slopes, ours, { 100 });
  EXPECT_EQ(ours.rays[0].light, 0);
  EXPECT_EQ(ours.rays[0].transmittance, 1);
}

// Nothing scatters in nothing; a cloud of stone is lit as its surface: J = rhoB gamma / (rhoB gamma + rhoA (dg/dr - s)).
TEST(HeightFieldScattering, LimitsOfDensity)
{
  const HeightField field(referenceShape());
  const CloudSlice above{ 0, 0, 600, 0.6, 0.8, 15000 };
  for (const char* const method : { "Exact", "Moments", "March" })
  {
    const RayLight nothing =
      lightOf(method, referenceShape(), 300, ScatteringDensities::physical(0), above, -0.3);
    EXPECT_EQ(nothing.light, 0);
    EXPECT_EQ(nothing.transmittance, 1);
  }
  for (const double slope : { -0.15, -0.3, -1.0, -20.0 })
  {
    SliceLight truth;
    const auto exact =
      HeightFieldScattering::make("Exact", field, 300, ScatteringDensities::physical(1e6));
    exact->shine(above, { slope }, truth);
    ASSERT_FALSE(truth.segments.empty());
    const double r = truth.segments[0].nearEnd;
    const HeightGradient top = field.top(field.gradient(0.6 * r, 0.8 * r));
    const double gamma = std::hypot(1, slope);
    // Below the cloud plane no sun comes.
    const bool isLit = 300 + slope * r > 0;
    const double stone = isLit ? gamma / (gamma + 0.6 * top.x + 0.8 * top.y - slope) : 0;
    EXPECT_NEAR(truth.rays[0].light, stone, 1e-4);
    const RayLight ours =
      lightOf("Moments", referenceShape(), 300, ScatteringDensities::physical(1e6), above, slope);
    EXPECT_NEAR(ours.light, stone, 5e-3) << slope;
    EXPECT_LT(ours.transmittance, 1e-300);
  }
}

// How far the paper's two conditions are from holding is told: for a slab both are known.
TEST(HeightFieldScattering, TellsThePapersConditions)
{
  const HeightField slab(slabShape(500));
  const double thickness = slab.top(500) - slab.bottom(500);
  const double delta = Paper.view * std::sqrt(5.0) - 2 * Paper.sun;
  for (const std::string& method : HeightFieldScattering::names())
  {
    SliceLight light;
    HeightFieldScattering::make(method, slab, 300, Paper)->shine(CloudSlice{}, { 2 }, light);
    EXPECT_NEAR(light.largestViewArgument, delta * thickness / 2, 0.02 * light.largestViewArgument)
      << method;
    EXPECT_NEAR(light.largestSunArgument, Paper.sun * slab.top(500), 1e-9) << method;
    EXPECT_GT(light.largestSunArgument, 2);
  }
}

// What a ray costs over the samples does not grow with its length in the cloud, whether it can see the end or not; that of marching does.
TEST(HeightFieldScattering, LongRaysCostNoMore)
{
  HeightFieldShape shape = slabShape(400);
  shape.waves = { { 60, 0.004, 0.003, 0.4 }, { 30, -0.006, 0.011, 1.2 } };
  const HeightField field(shape);
  const auto pieces = [&](const char* method, double length, double extinction)
  {
    SliceLight light;
    const CloudSlice slice{ 0, 0, 310, 0.6, 0.8, length };
    HeightFieldScattering::make(method, field, 300, ScatteringDensities::physical(extinction))
      ->shine(slice, { 1e-4 }, light);
    EXPECT_EQ(light.segments.size(), 1U);
    return light.pieces;
  };
  for (const double length : { 500.0, 5000.0, 50000.0 })
  {
    EXPECT_LE(pieces("Moments", length, 0.0163), 16U) << length;
    EXPECT_LE(pieces("Moments", length, 3 / length), 16U) << length;
    EXPECT_GE(pieces("Moments", length, 3 / length), 2U) << length;
    EXPECT_NEAR(static_cast<double>(pieces("March", length, 3 / length)), length / 5, 1);
  }
}

// In pixels all methods see the same faded waves: Moments is Exact's within 0.3 % in the middle and 3 % almost everywhere, where samples are
// up to 1.4 pixels apart.
TEST(HeightFieldScattering, MethodsFadeWavesAlike)
{
  HeightFieldShape shape = slabShape(-5);
  for (int i = 0; i < 9; ++i)
  {
    const double k = 0.008 * std::pow(1.4, i);
    shape.waves.push_back(
      { 30 * std::pow(0.7, i), k * std::cos(2.4 * i), k * std::sin(2.4 * i), 1.0 * i });
  }
  const HeightField field(shape);
  const CloudSlice slice{ 0, 0, 0, 0.6, 0.8, 15000, 0.02 };
  const CloudSlice sharp{ 0, 0, 0, 0.6, 0.8, 15000 };
  std::vector<double> slopes;
  for (int i = 0; i < 60; ++i)
  {
    slopes.push_back(0.03 + 0.004 * i);
  }
  SliceLight truth;
  SliceLight ours;
  SliceLight whole;
  HeightFieldScattering::make("Exact", field, 300, Paper)->shine(slice, slopes, truth);
  HeightFieldScattering::make("Exact", field, 300, Paper)->shine(sharp, slopes, whole);
  HeightFieldScattering::make("Moments", field, 300, Paper)->shine(slice, slopes, ours);
  std::vector<double> errors;
  double faded = 0;
  for (std::size_t i = 0; i < slopes.size(); ++i)
  {
    errors.push_back(std::abs(ours.rays[i].light - truth.rays[i].light));
    faded = std::max(faded, std::abs(whole.rays[i].light - truth.rays[i].light));
  }
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(part(errors, 0.5), 3e-3);
  EXPECT_LT(part(errors, 0.9), 3e-2);
  EXPECT_GT(faded, 0.1);
}

// Creases of absolute values and roots: within a percent in the middle, within a tenth almost everywhere.
TEST(HeightFieldScattering, CreasesCostLittle)
{
  HeightFieldShape shape = slabShape(-20);
  shape.waves = { { 40, 0.008, 0.003, 0.3, WaveShape::Absolute },
    { 30, -0.006, 0.011, 1.2, WaveShape::Root }, { 10, 0.02, 0.015, 2 } };
  const CloudSlice slice{ 0, 0, 0, 0.6, 0.8, 9000 };
  std::vector<double> slopes;
  for (double s = 0.06; s < 0.9; s += 0.021)
  {
    slopes.push_back(s);
  }
  SliceLight truth;
  SliceLight ours;
  const HeightField field(shape);
  HeightFieldScattering::make("Exact", field, 300, Paper)->shine(slice, slopes, truth);
  HeightFieldScattering::make("Moments", field, 300, Paper)->shine(slice, slopes, ours);
  std::vector<double> all;
  for (std::size_t i = 0; i < slopes.size(); ++i)
  {
    all.push_back(std::abs(ours.rays[i].light - truth.rays[i].light));
  }
  std::sort(all.begin(), all.end());
  EXPECT_LT(part(all, 0.5), 1e-2);
  EXPECT_LT(part(all, 0.9), 1e-1);
}

// What is no number comes out as no light, not as no number.
TEST(HeightFieldScattering, HostileSlicesGiveNumbers)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const HeightField field(referenceShape());
  for (const std::string& method : HeightFieldScattering::names())
  {
    const auto scattering = HeightFieldScattering::make(method, field, 300, { nan, infinity, -1 });
    for (const CloudSlice& slice : { CloudSlice{ nan, 0, 0, 0, 1, 900 },
           CloudSlice{ 0, 0, 0, 0, 1, infinity }, CloudSlice{ 0, 0, 300, 0, 1, 2000 },
           CloudSlice{ 0, 0, 300, 0, 0, 900 }, CloudSlice{ 0, 0, 0, 0, 1, -5 } })
    {
      SliceLight light;
      scattering->shine(slice, { -infinity, -1e300, 0, 0, 1e-300, 0.2, nan }, light);
      for (const RayLight& ray : light.rays)
      {
        EXPECT_TRUE(std::isfinite(ray.light) && std::isfinite(ray.transmittance)) << method;
      }
    }
    scattering->shine(CloudSlice{}, {}, *std::make_unique<SliceLight>());
  }
  try
  {
    HeightFieldScattering::make("Guess", field, 300, Paper);
    FAIL();
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_STREQ(
      error.what(), "no scattering method 'Guess': use Exact, March, Sexp1986 or Moments");
  }
}
