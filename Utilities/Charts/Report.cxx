// SPDX-License-Identifier: BSD-3-Clause
#include "Report.h"

#include "ChartFiles.h"
#ifdef NEPHOSCOPE_FITS
#include "FitCharts.h"
#endif
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

/// Pictures are float.
constexpr double Rounding = 1e-6;

const char* errorLabel(const Study& study)
{
  const std::string& group = study.group;
  return study.kind == Study::Choices          ? "Error of radiance of 95 % of the pixels, relative"
    : group == "contour"                       ? "RMS error of cloud fraction over the surface"
    : group == "advection"                     ? "RMS error of position, m of the scene"
    : group == "conversion"                    ? "RMS error of voxels' means, relative"
    : group == "order" || group == "voxels"    ? "RMS error of radiance"
    : group == "scattering" || group == "haze" ? "Median relative error of light"
                                               : "RMS error of transmittance";
}

LogChart speedAndAccuracy(const StudyResult& result)
{
  const Study& study = result.study;
  LogChart chart;
  chart.xLabel = "Time a run: median wall clock, after the first";
  chart.yLabel = errorLabel(study);
  chart.pareto = true;
  // Errors of choices below the rounding of pictures are drawn at it.
  const double least = study.kind == Study::Choices ? Rounding : 0;
  for (const Measurement& m : result.measured)
  {
    const auto error = m.figures.find("error");
    if (m.leftOut.empty() && error != m.figures.end())
    {
      chart.points.push_back({ m.median(), std::max(error->second, least), m.method.name,
        settingsText(m.method), m.method.ours, tolerancesOf(m.method, result.choices) });
    }
  }
  return chart;
}

LogChart growth(const StudyResult& result)
{
  const Study& study = result.study;
  LogChart chart;
  chart.xLabel = study.kind == Study::GrowthWithPixels ? "Pixels" : "Hexahedral cells";
  chart.yLabel = "Time a run: median wall clock";
  chart.xUnit = Unit::Count;
  chart.yUnit = Unit::Seconds;
  chart.linearGuide = true;
  for (const performance::Method& method : methodsOf(study.group))
  {
    ChartCurve curve;
    for (const Measurement& m : result.measured)
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

StudyResult measureStudy(const Study& study, const ReportOptions& options)
{
  StudyResult result{ study, {}, {} };
  std::vector<performance::Method> wanted;
  if (study.kind == Study::Choices)
  {
    ChoiceStudy family = choiceStudy(study.group, study.situations.front());
    wanted = std::move(family.methods);
    result.choices = std::move(family.choices);
  }
  else
  {
    wanted = methodsOf(study.group);
  }
  for (const Situation& s : study.situations)
  {
    const auto some = performance::measure(wanted, s, study.effort,
      [&](const std::string& what)
      {
        if (options.progress)
        {
          options.progress(study.name + ", " + situationText(s) + ": " + what);
        }
      });
    result.measured.insert(result.measured.end(), some.begin(), some.end());
  }
  return result;
}

void writeChart(const StudyResult& result, const std::string& folder)
{
  const Study::Kind kind = result.study.kind;
  LogChart chart = kind == Study::SpeedAndAccuracy || kind == Study::Choices
    ? speedAndAccuracy(result)
    : growth(result);
  chart.title = titleOf(result.study);
  chart.subtitle = subtitleOf(result);
  writeChartFiles(chart, folder, result.study.name);
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
  std::vector<Study> all{
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
    { "conversion", "conversion", Study::SpeedAndAccuracy,
      grids({ quick ? std::array<int, 3>{ 80, 40, 9 } : grid }, picture, threads),
      { 3, quick ? 1.0 : 8.0, true } },
    { "contour-cells", "contour", Study::GrowthWithCells, grids(sizes, picture, threads), growing },
    { "volume-cells", "volume", Study::GrowthWithCells, grids(sizes, picture, threads), growing },
    { "volume-pixels", "volume", Study::GrowthWithPixels, pictures, growing },
  };
  for (const std::string& family : choiceFamilies())
  {
    if (!quick || family == "cells")
    {
      const std::array<int, 2> size =
        quick ? std::array<int, 2>{ 64, 48 } : std::array<int, 2>{ 96, 72 };
      all.push_back({ "choice-" + family, family, Study::Choices,
        { situation({ 0, 0, 0 }, size, threads) }, { quick ? 2 : 5, quick ? 0.5 : 2.0, true } });
    }
  }
  return all;
}

void writeReport(const ReportOptions& options)
{
  makeFolder(options.folder);
  std::vector<StudyResult> results;
  for (const Study& study : studies(options.quick, options.threads))
  {
    results.push_back(measureStudy(study, options));
    writeChart(results.back(), options.folder);
  }
  std::vector<NamedChart> fits;
#ifdef NEPHOSCOPE_FITS
  fits = fitCharts(options.quick, options.progress);
#endif
  for (const NamedChart& fit : fits)
  {
    writeChartFiles(fit.chart, options.folder, fit.name);
  }
  const std::filesystem::path folder(options.folder);
  writeText(folder / "chart.json", jsonText(results, fits, options));
  writeText(folder / "index.html", pageText(results, fits, options));
}
}
}
