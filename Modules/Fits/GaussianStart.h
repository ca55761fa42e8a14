// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file GaussianStart.h
 * @brief Where a further Gaussian would do most: the start of a greedy search.
 *
 * The residual r, density less the terms that there are, is taken on a grid of equal steps. For each of a set of widths (the widest
 * that is asked for, half of it, ..., along z apart from x and y) and each point as centre, the Gaussian g with amplitude a = <r, g> / <g, g>
 * lowers the sum of r^2 by <r, g>^2 / <g, g>: the largest with a > 0 is taken. <r, g> for all points is a separable convolution.
 *
 * Cost: widths times points times taps: 0.2 s for a volume, under 1 ms for a column.
 * @sa FitDensity.h
 */
#ifndef GaussianStart_h
#define GaussianStart_h

#include "DensityGrid.h"

#include <array>
#include <vector>

namespace nephoscope
{
using GaussianTerm = std::array<double, GaussianParts>;

class GaussianStart
{
public:
  explicit GaussianStart(const DensityGrid& density);

  /// The best further term; one of amplitude 0 if nothing positive is left. @param widest width to try, as a share of the extent
  GaussianTerm best(const std::vector<GaussianTerm>& terms, double widest) const;

  /// The numbers of the terms by the sum of r^2 under each, the largest first.
  std::vector<std::size_t> worstFirst(const std::vector<GaussianTerm>& terms) const;

private:
  std::array<double, 3> place(int index) const;
  std::vector<double> residual(const std::vector<GaussianTerm>& terms) const;
  std::vector<double> smoothed(
    const std::vector<double>& values, int axis, const std::vector<double>& taps) const;

  const DensityGrid& Density;
  std::array<int, 3> Points{ 1, 1, 1 };
  std::array<double, 3> Step{ 0, 0, 0 }; ///< 0 along axes that do not count
  std::vector<double> Values;
};

/// The terms, of which one is two: aside along an axis by 0.7 of its width, each 2/3 as wide.
std::vector<GaussianTerm> splitTerm(std::vector<GaussianTerm> terms, std::size_t which, int axis);
}
#endif
