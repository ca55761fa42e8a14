// SPDX-License-Identifier: BSD-3-Clause
// Where light through height-field clouds is known to fail (Max 1986). Ours is the method Moments.
#include "HeightFieldTesting.h"
#include "Stability.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephoscope
{
namespace stability
{
namespace
{
using testing::lightOf;
using testing::referenceShape;
using testing::slabShape;

/// Worst difference of J of a method from Exact over a fan of slopes.
double worst(const std::string& method, const HeightFieldShape& shape,
  const ScatteringDensities& densities, const CloudSlice& slice, double from, double to)
{
  double error = 0;
  for (int i = 0; i < 40; ++i)
  {
    const double slope = from + (to - from) * i / 39;
    const double ours = lightOf(method, shape, 300, densities, slice, slope).light;
    const double truth = lightOf("Exact", shape, 300, densities, slice, slope).light;
    error = std::isfinite(ours) ? std::max(error, std::abs(ours - truth))
                                : std::numeric_limits<double>::infinity();
  }
  return error;
}

Outcome outcome(const std::string& what, double naive, double ours, double limit)
{
  return { figure(what, naive), figure(what, ours), ours <= limit };
}

/// Light of a slab along a stretch whose sun path grows from one optical depth to another.
double slabLight(double view, double length, double sun0, double sun1)
{
  const double rise = sun1 + view * length - sun0;
  return view * length * std::exp(-sun0) * (rise == 0 ? 1 : -std::expm1(-rise) / rise);
}

const StabilityRegistration quadraticsEnd({ "height field",
  "sexp's argument beyond -2, g beyond 2 / rho: density 0.05/m", "J as by quadrature within 0.02",
  []
  {
    const ScatteringDensities dense = ScatteringDensities::physical(0.05);
    const CloudSlice above{ 0, 0, 600, 0.6, 0.8, 6000 };
    return outcome("error of J", worst("Sexp1986", referenceShape(), dense, above, -0.7, -0.15),
      worst("Moments", referenceShape(), dense, above, -0.7, -0.15), 0.02);
  } });

const StabilityRegistration standingFade(
  { "height field", "delta = rhoB gamma - rhoA s from -0.01 through 0 to 0.01",
    "the slab's closed form to 1e-4 of it",
    []
    {
      const HeightField slab(slabShape(50));
      const double thickness = slab.top(50) - slab.bottom(50);
      const double view = 0.01 * std::sqrt(5.0);
      double ours = 0;
      double naive = 0;
      for (const double delta : { -0.01, -1e-12, 0.0, 1e-12, 0.01 })
      {
        const double sun = (view - delta) / 2;
        const double length = thickness / 2;
        const double truth = slabLight(view, length, sun * thickness, 0);
        const double light =
          lightOf("Moments", slab.shape(), 300, { sun, 0.01, 0.01 }, CloudSlice{}, 2).light;
        ours = std::max(ours, std::abs(light / truth - 1));
        const double divided =
          view * std::exp(-sun * thickness) * (1 - std::exp(-delta * length)) / delta;
        naive = std::isnan(divided) ? divided : std::max(naive, std::abs(divided / truth - 1));
      }
      return outcome("relative error", naive, ours, 1e-4);
    } });

const StabilityRegistration levelRays(
  { "height field", "rays level with the cloud plane, the eye in it: y_i -> infinity",
    "the slab's closed form to 1e-4 of it",
    []
    {
      const HeightField slab(slabShape(50));
      const CloudSlice within{ 0, 0, 300, 0.6, 0.8, 60000 };
      double ours = 0;
      for (const double slope : { -1e-9, 0.0, 1e-300, 1e-6 })
      {
        const double truth = std::exp(-0.0093 * slab.top(50));
        const double light = lightOf("Moments", slab.shape(), 300, {}, within, slope).light;
        ours = std::max(ours, std::abs(light / truth - 1));
      }
      // Max's places of samples, H / (sigma (maxi + 1 - i)), are all 0 where H is.
      return Outcome{ "samples at 0", figure("relative error", ours), ours < 1e-4 };
    } });

const StabilityRegistration tangents({ "height field",
  "rays about the tangent of a crest, where a segment opens", "J as by quadrature within 0.01",
  []
  {
    HeightFieldShape crest = slabShape(-10);
    crest.waves = { { 60, 0, 0.002, 0 } };
    const HeightField field(crest);
    const CloudSlice slice{ 0, 0, 300 + field.top(50) - 1, 0, 1, 3000 };
    return outcome("error of J", worst("March", crest, {}, slice, -0.004, 0.004),
      worst("Moments", crest, {}, slice, -0.004, 0.004), 0.01);
  } });

const StabilityRegistration touching({ "height field",
  "F touching 0, and above it by 1e-13 to 1e-3", "g to 1e-12 of itself; without cloud where F <= 0",
  []
  {
    const HeightField field(slabShape(0));
    double naive = 0;
    double ours = 0;
    for (double f = 1e-13; f < 2e-3; f *= 10)
    {
      const long double truth = std::sqrt(static_cast<long double>(f) * (f + 40.0L));
      const double t = (f + 20) * (f + 20);
      naive = std::max(naive, std::abs(static_cast<double>(std::sqrt(t - 400) / truth - 1)));
      ours = std::max(ours, std::abs(static_cast<double>(field.top(f) / truth - 1)));
    }
    HeightFieldShape ridge = slabShape(0);
    ridge.polynomial[5] = -1e-6;
    const RayLight none = lightOf("Moments", ridge, 300, {}, { 0, -900, 0, 0, 1, 6000 }, 0.3);
    Outcome result = outcome("relative error", naive, ours, 1e-12);
    result.holds = result.holds && none.light == 0 && none.transmittance == 1;
    return result;
  } });

const StabilityRegistration sharp({ "height field", "c = 0: sharp edges over a flat bottom",
  "J as by quadrature within 0.01; h at an edge is 0",
  []
  {
    HeightFieldShape shape = referenceShape();
    shape.c = 0;
    const double f = 0;
    const double naive = -60 * f / std::sqrt(f * f);
    const CloudSlice below{ 0, 0, 0, 0.6, 0.8, 6000 };
    const double ours = worst("Moments", shape, {}, below, 0.1, 0.6);
    return Outcome{ figure("h at an edge", naive), figure("error of J", ours),
      ours < 0.01 && HeightField(shape).bottom(0) == 0 };
  } });

const StabilityRegistration densities({ "height field", "densities of 0 and 1e6/m",
  "nothing; the light of a surface, gamma / (gamma + dg/dr - s), within 0.005",
  []
  {
    const HeightField field(referenceShape());
    const CloudSlice above{ 0, 0, 600, 0.6, 0.8, 6000 };
    const RayLight nothing =
      lightOf("Moments", referenceShape(), 300, ScatteringDensities::physical(0), above, -0.3);
    const ScatteringDensities stone = ScatteringDensities::physical(1e6);
    SliceLight truth;
    HeightFieldScattering::make("Exact", field, 300, stone)->shine(above, { -1 }, truth);
    const double r = truth.segments.at(0).nearEnd;
    const HeightGradient top = field.top(field.gradient(0.6 * r, 0.8 * r));
    const double gamma = std::sqrt(2.0);
    const double surface = gamma / (gamma + 0.6 * top.x + 0.8 * top.y + 1);
    const auto error = [&](const char* method)
    { return std::abs(lightOf(method, referenceShape(), 300, stone, above, -1).light - surface); };
    Outcome result = outcome("error of J", error("March"), error("Moments"), 0.005);
    result.holds = result.holds && nothing.light == 0 && nothing.transmittance == 1;
    return result;
  } });

const StabilityRegistration planeBelow(
  { "height field", "the cloud plane at and below the eye", "J as by quadrature within 0.01",
    []
    {
      double ours = 0;
      for (const double eye : { 300.0, 301.0, 340.0, 900.0 })
      {
        const CloudSlice slice{ 0, 0, eye, 0.6, 0.8, 6000 };
        ours = std::max(ours, worst("Moments", referenceShape(), {}, slice, -0.8, -0.2));
      }
      return Outcome{ "no samples: y_i = H / (sigma i) < 0", figure("error of J", ours),
        ours < 0.01 };
    } });

const StabilityRegistration manySegments({ "height field", "100,000 segments on one ray",
  "their product's transmittance to 1e-6 of it",
  []
  {
    HeightFieldShape ranks = slabShape(0);
    ranks.waves = { { 1, 0, 2 * 3.141592653589793, 0 } };
    const double density = 2e-5;
    const CloudSlice within{ 0, 0, 300, 0, 1, 1e5 };
    const double ours =
      lightOf("Moments", ranks, 300, ScatteringDensities::physical(density), within, 0)
        .transmittance;
    float naive = 1;
    for (int n = 0; n < 100000; ++n)
    {
      naive *= static_cast<float>(std::exp(-0.5 * density));
    }
    const double truth = std::exp(-0.5 * density * 1e5);
    return outcome("relative error", std::abs(naive / truth - 1), std::abs(ours / truth - 1), 1e-6);
  } });

const StabilityRegistration sunBehind(
  { "height field", "the sun exactly behind the eye, and before it",
    "(1 - exp(-2 tau)) / 2 and tau exp(-tau) to 1e-6",
    []
    {
      const HeightField field(referenceShape());
      const double f = field.value(120, 700);
      const double density = 0.0163;
      const double tau = density * (field.top(f) - field.bottom(f));
      const double vertical = std::numeric_limits<double>::infinity();
      const ScatteringDensities one = ScatteringDensities::physical(density);
      const double down =
        lightOf("Moments", referenceShape(), 300, one, { 120, 700, 900, 0, 1, 6000 }, -vertical)
          .light;
      const double up =
        lightOf("Moments", referenceShape(), 300, one, { 120, 700, 0, 0, 1, 6000 }, vertical).light;
      const double ours =
        std::max(std::abs(down + std::expm1(-2 * tau) / 2), std::abs(up - tau * std::exp(-tau)));
      // beta = tan 90 degrees
      const double naive = vertical - vertical;
      return outcome("error of J", naive, ours, 1e-6);
    } });

/// Int g sexp(-delta (y - y1)) dy over 100 m by running sums of moments in float about the eye (Max 1986), relative error.
double floatSums(double at)
{
  const double delta = 0.0163;
  const double factors[3] = { 1 + delta * at * (1 + delta * at / 4),
    -delta * (1 + 0.5 * delta * at), 0.25 * delta * delta };
  float sums[3] = {};
  float before[3] = {};
  double truth = 0;
  for (double y = 2; y <= at + 100; y += 2)
  {
    const double g = 40 + 20 * std::sin(0.02 * y);
    const double fade = 1 - 0.5 * delta * (y - at);
    truth += y > at ? 2 * g * fade * fade : 0;
    for (int i = 0; i < 3; ++i)
    {
      sums[i] += static_cast<float>(2 * g * std::pow(y, i));
      before[i] = y <= at ? sums[i] : before[i];
    }
  }
  double light = 0;
  for (int i = 0; i < 3; ++i)
  {
    light += factors[i] * (sums[i] - before[i]);
  }
  return std::abs(light / truth - 1);
}

const StabilityRegistration farAway({ "height field",
  "clouds at 1, 10 and 50 km: running sums in float about the eye", "J as near by, to 1e-4",
  []
  {
    double naive = 0;
    double ours = 0;
    HeightFieldShape shape = slabShape(40);
    shape.waves = { { 20, 0, 0.02, 0 } };
    const double period = 2 * 3.141592653589793 / 0.02;
    const auto lightAt = [&](double periods)
    {
      // The ray meets the same waves, from farther away. The layer is the sampling's, so that samples differ.
      const double away = periods * period;
      const CloudSlice slice{ 0, 200 - away, 300 - 60.5 - 0.1 * (away + 37), 0, 1, away + 4000 };
      return lightOf("Moments", shape, 300, {}, slice, 0.1).light;
    };
    const double near = lightAt(0);
    for (const double periods : { 3.0, 32.0, 159.0 })
    {
      naive = std::max(naive, floatSums(periods * period));
      ours = std::max(ours, std::abs(lightAt(periods) / near - 1));
    }
    return outcome("relative error", naive, ours, 1e-4);
  } });
}
}
}
