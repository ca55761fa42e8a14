// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file FittedConstants.h
 * @brief Constants of approximate methods, from calibrations.
 */
#ifndef FittedConstants_h
#define FittedConstants_h

#include "Scene.h"

class vtkCloudHeightField;

namespace nephoscope::program
{
/**
 * Gives clouds that are drawn by Sexp1986 the constants of the fit "printed with gain" whose densities have theirs: at Max's the one
 * for those, else the one for 0.25 to 4 times these.
 *
 * Without a shipped calibration Max's own constants stay, which is said on standard error; a file that is named has to be readable.
 * @throw ReadError for a file that cannot be used, std::out_of_range if it lacks the fit
 */
void setConstants(vtkCloudHeightField* clouds, const HeightFieldBody& body);
}
#endif
