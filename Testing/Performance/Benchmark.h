// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Benchmark.h
 * @brief Methods that answer one question, run in turns and measured alike.
 *
 * A method joins by registering itself once, at namespace scope of its source file:
 *
 *     const Registration linearGrid({ "vtkContour3DLinearGrid", "contour", { { "merged", "yes" } }, ... });
 *
 * Each method runs in a process of its own, so that peak memory is its own and a crash is told, not shared. A
 * measurement of several methods
 *  1. starts the processes and prepares each (input data; counted apart),
 *  2. runs each once: the first run, which pays for what is built once,
 *  3. runs them in turns, one run of each a round, until each has had its runs or used up its seconds, so that what else
 *     the machine does falls on all alike,
 *  4. asks each for its figures, among them its error against the group's truth.
 * Only one process works at a time.
 */
#ifndef Benchmark_h
#define Benchmark_h

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace nephoscope
{
namespace performance
{
/// What a method is asked to do. Every method of a group answers the same question for the same situation.
struct Situation
{
  std::array<int, 3> points{ 320, 160, 19 }; ///< of the grid, along longitude, latitude, level
  std::array<int, 2> pixels{ 1024, 768 };    ///< of the picture
  int threads = 2;
  bool doublePoints = false; ///< the grid's coordinates as double, else float

  long long cells() const { return (points[0] - 1LL) * (points[1] - 1LL) * (points[2] - 1LL); }
};

using Figures = std::map<std::string, double>;
using Settings = std::map<std::string, std::string>;

/// A method at work in its own process: constructed with its input made, run several times, then asked.
class Job
{
public:
  virtual ~Job() = default;
  virtual void run() = 0;
  /// Of the last run. "error" is the figure that charts show; its meaning is the group's.
  virtual Figures figures() = 0;
};

/// How a method is known and what it may be asked.
struct Method
{
  std::string name;    ///< the class
  std::string group;   ///< the question: "contour", "volume"
  Settings settings;   ///< what distinguishes it from the same class with other settings
  bool ours = false;   ///< of this project, or a peer
  bool window = false; ///< needs an OpenGL window, and with it a display
  long long mostCells =
    0; ///< hexahedra beyond which it would take minutes a run and is left out; 0 for no limit
  std::function<std::unique_ptr<Job>(const Situation&)> prepare;

  std::string label() const; ///< name and settings in one line
};

/// The register of all methods, in order of registration.
const std::vector<Method>& methods();

struct Registration
{
  explicit Registration(Method method);
};

/// What became of a method in a situation. Seconds are wall clock, memory is bytes.
struct Measurement
{
  Method method;
  Situation situation;
  std::string leftOut;         ///< why it was not run, else empty
  double prepareSeconds = 0;   ///< to make the input
  double firstSeconds = 0;     ///< the first run
  std::vector<double> seconds; ///< the runs after it
  double inputMemory = 0;      ///< resident once the input is made
  double peakMemory = 0;       ///< most that was resident in the runs
  double load = 0;             ///< the machine's load average of the last minute when it was done
  Figures figures;

  double median() const; ///< of seconds, or the first run's where there is no other; 0 if left out
  double spread() const; ///< half the distance between the quartiles
};

/// How often to run each.
struct Effort
{
  int runs = 7;        ///< after the first
  double seconds = 60; ///< no further run of a method that has used as many; the first counts
  bool figures = true; ///< whether to work out figures: the truth can cost more than the runs
};

/// Whether OpenGL windows can be opened.
bool haveDisplay();

/**
 * @brief Measure methods in turns. Call it while this process has a single thread: it forks.
 * @param progress told what is being done, may be empty
 */
std::vector<Measurement> measure(const std::vector<Method>& wanted, const Situation& situation,
  const Effort& effort, const std::function<void(const std::string&)>& progress);
}
}
#endif
