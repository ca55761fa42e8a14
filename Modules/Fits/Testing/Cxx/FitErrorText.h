// SPDX-License-Identifier: BSD-3-Clause
#ifndef FitErrorText_h
#define FitErrorText_h

#include "FitSubjects.h"

#include <string>

/// What a subject's fit over a range has to say against it.
inline std::string fitErrorOf(const std::string& subject, const nephoscope::FitRange& range)
{
  try
  {
    nephoscope::runFit(subject, range);
  }
  catch (const nephoscope::FitError& error)
  {
    return error.what();
  }
  return "no error";
}
#endif
