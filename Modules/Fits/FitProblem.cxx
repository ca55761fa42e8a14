// SPDX-License-Identifier: BSD-3-Clause
#include "FitProblem.h"

#include "FitCovariance.h"
#include "RemainingErrorOf.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <sstream>

namespace nephoscope
{
namespace
{
/// Ceres' own words stay unsaid: what matters becomes a FitError.
class QuietLog
{
public:
  QuietLog()
    : Level(FLAGS_minloglevel)
  {
    FLAGS_minloglevel = google::GLOG_FATAL;
  }
  ~QuietLog() { FLAGS_minloglevel = this->Level; }
  QuietLog(const QuietLog&) = delete;
  QuietLog& operator=(const QuietLog&) = delete;

private:
  int Level;
};

double lightness(double y)
{
  constexpr double Bend = 216.0 / 24389.0;
  return y > Bend ? 1.16 * std::cbrt(y) - 0.16 : y * (24389.0 / 2700.0);
}

double lightnessSlope(double y)
{
  constexpr double Bend = 216.0 / 24389.0;
  return y > Bend ? 1.16 / (3 * std::cbrt(y) * std::cbrt(y)) : 24389.0 / 2700.0;
}

/// d residual / d model.
double residualSlope(const FitProblem& problem, double model, double target)
{
  switch (problem.residual)
  {
    case Residual::Relative:
      return 1 / std::max(std::abs(target), problem.floor);
    case Residual::Perceptual:
      return lightnessSlope(model);
    default:
      return 1;
  }
}

const char* residualName(Residual residual)
{
  switch (residual)
  {
    case Residual::Relative:
      return "relative";
    case Residual::Perceptual:
      return "perceptual";
    default:
      return "absolute";
  }
}

std::string inputText(const FitCase& one)
{
  std::ostringstream text;
  for (std::size_t i = 0; i < one.input.size(); ++i)
  {
    text << (i ? ", " : "") << one.input[i];
  }
  return "(" + text.str() + ")";
}

/// One case's weighted residual, as Ceres wants it.
class CaseCost : public ceres::CostFunction
{
public:
  CaseCost(const FitProblem& problem, const FitCase& one, double rootWeight)
    : Problem(problem)
    , One(one)
    , RootWeight(rootWeight)
  {
    this->set_num_residuals(1);
    this->mutable_parameter_block_sizes()->push_back(static_cast<int>(problem.parameters.size()));
  }

