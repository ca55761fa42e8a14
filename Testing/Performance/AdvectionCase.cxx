// SPDX-License-Identifier: BSD-3-Clause
#include "AdvectionCase.h"

#include "Atmosphere.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace performance
{
namespace turn
{
namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

const Vector3 Axis{ -std::sqrt(0.5), 0, std::sqrt(0.5) };
constexpr double Omega = 2 * 3.14159265358979323846 / (12 * 86400);
}

vtkSmartPointer<vtkStructuredGrid> grid(const Situation& situation, WindKind kind)
{
  vtkNew<Atmosphere> air;
  std::copy(situation.points.begin(), situation.points.end(), air->Size);
  air->HeightScale = 30;
  air->Height = [](int level, double) { return 600.0 * level; };
  air->Wind = [kind](const double p[3], double, double wind[3])
  {
    const Vector3 place{ p[0], p[1], p[2] };
    const Vector3 v = kind == WindKind::OfTheScene
      ? -Omega * cross(Axis, place)
      : Omega * Atmosphere::Radius * cross(Axis, normalized(place));
    std::copy(v.v, v.v + 3, wind);
  };
  air->Update();
  return air->GetOutput();
}

Vector3 placeBefore(const Vector3& place, double seconds)
{
  const double angle = -Omega * seconds;
  const double along = dot(Axis, place);
  return std::cos(angle) * place + std::sin(angle) * cross(Axis, place) +
    (1 - std::cos(angle)) * along * Axis;
}

vtkStandardNewMacro(SteadySource);

int SteadySource::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkInformation* const out = outputs->GetInformationObject(0);
  out->Set(Pipeline::WHOLE_EXTENT(), this->Grid->GetExtent(), 6);
  std::vector<double> times;
  for (int n = 0; n < this->Steps; ++n)
  {
    times.push_back(n * StepSeconds);
  }
  out->Set(Pipeline::TIME_STEPS(), times.data(), this->Steps);
  const double range[2] = { times.front(), times.back() };
  out->Set(Pipeline::TIME_RANGE(), range, 2);
  return 1;
}

int SteadySource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkStructuredGrid* const grid = vtkStructuredGrid::GetData(outputs);
  grid->ShallowCopy(this->Grid);
  vtkInformation* const out = outputs->GetInformationObject(0);
  if (out->Has(Pipeline::UPDATE_TIME_STEP()))
  {
    grid->GetInformation()->Set(
      vtkDataObject::DATA_TIME_STEP(), out->Get(Pipeline::UPDATE_TIME_STEP()));
  }
  return 1;
}

void Misses::add(const Vector3& got, const Vector3& exact)
{
  const double miss = length(got - exact);
  this->Sum += miss * miss;
  this->Largest = std::max(this->Largest, miss);
  ++this->Found;
}

Figures Misses::figures() const
{
  Figures figures{ { "lost", this->Lost / std::max(this->Found + this->Lost, 1.0) } };
  if (this->Found > 0)
  {
    figures["error"] = std::sqrt(this->Sum / this->Found);
    figures["largestError"] = this->Largest;
  }
  return figures;
}
}
}
}
