// SPDX-License-Identifier: BSD-3-Clause
#include "ChoiceStudy.h"
#include "LogChart.h"
#include "MethodScenes.h"
#include "Quality.h"
#include "Report.h"
#include "ReportText.h"
#include "SvgDrawing.h"

#include <vtkCloudModelSelector.h>
#include <vtkNew.h>
#include <vtkSMPTools.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

using namespace nephoscope::charts;

namespace
{
std::vector<std::string> names(const std::vector<ChartPoint>& points)
{
  std::vector<std::string> all;
  for (const ChartPoint& p : points)
  {
    all.push_back(p.name);
  }
  return all;
}

/// A folder of its own that is gone afterwards.
class Scratch : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Folder = std::filesystem::temp_directory_path() /
      ("nephoscope_charts_" +
        std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(this->Folder);
    std::filesystem::create_directories(this->Folder);
  }
  void TearDown() override { std::filesystem::remove_all(this->Folder); }
  std::filesystem::path Folder;
};

/// Where each <text> stands: x, y, font size, words.
struct Words
{
  double x, y, size;
  std::string words;
};

std::vector<Words> textsOf(const std::string& svg)
{
  std::vector<Words> all;
  for (std::size_t at = svg.find("<text"); at != std::string::npos; at = svg.find("<text", at + 1))
  {
    Words w{};
    EXPECT_EQ(std::sscanf(svg.c_str() + at, "<text x=\"%lf\" y=\"%lf\" font-size=\"%lf\"", &w.x,
                &w.y, &w.size),
      3);
    const std::size_t from = svg.find('>', at) + 1;
    w.words = svg.substr(from, svg.find("</text>", at) - from);
    all.push_back(w);
  }
  return all;
}
}

TEST(ParetoFront, KeepsWhatNothingBeatsInBoth)
{
  const std::vector<ChartPoint> points = { { 1, 9, "fast", "", false },
    { 2, 3, "middle", "", true }, { 3, 4, "beaten", "", false }, { 8, 1, "exact", "", false },
    { 2, 3, "twin", "", false }, { 9, 1, "slower", "", false } };
  EXPECT_EQ(
    names(paretoFront(points)), (std::vector<std::string>{ "fast", "middle", "twin", "exact" }));
  EXPECT_TRUE(paretoFront({}).empty());
}

TEST(LogChart, NamesDoNotOverlapHoweverCloseThePointsAre)
{
  LogChart chart;
  for (int n = 0; n < 8; ++n)
  {
    chart.points.push_back({ 0.02 * (1 + 0.04 * n), 1e-3 * (1 + 0.02 * (n % 3)),
      "vtkSomethingWithALongName" + std::to_string(n), "setting " + std::to_string(n), n == 0 });
  }
  std::vector<Box> boxes;
  for (const Words& w : textsOf(drawChart(chart)))
  {
    if (w.words.find("vtk") == 0 || w.words.find("setting") == 0)
    {
      boxes.push_back(
        { w.x, w.y - w.size * 0.75, w.x + SvgDrawing::widthOf(w.words, w.size, false), w.y });
    }
  }
  ASSERT_EQ(boxes.size(), 16U);
  for (std::size_t a = 0; a < boxes.size(); ++a)
  {
    EXPECT_LT(boxes[a].right, 1000);
    for (std::size_t b = 0; b < a; ++b)
    {
      EXPECT_FALSE(boxes[a].overlaps(boxes[b])) << a << " and " << b;
    }
  }
}