  /// False where the model is not finite: Ceres then takes a shorter step.
  bool Evaluate(
    double const* const* parameters, double* residuals, double** jacobians) const override
  {
    double* const gradient = jacobians ? jacobians[0] : nullptr;
    const double value = this->Problem.model(this->One.input.data(), parameters[0], gradient);
    residuals[0] = this->RootWeight * residualOf(this->Problem, value, this->One.target);
    bool finite = std::isfinite(residuals[0]) && std::isfinite(residuals[0] * residuals[0]);
    const double slope = this->RootWeight * residualSlope(this->Problem, value, this->One.target);
    for (std::size_t i = 0; gradient && i < this->Problem.parameters.size(); ++i)
    {
      gradient[i] *= slope;
      finite = finite && std::isfinite(gradient[i]);
    }
    return finite;
  }

private:
  const FitProblem& Problem;
  const FitCase& One;
  double RootWeight;
};

void checkParameters(const FitProblem& problem)
{
  if (problem.parameters.empty() || !problem.model)
  {
    throw FitError(problem.name + ": there are no parameters, or no model");
  }
  for (const FitParameter& p : problem.parameters)
  {
    if (!(p.lower < p.upper) || !std::isfinite(p.lower) || !std::isfinite(p.upper))
    {
      throw FitError(
        problem.name + ": the bounds of " + p.name + " are not finite and in ascending order");
    }
    if (!(p.lower <= p.start && p.start <= p.upper))
    {
      throw FitError(problem.name + ": " + p.name + " starts outside its bounds");
    }
  }
}

void checkCases(const FitProblem& problem, const std::vector<FitCase>& cases)
{
  for (const FitCase& one : cases)
  {
    bool finite = std::isfinite(one.target) && std::isfinite(one.weight);
    for (const double x : one.input)
    {
      finite = finite && std::isfinite(x);
    }
    if (!finite || one.weight < 0)
    {
      throw FitError(problem.name + ": the case " + inputText(one) +
        " has an input, target or weight that is not finite, or a negative weight");
    }
  }
}

void checkEnough(const FitProblem& problem)
{
  const std::size_t cases = problem.training.size();
  if (cases == 0)
  {
    throw FitError(problem.name + ": there are no cases; widen the range");
  }
  if (cases <= problem.parameters.size())
  {
    throw FitError(problem.name + ": " + std::to_string(cases) +
      (cases == 1 ? " case does" : " cases do") + " not fix " +
      std::to_string(problem.parameters.size()) + " parameters; give at least " +
      std::to_string(problem.parameters.size() + 1));
  }
}

/// What would stop the first step, named.
void checkStart(const FitProblem& problem, const std::vector<double>& start)
{
  double cost = 0;
  for (const FitCase& one : problem.training)
  {
    const double value = problem.model(one.input.data(), start.data(), nullptr);
    const double r = residualOf(problem, value, one.target);
    if (!std::isfinite(r))
    {
      throw FitError(problem.name + ": the model gives " + std::to_string(value) + " for " +
        inputText(one) + " at the start; start elsewhere or leave the case out");
    }
    cost += one.weight * r * r;
  }
  if (!std::isfinite(cost))
  {
    throw FitError(
      problem.name + ": the cost overflows; fit relative residuals or leave large cases out");
  }
}

/// Factor that makes the mean weight 1.
double weightScale(const FitProblem& problem)
{
  double sum = 0;
  for (const FitCase& one : problem.training)
  {
    sum += one.weight;
  }
  const double scale = static_cast<double>(problem.training.size()) / sum;
  if (!(sum > 0) || !std::isfinite(scale))
  {
    throw FitError(problem.name + ": all cases have weight 0");
  }
  return scale;
}

struct Solution
{
  std::vector<double> parameters;
  std::vector<double> jacobian; ///< of the weighted residuals, row by row
  double squares = 0;           ///< weighted
  int iterations = 0;
};

/// Parameters that lie on one of their bounds.
std::vector<int> atBounds(const FitProblem& problem, const std::vector<double>& parameters)
{
  std::vector<int> there;
  for (std::size_t i = 0; i < parameters.size(); ++i)
  {
    const FitParameter& p = problem.parameters[i];
    if (parameters[i] == p.lower || parameters[i] == p.upper)
    {
      there.push_back(static_cast<int>(i));
    }
  }
  return there;
}

/// All cases and bounds; held parameters keep their value.
void buildProblem(const FitProblem& problem, const std::vector<int>& held,
  std::vector<double>& parameters, ceres::Problem& ceresProblem)
{
  const double scale = weightScale(problem);
  for (const FitCase& one : problem.training)
  {
    auto cost = std::make_unique<CaseCost>(problem, one, std::sqrt(one.weight * scale));
    std::unique_ptr<ceres::LossFunction> loss;
    if (problem.robustScale > 0)
    {
      loss = std::make_unique<ceres::HuberLoss>(problem.robustScale);
    }
    ceresProblem.AddResidualBlock(cost.release(), loss.release(), parameters.data());
  }
  const int count = static_cast<int>(parameters.size());
  if (static_cast<int>(held.size()) == count)
  {
    ceresProblem.SetParameterBlockConstant(parameters.data());
    return;
  }
  for (int i = 0; i < count; ++i)
  {
    ceresProblem.SetParameterLowerBound(parameters.data(), i, problem.parameters[i].lower);
    ceresProblem.SetParameterUpperBound(parameters.data(), i, problem.parameters[i].upper);
  }
  if (!held.empty())
  {
    ceresProblem.SetManifold(parameters.data(), new ceres::SubsetManifold(count, held));
  }
}

void readJacobian(ceres::Problem& ceresProblem, Solution& solution)
{
  ceres::Problem::EvaluateOptions options;
  options.apply_loss_function = false;
  options.num_threads = 1;
  std::vector<double> residuals;
  ceres::CRSMatrix rows;
  ceresProblem.Evaluate(options, nullptr, &residuals, nullptr, &rows);
  for (const double r : residuals)
  {
    solution.squares += r * r;
  }
  solution.jacobian.assign(residuals.size() * solution.parameters.size(), 0.0);
  for (int row = 0; row < rows.num_rows; ++row)
  {
    for (int k = rows.rows[row]; k < rows.rows[row + 1]; ++k)
    {
      solution.jacobian[static_cast<std::size_t>(row) * rows.num_cols + rows.cols[k]] =
        rows.values[k];
    }
  }
}

/// One run of Ceres from where the parameters are.
void improve(const FitProblem& problem, const std::vector<int>& held, Solution& solution)
{
  ceres::Problem ceresProblem;
  buildProblem(problem, held, solution.parameters, ceresProblem);
  ceres::Solver::Options options;
  // Constants are wanted to their last digits, steps of a search are not.
  options.linear_solver_type =
    problem.improvement > 0 ? ceres::DENSE_NORMAL_CHOLESKY : ceres::DENSE_QR;
  options.num_threads = 1;
  options.max_num_iterations = 500;
  options.function_tolerance = problem.improvement;
  options.gradient_tolerance = 1e-15;
  options.parameter_tolerance = 1e-14;
  options.initial_trust_region_radius = 1e6;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &ceresProblem, &summary);
  if (!summary.IsSolutionUsable())
  {
    throw FitError(problem.name + ": no solution: " + summary.message);
  }
  if (summary.termination_type != ceres::CONVERGENCE)
  {
    throw FitError(problem.name + ": not converged after " +
      std::to_string(options.max_num_iterations) + " iterations; bound the parameters closer");
  }
  solution.iterations += summary.num_successful_steps + summary.num_unsuccessful_steps;
}

/// Steps that a bound cuts short stall: the parameters there are held while the others are improved, then all are let go again.
Solution leastSquares(const FitProblem& problem)
{
  Solution solution;
  for (const FitParameter& p : problem.parameters)
  {
    solution.parameters.push_back(p.start);
  }
  improve(problem, {}, solution);
  const std::size_t rounds = problem.improvement > 0 ? 1 : problem.parameters.size();
  for (std::size_t round = 0; round < rounds; ++round)
  {
    const std::vector<int> held = atBounds(problem, solution.parameters);
    const std::vector<double> before = solution.parameters;
    if (held.empty())
    {
      break;
    }
    improve(problem, held, solution);
    improve(problem, {}, solution);
    if (solution.parameters == before)
    {
      break;
    }
  }
  return solution;
}

/// That the problem can be worked on.
void check(const FitProblem& problem)
{
  checkParameters(problem);
  checkCases(problem, problem.training);
  checkCases(problem, problem.heldOut);
  checkEnough(problem);
  std::vector<double> start;
  for (const FitParameter& p : problem.parameters)
  {
    start.push_back(p.start);
  }
  checkStart(problem, start);
}
}

