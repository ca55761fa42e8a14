// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Report.h
 * @brief Measures a stated selection of methods and writes it down: chart.json, charts, a page.
 */
#ifndef Report_h
#define Report_h

#include "Benchmark.h"
#include "ChoiceStudy.h"

#include <functional>
#include <string>
#include <vector>

namespace nephoscope
{
namespace charts
{
struct ReportOptions
{
  std::string folder; ///< made if it is not there
  bool quick = false; ///< small sizes, under a minute
  int threads = 2;
  std::function<void(const std::string&)> progress; ///< told what is being done
};

/// What is measured for one chart.
struct Study
{
  std::string name;  ///< of the files
  std::string group; ///< of performance::methods(), or a family of choiceFamilies()
  enum Kind
  {
    SpeedAndAccuracy, ///< error against time at one situation
    GrowthWithCells,  ///< time against cells
    GrowthWithPixels, ///< time against pixels
    Choices           ///< error against time, with what is taken for tolerances
  } kind;
  std::vector<performance::Situation> situations;
  performance::Effort effort;
};

struct StudyResult
{
  Study study;
  std::vector<performance::Measurement> measured;
  std::vector<Choice> choices; ///< of Choices
};

/// The selection.
std::vector<Study> studies(bool quick, int threads);

/// Measure all studies and write DIR/chart.json, DIR/NAME.svg, DIR/NAME.png for each, DIR/index.html; with Ceres, charts of fits too. Throws
/// std::runtime_error. Call it while this process has a single thread.
void writeReport(const ReportOptions& options);
}
}
#endif
