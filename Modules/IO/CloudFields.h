// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file CloudFields.h
 * @brief All fields of one time step on a region, physical and complete, not yet laid into the scene.
 */
#ifndef CloudFields_h
#define CloudFields_h

#include "CloudFile.h"
#include "FieldReader.h"
#include "VerticalReader.h"

#include <vector>

namespace nephoscope
{
/// Index (k rows + j) columns + i. A field that the file does not have is empty.
struct CloudFields
{
  std::vector<float> fraction; ///< 0..1
  std::vector<float> liquid;   ///< kg/kg, >= 0
  std::vector<float> ice;
  std::vector<float> east; ///< m/s; along the grid's x if gridWind
  std::vector<float> north;
  std::vector<float> up;
  std::vector<float> potential; ///< K; only if it was chosen
  VerticalReader::Fields air;
};

/// The wind's components run along the grid, not to the true east and north.
bool isGridWind(const CloudFile& file);

/// Says in file.Derivations what will be computed. @param diagnose a cloud fraction where there is none
void describeFields(CloudFile& file, bool diagnose);
bool canDiagnose(const CloudFile& file);

/// @throws ReadError
CloudFields readFields(
  CloudFile& file, const VerticalReader& vertical, const Region& region, bool diagnose);
}
#endif
