// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file ReportText.h
 * @brief The words of a report: titles, the JSON, the page.
 */
#ifndef ReportText_h
#define ReportText_h

#include "Report.h"

#include <utility>

namespace nephoscope
{
namespace charts
{
using Results = std::vector<std::pair<Study, std::vector<performance::Measurement>>>;

std::string settingsText(const performance::Method& method);        ///< "merged, normals"
std::string situationText(const performance::Situation& situation); ///< "320 x 160 x 19 points"
std::string titleOf(const Study& study);
std::string subtitleOf(const Study& study, const std::vector<performance::Measurement>& measured);

std::string jsonText(const Results& results, const ReportOptions& options);
std::string pageText(const Results& results, const ReportOptions& options);
}
}
#endif
