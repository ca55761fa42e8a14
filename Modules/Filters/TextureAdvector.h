// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file TextureAdvector.h
 * @brief The work of vtkCloudTextureAdvection without its pipeline: which times it needs, and what becomes of them.
 *
 * Use: begin(target); while (!isReady()) take(grid at nextTime()); then finish(grid of the target).
 * Texture number m >= 0 starts at start(m) = first time + m period; number -1 starts at the first time as well.
 *
 * Several processes do this together, each for the columns of its block (ColumnShare.h), with the same settings, times and targets: take()
 * and finish() have to be called by all, and throw in all. For each interval a process gets wind, heights and displacements of those
 * columns that air may come from to its own; if a parcel comes from farther away (cubics overshoot) all do the interval again with twice the
 * reach. Sums are made of the same numbers in the same order, so that the results are those of one process to the bit.
 */
#ifndef TextureAdvector_h
#define TextureAdvector_h

#include "AirSnapshot.h"

#include <map>
#include <utility>

namespace nephoscope
{
class TextureAdvector
{
public:
  struct Settings
  {
    Integrator integrator = Integrator::RungeKutta2;
    Interpolation interpolation = Interpolation::Linear;
    double tolerance = 5000; ///< m
    bool crossFade = true;
    double restartPeriod = 0; ///< s, 0 from the strain
  };

  /// @param times of the file, s, rising; may be empty: no motion. Throws GridError if they do not rise.
  TextureAdvector(const Settings& settings, std::vector<double> times);

  /// With other processes. Before the first take().
  void divide(vtkMultiProcessController* controller, const PointExtent& whole);
  bool isDivided() const { return this->Controller != nullptr; }

  /// Start on a time within the file's; what is known from before is used.
  void begin(double target);
  /// Whether all file times have been taken that the target needs.
  bool isReady() const { return this->Known && this->Next > this->Last; }
  /// The file time to take next.
  double nextTime() const { return this->Times.empty() ? 0 : this->Times[this->Next]; }
  /// Take the grid of nextTime(). Throws GridError.
  void take(vtkStructuredGrid* grid);
  /// How much of what the target needs has been taken, below 1.
  double progress() const;
  /// Together: ColumnShare's.
  bool everywhere(bool here) const { return nephoscope::everywhere(this->Controller, here); }
  void require(const std::string& wrong) const { nephoscope::require(this->Controller, wrong); }

  /// Coordinates of the textures at the target, that of even number first: 3 floats a point, m. Also forgets what later times do not need.
  struct Result
  {
    std::vector<float> coordinates[2];
    double weight[2] = { 1, 0 };
    std::vector<float> stretch; ///< of the heavier
    double medianStretch = 1;   ///< of all points of all processes
    double maximumStretch = 1;
  };
  /// @param grid that of the target time, whose points (with ghosts) are those of the result, and whose heights give the places if there
  /// are no file times
  Result finish(vtkStructuredGrid* grid);

  double period() const { return this->Period; } ///< s; 0 without cross-fade
  int substeps() const { return this->Substeps; }
  /// Of the intervals so far, that of the one whose air came from farthest, as AirInterval's.
  double farthestReach() const { return this->FarthestReach; }

private:
  using Displacement = std::vector<float>;

  /// A texture's way through an interval: from where, and what it had become there.
  struct Leg
  {
    long texture;
    double from; // fraction of the interval
    const Displacement* state;
    Displacement result;
  };

  void learn(vtkStructuredGrid* grid);
  void plan();
  void skipKnown();
  void cross(int step);
  int stepBefore(double time) const;
  double start(long texture) const;
  int firstStep(long texture) const;
  double weightOf(long texture) const;
  std::vector<Leg> legs(int step) const;
  void advance(const AirSnapshot& begin, const AirSnapshot& end, std::vector<Leg>& legs, double to,
    bool asDisplacement);
  bool advanceWithin(
    const AirInterval& interval, std::vector<Leg>& legs, double to, bool asDisplacement);
  void stand(const AirSnapshot& now, std::vector<Leg>& legs) const;
  void locateTextures(Result& result);
  void displaceOther(Result& result) const;
  void spread(vtkStructuredGrid* grid, Result& result) const;
  void measureStretch(Result& result) const;
  void forget();

  Settings Setting;
  std::vector<double> Times;
  double Target = 0;
  bool Known = false;
  vtkSmartPointer<vtkMultiProcessController> Controller; // null: one process has all
  PointExtent Whole{};                                   // if divided
  AirGrid Air;
  double Period = 0;
  std::vector<long> Textures; // those that are seen at the target
  int First = 0;              // file step that was taken first for the target
  int Next = 0;               // to take next
  int Last = 0;               // last file step that is needed
  int Substeps = 1;
  double FarthestReach = 1;
  std::map<int, AirSnapshot> Snapshots;
  std::map<std::pair<long, int>, Displacement> States; // of a texture at a file step
};
}
#endif
