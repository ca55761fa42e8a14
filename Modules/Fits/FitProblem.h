// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file FitProblem.h
 * @brief An approximation with named, bounded parameters, the cases it is to meet, and the parameters that meet them best.
 *
 *     minimise  1/2 sum_i  w_i rho(r_i^2),    r_i = residual(model(x_i, p), t_i),    lower <= p <= upper
 *
 * by Levenberg and Marquardt's method in Ceres, one thread, dense QR (normal equations if `improvement` is asked for): the same bits
 * in every run. rho is the identity or Huber's
 * loss. Weights are scaled so that their mean is 1.
 *
 * Residuals, of model value m and exact value t:
 *     absolute     m - t
 *     relative     (m - t) / max(|t|, floor)
 *     perceptual   (L(m) - L(t)) / 100 with L the CIE 1976 lightness of a radiance relative to white, continued by its
 *                  straight part below 0: what an eye sees of it
 *
 * Covariance: s^2 (J^T J)^-1 of the parameters that are not at a bound, J the weighted residuals' derivatives, s^2 the weighted sum
 * of r^2 over the number of cases less that of parameters. It measures how sharply the cases fix the parameters, not the
 * model's own error, which is RemainingError. Conditioning: singular values of J with columns of length 1; below 1e-7 of the
 * largest they are not determined, and the parameters in their directions are named in a warning.
 *
 * Errors (FitError, one line): no parameters or model, no or too few cases, bounds in the wrong order, a start outside them, an input, target or weight that is not
 * finite, a negative weight, a model that is not finite at the start (the case is named), a cost that overflows, no convergence.
 * @sa FitModel.h, TestFitProblem.cxx
 */
#ifndef FitProblem_h
#define FitProblem_h

#include "Calibration.h"

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace nephoscope
{
struct FitError : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

struct FitParameter
{
  std::string name;
  double start;
  double lower;
  double upper;
};

/// What the model is asked, and what it ought to answer.
struct FitCase
{
  std::vector<double> input;
  double target;
  double weight = 1; ///< >= 0, of the squared residual
};

/// The model's value for a case's input and parameters; its derivatives by them too if gradient is not null.
using FitModel =
  std::function<double(const double* input, const double* parameters, double* gradient)>;

enum class Residual
{
  Absolute,
  Relative,
  Perceptual
};

struct FitProblem
{
  std::string name;
  std::vector<FitParameter> parameters;
  FitModel model;
  std::vector<FitCase> training; ///< more than there are parameters
  std::vector<FitCase> heldOut;  ///< only measured; may be empty

  Residual residual = Residual::Absolute;
  double floor = 1e-3;    ///< of relative residuals, in the target's unit, > 0
  double robustScale = 0; ///< Huber's: residuals beyond count linearly; 0: all count squared
  double improvement =
    0; ///< the search ends with a step that lowers the cost by less than this share; 0: when none lowers it
};

/// @throw FitError
Fit solve(const FitProblem& problem);

/// The parameters alone, without covariance and errors: for steps of a larger search. @throw FitError
std::vector<double> bestParameters(const FitProblem& problem);

/// The residual itself; NaN if an argument is.
double residualOf(const FitProblem& problem, double model, double target);
}
#endif
