// SPDX-License-Identifier: BSD-3-Clause
#include "FitModel.h"
#include "FitProblem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using nephoscope::byDifferences;
using nephoscope::Fit;
using nephoscope::FitCase;
using nephoscope::FitError;
using nephoscope::FitProblem;
using nephoscope::Residual;
using nephoscope::solve;
using testing::ElementsAre;
using testing::HasSubstr;

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/// y = a + b x at x = 0, 1, ..., with given y.
FitProblem line(const std::vector<double>& y)
{
  FitProblem problem;
  problem.name = "line";
  problem.parameters = { { "a", 0, -100, 100 }, { "b", 0, -100, 100 } };
  problem.model =
    byDifferences(2, [](const double* x, const double* p) { return p[0] + p[1] * x[0]; });
  for (std::size_t i = 0; i < y.size(); ++i)
  {
    problem.training.push_back({ { static_cast<double>(i) }, y[i] });
  }
  return problem;
}

std::string errorOf(const FitProblem& problem)
{
  try
  {
    solve(problem);
  }
  catch (const FitError& error)
  {
    return error.what();
  }
  return "no error";
}
}

// Linear regression has closed forms: b = Sxy / Sxx, var b = s^2 / Sxx, cov(a, b) = -xmean s^2 / Sxx, s^2 = SSE / (n - 2).
TEST(FitProblem, IsTheRegressionLineWithItsCovariance)
{
  const Fit fit = solve(line({ 1, 3, 2, 5, 4 }));
  EXPECT_NEAR(fit.value("a"), 1.4, 1e-9);
  EXPECT_NEAR(fit.value("b"), 0.8, 1e-9);
  const double variance = 3.6 / 3; // sum of squared errors of that line
  EXPECT_NEAR(fit.covariance[3], variance / 10, 1e-9);
  EXPECT_NEAR(fit.covariance[1], -2 * variance / 10, 1e-9);
  EXPECT_NEAR(fit.covariance[2], -2 * variance / 10, 1e-9);
  EXPECT_NEAR(fit.covariance[0], variance * (0.2 + 0.4), 1e-9);
  EXPECT_NEAR(fit.parameters[1].standardError, std::sqrt(variance / 10), 1e-9);
  EXPECT_NEAR(fit.training.bias, 0, 1e-10);
  EXPECT_NEAR(fit.training.rms, std::sqrt(3.6 / 5), 1e-10);
  EXPECT_NEAR(fit.training.max, 1.2, 1e-9);
  EXPECT_TRUE(fit.warnings.empty());
}

// Errors on cases that were held out, sorted by hand: residuals 1, -2, 3, -4 of a line through the origin.
TEST(FitProblem, MeasuresHeldOutCases)
{
  FitProblem problem = line({ 0, 1, 2, 3 });
  problem.heldOut = { { { 10 }, 9 }, { { 10 }, 12 }, { { 10 }, 7 }, { { 10 }, 14 } };
  const Fit fit = solve(problem);
  EXPECT_EQ(fit.heldOut.cases, 4);
  EXPECT_NEAR(fit.heldOut.bias, -0.5, 1e-8);
  EXPECT_NEAR(fit.heldOut.rms, std::sqrt(7.5), 1e-8);
  EXPECT_NEAR(fit.heldOut.median, 2, 1e-8);
  EXPECT_NEAR(fit.heldOut.p95, 4, 1e-8);
  EXPECT_NEAR(fit.heldOut.max, 4, 1e-8);
}

// A case of weight 3 is three cases.
TEST(FitProblem, WeightsCountCases)
{
  FitProblem weighted = line({ 1, 3, 2, 5 });
  weighted.training[2].weight = 3;
  FitProblem repeated = line({ 1, 3, 2, 5 });
  repeated.training.insert(repeated.training.end(), 2, repeated.training[2]);
  EXPECT_NEAR(solve(weighted).value("b"), solve(repeated).value("b"), 1e-9);
  EXPECT_NEAR(solve(weighted).training.rms, solve(repeated).training.rms, 1e-9);
}

