// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file FitSubjects.h
 * @brief What can be fitted, by name, each to its exact integral: the entry to the module.
 * @sa vtkCloudFit, Utilities/Doc/fits.md
 */
#ifndef FitSubjects_h
#define FitSubjects_h

#include "Calibration.h"
#include "FitProblem.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace nephoscope
{
struct FitRange
{
  double from;
  double to;
};

/// Called after each fit with the share that is done, 0 to 1; false ends the work, and what is done is returned.
using FitProgress = std::function<bool(double)>;

struct FitSubject
{
  std::string name;
  std::string about; ///< one line
  std::string range; ///< what a range means, with its unit and default
  std::function<std::vector<Fit>(const std::optional<FitRange>&, const FitProgress&)> run;
  /// The same for optical depths that occur in a picture instead of the subject's own cases; empty if that makes no sense.
  std::function<std::vector<Fit>(
    const std::vector<double>&, const std::optional<FitRange>&, const FitProgress&)>
    runForDepths = nullptr;
};

/// All subjects.
const std::vector<FitSubject>& fitSubjects();

/**
 * Fit a subject.
 * @param range in place of the subject's default
 * @param depths optical depths that occur, in place of the subject's cases; none: its own
 * @throw FitError with one line: no such subject (the names are listed), an empty or negative range, depths that the subject has no use
 *        for, and those of solve()
 */
Calibration runFit(const std::string& subject, const std::optional<FitRange>& range,
  const FitProgress& progress = nullptr, const std::vector<double>& depths = {});

/// Solve problems in order and report each. What a subject's run consists of.
std::vector<Fit> solveAll(const std::vector<FitProblem>& problems, const FitProgress& progress);
}
#endif
