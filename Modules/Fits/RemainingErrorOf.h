// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file RemainingErrorOf.h
 * @brief Bias, RMS, median, 95 % and maximum of a model's residuals over cases, weighted as the cases are.
 */
#ifndef RemainingErrorOf_h
#define RemainingErrorOf_h

#include "FitProblem.h"

namespace nephoscope
{
/// All 0 without cases. @throw FitError if the model is not finite for one of them
RemainingError remainingError(const FitProblem& problem, const std::vector<FitCase>& cases,
  const std::vector<double>& parameters);
}
#endif
