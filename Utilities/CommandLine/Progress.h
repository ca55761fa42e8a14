// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Progress.h
 * @brief A progress bar on a terminal; nothing anywhere else.
 */
#ifndef Progress_h
#define Progress_h

#include <chrono>
#include <string>
#include <vector>

class vtkAlgorithm;

namespace nephoscope::program
{
/// Shows on standard error how far the algorithms that it watches have come; only if that is a terminal.
class Progress
{
public:
  Progress();
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Show an algorithm's progress events under a name. The algorithm must live until forget().
  void watch(vtkAlgorithm* algorithm, const std::string& name);

  /// Stop watching, and clear the bar.
  void forget();

  /// How far something else has come, 0 to 1.
  void show(const std::string& name, double done);

private:
  struct Watched
  {
    vtkAlgorithm* Algorithm;
    unsigned long Tag;
  };
  bool Terminal;
  bool Shown = false;
  std::chrono::steady_clock::time_point Last;
  std::vector<Watched> Algorithms;
};

/// Seconds of a stage: from construction or the last lap.
class Stopwatch
{
public:
  double lap();

private:
  std::chrono::steady_clock::time_point Started = std::chrono::steady_clock::now();
};
}
#endif
