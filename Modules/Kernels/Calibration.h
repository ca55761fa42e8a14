// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Calibration.h
 * @brief Constants fitted to exact integrals, with what is known about them: standard errors, and errors on held-out cases.
 *
 * A calibration is a named list of fits; a fit is a named list of parameters. The module Fits makes calibrations, a file of
 * Data/Calibration keeps them, and who draws looks constants up by name.
 * @sa readCalibration, vtkCloudFit, Utilities/Doc/fits.md
 */
#ifndef Calibration_h
#define Calibration_h

#include <string>
#include <string_view>
#include <vector>

namespace nephoscope
{
struct FittedParameter
{
  std::string name;
  double value = 0;
  /// Of the value, in its unit. At a bound 0: the bound says what it is. Not determined by the cases: that of a
  /// uniform distribution between the bounds, (upper - lower) / sqrt(12).
  double standardError = 0;
  double lower = 0;
  double upper = 0;
  bool atBound = false;
  bool determined = true;
};

/// What remains between the approximation and the exact value, in the unit of the fit's residual; weighted as the cases.
struct RemainingError
{
  int cases = 0;
  double bias = 0;   ///< mean, signed: positive if the approximation is too large
  double rms = 0;    ///< root of the mean square
  double median = 0; ///< of the absolute value
  double p95 = 0;    ///< 95 % of the cases are at or below
  double max = 0;
};

struct Fit
{
  std::string name;
  std::string residual; ///< absolute, relative or perceptual
  std::vector<FittedParameter> parameters;
  std::vector<double>
    covariance; ///< of the parameters, row by row; 0 where they are at a bound or not determined
  RemainingError training;
  RemainingError heldOut; ///< cases that the parameters have not seen
  int iterations = 0;
  std::vector<std::string> warnings;
  double seconds = 0; ///< differs from run to run, so that no file keeps it

  /// The value of a parameter. @throw std::out_of_range naming the fit, the parameter and those that there are
  double value(std::string_view parameter) const;
};

struct Calibration
{
  std::string what;    ///< transmittance, phase, ...
  std::string command; ///< that makes it again
  std::vector<Fit> fits;

  /// The fit of a name. @throw std::out_of_range naming what is missing and where
  const Fit& fit(std::string_view name) const;
};

/// What contradicts itself: no name, a value that is not finite or outside its bounds, a covariance of the wrong size.
/// @return one line, empty if all is well
std::string whatIsWrong(const Calibration& calibration);
}
#endif
