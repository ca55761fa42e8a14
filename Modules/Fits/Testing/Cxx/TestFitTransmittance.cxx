// SPDX-License-Identifier: BSD-3-Clause
// The constants against a table worked out independently, by another program's least squares and exchange algorithm.
#include "ClippedTransmittance.h"
#include "FitErrorText.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

using nephoscope::Calibration;
using nephoscope::Fit;
using nephoscope::FitProblem;
using nephoscope::FitRange;
using nephoscope::runFit;
using testing::HasSubstr;

namespace
{
const Calibration& calibration()
{
  static const Calibration all = runFit("transmittance", std::nullopt);
  return all;
}

/// The L2 norm of the error over the range of optical depths.
double normOver(const Fit& fit, double width)
{
  return fit.training.rms * std::sqrt(width);
}

/// The table's own cases: equal steps of 0.0004.
FitProblem sampledPolynomial(int degree, double end, int places)
{
  FitProblem problem;
  problem.name = "polynomial " + std::to_string(degree) + " to " + std::to_string(int(end));
  for (int i = 0; i <= degree; ++i)
  {
    problem.parameters.push_back({ "c" + std::to_string(i), 0, -100, 100 });
  }
  problem.model = [degree](const double* x, const double* c, double* gradient)
  {
    double sum = 0;
    double power = 1;
    for (int i = 0; i <= degree; ++i, power *= x[0])
    {
      sum += c[i] * power;
      if (gradient)
      {
        gradient[i] = power;
      }
    }
    return sum;
  };
  for (int i = 0; i < places; ++i)
  {
    problem.training.push_back({ { i * 0.0004 }, std::exp(-i * 0.0004) });
  }
  return problem;
}
}

// The table's least squares on [0, inf). Its least largest error, at k = 0.71172, is what the fit could still gain.
TEST(FitTransmittance, HasTheTablesPowers)
{
  const Fit& k = calibration().fit("power 2 k");
  EXPECT_NEAR(k.value("k"), 0.71793, 5e-6);
  EXPECT_NEAR(k.training.max, 0.0718, 5e-5);
  EXPECT_NEAR(normOver(k, 40), 0.0969, 5e-5);

  const Fit& gain = calibration().fit("power 2 gain k");
  EXPECT_NEAR(gain.value("gain"), 0.8930, 5e-5);
  EXPECT_NEAR(gain.value("k"), 0.6453, 5e-5);
  EXPECT_NEAR(gain.heldOut.max, 0.1070, 5e-5);
  EXPECT_NEAR(normOver(gain, 40), 0.0757, 5e-5);
}

// The table's polynomials are least squares over x = 0, 0.0004, 0.0008, ..., not clipped; rounding has left out the end at 3.
// With these cases come its digits. The integral over x, which is what is shipped, differs by what the ends' half steps weigh,
// and for the last by the clipping.
TEST(FitTransmittance, HasTheTablesPolynomials)
{
  struct Row
  {
    double end;
    int places;
    std::vector<double> c;
    double max;
    double sampling; // what the shipped constants differ by
  };
  for (const Row& row : { Row{ 1, 2501, { 0.994496, -0.930565, 0.308723 }, 0.0055, 3e-5 },
         Row{ 2, 5001, { 0.969991, -0.800930, 0.197454 }, 0.0300, 3e-5 },
         Row{ 3, 7500, { 0.929084, -0.669587, 0.130681 }, 0.0709, 1e-4 },
         Row{ 2, 5001, { 0.995895, -0.956433, 0.391852, -0.064799 }, 0.0041, 3e-5 },
         Row{ 3, 7500, { 0.985860, -0.896798, 0.320061, -0.042090 }, 0.0141, 1e-4 },
         Row{ 4, 10001, { 0.968894, -0.824235, 0.257586, -0.028049 }, 0.0311, 6e-3 } })
  {
    const FitProblem problem =
      sampledPolynomial(static_cast<int>(row.c.size()) - 1, row.end, row.places);
    const Fit sampled = solve(problem);
    const std::string name = problem.name;
    const Fit& shipped = calibration().fit(name);
    for (std::size_t i = 0; i < row.c.size(); ++i)
    {
      EXPECT_NEAR(sampled.parameters[i].value, row.c[i], 6e-7) << name << ", c" << i;
      EXPECT_NEAR(shipped.parameters[i].value, row.c[i], row.sampling) << name << ", c" << i;
    }
    EXPECT_NEAR(sampled.training.max, row.max, 6e-5) << name;
    EXPECT_NEAR(shipped.heldOut.max, row.max, 2e-4 + row.sampling) << name;
    EXPECT_NEAR(shipped.heldOut.rms, shipped.training.rms, 0.05 * shipped.training.rms) << name;
    EXPECT_TRUE(shipped.warnings.empty()) << name;
  }
}

