// SPDX-License-Identifier: BSD-3-Clause
#include "Report.h"

#include "ChartFiles.h"
#include "LogChart.h"
#include "ReportText.h"

#include <filesystem>

namespace nephoscope
{
namespace charts
{
namespace
{
using performance::Measurement;
using performance::Situation;

Situation situation(const std::array<int, 3>& points, const std::array<int, 2>& pixels, int threads)
{
  Situation s;
  s.points = points;
  s.pixels = pixels;
  s.threads = threads;
  return s;
}

/// The same situation for each of several grids.
std::vector<Situation> grids(
  const std::vector<std::array<int, 3>>& sizes, const std::array<int, 2>& pixels, int threads)
{
  std::vector<Situation> all;
  for (const auto& points : sizes)
  {
    all.push_back(situation(points, pixels, threads));
  }
  return all;
}

std::vector<performance::Method> methodsOf(const std::string& group)
{
  std::vector<performance::Method> found;
  for (const performance::Method& method : performance::methods())
  {
    if (method.group == group)
    {
      found.push_back(method);
    }
  }
  return found;
}

double sizeOf(const Situation& s, Study::Kind kind)
{
  return kind == Study::GrowthWithPixels ? static_cast<double>(s.pixels[0]) * s.pixels[1]
                                         : static_cast<double>(s.cells());
}

const char* errorLabel(const std::string& group)
{
  return group == "contour"                    ? "RMS error of cloud fraction over the surface"
    : group == "advection"                     ? "RMS error of position, m of the scene"
    : group == "order" || group == "voxels"    ? "RMS error of radiance"
    : group == "scattering" || group == "haze" ? "Median relative error of light"
                                               : "RMS error of transmittance";
}

LogChart speedAndAccuracy(const Study& study, const std::vector<Measurement>& measured)
{
  LogChart chart;
  chart.xLabel = "Time a run: median wall clock, after the first";
  chart.yLabel = errorLabel(study.group);
  chart.pareto = true;
  for (const Measurement& m : measured)
  {
    const auto error = m.figures.find("error");
    if (m.leftOut.empty() && error != m.figures.end())
    {
      chart.points.push_back(
        { m.median(), error->second, m.method.name, settingsText(m.method), m.method.ours });
    }
  }
  return chart;
}

LogChart growth(const Study& study, const std::vector<Measurement>& measured)
{
  LogChart chart;
  chart.xLabel = study.kind == Study::GrowthWithPixels ? "Pixels" : "Hexahedral cells";
  chart.yLabel = "Time a run: median wall clock";
  chart.xUnit = Unit::Count;
  chart.yUnit = Unit::Seconds;
  chart.linearGuide = true;
  for (const performance::Method& method : methodsOf(study.group))
  {
    ChartCurve curve;
    for (const Measurement& m : measured)
    {
      if (m.leftOut.empty() && m.method.label() == method.label())
      {
        curve.points.push_back({ sizeOf(m.situation, study.kind), m.median(), method.name,
          settingsText(method), method.ours });
      }
    }
    chart.curves.push_back(curve);
  }
  return chart;
}

std::vector<Measurement> measureStudy(const Study& study, const ReportOptions& options)
{
  std::vector<Measurement> all;
  for (const Situation& s : study.situations)
  {
    const auto some = performance::measure(methodsOf(study.group), s, study.effort,
      [&](const std::string& what)
      {
        if (options.progress)
        {
          options.progress(study.name + ", " + situationText(s) + ": " + what);
        }
      });
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

void writeChart(
  const Study& study, const std::vector<Measurement>& measured, const std::string& folder)
{
  LogChart chart = study.kind == Study::SpeedAndAccuracy ? speedAndAccuracy(study, measured)
                                                         : growth(study, measured);
  chart.title = titleOf(study);
  chart.subtitle = subtitleOf(study, measured);
  writeChartFiles(chart, folder, study.name);
}
}

std::vector<Study> studies(bool quick, int threads)
{
  using Sizes = std::vector<std::array<int, 3>>;
  const std::array<int, 2> picture =
    quick ? std::array<int, 2>{ 384, 288 } : std::array<int, 2>{ 1024, 768 };
  const std::array<int, 3> grid =
    quick ? std::array<int, 3>{ 120, 60, 13 } : std::array<int, 3>{ 320, 160, 19 };
  const performance::Effort accuracy{ quick ? 3 : 7, quick ? 2.0 : 30.0, true };
  const performance::Effort growing{ quick ? 2 : 3, quick ? 1.0 : 8.0, false };
  const Sizes sizes = quick ? Sizes{ { 40, 20, 9 }, { 80, 40, 9 }, { 160, 80, 9 } }
                            : Sizes{ { 96, 64, 19 }, { 160, 120, 31 }, { 320, 160, 37 },
                                { 640, 320, 31 }, { 800, 500, 51 } };
  std::vector<Situation> pictures;
  for (const int n :
    quick ? std::vector<int>{ 96, 192, 384 } : std::vector<int>{ 256, 512, 1024, 2048 })
  {
    pictures.push_back(
      situation(quick ? std::array<int, 3>{ 80, 40, 9 } : std::array<int, 3>{ 128, 96, 19 },
        { n, n * 3 / 4 }, threads));
  }
  return {
    { "contour", "contour", Study::SpeedAndAccuracy, grids({ grid }, picture, threads), accuracy },
    { "volume", "volume", Study::SpeedAndAccuracy, grids({ grid }, picture, threads), accuracy },
    { "order", "order", Study::SpeedAndAccuracy,
      grids({ quick ? grid : std::array<int, 3>{ 160, 80, 19 } }, picture, threads), accuracy },
    { "advection", "advection", Study::SpeedAndAccuracy, grids({ grid }, picture, threads),
      accuracy },
    { "scattering", "scattering", Study::SpeedAndAccuracy, grids({ grid }, picture, threads),
      accuracy },
    { "haze", "haze", Study::SpeedAndAccuracy, grids({ grid }, picture, threads),
      { 3, quick ? 0.2 : 2.0, true } },
    { "voxels", "voxels", Study::SpeedAndAccuracy,
      grids({ quick ? std::array<int, 3>{ 96, 96, 96 } : std::array<int, 3>{ 256, 256, 256 } },
        quick ? picture : std::array<int, 2>{ 512, 384 }, threads),
      accuracy },
    { "contour-cells", "contour", Study::GrowthWithCells, grids(sizes, picture, threads), growing },
    { "volume-cells", "volume", Study::GrowthWithCells, grids(sizes, picture, threads), growing },
    { "volume-pixels", "volume", Study::GrowthWithPixels, pictures, growing },
  };
}

void writeReport(const ReportOptions& options)
{
  makeFolder(options.folder);
  std::vector<std::pair<Study, std::vector<Measurement>>> results;
  for (const Study& study : studies(options.quick, options.threads))
  {
    results.emplace_back(study, measureStudy(study, options));
    writeChart(study, results.back().second, options.folder);
  }
  const std::filesystem::path folder(options.folder);
  writeText(folder / "chart.json", jsonText(results, options));
  writeText(folder / "index.html", pageText(results, options));
}
}
}
