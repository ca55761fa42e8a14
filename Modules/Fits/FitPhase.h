// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file FitPhase.h
 * @brief The constants of PhaseFunction.h that come closest to Mie's phase functions of water droplets.
 *
 * For effective radii of 0.1, 0.2, 0.5, 1, 2, 5, 10, 20 and 50 um, effective variance 0.1, at 650, 550 and 450 nm (red, green, blue).
 * Fits "FORM, R um, COLOUR":
 *     Henyey-Greenstein            g
 *     Draine                       g, alpha
 *     double Henyey-Greenstein     (1 - w) p_HG(g1) + w p_HG(g2)
 *     Henyey-Greenstein + Draine   (1 - w) p_HG(g1) + w p_D(g2, alpha), the form of Jendersie and d'Eon 2023
 * All are 1 over all directions whatever the constants. Perceptual residuals of 4 pi p, in which an isotropic scatterer is white;
 * all directions of the sphere count alike. Derivatives by ceres::Jet. Held out: 200 random directions. A form that contains a
 * simpler one is also started from the simpler one's constants, and the better fit is kept: it is never the worse of the two.
 * @sa Mie.h, TestFitPhase.cxx
 */
#ifndef FitPhase_h
#define FitPhase_h

#include "FitSubjects.h"

namespace nephoscope
{
/// @param range of effective radii, um
std::vector<Fit> fitPhase(const std::optional<FitRange>& range, const FitProgress& progress);
}
#endif