// Where the integral is kept, it is: the mean error over quadrature places is the integral's error over the range. To 4,
// polynomials are clipped near the end, and what is cut is missing below: 0.9 % of the integral at most.
TEST(FitTransmittance, KeepsTheIntegralWhereItSaysSo)
{
  for (const Fit& fit : calibration().fits)
  {
    const bool free =
      fit.name.rfind("polynomial", 0) == 0 && fit.name.find("from") == std::string::npos;
    if (free || fit.name.find("integral kept") != std::string::npos)
    {
      const bool clipped = fit.name.find("to 4") != std::string::npos;
      EXPECT_NEAR(fit.training.bias * (clipped ? 4 : 1), 0, clipped ? 0.009 : 1e-9) << fit.name;
    }
    else if (fit.name.rfind("gain") == fit.name.size() - 4)
    {
      EXPECT_NEAR(fit.training.bias, 0, 1e-6) << fit.name; // the kink lies between places
    }
  }
}

// A constraint cannot make the fit better, a parameter more cannot make it worse.
TEST(FitTransmittance, IsOrderedAsConstraintsAre)
{
  const auto rms = [](const std::string& name) { return calibration().fit(name).training.rms; };
  for (const char* const base : { "polynomial 2 to 3", "polynomial 3 to 3", "polynomial 4 to 4" })
  {
    const std::string name = base;
    EXPECT_LT(rms(name), rms(name + " from one"));
    EXPECT_LT(rms(name + " from one"), rms(name + " from one, integral kept"));
  }
  EXPECT_LT(rms("polynomial 4 to 2"), rms("polynomial 3 to 2"));
  EXPECT_LT(rms("power 4 k"), rms("power 3 k"));
  EXPECT_LT(rms("power 2 gain k"), rms("power 2 k"));
  EXPECT_LT(rms("power 2 gain k"), rms("power 2 gain"));
}

// Ranges up to 1e6 give an answer; there the polynomial can only be nothing.
TEST(FitTransmittance, TakesARangeAndRefusesNonsense)
{
  const Calibration wide = runFit("transmittance", FitRange{ 0, 1e6 });
  EXPECT_LE(wide.fit("polynomial 2 to 1e+06").training.rms, 1.1e-3);
  EXPECT_EQ(wide.command, "nephoscope fit transmittance --range 0:1000000");
  EXPECT_EQ(whatIsWrong(wide), "");
  EXPECT_THAT(fitErrorOf("transmittance", { 2, 2 }), HasSubstr("the range 2:2 is empty"));
  EXPECT_THAT(fitErrorOf("transmittance", { 2, 1 }), HasSubstr("the range 2:1 is empty"));
  EXPECT_THAT(fitErrorOf("transmittance", { -1, 1 }), HasSubstr("the range -1:1 is negative"));
  EXPECT_THAT(fitErrorOf("transmittance", { 0, std::nan("") }), HasSubstr("is empty"));
  EXPECT_THAT(fitErrorOf("transmitance", { 0, 1 }),
    HasSubstr("there is no fit 'transmitance'; there are transmittance"));
}

// Depths of a picture of thin cloud: the constants are those of thin cloud, and better there than the ones for all depths; the held-out
// errors are as the training's. Depths of exactly two values are met by what has two constants.
TEST(FitTransmittance, TakesTheDepthsThatOccur)
{
  std::vector<double> depths;
  for (int i = 0; i < 5000; ++i)
  {
    depths.push_back(0.5 * (1 + std::sin(0.7 * i * i)));
  }
  const Calibration own = runFit("transmittance", std::nullopt, nullptr, depths);
  const Fit& k = own.fit("power 2 k");
  EXPECT_EQ(k.training.cases, 2000);
  EXPECT_EQ(k.heldOut.cases, 2000);
  EXPECT_NEAR(k.heldOut.rms, k.training.rms, 0.1 * k.training.rms);
  const double all = calibration().fit("power 2 k").value("k");
  double squares = 0;
  for (const double x : depths)
  {
    const double error = nephoscope::clippedPower(2, 1.0, all, x) - std::exp(-x);
    squares += error * error / static_cast<double>(depths.size());
  }
  EXPECT_LT(k.heldOut.rms, 0.7 * std::sqrt(squares));

  std::vector<double> twoDepths;
  for (int i = 0; i < 40; ++i)
  {
    twoDepths.push_back(i % 4 < 2 ? 0.2 : 1);
  }
  const Calibration two = runFit("transmittance", FitRange{ 0, 1.5 }, nullptr, twoDepths);
  EXPECT_LT(two.fit("power 2 gain k").heldOut.max, 1e-9);
  EXPECT_FALSE(two.fit("polynomial 4 to 1.5").warnings.empty());
}

TEST(FitTransmittance, RefusesDepthsThatDoNotFixIt)
{
  const auto refusal = [](const std::string& subject, const std::vector<double>& depths)
  {
    try
    {
      runFit(subject, std::nullopt, nullptr, depths);
    }
    catch (const nephoscope::FitError& error)
    {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(refusal("transmittance", { 1 }), HasSubstr("1 case does not fix 1 parameters"));
  EXPECT_THAT(refusal("transmittance", { 1, 2, std::nan(""), 3, 5, 6 }), HasSubstr("not finite"));
  EXPECT_THAT(refusal("slab", { 1, 2 }), HasSubstr("the fit 'slab' takes no optical depths"));
}
