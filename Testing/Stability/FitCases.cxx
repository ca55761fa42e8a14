// SPDX-License-Identifier: BSD-3-Clause
// Where fits are known to fail. Naive is the textbook's regression line by its sums, without bounds and questions.
#include "Stability.h"

#include "ClippedTransmittance.h"
#include "FitModel.h"
#include "FitProblem.h"
#include "FitSubjects.h"

#include <cmath>
#include <limits>

namespace nephoscope
{
namespace stability
{
namespace
{
struct Point
{
  double x;
  double y;
};

/// Slope of the regression line: Sxy / Sxx.
double naiveSlope(const std::vector<Point>& points)
{
  double x = 0;
  double y = 0;
  for (const Point& p : points)
  {
    x += p.x / static_cast<double>(points.size());
    y += p.y / static_cast<double>(points.size());
  }
  double across = 0;
  double along = 0;
  for (const Point& p : points)
  {
    across += (p.x - x) * (p.y - y);
    along += (p.x - x) * (p.x - x);
  }
  return across / along;
}

/// y = a + b x with 0 <= b.
FitProblem line(const std::vector<Point>& points)
{
  FitProblem problem;
  problem.name = "line";
  problem.parameters = { { "a", 0, -100, 100 }, { "b", 1, 0, 100 } };
  problem.model =
    byDifferences(2, [](const double* x, const double* p) { return p[0] + p[1] * x[0]; });
  for (const Point& p : points)
  {
    problem.training.push_back({ { p.x }, p.y });
  }
  return problem;
}

/// The error's words, or none.
template <class Work>
std::string refusal(const Work& work)
{
  try
  {
    work();
  }
  catch (const FitError& error)
  {
    return error.what();
  }
  return "no error";
}

Outcome refused(const std::vector<Point>& points, const std::string& words)
{
  const std::string ours = refusal([&points] { solve(line(points)); });
  return { figure("slope", naiveSlope(points)), ours, ours.find(words) != std::string::npos };
}

const StabilityRegistration onePlace(
  { "fit", "all cases in one place", "a warning that names a and b",
    []
    {
      const std::vector<Point> points{ { 1, 2 }, { 1, 3 }, { 1, 2.5 } };
      const Fit fit = solve(line(points));
      const std::string ours = fit.warnings.empty() ? "no warning" : fit.warnings.front();
      return Outcome{ figure("slope", naiveSlope(points)), ours,
        ours.find("do not determine a, b") != std::string::npos };
    } });

const StabilityRegistration oneSample(
  { "fit", "one sample for two constants", "an error that says so", [] {
     return refused({ { 1, 2 } }, "1 case does not fix 2 parameters");
   } });

const StabilityRegistration noSample({ "fit", "no sample", "an error that says so",
  [] { return refused({}, "there are no cases"); } });

const StabilityRegistration notANumber(
  { "fit", "a target that is NaN", "an error that names the case",
    []
    {
      return refused(
        { { 0, 1 }, { 1, std::numeric_limits<double>::quiet_NaN() }, { 2, 2 } }, "the case (1)");
    } });

const StabilityRegistration overflow(
  { "fit", "a target of 1e200", "an error that says that the cost overflows", [] {
     return refused({ { 0, 1 }, { 1, 1e200 }, { 2, 2 } }, "the cost overflows");
   } });

const StabilityRegistration constant({ "fit", "values without variance", "slope 0, and no warning",
  []
  {
    const std::vector<Point> points{ { 0, 2 }, { 1, 2 }, { 2, 2 } };
    const Fit fit = solve(line(points));
    const double slope = fit.value("b");
    return Outcome{ figure("slope", naiveSlope(points)), figure("slope", slope),
      std::abs(slope) < 1e-9 && fit.value("a") > 1.999999 };
  } });

const StabilityRegistration negative(
  { "fit", "noise that asks for a negative density", "0, and a warning that it is at its bound",
    []
    {
      const std::vector<Point> points{ { 0, 1 }, { 1, 0.9 }, { 2, 0.95 }, { 3, 0.8 } };
      const Fit fit = solve(line(points));
      const std::string warning = fit.warnings.empty() ? "no warning" : fit.warnings.front();
      return Outcome{ figure("density", naiveSlope(points)),
        figure("density", fit.value("b")) + ", " + warning,
        fit.value("b") == 0 && warning.find("b is at its lower bound 0") == 0 };
    } });

const StabilityRegistration emptyRange({ "fit", "an empty range, 2:2", "an error that names it",
  []
  {
    const std::string ours = refusal([] { runFit("transmittance", FitRange{ 2, 2 }); });
    return Outcome{ "no cases", ours, ours.find("the range 2:2 is empty") == 0 };
  } });

const StabilityRegistration deep({ "fit", "a cubic for exp(-x), at x = 1e6", "0",
  []
  {
    const double c[] = { 0.985842, -0.896746, 0.320022, -0.0420816 };
    const double x = 1e6;
    const double naive = c[0] + x * (c[1] + x * (c[2] + x * c[3]));
    const double ours = clippedPolynomial(3, c, x, 3);
    return Outcome{ figure("transmittance", naive), figure("transmittance", ours), ours == 0 };
  } });
}
}
}