double residualOf(const FitProblem& problem, double model, double target)
{
  switch (problem.residual)
  {
    case Residual::Relative:
      return (model - target) / std::max(std::abs(target), problem.floor);
    case Residual::Perceptual:
      return lightness(model) - lightness(target);
    default:
      return model - target;
  }
}

std::vector<double> bestParameters(const FitProblem& problem)
{
  const QuietLog quiet;
  check(problem);
  return leastSquares(problem).parameters;
}

Fit solve(const FitProblem& problem)
{
  const auto started = std::chrono::steady_clock::now();
  const QuietLog quiet;
  check(problem);
  Solution found = leastSquares(problem);
  ceres::Problem all;
  buildProblem(problem, {}, found.parameters, all);
  readJacobian(all, found);
  Fit fit;
  fit.name = problem.name;
  fit.residual = residualName(problem.residual);
  fit.iterations = found.iterations;
  for (std::size_t i = 0; i < problem.parameters.size(); ++i)
  {
    const FitParameter& p = problem.parameters[i];
    fit.parameters.push_back({ p.name, found.parameters[i], 0, p.lower, p.upper });
  }
  setCovariance(fit, found.jacobian, found.squares);
  fit.training = remainingError(problem, problem.training, found.parameters);
  fit.heldOut = remainingError(problem, problem.heldOut, found.parameters);
  fit.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return fit;
}
}
