// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudTextureAdvection.h"

#include "CloudArrays.h"
#include "PieceOfWhole.h"
#include "TextureAdvector.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStructuredGrid.h"

#include <algorithm>

vtkStandardNewMacro(vtkCloudTextureAdvection);

struct vtkCloudTextureAdvection::Progress
{
  nephoscope::TextureAdvector Textures;
  bool Running = false; // between the first time taken in an update and its end
};

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

std::vector<double> timesOf(vtkInformation* info)
{
  if (!info->Has(Pipeline::TIME_STEPS()))
  {
    return {};
  }
  const double* const steps = info->Get(Pipeline::TIME_STEPS());
  return { steps, steps + info->Length(Pipeline::TIME_STEPS()) };
}

void addArray(
  vtkDataSetAttributes* data, const char* name, int components, const std::vector<float>& values)
{
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / components);
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  data->AddArray(array);
}
}

vtkCloudTextureAdvection::vtkCloudTextureAdvection() = default;
vtkCloudTextureAdvection::~vtkCloudTextureAdvection() = default;

int vtkCloudTextureAdvection::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  // Called whenever this or the input has changed: nothing from before holds.
  nephoscope::TextureAdvector::Settings settings;
  settings.integrator = this->Integrator == RungeKutta4 ? nephoscope::Integrator::RungeKutta4
                                                        : nephoscope::Integrator::RungeKutta2;
  settings.interpolation = this->Interpolation == Cubic ? nephoscope::Interpolation::Cubic
                                                        : nephoscope::Interpolation::Linear;
  settings.tolerance = this->Tolerance;
  settings.crossFade = this->CrossFade;
  settings.restartPeriod = this->RestartPeriod;
  try
  {
    this->Work = std::make_unique<Progress>(Progress{
      nephoscope::TextureAdvector(settings, timesOf(inputs[0]->GetInformationObject(0))) });
  }
  catch (const nephoscope::GridError& error)
  {
    this->Work.reset();
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

int vtkCloudTextureAdvection::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkInformation* const in = inputs[0]->GetInformationObject(0);
  nephoscope::askForWhole(in);
  const std::vector<double> times = timesOf(in);
  if (!this->Work || times.empty())
  {
    return this->Work ? 1 : 0;
  }
  vtkInformation* const out = outputs->GetInformationObject(0);
  const double target =
    out->Has(Pipeline::UPDATE_TIME_STEP()) ? out->Get(Pipeline::UPDATE_TIME_STEP()) : times.front();
  if (!this->Work->Running)
  {
    if (!(target >= times.front() && target <= times.back()))
    {
      vtkErrorMacro("Time " << target << " s is not within the input's, " << times.front() << " to "
                            << times.back() << " s.");
      return 0;
    }
    this->Work->Textures.begin(target);
  }
  in->Set(Pipeline::UPDATE_TIME_STEP(),
    this->Work->Textures.isReady() ? target : this->Work->Textures.nextTime());
  return 1;
}

int vtkCloudTextureAdvection::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkStructuredGrid* const input = vtkStructuredGrid::GetData(inputs[0]);
  vtkStructuredGrid* const output = vtkStructuredGrid::GetData(outputs);
  try
  {
    const bool timed = !timesOf(inputs[0]->GetInformationObject(0)).empty();
    if (!timed)
    {
      this->Work->Textures.begin(0);
    }
    if (!this->Work->Textures.isReady())
    {
      this->Work->Textures.take(input);
      if (timed)
      {
        this->Work->Running = true;
        request->Set(Pipeline::CONTINUE_EXECUTING(), 1);
        return 1;
      }
    }
    const nephoscope::TextureAdvector::Result result = this->Work->Textures.finish(input);
    output->ShallowCopy(input);
    vtkPointData* const data = output->GetPointData();
    addArray(data, nephoscope::arrays::TextureCoordinates, 3, result.coordinates[0]);
    if (!result.coordinates[1].empty())
    {
      addArray(data, nephoscope::arrays::OtherTextureCoordinates, 3, result.coordinates[1]);
      vtkNew<vtkDoubleArray> weights;
      weights->SetName(nephoscope::arrays::TextureWeights);
      weights->InsertNextValue(result.weight[0]);
      weights->InsertNextValue(result.weight[1]);
      output->GetFieldData()->AddArray(weights);
    }
    addArray(data, nephoscope::arrays::TextureStretch, 1, result.stretch);
    std::vector<float> ordered = result.stretch;
    const auto middle = ordered.begin() + static_cast<std::ptrdiff_t>(ordered.size() / 2);
    std::nth_element(ordered.begin(), middle, ordered.end());
    this->MedianStretch = *middle;
    this->MaximumStretch = *std::max_element(middle, ordered.end());
    this->UsedRestartPeriod = this->Work->Textures.period();
    this->NumberOfSubsteps = this->Work->Textures.substeps();
    nephoscope::cutPiece(output, outputs->GetInformationObject(0));
  }
  catch (const nephoscope::GridError& error)
  {
    vtkErrorMacro(<< error.what());
    request->Remove(Pipeline::CONTINUE_EXECUTING());
    this->Work->Running = false;
    return 0;
  }
  request->Remove(Pipeline::CONTINUE_EXECUTING());
  this->Work->Running = false;
  return 1;
}

void vtkCloudTextureAdvection::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent
     << "Integrator: " << (this->Integrator == RungeKutta4 ? "RungeKutta4" : "RungeKutta2") << '\n';
  os << indent << "Interpolation: " << (this->Interpolation == Cubic ? "Cubic" : "Linear") << '\n';
  os << indent << "Tolerance: " << this->Tolerance << " m\n";
  os << indent << "CrossFade: " << (this->CrossFade ? "on" : "off") << '\n';
  os << indent << "RestartPeriod: " << this->RestartPeriod << " s\n";
  os << indent << "UsedRestartPeriod: " << this->UsedRestartPeriod << " s\n";
  os << indent << "MedianStretch: " << this->MedianStretch << '\n';
  os << indent << "MaximumStretch: " << this->MaximumStretch << '\n';
  os << indent << "NumberOfSubsteps: " << this->NumberOfSubsteps << '\n';
}
