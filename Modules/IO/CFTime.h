// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file CFTime.h
 * @brief Times of the CF conventions, section 4.4: "UNIT since INSTANT" in any of the calendars.
 */
#ifndef CFTime_h
#define CFTime_h

#include <string>

namespace nephoscope
{
enum class Calendar
{
  Standard, ///< Julian until 1582-10-04, Gregorian from 1582-10-15
  ProlepticGregorian,
  Julian,
  NoLeap,
  AllLeap,
  Days360
};

/// @throws ReadError if the name is not known
Calendar calendarOfName(const std::string& name);
const char* calendarName(Calendar calendar);

struct DateTime
{
  long long year = 1;
  int month = 1;
  int day = 1;
  double second = 0; ///< of the day, 0..86400
};

/// Days since 0000-03-01 or any other fixed day of the calendar: only differences have a meaning.
long long dayNumber(Calendar calendar, long long year, int month, int day);
DateTime dateOfDayNumber(Calendar calendar, long long day);

/// "hours since 1959-01-01" in a calendar.
class TimeAxis
{
public:
  TimeAxis() = default;
  /// @throws ReadError if the units cannot be read
  TimeAxis(const std::string& units, const std::string& calendar);

  double seconds(double value) const { return value * this->Scale; } ///< since the reference
  /// From this reference instant to that of another axis of the same calendar, s.
  double secondsTo(const TimeAxis& other) const;
  std::string label(double seconds) const; ///< yyyy-mm-ddThh:mm:ss
  std::string units() const;               ///< "seconds since yyyy-mm-ddThh:mm:ss"
  const char* calendar() const { return calendarName(this->Kind); }

private:
  Calendar Kind = Calendar::Standard;
  DateTime Reference;
  double Scale = 1;
};
}
#endif
