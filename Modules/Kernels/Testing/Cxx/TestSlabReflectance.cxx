// SPDX-License-Identifier: BSD-3-Clause
#include "SlabReflectance.h"

#include <gtest/gtest.h>

#include <cmath>

using nephoscope::SlabReflectance;

// Without end and isotropic: (1 - mu0 ln(1 + 1/mu0)) / 2, and proportional to the albedo.
TEST(SlabReflectance, HasTheClosedFormOfAHalfSpace)
{
  for (const double mu0 : { 0.1, 0.5, 1.0 })
  {
    const double half = (1 - mu0 * std::log(1 + 1 / mu0)) / 2;
    EXPECT_NEAR(SlabReflectance(0, mu0)(1.0, 1e6), half, 1e-9) << mu0;
    EXPECT_NEAR(SlabReflectance(0, mu0)(0.3, 1e6), 0.3 * half, 1e-9) << mu0;
  }
}

// Thin: albedo tau / mu0 times the share that is scattered backward. Overhead sun: (1 - g)/(2 g) ((1 + g)/sqrt(1 + g^2) - 1), the
// integral of Henyey and Greenstein's function over the backward hemisphere.
TEST(SlabReflectance, IsTheBackwardShareOfAThinSlab)
{
  for (const double g : { -0.5, 0.3, 0.75, 0.9 })
  {
    const double back = (1 - g) / (2 * g) * ((1 + g) / std::sqrt(1 + g * g) - 1);
    const double tau = 1e-7;
    EXPECT_NEAR(SlabReflectance(g, 1)(0.8, tau) / tau, 0.8 * back, 1e-6) << g;
  }
}

// Nothing reflects nothing, more reflects more, and of one scattering less than half comes back.
TEST(SlabReflectance, RisesWithDepthToItsLimit)
{
  const SlabReflectance slab(0.75, 0.5);
  EXPECT_EQ(slab(1.0, 0.0), 0);
  double before = 0;
  for (const double tau : { 0.1, 0.5, 2.0, 8.0, 1e6 })
  {
    const double now = slab(1.0, tau);
    EXPECT_GE(now, before);
    EXPECT_LT(now, 0.5);
    before = now;
  }
}
