// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file FitCovariance.h
 * @brief How sharply the cases fix the parameters: covariance, standard errors, and which parameters they leave open.
 * @sa FitProblem.h, which has the definitions
 */
#ifndef FitCovariance_h
#define FitCovariance_h

#include "Calibration.h"

namespace nephoscope
{
/**
 * Fills in covariance, standard errors, atBound, determined and a warning for each of the latter.
 * @param jacobian of the weighted residuals, row by row: as many rows as residuals, as many columns as fit has parameters
 * @param squares the weighted sum of squared residuals
 */
void setCovariance(Fit& fit, const std::vector<double>& jacobian, double squares);
}
#endif
