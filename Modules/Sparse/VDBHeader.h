// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file VDBHeader.h
 * @brief The table of contents of an OpenVDB file, checked before OpenVDB sees it.
 *
 * OpenVDB trusts lengths and offsets that a file declares. Here each is compared with the file's size first, so that a file that
 * is cut short or damaged there is told as such.
 */
#ifndef VDBHeader_h
#define VDBHeader_h

#include <cstdint>
#include <string>
#include <vector>

namespace nephoscope
{
/// A grid of the file.
struct VDBEntry
{
  std::string name;       ///< without what makes it unique
  std::string type;       ///< such as Tree_float_5_4_3
  bool half = false;      ///< saved as 16-bit floats
  bool instance = false;  ///< shares its tree with another
  std::int64_t begin = 0; ///< of its descriptor, bytes from the file's beginning
  std::int64_t end = 0;   ///< of its last block
};

struct VDBHeader
{
  std::int64_t gridCount = 0; ///< where the number of grids stands
  std::vector<VDBEntry> grids;
};

/// @throw VDBError for what is missing, no OpenVDB file, of a version that is not known, or cut short
VDBHeader readVDBHeader(const std::string& path);
}
#endif
