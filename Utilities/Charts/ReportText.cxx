// SPDX-License-Identifier: BSD-3-Clause
#include "ReportText.h"

#include "SvgDrawing.h"

#include "vtkVersion.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

namespace nephoscope
{
namespace charts
{
namespace
{
using performance::Measurement;
using performance::Situation;
using Json = nlohmann::ordered_json;

std::string processor()
{
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
  {
    const std::size_t colon = line.find(": ");
    if (line.compare(0, 10, "model name") == 0 && colon != std::string::npos)
    {
      return line.substr(colon + 2);
    }
  }
  return "not known";
}

std::string digits(const char* format, double value)
{
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string secondsText(double seconds)
{
  return seconds >= 1 ? digits("%.2f s", seconds) : digits("%.3g ms", seconds * 1e3);
}

Json situationJson(const Situation& s)
{
  return { { "points", s.points }, { "cells", s.cells() }, { "pixels", s.pixels },
    { "threads", s.threads } };
}

Json measurementJson(const Measurement& m)
{
  Json json = { { "method", m.method.name }, { "settings", m.method.settings },
    { "ours", m.method.ours }, { "situation", situationJson(m.situation) } };
  if (!m.leftOut.empty())
  {
    json["leftOut"] = m.leftOut;
    return json;
  }
  json["seconds"] = { { "prepare", m.prepareSeconds }, { "first", m.firstSeconds },
    { "runs", m.seconds }, { "median", m.median() }, { "spread", m.spread() } };
  json["bytes"] = { { "input", m.inputMemory }, { "peak", m.peakMemory } };
  json["figures"] = m.figures;
  json["loadAverage"] = m.load;
  return json;
}

Json curveJson(const ChartCurve& curve)
{
  Json json;
  for (const ChartPoint& p : curve.points)
  {
    json["name"] = p.name;
    json["detail"] = p.detail;
    json["points"].push_back({ p.x, p.y });
  }
  return json;
}

/// A chart's title and picture.
std::string heading(const std::string& name, const std::string& title)
{
  return "<h2>" + escaped(title) + "</h2>\n<img src=\"" + name + ".svg\" alt=\"" + escaped(title) +
    "\">\n";
}

std::string figureText(const Measurement& m, const char* name)
{
  const auto found = m.figures.find(name);
  return found == m.figures.end() ? "" : digits("%.3g", found->second);
}

/// What is taken for each tolerance, and what cannot be reached.
std::string choicesText(const std::vector<Choice>& choices)
{
  std::string text;
  for (const Choice& choice : choices)
  {
    text += (text.empty() ? "" : "; ") + digits("%g", choice.tolerance) + ": " +
      (choice.method.empty() ? "cannot be reached, " + digits("%.2g", choice.reachable) + " can"
                             : choice.method);
  }
  return text;
}

std::string row(const std::vector<std::string>& cells, const char* tag)
{
  std::string text = "<tr>";
  for (const std::string& cell : cells)
  {
    text += std::string("<") + tag + ">" + escaped(cell) + "</" + tag + ">";
  }
  return text + "</tr>\n";
}

std::string tableText(const std::vector<Measurement>& measured)
{
  std::string table = "<table>\n" +
    row({ "method", "settings", "grid", "picture", "median", "spread", "first", "input", "peak",
          "RMS error", "largest error", "lost", "load" },
      "th");
  for (const Measurement& m : measured)
  {
    const Situation& s = m.situation;
    const std::string grid = situationText(s);
    const std::string picture = std::to_string(s.pixels[0]) + " x " + std::to_string(s.pixels[1]);
    if (!m.leftOut.empty())
    {
      table += row(
        { m.method.name, settingsText(m.method), grid, picture, "left out: " + m.leftOut }, "td");
      continue;
    }
    table += row({ m.method.name, settingsText(m.method), grid, picture, secondsText(m.median()),
                   secondsText(m.spread()), secondsText(m.firstSeconds),
                   digits("%.0f MB", m.inputMemory / 1e6), digits("%.0f MB", m.peakMemory / 1e6),
                   figureText(m, "error"), figureText(m, "largestError"), figureText(m, "lost"),
                   digits("%.1f", m.load) },
      "td");
  }
  return table + "</table>\n";
}

std::string machineText(const ReportOptions& options)
{
  return processor() + ", " + std::to_string(std::thread::hardware_concurrency()) + " cores, " +
    std::to_string(options.threads) + " threads, VTK " + vtkVersion::GetVTKVersion();
}
}

std::string settingsText(const performance::Method& method)
{
  std::string text;
  for (const auto& setting : method.settings)
  {
    const std::string words = setting.second == "yes" ? setting.first
      : setting.second == "no"                        ? "no " + setting.first
                                                      : setting.first + " " + setting.second;
    text += (text.empty() ? "" : ", ") + words;
  }
  return text;
}

std::string situationText(const Situation& s)
{
  if (s.points[0] == 0)
  {
    return std::to_string(s.pixels[0]) + " x " + std::to_string(s.pixels[1]) + " pixels";
  }
  return std::to_string(s.points[0]) + " x " + std::to_string(s.points[1]) + " x " +
    std::to_string(s.points[2]) + " points";
}

std::string optionText(const performance::Method& method)
{
  return method.name + (method.settings.empty() ? "" : ", " + settingsText(method));
}

std::string tolerancesOf(const performance::Method& method, const std::vector<Choice>& choices)
{
  std::string text;
  for (const Choice& choice : choices)
  {
    if (choice.method == optionText(method))
    {
      text += (text.empty() ? "taken for " : ", ") + digits("%g", choice.tolerance);
    }
  }
  return text;
}

std::string titleOf(const Study& study)
{
  if (study.kind == Study::Choices)
  {
    return titleOfFamily(study.group) + ": what is taken for a tolerance";
  }
  const std::string what = study.group == "contour" ? "Contours of a gridded cloud field"
    : study.group == "advection"                    ? "A step of trajectories on a turning globe"
    : study.group == "order"                        ? "Orders of cells in volume pictures"
    : study.group == "scattering" ? "Sunlight scattered once in height-field clouds"
    : study.group == "haze"       ? "Shafts of sunlight in haze"
    : study.group == "conversion" ? "A gridded cloud field as voxels of an OpenVDB file"
    : study.group == "voxels"     ? "Sunlight scattered once in voxels of an OpenVDB file"
                                  : "Volume pictures of a gridded cloud field";
  switch (study.kind)
  {
    case Study::SpeedAndAccuracy:
      return what + ": speed and accuracy";
    case Study::GrowthWithCells:
      return what + ": growth with cells";
    default:
      return what + ": growth with pixels";
  }
}

std::string subtitleOf(const StudyResult& result)
{
  const Study& study = result.study;
  const Situation& s = study.situations.front();
  if (study.kind == Study::Choices)
  {
    std::string text = situationText(s) + ", " + std::to_string(s.threads) +
      " threads; below 1e-6 errors are rounding, and drawn there";
    for (const Choice& choice : result.choices)
    {
      text +=
        choice.method.empty() ? "; " + digits("%g", choice.tolerance) + " cannot be reached" : "";
    }
    return text;
  }
  std::string text = study.kind == Study::GrowthWithCells ? "shell round a globe"
    : study.group == "voxels"                             ? situationText(s)
    : study.group == "conversion"                         ? situationText(s) + ", a map"
                                                          : situationText(s) + " round a globe";
  if ((study.group == "volume" || study.group == "order" || study.group == "voxels") &&
    study.kind != Study::GrowthWithPixels)
  {
    text += ", " + std::to_string(s.pixels[0]) + " x " + std::to_string(s.pixels[1]) + " pixels";
  }
  if (study.group == "scattering")
  {
    return "12 slices of " + std::to_string(s.pixels[1]) + " rays from below, one thread";
  }
  if (study.group == "haze")
  {
    return std::to_string(s.pixels[0] / 8) + " x " + std::to_string(s.pixels[1] / 8) +
      " rays from below, one thread; the first run makes the table of Moments";
  }
  text += ", " + std::to_string(s.threads) + (s.threads == 1 ? " thread" : " threads");
  std::size_t leftOut = 0;
  double load = 0;
  for (const Measurement& m : result.measured)
  {
    leftOut += m.leftOut.empty() ? 0 : 1;
    load = std::max(load, m.load);
  }
  text += digits(", load average %.1f", load);
  return text + (leftOut > 0 ? ", " + std::to_string(leftOut) + " left out (see the table)" : "");
}

std::string jsonText(
  const Results& results, const std::vector<NamedChart>& fits, const ReportOptions& options)
{
  Json json = { { "quick", options.quick }, { "threads", options.threads },
    { "processor", processor() }, { "cores", std::thread::hardware_concurrency() },
    { "vtk", vtkVersion::GetVTKVersion() }, { "display", performance::haveDisplay() } };
  for (const auto& result : results)
  {
    Json measurements = Json::array();
    for (const Measurement& m : result.measured)
    {
      measurements.push_back(measurementJson(m));
    }
    const Study& study = result.study;
    Json entry = { { "name", study.name }, { "group", study.group }, { "runs", study.effort.runs },
      { "secondsEach", study.effort.seconds }, { "measurements", measurements } };
    for (const Choice& choice : result.choices)
    {
      entry["choices"].push_back({ { "tolerance", choice.tolerance },
        { "method", choice.method.empty() ? Json() : Json(choice.method) },
        { "reachable", choice.reachable } });
    }
    json["studies"].push_back(entry);
  }
  for (const NamedChart& fit : fits)
  {
    Json curves = Json::array();
    for (const ChartCurve& curve : fit.chart.curves)
    {
      curves.push_back(curveJson(curve));
    }
    json["fits"].push_back({ { "name", fit.name }, { "x", fit.chart.xLabel },
      { "y", fit.chart.yLabel }, { "curves", curves } });
  }
  return json.dump(2) + "\n";
}

std::string pageText(
  const Results& results, const std::vector<NamedChart>& fits, const ReportOptions& options)
{
  std::string page =
    "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
    "<title>Nephoscope: speed and accuracy</title>\n<style>\n"
    "body { font-family: sans-serif; margin: 2em auto; max-width: 1100px; color: #222; }\n"
    "img { width: 100%; }\ntable { border-collapse: collapse; font-size: 80%; }\n"
    "td, th { padding: 2px 8px; text-align: left; border-bottom: 1px solid #ddd; }\n"
    "</style>\n</head>\n<body>\n<h1>Speed and accuracy</h1>\n<p>" +
    escaped(machineText(options)) +
    ". Methods ran in turns, each in a process of its own. Medians and half the distance between "
    "the quartiles; first: the "
    "first run, which pays for what is built once; input: memory with the input made; peak: the "
    "most in the runs. Volumes drawn in a window are read back at 8 bits a channel, ours "
    "(vtkCloudVolumeMapper) too: their errors do not fall below 1.1e-3. Orders of cells are "
    "compared "
    "by the light of cloud that is dark where it is dense; for white cloud no order matters. All "
    "figures: <a href=\"chart.json\">chart.json</a>.</p>\n";
  for (const auto& result : results)
  {
    page += heading(result.study.name, titleOf(result.study)) +
      (result.choices.empty() ? "" : "<p>" + escaped(choicesText(result.choices)) + ".</p>\n") +
      tableText(result.measured);
  }
  for (const NamedChart& fit : fits)
  {
    page += heading(fit.name, fit.chart.title);
  }
  return page + "</body>\n</html>\n";
}
}
}
