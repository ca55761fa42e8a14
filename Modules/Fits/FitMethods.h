// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file FitMethods.h
 * @brief The constants of cost and error models (MethodChoice.h), fitted to what methods cost and by how much they were wrong.
 *
 *     seconds: sum_i c_i w_i, c_i in microseconds from 0 to 1e6, relative residuals
 *     error:   log scale + power log x, absolute residuals; then scale is raised by exp(k s), s the standard deviation of the n
 *              training cases' residuals and k the factor of a normal distribution's one-sided tolerance limit: with 95 %
 *              confidence, 95 % of all cases lie below (Natrella, Experimental Statistics, 1963, 2-4; k is 2.38 for n = 20, 1.92 for
 *              100). The power is 0 where all cases are equally coarse.
 * @sa FitProblem.h, vtkCloudModelSelector, Utilities/Doc/choosing.md
 */
#ifndef FitMethods_h
#define FitMethods_h

#include "Calibration.h"

#include <string>
#include <vector>

namespace nephoscope
{
/// A method that was measured.
struct MethodTrial
{
  std::vector<double> work;
  double coarseness = 1;
  double seconds = 0;
  double error = 0;
  bool heldOut = false; ///< not for fitting
};

struct TriedMethod
{
  std::string name;
  std::vector<std::string> work;
  bool hasError = true; ///< false: none is fitted
  std::vector<MethodTrial> trials;
};

/// The fits "NAME seconds" and "NAME error" of a method. @throw FitError
std::vector<Fit> fitMethod(const TriedMethod& method);
}
#endif
