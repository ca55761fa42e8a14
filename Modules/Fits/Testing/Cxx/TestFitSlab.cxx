// SPDX-License-Identifier: BSD-3-Clause
#include "FitErrorText.h"
#include "SlabReference.h"
#include "SlabReflectance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

using nephoscope::Calibration;
using nephoscope::Fit;
using nephoscope::FitRange;
using nephoscope::runFit;
using testing::HasSubstr;

namespace
{
const Calibration& calibration()
{
  static const Calibration all = runFit("slab", std::nullopt);
  return all;
}
}

// One scattering of the true density and albedo is less than all orders, and close to them where slabs are thin and dark.
TEST(FitSlab, ReferenceExceedsOneScattering)
{
  for (const auto& material : nephoscope::SlabReference)
  {
    for (int sun = 0; sun < 2; ++sun)
    {
      const nephoscope::SlabReflectance slab(material.g, nephoscope::SlabSuns[sun]);
      for (int i = 0; i < 7; ++i)
      {
        EXPECT_LT(slab(material.albedo, nephoscope::SlabDepths[i]), material.reflectance[i][sun]);
      }
    }
  }
}

// With an albedo of at most 1 thick white slabs stay dark: the bound is active and is said to be.
TEST(FitSlab, ShowsTheLimitOfSingleScattering)
{
  const Fit& limited = calibration().fit("g 0, albedo 1, at most 1");
  EXPECT_EQ(limited.value("albedo"), 1);
  EXPECT_THAT(limited.warnings, testing::Contains("albedo is at its upper bound 1"));
  EXPECT_GT(limited.heldOut.max, 0.5);
}

// A gain on the light helps every material, and dark ones most: an exponential's rise is too sudden for white slabs, whose
// reflectance goes on rising like depth / (depth + constant).
TEST(FitSlab, ReachesDarkSlabsWithAGain)
{
  for (const Fit& fit : calibration().fits)
  {
    if (fit.name.find("at most") == std::string::npos)
    {
      EXPECT_GT(fit.value("albedo"), 1) << fit.name;
      EXPECT_LT(fit.training.rms, 0.5 * calibration().fit(fit.name + ", at most 1").training.rms)
        << fit.name;
      EXPECT_TRUE(fit.warnings.empty()) << fit.name;
    }
  }
  for (const char* const g : { "g 0", "g 0.75" })
  {
    const std::string name = g;
    EXPECT_LT(calibration().fit(name + ", albedo 0.9").heldOut.rms, 0.04) << name;
    EXPECT_GT(calibration().fit(name + ", albedo 1").heldOut.rms, 0.1) << name;
  }
}

// One depth alone does not say which of density and albedo it is.
TEST(FitSlab, RefusesTooFewCases)
{
  EXPECT_THAT(fitErrorOf("slab", { 1.5, 2.5 }),
    HasSubstr("2 cases do not fix 2 parameters; give at least 3"));
  EXPECT_THAT(fitErrorOf("slab", { 40, 50 }), HasSubstr("there are no cases; widen the range"));
}
