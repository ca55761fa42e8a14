// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Failure.h
 * @brief What ends the program early: one line for the user and an exit code.
 */
#ifndef Failure_h
#define Failure_h

#include <stdexcept>
#include <string>

namespace nephoscope::program
{
/// The program's exit codes; a shell shows an interrupt as 130 = 128 + SIGINT.
enum ExitCode
{
  Success = 0,
  RunTimeError = 1,
  UsageError = 2,
  Interrupted = 130
};

/// Something that went wrong while running; what() is one line that names what, where and the remedy.
class Failure : public std::runtime_error
{
public:
  explicit Failure(const std::string& message, ExitCode code = RunTimeError)
    : std::runtime_error(message)
    , Code(code)
  {
  }
  ExitCode code() const { return this->Code; }

private:
  ExitCode Code;
};

/// The user asked for something that does not exist: on the command line or in a scene file.
class UsageFailure : public Failure
{
public:
  explicit UsageFailure(const std::string& message)
    : Failure(message, UsageError)
  {
  }
};
}
#endif