TEST(LogChart, DrawsNoPointThatIsNotPositive)
{
  LogChart chart;
  chart.pareto = true;
  chart.points = { { 1, 0, "zero", "", false }, { -1, 1, "negative", "", false },
    { NAN, 1, "nan", "", false }, { 1, 1, "good", "", false } };
  const std::string svg = drawChart(chart);
  EXPECT_NE(svg.find("good"), std::string::npos);
  EXPECT_EQ(svg.find("zero"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(LogChart, TicksHaveUnits)
{
  LogChart chart;
  chart.points = { { 0.002, 1e-6, "a", "", false }, { 30, 1e-2, "b", "", false } };
  const std::string svg = drawChart(chart);
  for (const char* label : { ">1 ms<", ">10 ms<", ">100 ms<", ">1 s<", ">10 s<" })
  {
    EXPECT_NE(svg.find(label), std::string::npos) << label;
  }
}

TEST(SvgDrawing, EscapesWhatWouldBeMarkup)
{
  SvgDrawing drawing(10, 10);
  drawing.text(1, 2, "a<b & \"c\"", {});
  EXPECT_NE(drawing.svg().find("a&lt;b &amp; &quot;c&quot;"), std::string::npos);
}

TEST_F(Scratch, PngHasTheDrawingsSizeTimesTheScale)
{
  const std::string path = (this->Folder / "a.png").string();
  writePng(SvgDrawing(31, 20).svg(), path, 2);
  std::ifstream file(path, std::ios::binary);
  unsigned char head[24] = {};
  file.read(reinterpret_cast<char*>(head), sizeof head);
  EXPECT_EQ(std::string(head + 1, head + 4), "PNG");
  EXPECT_EQ(head[18] * 256 + head[19], 62);
  EXPECT_EQ(head[22] * 256 + head[23], 40);
}

TEST_F(Scratch, PngErrorsSayWhere)
{
  try
  {
    writePng(SvgDrawing(31, 20).svg(), (this->Folder / "no" / "a.png").string(), 1);
    FAIL();
  }
  catch (const std::runtime_error& error)
  {
    EXPECT_NE(std::string(error.what()).find("no/a.png"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("writable"), std::string::npos);
  }
}

// What is marked is what the selector takes, and is as exact as was asked for.
TEST(ChoiceStudy, MarksWhatTheSelectorTakes)
{
  nephoscope::performance::Situation situation;
  situation.pixels = { 36, 27 };
  const ChoiceStudy study = choiceStudy("haze", situation);
  ASSERT_EQ(study.choices.size(), 5U);
  std::map<std::string, double> errors;
  for (const auto& m :
    nephoscope::performance::measure(study.methods, situation, { 1, 0, true }, {}))
  {
    ASSERT_EQ(m.leftOut, "") << m.method.label();
    errors[optionText(m.method)] = m.figures.at("error");
  }
  const auto scene =
    nephoscope::program::methodScene(nephoscope::program::SceneKind::HazeUnderClouds, 20001, 36);
  vtkNew<vtkCloudModelSelector> selector;
  selector->SetCloudscape(scene.scape);
  nephoscope::program::useCalibration(selector);
  double tolerance = 0.1;
  for (const Choice& choice : study.choices)
  {
    EXPECT_DOUBLE_EQ(choice.tolerance, tolerance);
    selector->SetTolerance(tolerance);
    const auto select = [&selector] { EXPECT_TRUE(selector->Select()); };
    vtkSMPTools::LocalScope(vtkSMPTools::Config{ 1, "Sequential", false }, select);
    EXPECT_EQ(choice.method, selector->GetTaken("light in haze"));
    ASSERT_EQ(errors.count(choice.method), 1U) << choice.method;
    EXPECT_LE(errors[choice.method], tolerance) << choice.method;
    tolerance /= 10;
  }
  EXPECT_NE(study.choices.front().method, study.choices.back().method);
  EXPECT_EQ(selector->GetTaken("no such part"), "");
}

TEST(ChoiceStudy, FamiliesThatAreNoneAreRefused)
{
  try
  {
    choiceStudy("weather", {});
    FAIL();
  }
  catch (const std::runtime_error& error)
  {
    EXPECT_STREQ(error.what(), "there is no family of methods 'weather'");
  }
}

TEST(ReportText, TellsWhatCannotBeReached)
{
  StudyResult result;
  result.study = { "choice-cells", "cells", Study::Choices, { {} }, {} };
  nephoscope::performance::Measurement m;
  m.method.name = "March";
  m.method.settings = { { "steps of 5 m", "yes" } };
  m.situation.points = { 0, 0, 0 };
  result.measured = { m };
  result.choices = { { 0.1, "March, steps of 5 m", 2e-3 }, { 0.01, "March, steps of 5 m", 2e-3 },
    { 0.001, "", 2e-3 } };
  EXPECT_EQ(tolerancesOf(m.method, result.choices), "taken for 0.1, 0.01");
  const std::string page = pageText({ result }, {}, {});
  EXPECT_NE(page.find("0.01: March, steps of 5 m; 0.001: cannot be reached, 0.002 can."),
    std::string::npos);
  EXPECT_NE(subtitleOf(result).find("0.001 cannot be reached"), std::string::npos);
  EXPECT_TRUE(
    nlohmann::json::parse(jsonText({ result }, {}, {}))["studies"][0]["choices"][2]["method"]
      .is_null());
}

TEST(LogChart, MarksAreRingsWithWords)
{
  LogChart chart;
  chart.points = { { 1, 1, "plain", "", true }, { 10, 0.1, "marked", "", true, "taken for 0.1" } };
  const std::string svg = drawChart(chart);
  std::size_t discs = 0;
  for (std::size_t at = svg.find("<circle"); at != std::string::npos;
       at = svg.find("<circle", at + 1))
  {
    ++discs;
  }
  EXPECT_EQ(discs, 3U);
  EXPECT_NE(svg.find(">taken for 0.1<"), std::string::npos);
}

TEST_F(Scratch, ReportHasEveryMethodOrSaysWhyNot)
{
  ReportOptions options;
  options.folder = (this->Folder / "chart").string();
  options.quick = true;
  writeReport(options);
  std::ifstream file(options.folder + "/chart.json");
  const auto json = nlohmann::json::parse(file);
  ASSERT_EQ(json["studies"].size(), studies(true, options.threads).size());
  for (const auto& study : json["studies"])
  {
    const std::filesystem::path base =
      std::filesystem::path(options.folder) / study["name"].get<std::string>();
    EXPECT_GT(std::filesystem::file_size(base.string() + ".svg"), 2000U);
    EXPECT_GT(std::filesystem::file_size(base.string() + ".png"), 2000U);
    EXPECT_EQ(study.contains("choices"), study["name"] == "choice-cells") << study["name"];
    for (const auto& m : study["measurements"])
    {
      EXPECT_TRUE(m.contains("leftOut") || m["seconds"]["median"] > 0) << m.dump();
      // Only for want of a window.
      EXPECT_FALSE(m["ours"] == true && m.contains("leftOut") &&
        m["leftOut"].get<std::string>().find("xvfb-run") == std::string::npos)
        << m.dump();
    }
  }
  EXPECT_GT(std::filesystem::file_size(options.folder + "/index.html"), 2000U);
  if (!json.contains("fits"))
  {
    GTEST_SKIP() << "built without Ceres: no charts of fits";
  }
  // Powers reach as far as they like, to what is documented; polynomials fail with their range, quartics last.
  const auto& curves = json["fits"][0]["curves"];
  ASSERT_EQ(json["fits"][0]["name"], "transmittance");
  for (int n = 0; n < 3; ++n)
  {
    const auto& polynomial = curves[n]["points"];
    EXPECT_LT(polynomial.front()[1], 0.01 * polynomial.back()[1].get<double>());
    EXPECT_GT(curves[n + 3]["points"].back()[1], 0.03);
  }
  EXPECT_GT(curves[0]["points"][2][1], 5 * curves[1]["points"][2][1].get<double>());
  EXPECT_GT(curves[1]["points"][2][1], 5 * curves[2]["points"][2][1].get<double>());
  // More Gaussians, less error in optical depths; a sharp edge stays wrong.
  for (const auto& curve : json["fits"][1]["curves"])
  {
    const auto& points = curve["points"];
    EXPECT_GT(points.back()[0], points.front()[0]);
    EXPECT_LT(points.back()[1], points.front()[1]);
    EXPECT_GT(curve["detail"] == "the density itself" ? points.back()[1].get<double>() : 1, 0.05);
  }
}
