// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file ChoiceStudy.h
 * @brief The methods that vtkCloudModelSelector knows for a part, each measured in one scene, and those that it takes for tolerances.
 *
 * A family is a part of a scene of MethodScenes.h. Its methods are those that the selector offers there; each draws the whole picture. The
 * error is that of the selector's promises: relative radiance, what 95 % of the pixels that the part touches do not exceed.
 * @sa Report.h, vtkCloudModelSelector, Utilities/Doc/choosing.md
 */
#ifndef ChoiceStudy_h
#define ChoiceStudy_h

#include "Benchmark.h"

#include <string>
#include <vector>

namespace nephoscope
{
namespace charts
{
/// What the selector took for a tolerance.
struct Choice
{
  double tolerance;
  std::string
    method; ///< with its settings, as the selector names it; none if the tolerance cannot be reached
  double reachable = 0; ///< the least error that is predicted of any methods
};

struct ChoiceStudy
{
  std::vector<performance::Method>
    methods; ///< those taken, and others that take no more than a second by the built-in constants
  std::vector<Choice> choices; ///< for 0.1, 0.01, ... 1e-5
};

/// The names of the families: "clouds", "clouds-above", "haze", "clear-haze", "cells".
const std::vector<std::string>& choiceFamilies();

/// A family's words for a chart's title.
std::string titleOfFamily(const std::string& family);

/**
 * Ask the selector, with the calibration in force. Pictures have the situation's pixels.x across, and three quarters of it up.
 * No thread is started. @throw std::runtime_error for a name that is none
 */
ChoiceStudy choiceStudy(const std::string& family, const performance::Situation& situation);
}
}
#endif
