// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file NumberText.h
 * @brief A number as messages say it: std::to_string turns 1e-7 into 0.000000.
 */
#ifndef NumberText_h
#define NumberText_h

#include <sstream>
#include <string>

namespace nephoscope
{
/// The shortest of decimal and exponential, without trailing zeros: 0.15, 30000, 1e-07. @param digits significant, 1 to 17
inline std::string numberText(double value, int digits = 6)
{
  std::ostringstream text;
  text.precision(digits);
  text << value;
  return text.str();
}
}
#endif
