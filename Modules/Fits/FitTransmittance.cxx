// SPDX-License-Identifier: BSD-3-Clause
#include "FitTransmittance.h"

#include "ClippedTransmittance.h"
#include "FitModel.h"
#include "GaussLegendre.h"

#include <ceres/jet.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>
#include <type_traits>

namespace nephoscope
{
namespace
{
constexpr double Everything = 40; // optical depth

/// Cases that take the place of the quadrature's, if there are any.
struct DepthCases
{
  std::vector<FitCase> training;
  std::vector<FitCase> heldOut;
};

/// Means of runs of equal count of the sorted depths.
std::vector<FitCase> histogram(std::vector<double> depths)
{
  constexpr std::size_t Most = 2000;
  std::sort(depths.begin(), depths.end());
  const std::size_t steps = std::min(Most, depths.size());
  std::vector<FitCase> cases;
  for (std::size_t i = 0; i < steps; ++i)
  {
    const std::size_t first = i * depths.size() / steps;
    const std::size_t last = (i + 1) * depths.size() / steps;
    double sum = 0;
    for (std::size_t k = first; k < last; ++k)
    {
      sum += depths[k];
    }
    const auto count = static_cast<double>(last - first);
    cases.push_back({ { sum / count }, std::exp(-sum / count), count });
  }
  return cases;
}

DepthCases casesOf(const std::vector<double>& depths)
{
  std::vector<double> even;
  std::vector<double> odd;
  for (std::size_t i = 0; i < depths.size(); ++i)
  {
    (i % 2 ? odd : even).push_back(depths[i]);
  }
  return { histogram(even), histogram(odd) };
}

/// Quadrature in [from, to]; held out are random places and the ends.
FitProblem problemOver(
  const std::string& name, double from, double to, int panels, const DepthCases& depths)
{
  FitProblem problem;
  problem.name = name;
  if (!depths.training.empty())
  {
    problem.training = depths.training;
    problem.heldOut = depths.heldOut;
    return problem;
  }
  for (const QuadraturePoint& point : gaussLegendrePanels(panels, 4, from, to))
  {
    problem.training.push_back({ { point.x }, std::exp(-point.x), point.weight });
  }
  std::mt19937_64 random(1994);
  for (int i = 0; i < 1000; ++i)
  {
    // The generator's bits are the standard's; its distributions are not.
    const double x = from + (to - from) * (static_cast<double>(random() >> 11) * 0x1p-53);
    problem.heldOut.push_back({ { x }, std::exp(-x) });
  }
  problem.heldOut.push_back({ { from }, std::exp(-from) });
  problem.heldOut.push_back({ { to }, std::exp(-to) });
  return problem;
}

FitModel powerModel(int n)
{
  return differentiated<ceres::Jet<double, 1>>([n](const double* x, const auto* p)
    { return clippedPower(n, std::decay_t<decltype(*p)>(1), p[0], x[0]); });
}

void addPowers(std::vector<FitProblem>& problems, int n, const DepthCases& depths)
{
  const std::string name = "power " + std::to_string(n);
  FitProblem problem = problemOver(name + " k", 0, Everything, 1000, depths);
  problem.parameters = { { "k", 1, 0.1, 2 } };
  problem.model = powerModel(n);
  problems.push_back(problem);

  problem.name = name + " gain k";
  problem.parameters = { { "gain", 1, 0.1, 2 }, { "k", 1, 0.1, 2 } };
  problem.model = differentiated<ceres::Jet<double, 2>>(
    [n](const double* x, const auto* p) { return clippedPower(n, p[0], p[1], x[0]); });
  problems.push_back(problem);

  problem.name = name + " gain";
  problem.parameters = { { "gain", 1, 0.1, 2 } };
  problem.model = differentiated<ceres::Jet<double, 1>>([n](const double* x, const auto* p)
    { return clippedPower(n, p[0], p[0] * (static_cast<double>(n) / (n + 1)), x[0]); });
  problems.push_back(problem);
}

/// The coefficients' names from one on.
std::vector<FitParameter> coefficients(int first, int last)
{
  std::vector<FitParameter> all;
  for (int i = first; i <= last; ++i)
  {
    all.push_back({ "c" + std::to_string(i), std::pow(-0.3, i), -100, 100 });
  }
  return all;
}

template <int N>
FitModel freePolynomial(double end)
{
  return differentiated<ceres::Jet<double, N + 1>>(
    [end](const double* x, const auto* p) { return clippedPolynomial(N, p, x[0], end); });
}

template <int N>
FitModel polynomialFromOne(double end)
{
  return differentiated<ceres::Jet<double, N>>(
    [end](const double* x, const auto* p)
    {
      std::decay_t<decltype(*p)> c[N + 1];
      c[0] = std::decay_t<decltype(*p)>(1);
      std::copy(p, p + N, c + 1);
      return clippedPolynomial(N, c, x[0], end);
    });
}

/// c1 from the others: sum c_i (b^(i+1) - a^(i+1)) / (i + 1) = exp(-a) - exp(-b), which holds while nothing is clipped.
template <int N>
FitModel polynomialOfIntegral(FitRange range)
{
  return differentiated<ceres::Jet<double, N - 1>>(
    [range](const double* x, const auto* p)
    {
      std::decay_t<decltype(*p)> c[N + 1];
      const auto moment = [range](int i)
      { return (std::pow(range.to, i + 1) - std::pow(range.from, i + 1)) / (i + 1); };
      c[0] = std::decay_t<decltype(*p)>(1);
      c[1] = std::decay_t<decltype(*p)>(std::exp(-range.from) - std::exp(-range.to) - moment(0));
      for (int i = 2; i <= N; ++i)
      {
        c[i] = p[i - 2];
        c[1] -= c[i] * moment(i);
      }
      c[1] /= moment(1);
      return clippedPolynomial(N, c, x[0], range.to);
    });
}

template <int N>
void addPolynomials(std::vector<FitProblem>& problems, FitRange range, const DepthCases& depths)
{
  std::ostringstream name;
  name << "polynomial " << N << " to " << range.to;
  FitProblem problem = problemOver(name.str(), range.from, range.to, 100, depths);
  problem.parameters = coefficients(0, N);
  problem.model = freePolynomial<N>(range.to);
  problems.push_back(problem);

  problem.name = name.str() + " from one";
  problem.parameters = coefficients(1, N);
  problem.model = polynomialFromOne<N>(range.to);
  problems.push_back(problem);

  problem.name = name.str() + " from one, integral kept";
  problem.parameters = coefficients(2, N);
  problem.model = polynomialOfIntegral<N>(range);
  problems.push_back(problem);
}

std::vector<Fit> fitAll(
  const DepthCases& depths, const std::optional<FitRange>& range, const FitProgress& progress)
{
  std::vector<FitProblem> problems;
  for (const int n : { 2, 3, 4 })
  {
    addPowers(problems, n, depths);
  }
  std::vector<FitRange> ranges{ { 0, 1 }, { 0, 2 }, { 0, 3 }, { 0, 4 } };
  if (range)
  {
    ranges = { *range };
  }
  for (const FitRange& each : ranges)
  {
    addPolynomials<2>(problems, each, depths);
    addPolynomials<3>(problems, each, depths);
    addPolynomials<4>(problems, each, depths);
  }
  return solveAll(problems, progress);
}
}

std::vector<Fit> fitTransmittance(const std::optional<FitRange>& range, const FitProgress& progress)
{
  return fitAll({}, range, progress);
}

std::vector<Fit> fitTransmittanceToDepths(const std::vector<double>& depths,
  const std::optional<FitRange>& range, const FitProgress& progress)
{
  const auto bad = std::find_if(depths.begin(), depths.end(),
    [](double depth) { return !(depth >= 0) || !std::isfinite(depth); });
  if (bad != depths.end())
  {
    throw FitError("transmittance: an optical depth is " + std::to_string(*bad) +
      ", which is negative or not finite");
  }
  return fitAll(casesOf(depths), range, progress);
}
}
