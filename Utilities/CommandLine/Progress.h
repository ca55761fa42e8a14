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

class vtkObject;

namespace nephoscope::program
{
/// Shows on standard error how far the objects that it watches have come; only if that is a terminal.
class Progress
{
public:
  Progress();
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Show an object's progress events under a name. The object must live until forget().
  void watch(vtkObject* working, const std::string& name);

  /// Stop watching, and clear the bar.
  void forget();

  /// How far something else has come, 0 to 1.
  void show(const std::string& name, double done);

private:
  struct Watched
  {
    vtkObject* Working;
    unsigned long Tag;
  };
  bool Terminal;
  bool Shown = false;
  std::chrono::steady_clock::time_point Last;
  std::vector<Watched> All;
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
