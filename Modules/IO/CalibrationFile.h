// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file CalibrationFile.h
 * @brief Calibrations as JSON files: what `nephoscope fit` writes, and who draws reads.
 *
 *     { "format": "nephoscope calibration", "version": 1, "what": "transmittance", "command": "nephoscope fit transmittance",
 *       "fits": [ { "name": "power 2 k", "residual": "absolute",
 *                   "parameters": [ { "name": "k", "value": 0.71793, "standard_error": 3e-5, "lower": 0.1, "upper": 2,
 *                                     "at_bound": false, "determined": true } ],
 *                   "covariance": [ 1e-9 ], "training": { "cases": 4000, "bias": 0, "rms": 0, "median": 0, "p95": 0, "max": 0 },
 *                   "held_out": { ... }, "iterations": 7, "warnings": [] } ],
 *       "checksum": "89abcdef01234567" }
 *
 * Numbers are written with the digits that give the same bits when they are read. The checksum is FNV-1a, 64 bits, of all before it: a
 * constant changed by hand would still claim the errors of the one that was fitted, so such a file is refused.
 * @sa Calibration.h, Data/Calibration, TestCalibrationFile.cxx
 */
#ifndef CalibrationFile_h
#define CalibrationFile_h

#include "Calibration.h"
#include "ReadError.h"

#include <string>

namespace nephoscope
{
/// @throw ReadError in one line that begins with the path: missing, cut short or no JSON, not a calibration, of a newer version, edited
///        by hand, with values that cannot be, or of something other than `what` if that is given
Calibration readCalibration(const std::string& path, const std::string& what = {});

/// The file's text; the same bytes for the same calibration.
std::string calibrationText(const Calibration& calibration);
}
#endif
