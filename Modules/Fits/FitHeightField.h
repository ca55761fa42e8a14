// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file FitHeightField.h
 * @brief Factors on the densities of height-field clouds with which Max's quadratic stands in best for the exponentials.
 *
 * The exact light of a ray (HeightFieldScattering.h, method Exact) is sum T int rhoB gamma exp(-a) exp(-b) dr over its segments, with
 * a = rhoA (g - zeta), b = rhoB gamma (r - rL), T = exp of rhoC times what lies in front. q(x) = (1 - x/2)_+^2 replaces:
 *     product    gain q(ma a) q(mb b)                                     the wording of Max 1994
 *     printed    gain exp(ma rhoA zeta_L) q(ma rhoA g) q(mb b - ma rhoA s (r - rL))      Max 1986, as printed
 * s the ray's slope, zeta_L the height of its entry over the cloud plane. Fits "FORM, densities D" have gain 1, those "with gain" fit it;
 * "transmission" is q(mc x) for exp(-x), x the segments' depths by rhoC. D is a factor on Max's three densities.
 * Absolute residuals in units of the training rays' mean light; 6 random clouds of 6 waves for training and 6 others held out, seen
 * from below and from above, 96 rays each. Derivatives by ceres::Jet.
 * Limits: the printed form is the wrong shape from above, where exp(ma rhoA zeta_L) exceeds 1; no factor cures that.
 * @sa TestFitHeightField.cxx
 */
#ifndef FitHeightField_h
#define FitHeightField_h

#include "FitSubjects.h"

namespace nephoscope
{
/// @param range of factors on Max's densities
std::vector<Fit> fitHeightField(const std::optional<FitRange>& range, const FitProgress& progress);
}
#endif
