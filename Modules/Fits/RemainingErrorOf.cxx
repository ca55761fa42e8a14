// SPDX-License-Identifier: BSD-3-Clause
#include "RemainingErrorOf.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nephoscope
{
namespace
{
/// Pairs of absolute residual and weight, ascending by the former.
using Sorted = std::vector<std::pair<double, double>>;

/// The least residual that a share of the weight does not exceed.
double quantile(const Sorted& sorted, double share, double weight)
{
  double sum = 0;
  for (const auto& [residual, own] : sorted)
  {
    sum += own;
    if (sum >= share * weight)
    {
      return residual;
    }
  }
  return sorted.back().first;
}
}

RemainingError remainingError(const FitProblem& problem, const std::vector<FitCase>& cases,
  const std::vector<double>& parameters)
{
  RemainingError error;
  Sorted sorted;
  double weight = 0;
  for (const FitCase& one : cases)
  {
    const double r =
      residualOf(problem, problem.model(one.input.data(), parameters.data(), nullptr), one.target);
    if (!std::isfinite(r))
    {
      throw FitError(problem.name + ": the fitted model is not finite for a held-out case");
    }
    error.bias += one.weight * r;
    error.rms += one.weight * r * r;
    weight += one.weight;
    sorted.emplace_back(std::abs(r), one.weight);
  }
  error.cases = static_cast<int>(cases.size());
  if (!(weight > 0))
  {
    error.bias = 0;
    error.rms = 0;
    return error;
  }
  std::sort(sorted.begin(), sorted.end());
  error.bias /= weight;
  error.rms = std::sqrt(error.rms / weight);
  error.median = quantile(sorted, 0.5, weight);
  error.p95 = quantile(sorted, 0.95, weight);
  error.max = sorted.back().first;
  return error;
}
}