TEST(FitProblem, IsTheSameBitsAgain)
{
  const Fit one = solve(line({ 1, 3, 2, 5, 4 }));
  const Fit two = solve(line({ 1, 3, 2, 5, 4 }));
  EXPECT_EQ(one.covariance, two.covariance);
  EXPECT_EQ(one.value("a"), two.value("a"));
}

// Only the sum of two parameters matters: both are named, and their standard errors say no more than the bounds.
TEST(FitProblem, NamesWhatTheCasesDoNotDetermine)
{
  FitProblem problem = line({ 1, 2, 3, 4.5, 4 });
  problem.parameters.push_back({ "c", 0, -100, 100 });
  problem.parameters.push_back({ "unused", 0.25, 0, 1 });
  problem.model =
    byDifferences(4, [](const double* x, const double* p) { return p[0] + (p[1] + p[2]) * x[0]; });
  const Fit fit = solve(problem);
  ASSERT_EQ(fit.warnings.size(), 1U);
  EXPECT_THAT(fit.warnings[0], HasSubstr("the cases do not determine b, c, unused"));
  EXPECT_TRUE(fit.parameters[0].determined);
  EXPECT_GT(fit.parameters[0].standardError, 0);
  EXPECT_DOUBLE_EQ(fit.parameters[3].standardError, 1 / std::sqrt(12.0));
  EXPECT_EQ(fit.value("unused"), 0.25);
  EXPECT_NEAR(fit.value("b") + fit.value("c"), 0.85, 1e-6);
}

// All cases in one place: a slope cannot be seen there.
TEST(FitProblem, NamesWhatOnePlaceCannotShow)
{
  FitProblem problem = line({ 2, 2, 2 });
  for (FitCase& one : problem.training)
  {
    one.input[0] = 1;
  }
  const Fit fit = solve(problem);
  ASSERT_EQ(fit.warnings.size(), 1U);
  EXPECT_THAT(fit.warnings[0], HasSubstr("do not determine a, b"));
  EXPECT_NEAR(fit.training.max, 0, 1e-6);
}

// Values without variance are met exactly, and that is no rank deficiency.
TEST(FitProblem, MeetsDataWithoutVariance)
{
  const Fit fit = solve(line({ 2, 2, 2, 2 }));
  EXPECT_NEAR(fit.value("a"), 2, 1e-12);
  EXPECT_NEAR(fit.value("b"), 0, 1e-12);
  EXPECT_TRUE(fit.warnings.empty());
}

// The slope is held at its bound; the rest is least squares without it: a = mean(y - 0.5 x).
TEST(FitProblem, StaysWithinBoundsAndSaysSo)
{
  FitProblem problem = line({ 1, 3, 2, 5, 4 });
  problem.parameters[1].upper = 0.5;
  const Fit fit = solve(problem);
  EXPECT_DOUBLE_EQ(fit.value("b"), 0.5);
  EXPECT_NEAR(fit.value("a"), 2, 1e-7);
  EXPECT_TRUE(fit.parameters[1].atBound);
  EXPECT_EQ(fit.parameters[1].standardError, 0);
  EXPECT_GT(fit.parameters[0].standardError, 0);
  EXPECT_THAT(fit.warnings, ElementsAre("b is at its upper bound 0.5"));
}

// One case far off pulls the least squares; Huber's loss lets it count by its sign alone.
TEST(FitProblem, HubersLossResistsAnOutlier)
{
  FitProblem problem = line({ 0, 1, 2, 3, 4, 5, 6, 7, 8, 90 });
  EXPECT_GT(solve(problem).value("b"), 4);
  problem.robustScale = 0.1;
  EXPECT_NEAR(solve(problem).value("b"), 1, 0.05);
}

// Relative residuals weigh small targets like large ones; at a target of 0 the floor stands in.
TEST(FitProblem, RelativeResidualsHaveAFloor)
{
  FitProblem problem;
  problem.residual = Residual::Relative;
  problem.floor = 0.5;
  EXPECT_DOUBLE_EQ(residualOf(problem, 3, 2), 0.5);
  EXPECT_DOUBLE_EQ(residualOf(problem, 0.25, 0), 0.5);
  EXPECT_DOUBLE_EQ(residualOf(problem, 0, -2), 1);
}

