// SPDX-License-Identifier: BSD-3-Clause
#include "FitMethods.h"

#include "FitProblem.h"
#include "RadianceError.h"
#include "RemainingErrorOf.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
/// Errors below this are rounding: pictures are float, and dark pixels count as DarkestRadiance.
constexpr double Rounding = 1e-6;
/// What the scale is raised by beyond the training cases.
constexpr double Margin = 2;
constexpr double LargestScale = 1e9;
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

/// log of the error; parameters are scale and power.
double logError(const double* coarseness, const double* p, double* gradient)
{
  const double x = std::log(coarseness[0]);
  if (gradient)
  {
    gradient[0] = 1 / p[0];
    gradient[1] = x;
  }
  return std::log(p[0]) + p[1] * x;
}

Fit fitError(const TriedMethod& method)
{
  FitProblem problem;
  problem.name = method.name + " error";
  problem.model = logError;
  double least = LargestScale;
  double most = 0;
  for (const MethodTrial& trial : method.trials)
  {
    least = std::min(least, trial.coarseness);
    most = std::max(most, trial.coarseness);
    addCase(problem, trial, { { trial.coarseness }, std::log(std::max(trial.error, Rounding)) });
  }
  // Equally coarse cases leave the power open; bounds that meet at 0 hold it there.
  const double steepest = most > 1.01 * least ? 6 : 1e-9;
  problem.parameters = { { "scale", 1e-2, 1e-12, LargestScale },
    { "power", steepest / 6, 0, steepest } };
  Fit fit = solve(problem);
  double& scale = fit.parameters[0].value;
  const double p[2] = { scale, fit.parameters[1].value };
  std::vector<double> over;
  for (const FitCase& fitCase : problem.training)
  {
    over.push_back(fitCase.target - logError(fitCase.input.data(), p, nullptr));
  }
  scale = std::clamp(scale * Margin * std::exp(quantile(over, 0.95)), 1e-12, LargestScale);
  fit.training = remainingError(problem, problem.training, { scale, p[1] });
  fit.heldOut = remainingError(problem, problem.heldOut, { scale, p[1] });
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
