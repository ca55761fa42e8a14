// SPDX-License-Identifier: BSD-3-Clause
#include "CFTime.h"

#include "ReadError.h"
#include "Units.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

namespace nephoscope
{
namespace
{
constexpr long long GregorianStart = 15821015;

std::string lowered(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

long long floorDiv(long long a, long long b)
{
  return a / b - (a % b != 0 && (a < 0) != (b < 0) ? 1 : 0);
}

/// Days before March 1 of year y, counted from March 1 of year 0, in the proleptic calendars.
long long daysBeforeYear(Calendar calendar, long long y)
{
  switch (calendar)
  {
    case Calendar::NoLeap:
      return 365 * y;
    case Calendar::AllLeap:
      return 366 * y;
    case Calendar::Julian:
      return 365 * y + floorDiv(y, 4);
    default:
      return 365 * y + floorDiv(y, 4) - floorDiv(y, 100) + floorDiv(y, 400);
  }
}

long long prolepticDay(Calendar calendar, long long year, int month, int day)
{
  if (calendar == Calendar::Days360)
  {
    return 360 * year + 30 * (month - 1) + day - 1;
  }
  // The year from March on: its months' lengths repeat 31 30 31 30 31 and the leap day comes last.
  const long long y = month > 2 ? year : year - 1;
  const int m = (month + 9) % 12;
  return daysBeforeYear(calendar, y) + (153 * m + 2) / 5 + day - 1;
}

DateTime prolepticDate(Calendar calendar, long long number)
{
  DateTime date;
  if (calendar == Calendar::Days360)
  {
    date.year = floorDiv(number, 360);
    const int rest = static_cast<int>(number - 360 * date.year);
    date.month = rest / 30 + 1;
    date.day = rest % 30 + 1;
    return date;
  }
  long long y = floorDiv(number, 366) - 1;
  while (daysBeforeYear(calendar, y + 400) <= number)
  {
    y += 400;
  }
  while (daysBeforeYear(calendar, y + 1) <= number)
  {
    ++y;
  }
  const int rest = static_cast<int>(number - daysBeforeYear(calendar, y));
  const int m = (5 * rest + 2) / 153;
  date.day = rest - (153 * m + 2) / 5 + 1;
  date.month = m < 10 ? m + 3 : m - 9;
  date.year = date.month > 2 ? y : y + 1;
  return date;
}

/// The Julian calendar's day count lies two days after the Gregorian's at 0000-03-01.
constexpr long long JulianShift = -2;
}

Calendar calendarOfName(const std::string& name)
{
  const std::string n = lowered(name);
  if (n.empty() || n == "standard" || n == "gregorian" || n == "none")
  {
    return Calendar::Standard;
  }
  if (n == "proleptic_gregorian")
  {
    return Calendar::ProlepticGregorian;
  }
  if (n == "julian")
  {
    return Calendar::Julian;
  }
  if (n == "noleap" || n == "365_day" || n == "no_leap")
  {
    return Calendar::NoLeap;
  }
  if (n == "all_leap" || n == "366_day")
  {
    return Calendar::AllLeap;
  }
  if (n == "360_day")
  {
    return Calendar::Days360;
  }
  throw ReadError("calendar '" + name +
    "' is not known; use standard, proleptic_gregorian, julian, noleap, all_leap or 360_day");
}

const char* calendarName(Calendar calendar)
{
  static const char* const names[] = { "standard", "proleptic_gregorian", "julian", "noleap",
    "all_leap", "360_day" };
  return names[static_cast<int>(calendar)];
}

long long dayNumber(Calendar calendar, long long year, int month, int day)
{
  if (calendar != Calendar::Standard)
  {
    return prolepticDay(calendar, year, month, day);
  }
  return year * 10000 + month * 100 + day >= GregorianStart
    ? prolepticDay(Calendar::ProlepticGregorian, year, month, day)
    : prolepticDay(Calendar::Julian, year, month, day) + JulianShift;
}

DateTime dateOfDayNumber(Calendar calendar, long long day)
{
  if (calendar != Calendar::Standard)
  {
    return prolepticDate(calendar, day);
  }
  return day >= prolepticDay(Calendar::ProlepticGregorian, 1582, 10, 15)
    ? prolepticDate(Calendar::ProlepticGregorian, day)
    : prolepticDate(Calendar::Julian, day - JulianShift);
}

TimeAxis::TimeAxis(const std::string& units, const std::string& calendar)
  : Kind(calendarOfName(calendar))
{
  const std::size_t since = lowered(units).find(" since ");
  const std::string what = "time units '" + units.substr(0, 80) + "'";
  if (since == std::string::npos)
  {
    throw ReadError(what + " are not of the form 'hours since 2000-01-01 00:00'");
  }
  const std::string unit = lowered(units.substr(0, since));
  if (unit.rfind("month", 0) == 0 && this->Kind == Calendar::Days360)
  {
    this->Scale = 30 * 86400.0;
  }
  else if (const auto conversion = unitConversion(unit, "s"))
  {
    this->Scale = conversion->scale;
  }
  else
  {
    throw ReadError(what + " have no unit of time; use days, hours, minutes or seconds");
  }
  int hour = 0;
  int minute = 0;
  double second = 0;
  char separator = 0;
  const std::string instant = units.substr(since + 7);
  const int read =
    std::sscanf(instant.c_str(), "%9lld-%2d-%2d%c%2d:%2d:%10lf", &this->Reference.year,
      &this->Reference.month, &this->Reference.day, &separator, &hour, &minute, &second);
  if (read < 3 || this->Reference.month < 1 || this->Reference.month > 12 ||
    this->Reference.day < 1 || this->Reference.day > 31 || !std::isfinite(second) ||
    std::abs(hour) > 24 || std::abs(minute) > 60)
  {
    throw ReadError(what + " have no date yyyy-mm-dd");
  }
  this->Reference.second = hour * 3600.0 + minute * 60.0 + second;
}

double TimeAxis::secondsTo(const TimeAxis& other) const
{
  const DateTime& from = this->Reference;
  const DateTime& to = other.Reference;
  const long long days = dayNumber(this->Kind, to.year, to.month, to.day) -
    dayNumber(this->Kind, from.year, from.month, from.day);
  return static_cast<double>(days) * 86400 + to.second - from.second;
}

std::string TimeAxis::label(double seconds) const
{
  const double total = std::round(seconds + this->Reference.second);
  const double days = std::floor(total / 86400);
  if (!(std::abs(days) < 1e9))
  {
    return "out of range";
  }
  const DateTime date = dateOfDayNumber(this->Kind,
    dayNumber(this->Kind, this->Reference.year, this->Reference.month, this->Reference.day) +
      static_cast<long long>(days));
  const int second = static_cast<int>(total - 86400 * days);
  char text[64];
  std::snprintf(text, sizeof(text), "%04lld-%02d-%02dT%02d:%02d:%02d", date.year, date.month,
    date.day, second / 3600, second / 60 % 60, second % 60);
  return text;
}

std::string TimeAxis::units() const
{
  return "seconds since " + this->label(0);
}
}
