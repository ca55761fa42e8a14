// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file CalibrationPath.h
 * @brief Where the calibrations are: the same rule in a build tree, in an install tree and in one that was moved.
 *
 * Looked for in this order:
 *  1. the folder that the environment variable NEPHOSCOPE_CALIBRATION names,
 *  2. share/nephoscope/Calibration in one of the folders above this library, or above the program: CMake installs Data/Calibration
 *     there, and links it there in the build tree.
 * @sa readCalibration, Utilities/Doc/fits.md, TestCalibrationPath.cxx
 */
#ifndef CalibrationPath_h
#define CalibrationPath_h

#include "ReadError.h"

#include <string>
#include <vector>

namespace nephoscope
{
/// The folders that are looked into, in order, whether they are there or not; without repetitions.
std::vector<std::string> calibrationFolders();

/**
 * The file of a calibration, for readCalibration().
 * @param what  its name without .json: transmittance, phase, slab, heightfield, ...
 * @throw ReadError in one line with the folders that lack it
 */
std::string calibrationPath(const std::string& what);
}
#endif
