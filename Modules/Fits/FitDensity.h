// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file FitDensity.h
 * @brief Density on a grid (a column, or a volume) as the fewest Gaussians whose line integrals meet a tolerance.
 *
 * Cases are line integrals, as rays of a picture need them: 4000 rays at random through the grid, every other one from a random place on
 * instead of all the way (of a column, 400, all from a place on), and as many others held out. The error is the root mean square of the
 * optical depths' errors over that of the exact depths; a sum meets the tolerance if both sets of rays do. The rays held out thus have a
 * say in the number of Gaussians, none in their shapes. Places are even in the grid's points: close levels count as far ones.
 *  1. Add: a Gaussian where it does most (GaussianStart.h), fitted to what is left, then all together; until the tolerance is met.
 *  2. Leave out: each in turn, from the one of least mass; if the others, fitted anew, meet the tolerance, it stays out. Then from the
 *     beginning, until none can be left out.
 *  3. All together once more, to the end, with covariances.
 * Few, not provably fewest: another start may lead to fewer. A Gaussian has its axes free: 10 numbers in a volume, 3 in a column.
 *
 * Fits that come out: "sum" (errors of line integrals, relative to the rms depth), "density" (of the density at the grid's points,
 * relative to its rms), "mass" (of what is in the grid: its relative error as bias), and "Gaussian 1", ... with the parameters a, x, y, z, m00 to m22 of
 * GaussianDensity.h, their covariance, and the largest first.
 * Errors     FitError: what is wrong with the grid, a density that is 0 everywhere, a tolerance or number of terms that is none, a
 *            tolerance that is not met: the message says what is.
 * Cost       grows with the fourth power of the number of Gaussians: of a column under a second; of a volume, a second with 3, a
 *            minute with 15. One thread, no chance: the same bits in every run.
 * Limits     edges are blurred: cloud that ends sharply needs many terms. Outside the grid the Gaussians have tails, where the density is 0;
 *            rays that go all the way see them.
 * @sa GaussianDensity.h, DensityGrid.h, TestFitDensity.cxx
 */
#ifndef FitDensity_h
#define FitDensity_h

#include "DensityGrid.h"
#include "FitSubjects.h"

namespace nephoscope
{
struct DensityFitSettings
{
  double tolerance = 0.05; ///< of line integrals, relative rms, > 0
  int terms = 32;          ///< at most, 1 to 100
};

/// @param progress false from it ends the search: an error, unless the tolerance was met @throw FitError
std::vector<Fit> fitDensity(const DensityGrid& density, const DensityFitSettings& settings,
  const FitProgress& progress = nullptr);

/// The term of a fit "Gaussian N"; parts that are the same everywhere are 0.
std::array<double, GaussianParts> gaussianOf(const Fit& fit);
}
#endif
