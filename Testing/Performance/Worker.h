// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Worker.h
 * @brief A method's own process: it prepares, runs and tells on command, through two pipes.
 *
 * The process is a fork of this one, so it has to be made while this one has a single thread.
 */
#ifndef Worker_h
#define Worker_h

#include "Benchmark.h"

#include <string>
#include <sys/types.h>

namespace nephoscope
{
namespace performance
{
class Worker
{
public:
  enum class Command : char
  {
    Prepare = 'p',
    Run = 'r',
    Figures = 'f'
  };

  struct Answer
  {
    double seconds = 0; ///< wall clock of what was asked
    double memory = 0;  ///< bytes: resident after Prepare, the most resident since then after Run
    performance::Figures figures;
    std::string failure; ///< what went wrong, else empty
  };

  Worker(const Method& method, const Situation& situation);
  ~Worker(); ///< ends the process
  Worker(const Worker&) = delete;
  void operator=(const Worker&) = delete;

  Answer ask(Command command);

private:
  std::string read(); ///< a line, or nothing if the process has ended

  pid_t Process = -1;
  int ToChild = -1;
  int FromChild = -1;
};
}
}
#endif
