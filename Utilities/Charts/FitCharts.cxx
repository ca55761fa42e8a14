// SPDX-License-Identifier: BSD-3-Clause
#include "FitCharts.h"

#include "FitDensity.h"
#include "FitTransmittance.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace charts
{
namespace
{
using Progress = std::function<void(const std::string&)>;

const char* const Orders[] = { "quadratic", "cubic", "quartic" };

void tell(const Progress& progress, const std::string& what)
{
  if (progress)
  {
    progress(what);
  }
}

const Fit& fitOf(const std::vector<Fit>& fits, const std::string& name)
{
  return *std::find_if(
    fits.begin(), fits.end(), [&name](const Fit& fit) { return fit.name == name; });
}

/// Largest errors of polynomials against the range that they are fitted to, and of powers of a clipped line, which need none.
LogChart transmittanceChart(const Progress& progress)
{
  LogChart chart;
  chart.title = "Stand-ins for exp(-x), fitted: how far they reach";
  chart.subtitle = "held-out cases; beyond its range a polynomial is 0, which is off by exp(-X)";
  chart.xLabel = "Optical depth X to which it is fitted";
  chart.yLabel = "Largest error of the transmittance";
  chart.xUnit = Unit::Count;
  chart.curves.resize(7);
  for (const double end : { 0.5, 1.0, 2.0, 4.0, 8.0 })
  {
    tell(progress, "transmittance to " + std::to_string(end));
    for (int n = 2; n <= 4; ++n)
    {
      const std::vector<Fit> fits = fitTransmittance(FitRange{ 0, end }, {});
      const std::string order = Orders[n - 2];
      const auto found = std::find_if(fits.begin(), fits.end(),
        [n](const Fit& fit) { return fit.name.rfind("polynomial " + std::to_string(n), 0) == 0; });
      chart.curves[n - 2].points.push_back(
        { end, found->heldOut.max, order + " polynomial", "on 0 to X", true });
      const Fit& power = fitOf(fits, "power " + std::to_string(n) + " k");
      chart.curves[n + 1].points.push_back(
        { end, power.heldOut.max, order + " power", "of a clipped line, for all x", true });
    }
    chart.curves[6].points.push_back(
      { end, std::exp(-end), "exp(-X)", "what is dropped beyond X", false });
  }
  return chart;
}

/// Two layers: a stratus that ends sharply, and a cirrus that does not. 1/m.
DensityGrid column()
{
  std::vector<double> heights;
  std::vector<double> values;
  for (double z = 0; z <= 12000; z += 100 + z / 100)
  {
    heights.push_back(z);
    values.push_back(
      (z > 800 && z < 1600 ? 0.02 : 0) + 4e-4 * std::exp(-std::pow((z - 9000) / 900, 2)));
  }
  return { { { { 0 }, { 0 }, heights } }, values };
}

/// Three round heaps on a common base, at 21 x 17 x 13 points of a cubic kilometre; they end sharply. 1/m.
DensityGrid heaps()
{
  constexpr double Heaps[3][4] = { { 300, 350, 200, 220 }, { 620, 500, 250, 280 },
    { 480, 750, 180, 160 } };
  std::array<std::vector<double>, 3> places;
  const int size[] = { 21, 17, 13 };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i < size[axis]; ++i)
    {
      places[axis].push_back(1000.0 * i / (size[axis] - 1));
    }
  }
  std::vector<double> values;
  for (const double z : places[2])
  {
    for (const double y : places[1])
    {
      for (const double x : places[0])
      {
        const bool inside = std::any_of(std::begin(Heaps), std::end(Heaps),
          [x, y, z](const double* h)
          { return z > 150 && std::hypot(x - h[0], y - h[1], z - h[2]) < h[3]; });
        values.push_back(inside ? 0.016 : 0);
      }
    }
  }
  return { places, values };
}

/// Errors against the number of Gaussians, of sums that meet ever smaller tolerances.
void addSums(const std::string& what, const DensityGrid& density,
  const std::vector<double>& tolerances, LogChart& chart, const Progress& progress)
{
  ChartCurve integrals;
  ChartCurve itself;
  for (const double tolerance : tolerances)
  {
    tell(progress, "Gaussians, " + what + " to " + std::to_string(tolerance));
    DensityFitSettings settings;
    settings.tolerance = tolerance;
    const std::vector<Fit> fits = fitDensity(density, settings);
    const auto terms = static_cast<double>(std::count_if(
      fits.begin(), fits.end(), [](const Fit& fit) { return fit.name.rfind("Gaussian", 0) == 0; }));
    integrals.points.push_back(
      { terms, fitOf(fits, "sum").heldOut.rms, what, "optical depths of rays", true });
    itself.points.push_back(
      { terms, fitOf(fits, "density").heldOut.rms, what, "the density itself", false });
  }
  chart.curves.push_back(integrals);
  chart.curves.push_back(itself);
}
}

std::vector<NamedChart> fitCharts(bool quick, const Progress& progress)
{
  LogChart density;
  density.title = "Density as a sum of Gaussians: error against their number";
  density.subtitle = "the fewest that were found for tolerances of the optical depths; held-out "
                     "rays; stratus and heaps end sharply";
  density.xLabel = "Gaussians";
  density.yLabel = "RMS error over the RMS of what is exact";
  density.xUnit = Unit::Count;
  addSums("column of two layers", column(), { 0.1, 0.03, 0.01 }, density, progress);
  addSums("three heaps", heaps(),
    quick ? std::vector<double>{ 0.4, 0.2 } : std::vector<double>{ 0.4, 0.2, 0.1 }, density,
    progress);
  return { { "transmittance", transmittanceChart(progress) }, { "density", density } };
}
}
}
