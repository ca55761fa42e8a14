// SPDX-License-Identifier: BSD-3-Clause
#include "FitMethods.h"

#include "FitProblem.h"
#include "RemainingErrorOf.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
/// Errors below this are rounding: pictures are float, and dark pixels count as DarkestRadiance.
constexpr double Rounding = 1e-6;
constexpr double LogLimit = 28; // of the scale's logarithm: from 1e-12 to 1e12
/// Coefficients are in microseconds, so that they are numbers near 1.
constexpr double Micro = 1e-6;

void addCase(FitProblem& problem, const MethodTrial& trial, FitCase fitCase)
{
  (trial.heldOut ? problem.heldOut : problem.training).push_back(std::move(fitCase));
}

Fit fitSeconds(const TriedMethod& method)
{
  FitProblem problem;
  problem.name = method.name + " seconds";
  problem.residual = Residual::Relative;
  problem.floor = 1e-4; // what is quicker does not matter
  problem.robustScale = 1;
  for (const std::string& work : method.work)
  {
    problem.parameters.push_back({ work, 0.1, 0, 1e6 });
  }
  const std::size_t n = method.work.size();
  problem.model = [n](const double* work, const double* c, double* gradient)
  {
    double seconds = 0;
    for (std::size_t i = 0; i < n; ++i)
    {
      seconds += Micro * c[i] * work[i];
      if (gradient)
      {
        gradient[i] = Micro * work[i];
      }
    }
    return seconds;
  };
  for (const MethodTrial& trial : method.trials)
  {
    addCase(problem, trial, { trial.work, trial.seconds });
  }
  return solve(problem);
}

/// log of the error; parameters are the scale's logarithm and the power.
double logError(const double* coarseness, const double* p, double* gradient)
{
  const double x = std::log(coarseness[0]);
  if (gradient)
  {
    gradient[0] = 1;
    gradient[1] = x;
  }
  return p[0] + p[1] * x;
}

/// Makes the first parameter what it was the logarithm of.
void takeExponential(Fit& fit)
{
  FittedParameter& scale = fit.parameters[0];
  scale.name = "scale";
  scale.value = std::exp(scale.value);
  scale.lower = std::exp(scale.lower);
  scale.upper = std::exp(scale.upper);
  scale.standardError *= scale.value;
  const std::size_t n = fit.parameters.size();
  for (std::size_t i = 0; i < n; ++i)
  {
    fit.covariance[i] *= scale.value;
    fit.covariance[i * n] *= scale.value;
  }
}

/// k so that the mean and k standard deviations of n values bound 95 % of their normal distribution, with 95 % confidence.
double toleranceFactor(std::size_t n)
{
  constexpr double z = 1.6449; // of 95 %
  const auto count = static_cast<double>(std::max<std::size_t>(n, 4));
  const double a = 1 - z * z / (2 * (count - 1));
  const double b = z * z * (1 - 1 / count);
  return (z + std::sqrt(z * z - a * b)) / a;
}

/// Raises the logarithm of the scale to the tolerance limit.
void raise(const FitProblem& problem, Fit& fit)
{
  double p[2] = { fit.parameters[0].value, fit.parameters[1].value };
  p[0] += toleranceFactor(problem.training.size()) * fit.training.rms;
  p[0] = fit.parameters[0].value = std::min(p[0], LogLimit);
  fit.training = remainingError(problem, problem.training, { p[0], p[1] });
  fit.heldOut = remainingError(problem, problem.heldOut, { p[0], p[1] });
}

Fit fitError(const TriedMethod& method)
{
  FitProblem problem;
  problem.name = method.name + " error";
  problem.model = logError;
  double least = HUGE_VAL;
  double most = 0;
  for (const MethodTrial& trial : method.trials)
  {
    least = std::min(least, trial.coarseness);
    most = std::max(most, trial.coarseness);
    addCase(problem, trial, { { trial.coarseness }, std::log(std::max(trial.error, Rounding)) });
  }
  // Equally coarse cases leave the power open; bounds that meet at 0 hold it there.
  const double steepest = most > 1.01 * least ? 6 : 1e-9;
  problem.parameters = { { "log scale", -4, -LogLimit, LogLimit },
    { "power", steepest / 6, 0, steepest } };
  Fit fit = solve(problem);
  raise(problem, fit);
  takeExponential(fit);
  return fit;
}
}

std::vector<Fit> fitMethod(const TriedMethod& method)
{
  std::vector<Fit> fits{ fitSeconds(method) };
  if (method.hasError)
  {
    fits.push_back(fitError(method));
  }
  return fits;
}
}