// CIE lightness: a white of 1 is 100, 18.4187 % grey is 50, and both parts meet at 216/24389 = lightness 8.
TEST(FitProblem, PerceptualResidualsAreLightness)
{
  FitProblem problem;
  problem.residual = Residual::Perceptual;
  EXPECT_NEAR(residualOf(problem, 1, 0), 1, 1e-15);
  EXPECT_NEAR(residualOf(problem, 0.18418651851244416, 0), 0.5, 1e-12);
  EXPECT_NEAR(residualOf(problem, 216.0 / 24389, 0), 0.08, 1e-12);
  EXPECT_NEAR(residualOf(problem, 216.0 / 24389 * (1 + 1e-9), 0), 0.08, 1e-9);
  EXPECT_LT(residualOf(problem, -0.01, 0), 0);
}

// Perceptual residuals are minimised, not absolute ones: a constant between black and white is at lightness 50.
TEST(FitProblem, MinimisesPerceptualResiduals)
{
  FitProblem problem = line({ 0, 1 });
  problem.parameters = { { "a", 0.7, 0, 2 } };
  problem.model = byDifferences(1, [](const double*, const double* p) { return p[0]; });
  problem.residual = Residual::Perceptual;
  EXPECT_NEAR(solve(problem).value("a"), 0.18418651851244416, 1e-7);
}

// A model without value for some parameters is walked around.
TEST(FitProblem, StepsBackFromNaN)
{
  FitProblem problem = line({ 2, 2, 2 });
  problem.parameters = { { "a", 0.01, -10, 10 } };
  problem.model = byDifferences(1, [](const double*, const double* p) { return std::log(p[0]); });
  EXPECT_NEAR(solve(problem).value("a"), std::exp(2.0), 1e-6);
}

TEST(FitProblem, SaysWhatIsWrong)
{
  EXPECT_THAT(errorOf(line({})), HasSubstr("line: there are no cases; widen the range"));
  EXPECT_THAT(errorOf(line({ 1 })), HasSubstr("1 case does not fix 2 parameters; give at least 3"));
  EXPECT_THAT(errorOf(line({ 1, 2 })), HasSubstr("2 cases do not fix 2 parameters"));
  EXPECT_THAT(errorOf(line({ 1, NaN, 2 })), HasSubstr("the case (1) has an input, target"));
  EXPECT_THAT(errorOf(line({ 1e200, 1, 2 })), HasSubstr("the cost overflows"));

  FitProblem problem = line({ 1, 2, 3 });
  problem.heldOut = { { { NaN }, 1 } };
  EXPECT_THAT(errorOf(problem), HasSubstr("the case (nan) has an input, target"));
  problem = line({ 1, 2, 3 });
  problem.parameters.clear();
  EXPECT_THAT(errorOf(problem), HasSubstr("there are no parameters, or no model"));
  problem = line({ 1, 2, 3 });
  problem.model = nullptr;
  EXPECT_THAT(errorOf(problem), HasSubstr("there are no parameters, or no model"));
  problem = line({ 1, 2, 3 });
  problem.parameters[1].upper = -100;
  EXPECT_THAT(errorOf(problem), HasSubstr("the bounds of b are not finite and in ascending order"));
  problem.parameters[1] = { "b", 3, 0, 1 };
  EXPECT_THAT(errorOf(problem), HasSubstr("b starts outside its bounds"));
  problem = line({ 1, 2, 3 });
  problem.training[1].weight = -1;
  EXPECT_THAT(errorOf(problem), HasSubstr("a negative weight"));
  for (FitCase& one : problem.training)
  {
    one.weight = 0;
  }
  EXPECT_THAT(errorOf(problem), HasSubstr("all cases have weight 0"));
  problem = line({ 1, 2, 3 });
  problem.model = [](const double* x, const double*, double*) { return 1 / x[0] - 1 / x[0]; };
  EXPECT_THAT(errorOf(problem), HasSubstr("the model gives"));
  EXPECT_THAT(errorOf(problem), HasSubstr("for (0) at the start"));
}
