// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file AdvectionCase.h
 * @brief The case for trajectories: a globe that turns as a solid body, so that every parcel's place is known.
 *
 * Wind of one turn in 12 days about an axis 45 degrees from the pole's (Williamson et al. 1992, test 1): at any place
 * u = omega x p. Asked is where the air of each grid point was a step of 6 hours, 7.5 degrees, ago. Errors are distances from
 * the exact place in metres of the scene: a globe of Earth's radius, levels 600 m apart exaggerated 30 times.
 */
#ifndef AdvectionCase_h
#define AdvectionCase_h

#include "Benchmark.h"
#include "Vector3.h"
#include "vtkSmartPointer.h"
#include "vtkStructuredGridAlgorithm.h"

class vtkStructuredGrid;

namespace nephoscope
{
namespace performance
{
namespace turn
{
constexpr double StepSeconds = 6 * 3600;

enum class WindKind
{
  OfTheModel, ///< m/s at sea level, as a model that neglects its depth has it
  OfTheScene  ///< scene units a second, and turned round, so that following it forward leads back
};

/// The grid with its Wind and Height; its heights are 30 times as large in the scene.
vtkSmartPointer<vtkStructuredGrid> grid(const Situation& situation, WindKind kind);

/// Where the air at a place was (negative: will be) that many seconds ago.
Vector3 placeBefore(const Vector3& place, double seconds);

/// The same grid at every time: 0, a step, two steps and so on, as many as asked for.
class SteadySource : public vtkStructuredGridAlgorithm
{
public:
  static SteadySource* New();
  vtkTypeMacro(SteadySource, vtkStructuredGridAlgorithm);

  vtkSmartPointer<vtkStructuredGrid> Grid;
  int Steps = 1000;

protected:
  SteadySource() { this->SetNumberOfInputPorts(0); }
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
};

/// Root mean square and largest distance, of those that were found; "lost" is the share of those that were not.
class Misses
{
public:
  void add(const Vector3& got, const Vector3& exact);
  void lose() { ++this->Lost; }
  Figures figures() const;

private:
  double Sum = 0;
  double Largest = 0;
  double Found = 0;
  double Lost = 0;
};
}
}
}
#endif
