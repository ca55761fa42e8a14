// SPDX-License-Identifier: BSD-3-Clause
#include "FitMethods.h"
#include "FitProblem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

using nephoscope::Fit;
using nephoscope::fitMethod;
using nephoscope::MethodTrial;
using nephoscope::TriedMethod;
using testing::HasSubstr;

namespace
{
/// Trials of 3 us a ray and 0.02 us a step, errors of 0.5 x^2 scattered by up to a factor of `spread`.
TriedMethod tried(double spread)
{
  std::mt19937 random(5);
  TriedMethod method{ "march", { "rays", "steps" }, true, {} };
  for (int n = 0; n < 80; ++n)
  {
    const double rays = 1000 + random() % 5000;
    const double x = std::pow(10.0, -2.0 * (random() % 1000) / 1000);
    const double luck = std::pow(spread, 2.0 * (random() % 1000) / 1000 - 1);
    method.trials.push_back(
      { { rays, rays / x }, x, 3e-6 * rays + 2e-8 * rays / x, 0.5 * x * x * luck, n % 2 == 1 });
  }
  return method;
}
}

TEST(FitMethods, RecoversWhatIsExact)
{
  const std::vector<Fit> fits = fitMethod(tried(1));
  ASSERT_EQ(fits.size(), 2U);
  EXPECT_EQ(fits[0].name, "march seconds");
  EXPECT_NEAR(fits[0].value("rays"), 3, 1e-6) << "microseconds";
  EXPECT_NEAR(fits[0].value("steps"), 0.02, 1e-8);
  EXPECT_LT(fits[0].heldOut.max, 1e-6);
  EXPECT_EQ(fits[1].name, "march error");
  EXPECT_NEAR(fits[1].value("power"), 2, 1e-6);
  EXPECT_NEAR(fits[1].value("scale"), 0.5, 1e-5);
}

// 40 cases of a uniform logarithm between +-log 3, whose standard deviation is log 3 / sqrt 3: the normal tolerance limit for 95 % of
// them with 95 % confidence is 2.125 of that above the middle (tables of one-sided limits, n = 40).
TEST(FitMethods, LiesAboveWhatIsScattered)
{
  const TriedMethod method = tried(3);
  const Fit fit = fitMethod(method)[1];
  int above = 0;
  for (const MethodTrial& trial : method.trials)
  {
    const double model = fit.value("scale") * std::pow(trial.coarseness, fit.value("power"));
    above += trial.heldOut && trial.error > model ? 1 : 0;
  }
  EXPECT_LE(above, 2);
  const double middle = std::pow(0.1, fit.value("power")); // of log x
  EXPECT_NEAR(
    std::log(fit.value("scale") * middle / (0.5 * 0.01)), 2.125 * std::log(3) / std::sqrt(3), 0.3);
}

// Cost is never negative, even where noise asks for it, and equally coarse cases have no power.
TEST(FitMethods, StaysPhysical)
{
  TriedMethod method = tried(1);
  for (MethodTrial& trial : method.trials)
  {
    trial.seconds = std::max(1e-6, 3e-6 * trial.work[0] - 1e-9 * trial.work[1]);
    trial.coarseness = 1;
    trial.error = 0.1;
  }
  const std::vector<Fit> fits = fitMethod(method);
  EXPECT_EQ(fits[0].value("steps"), 0);
  EXPECT_NEAR(fits[1].value("scale"), 0.1, 1e-6);
  EXPECT_LT(fits[1].value("power"), 1e-6);
}

TEST(FitMethods, SaysWhatIsMissing)
{
  TriedMethod method = tried(1);
  method.trials.resize(1);
  EXPECT_THAT([&] { fitMethod(method); },
    testing::ThrowsMessage<nephoscope::FitError>(
      HasSubstr("march seconds: 1 case does not fix 2 parameters")));
}
