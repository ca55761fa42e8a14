// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file FitSlab.h
 * @brief Multiple scattering as single: the density and albedo with which one scattering reflects what all orders do.
 *
 * For each material of SlabReference.h (g 0 and 0.75; albedo 1, 0.99, 0.9) the slab's depth is multiplied by `density` and
 * `albedo` put in place of the true one in SlabReflectance. Fits "g G, albedo W" let the effective albedo pass 1: it is a gain on the
 * light, no material has it. Fits "g G, albedo W, at most 1" do not, and show what single scattering can do alone.
 * Absolute residuals of the reflectance; training at depths 0.5, 2, 8, 32, held out 1, 4, 16, both suns.
 * @sa SlabReflectance.h, TestFitSlab.cxx
 */
#ifndef FitSlab_h
#define FitSlab_h

#include "FitSubjects.h"

namespace nephoscope
{
/// @param range of optical depths
std::vector<Fit> fitSlab(const std::optional<FitRange>& range, const FitProgress& progress);
}
#endif
