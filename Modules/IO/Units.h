// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Units.h
 * @brief Conversion between units of measurement by UDUNITS-2, with the spellings that models use beside.
 */
#ifndef Units_h
#define Units_h

#include <optional>
#include <string>

namespace nephoscope
{
/// y = scale x + offset.
struct UnitConversion
{
  double scale = 1;
  double offset = 0;
};

/// From one unit to another, or nothing if either is unknown or they do not convert. "%", "(0 - 1)", "fraction", "mb" are known.
std::optional<UnitConversion> unitConversion(const std::string& from, const std::string& to);
}
#endif
