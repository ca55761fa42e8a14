// SPDX-License-Identifier: BSD-3-Clause
#include "Units.h"

#include <udunits2.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <mutex>

namespace nephoscope
{
namespace
{
struct UnitFree
{
  void operator()(ut_unit* unit) const { ut_free(unit); }
  void operator()(cv_converter* converter) const { cv_free(converter); }
};
using Unit = std::unique_ptr<ut_unit, UnitFree>;

ut_system* unitSystem()
{
  static ut_system* system = []
  {
    ut_set_error_message_handler(ut_ignore);
    return ut_read_xml(nullptr);
  }();
  return system;
}

/// The spellings outside UDUNITS that models write.
std::string plainSpelling(const std::string& text)
{
  std::string s = text;
  s.erase(0, s.find_first_not_of(" \t"));
  s.erase(s.find_last_not_of(" \t") + 1);
  std::string lower = s;
  std::transform(lower.begin(), lower.end(), lower.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const char* one : { "", "(0 - 1)", "(0-1)", "0-1", "0 - 1", "fraction", "none",
         "dimensionless", "proportion", "unitless", "-", "[-]", "[]", "~", "numeric" })
  {
    if (lower == one)
    {
      return "1";
    }
  }
  for (const char* hundredth : { "percent", "per cent", "pct", "% (0-100)" })
  {
    if (lower == hundredth)
    {
      return "%";
    }
  }
  if (lower == "mb" || lower == "mbar" || lower == "millibars")
  {
    return "hPa"; // UDUNITS reads mb as millibarn
  }
  if (lower == "gpm" || lower == "geopotential meter" || lower == "geopotential metre")
  {
    return "m";
  }
  return s;
}

Unit parse(const std::string& text)
{
  const bool sane = text.size() < 128 &&
    std::all_of(text.begin(), text.end(), [](unsigned char c) { return c >= 32 && c < 127; });
  return Unit(sane && unitSystem() ? ut_parse(unitSystem(), text.c_str(), UT_ASCII) : nullptr);
}
}

std::optional<UnitConversion> unitConversion(const std::string& from, const std::string& to)
{
  static std::mutex guard; // UDUNITS is not thread-safe
  const std::lock_guard<std::mutex> lock(guard);
  const Unit source = parse(plainSpelling(from));
  const Unit target = parse(plainSpelling(to));
  if (!source || !target || !ut_are_convertible(source.get(), target.get()))
  {
    return std::nullopt;
  }
  const std::unique_ptr<cv_converter, UnitFree> converter(
    ut_get_converter(source.get(), target.get()));
  if (!converter)
  {
    return std::nullopt;
  }
  const double offset = cv_convert_double(converter.get(), 0);
  const double scale = cv_convert_double(converter.get(), 1) - offset;
  // A reciprocal or logarithmic unit is not linear.
  if (!(std::abs(cv_convert_double(converter.get(), 2) - (2 * scale + offset)) <=
        1e-9 * (std::abs(2 * scale) + std::abs(offset))))
  {
    return std::nullopt;
  }
  return UnitConversion{ scale, offset };
}
}
