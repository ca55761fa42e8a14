// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file FitCharts.h
 * @brief How far approximations reach that are fitted: stand-ins for exp(-x), and Gaussians in place of a density.
 *
 * The fits are made anew, by Modules/Fits; their errors are those on cases that they have not seen. No time is measured.
 * @sa Utilities/Doc/fits.md, Utilities/Doc/failures.md
 */
#ifndef FitCharts_h
#define FitCharts_h

#include "LogChart.h"

#include <functional>
#include <string>
#include <vector>

namespace nephoscope
{
namespace charts
{
/// "transmittance" and "density". @param quick without the finest sums of Gaussians @param progress told what is fitted, may be empty
std::vector<NamedChart> fitCharts(
  bool quick, const std::function<void(const std::string&)>& progress);
}
}
#endif
