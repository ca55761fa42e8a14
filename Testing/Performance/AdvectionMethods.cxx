// SPDX-License-Identifier: BSD-3-Clause
// Trajectories of a step, from every point of the turning globe. A run is one step of texture advection: a texture that is there
// already is carried on over the next interval. Figures: error and largestError, m, and lost, the share of points without
// an answer.
#include "AdvectionCase.h"

#include "CloudArrays.h"
#include "vtkCloudTextureAdvection.h"
#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkStructuredGrid.h"

namespace nephoscope
{
namespace performance
{
namespace
{
/// Integrator, interpolation, tolerance in metres.
struct Scheme
{
  int integrator;
  int interpolation;
  double tolerance;
};

class AdvectionJob : public Job
{
public:
  AdvectionJob(const Situation& situation, const Scheme& scheme)
    : Wanted(scheme)
  {
    this->Source->Grid = turn::grid(situation, turn::WindKind::OfTheModel);
    this->connect(this->Textures);
    this->Textures->UpdateTimeStep(0);
  }

  void run() override { this->Textures->UpdateTimeStep(++this->Step * turn::StepSeconds); }

  Figures figures() override
  {
    vtkNew<vtkCloudTextureAdvection> first;
    this->connect(first);
    first->UpdateTimeStep(turn::StepSeconds);
    vtkStructuredGrid* const grid = first->GetOutput();
    vtkDataArray* const coordinates = grid->GetPointData()->GetArray(arrays::TextureCoordinates);
    turn::Misses misses;
    for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
    {
      Vector3 place{};
      grid->GetPoint(p, place.v);
      Vector3 was{};
      coordinates->GetTuple(p, was.v);
      misses.add(was, turn::placeBefore(place, turn::StepSeconds));
    }
    Figures figures = misses.figures();
    figures["substeps"] = first->GetNumberOfSubsteps();
    return figures;
  }

private:
  void connect(vtkCloudTextureAdvection* filter) const
  {
    filter->SetInputConnection(this->Source->GetOutputPort());
    filter->CrossFadeOff();
    filter->SetIntegrator(this->Wanted.integrator);
    filter->SetInterpolation(this->Wanted.interpolation);
    filter->SetTolerance(this->Wanted.tolerance);
  }

  Scheme Wanted;
  vtkNew<turn::SteadySource> Source;
  vtkNew<vtkCloudTextureAdvection> Textures;
  int Step = 0;
};

Registration method(const char* integrator, const char* interpolation, const char* tolerance)
{
  const Scheme scheme{ integrator[2] == '4' ? vtkCloudTextureAdvection::RungeKutta4
                                            : vtkCloudTextureAdvection::RungeKutta2,
    interpolation[0] == 'c' ? vtkCloudTextureAdvection::Cubic : vtkCloudTextureAdvection::Linear,
    std::stod(tolerance) };
  return Registration({ "vtkCloudTextureAdvection", "advection",
    { { "integrator", integrator }, { "interpolation", interpolation },
      { "tolerance", std::string(tolerance) + " m" } },
    true, false, 0,
    [scheme](const Situation& s) { return std::make_unique<AdvectionJob>(s, scheme); } });
}

const Registration linear5000 = method("RK2", "linear", "5000");
const Registration linear500 = method("RK2", "linear", "500");
const Registration linear50 = method("RK2", "linear", "50");
const Registration linearFourth = method("RK4", "linear", "50");
const Registration cubic500 = method("RK2", "cubic", "500");
const Registration cubic5 = method("RK2", "cubic", "5");
const Registration cubicFourth50 = method("RK4", "cubic", "50");
const Registration cubicFourth = method("RK4", "cubic", "0.05");
}
}
}
