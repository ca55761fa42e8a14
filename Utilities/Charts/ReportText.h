// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file ReportText.h
 * @brief The words of a report: titles, the JSON, the page.
 */
#ifndef ReportText_h
#define ReportText_h

#include "LogChart.h"
#include "Report.h"

namespace nephoscope
{
namespace charts
{
using Results = std::vector<StudyResult>;

std::string settingsText(const performance::Method& method); ///< "merged, normals"
std::string optionText(
  const performance::Method& method); ///< name and settings: "March, steps of 5 m"
std::string situationText(const performance::Situation& situation); ///< "320 x 160 x 19 points"
std::string titleOf(const Study& study);
std::string subtitleOf(const StudyResult& result);
/// "taken for 0.1, 0.01", or nothing.
std::string tolerancesOf(const performance::Method& method, const std::vector<Choice>& choices);

std::string jsonText(
  const Results& results, const std::vector<NamedChart>& fits, const ReportOptions& options);
std::string pageText(
  const Results& results, const std::vector<NamedChart>& fits, const ReportOptions& options);
}
}
#endif
