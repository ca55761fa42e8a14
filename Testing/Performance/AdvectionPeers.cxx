// SPDX-License-Identifier: BSD-3-Clause
// The same trajectories by VTK's vtkParticleTracer: forward in the wind turned round, which leads back. A run traces every point
// through a step, with what the tracer builds for it. Particles that leave the grid on the way are lost: at the poles, where
// it has no cells, and at its top, where the step's chords leave the shell.
#include "AdvectionCase.h"

#include "CloudArrays.h"
#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkParticleTracer.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamTracer.h"
#include "vtkStructuredGrid.h"

namespace nephoscope
{
namespace performance
{
namespace
{
class ParticleJob : public Job
{
public:
  ParticleJob(const Situation& situation, int integrator)
    : Integrator(integrator)
  {
    vtkSmartPointer<vtkStructuredGrid> grid = turn::grid(situation, turn::WindKind::OfTheScene);
    grid->GetPointData()->SetActiveVectors(arrays::Wind);
    this->Source->Grid = grid;
    this->Source->Steps = 2;
    this->Seeds->SetPoints(grid->GetPoints());
  }

  void run() override
  {
    vtkNew<vtkParticleTracer> tracer;
    tracer->SetInputConnection(this->Source->GetOutputPort());
    tracer->SetInputDataObject(1, this->Seeds);
    tracer->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, arrays::Wind);
    tracer->SetIntegratorType(this->Integrator);
    tracer->SetComputeVorticity(false);
    tracer->SetStaticMesh(1);
    tracer->SetStartTime(0);
    tracer->UpdateTimeStep(turn::StepSeconds);
    this->Particles = vtkPolyData::SafeDownCast(tracer->GetOutputDataObject(0));
  }

  Figures figures() override
  {
    vtkPoints* const seeds = this->Seeds->GetPoints();
    vtkDataArray* const ids = this->Particles->GetPointData()->GetArray("InjectedPointId");
    turn::Misses misses;
    for (vtkIdType n = 0; n < this->Particles->GetNumberOfPoints(); ++n)
    {
      Vector3 got{};
      this->Particles->GetPoint(n, got.v);
      Vector3 place{};
      seeds->GetPoint(static_cast<vtkIdType>(ids->GetComponent(n, 0)), place.v);
      misses.add(got, turn::placeBefore(place, turn::StepSeconds));
    }
    for (vtkIdType n = this->Particles->GetNumberOfPoints(); n < seeds->GetNumberOfPoints(); ++n)
    {
      misses.lose();
    }
    return misses.figures();
  }

private:
  int Integrator;
  vtkNew<turn::SteadySource> Source;
  vtkNew<vtkPolyData> Seeds;
  vtkSmartPointer<vtkPolyData> Particles;
};

Registration tracer(const char* name, int integrator)
{
  return Registration({ "vtkParticleTracer", "advection", { { "integrator", name } }, false, false,
    0, [integrator](const Situation& s) { return std::make_unique<ParticleJob>(s, integrator); } });
}

const Registration second = tracer("RK2", vtkStreamTracer::RUNGE_KUTTA2);
const Registration fourth = tracer("RK4", vtkStreamTracer::RUNGE_KUTTA4);
}
}
}
