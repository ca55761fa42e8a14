// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file FitTransmittance.h
 * @brief The constants of ClippedTransmittance.h that come closest to exp(-x).
 *
 * Powers "power N ...", N = 2, 3, 4, over all x: quadrature on [0, 40], where exp(-x) has become 4e-18.
 *     k             gain 1, so the value at 0 is 1
 *     gain k        both free
 *     gain          the integral of exp(-x), 1, is kept: k = gain N / (N + 1)
 * Polynomials "polynomial N to X", N = 2, 3, 4, over [0, X], X = 1, 2, 3, 4, or the range that is asked for, then over [a, b]
 *     (free)        N + 1 coefficients. Least squares with a free constant keep the integral over the range by themselves.
 *     from one      c0 = 1
 *     from one, integral kept      c0 = 1, and c1 is what keeps the polynomial's integral over the range; where it is
 *                                  negative and cut, near X = 4, the bias says by how much it is not kept
 * Absolute residuals, weighted as the integral of their square over x. Derivatives by ceres::Jet. Held out: 1000 random x and both ends.
 *
 * To depths that occur, in a picture say: the same forms and names, but the cases are these depths, every other one held out; up to 2000
 * steps of equal count, sorted, count by their means. A polynomial is 0 beyond its range, and that counts too.
 * @sa ClippedTransmittance.h, TestFitTransmittance.cxx
 */
#ifndef FitTransmittance_h
#define FitTransmittance_h

#include "FitSubjects.h"

namespace nephoscope
{
std::vector<Fit> fitTransmittance(
  const std::optional<FitRange>& range, const FitProgress& progress);

/// @param depths >= 0 and finite, in any order @throw FitError, without two of them for instance
std::vector<Fit> fitTransmittanceToDepths(const std::vector<double>& depths,
  const std::optional<FitRange>& range, const FitProgress& progress);
}
#endif
