// SPDX-License-Identifier: BSD-3-Clause
#include "FitErrorText.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using nephoscope::Calibration;
using nephoscope::Fit;
using nephoscope::FitRange;
using nephoscope::runFit;
using testing::HasSubstr;

namespace
{
const Calibration& small()
{
  static const Calibration fits = runFit("phase", FitRange{ 0.1, 0.5 });
  return fits;
}
}

// A droplet of 0.1 um is between Rayleigh's scatterer and a forward one: Draine's form, made for that, comes close to it and one of
// Henyey and Greenstein's does not.
TEST(FitPhase, KnowsWhichFormFitsSmallDroplets)
{
  const Fit& draine = small().fit("Draine, 0.1 um, red");
  const Fit& henyey = small().fit("Henyey-Greenstein, 0.1 um, red");
  EXPECT_LT(draine.heldOut.rms, 0.5 * henyey.heldOut.rms);
  EXPECT_LT(draine.heldOut.max, 0.1);
  EXPECT_GT(draine.value("alpha"), 0.5);
  EXPECT_LT(draine.value("alpha"), 1.5);
}

// A form with more constants contains the other, and cannot be worse; held-out angles are met as well as the training's.
TEST(FitPhase, MoreConstantsAreNotWorse)
{
  for (const char* const place :
    { ", 0.1 um, blue", ", 0.2 um, green", ", 0.5 um, red", ", 0.5 um, blue" })
  {
    const auto rms = [place](const std::string& form)
    { return small().fit(form + place).training.rms; };
    EXPECT_LE(rms("Draine"), rms("Henyey-Greenstein") + 1e-9) << place;
    EXPECT_LE(rms("double Henyey-Greenstein"), rms("Henyey-Greenstein") + 1e-9) << place;
    EXPECT_LE(rms("Henyey-Greenstein + Draine"), rms("double Henyey-Greenstein") + 1e-9) << place;
  }
  for (const Fit& fit : small().fits)
  {
    EXPECT_NEAR(fit.heldOut.rms, fit.training.rms, 0.3 * fit.training.rms + 1e-4) << fit.name;
  }
}

// Red light sees a droplet as smaller than blue light does, and is scattered less forward.
TEST(FitPhase, OrdersColours)
{
  const auto g = [](const char* colour)
  { return small().fit(std::string("Henyey-Greenstein, 0.2 um, ") + colour).value("g"); };
  EXPECT_LT(g("red"), g("green"));
  EXPECT_LT(g("green"), g("blue"));
}

TEST(FitPhase, RefusesARangeWithoutDroplets)
{
  EXPECT_THAT(fitErrorOf("phase", { 60, 70 }), HasSubstr("none of the effective radii"));
}
