// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudTextureAdvection.h"

#include "CloudArrays.h"
#include "InputPipeline.h"
#include "PieceOfWhole.h"
#include "TextureAdvector.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
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
  bool Cut = true;      // whether the input comes whole
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

vtkCloudTextureAdvection::vtkCloudTextureAdvection()
  : Controller(vtkMultiProcessController::GetGlobalController())
{
}
vtkCloudTextureAdvection::~vtkCloudTextureAdvection() = default;

void vtkCloudTextureAdvection::SetController(vtkMultiProcessController* controller)
{
  if (this->Controller != controller)
  {
    this->Controller = controller;
    this->Modified();
  }
}

vtkMultiProcessController* vtkCloudTextureAdvection::GetController() const
{
  return this->Controller;
}

bool vtkCloudTextureAdvection::IsTogether(vtkInformation* output) const
{
  const int ranks = this->Controller ? this->Controller->GetNumberOfProcesses() : 1;
  return ranks > 1 && output->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()) == ranks &&
    output->Get(Pipeline::UPDATE_PIECE_NUMBER()) == this->Controller->GetLocalProcessId();
}

vtkExecutive* vtkCloudTextureAdvection::CreateDefaultExecutive()
{
  return nephoscope::InputPipeline::New();
}

bool vtkCloudTextureAdvection::Begin(vtkInformation* input, bool together)
{
  this->Work.reset();
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
    nephoscope::TextureAdvector textures(settings, timesOf(input));
    if (together)
    {
      nephoscope::PointExtent whole;
      input->Get(Pipeline::WHOLE_EXTENT(), whole.data());
      textures.divide(this->Controller, whole);
    }
    this->Work = std::make_unique<Progress>(Progress{ std::move(textures) });
  }
  catch (const nephoscope::GridError& error)
  {
    vtkErrorMacro(<< error.what());
    return false;
  }
  return true;
}

double vtkCloudTextureAdvection::FarthestReach() const
{
  return this->Work ? this->Work->Textures.farthestReach() : 1;
}

int vtkCloudTextureAdvection::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  // Called whenever this or the input has changed: nothing from before holds.
  return this->Begin(inputs[0]->GetInformationObject(0), false) ? 1 : 0;
}

int vtkCloudTextureAdvection::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkInformation* const in = inputs[0]->GetInformationObject(0);
  vtkInformation* const out = outputs->GetInformationObject(0);
  if (!this->Work)
  {
    return 0;
  }
  const bool together = this->IsTogether(out);
  if (together != this->Work->Textures.isDivided() && !this->Begin(in, together))
  {
    return 0; // begun again, as what is known is of other columns
  }
  const std::vector<double> times = timesOf(in);
  double target = 0;
  if (!times.empty())
  {
    target = out->Has(Pipeline::UPDATE_TIME_STEP()) ? out->Get(Pipeline::UPDATE_TIME_STEP())
                                                    : times.front();
    if (!(target >= times.front() && target <= times.back()))
    {
      vtkErrorMacro("Time " << target << " s is not within the input's, " << times.front() << " to "
                            << times.back() << " s.");
      return 0;
    }
  }
  return this->Ask(in, out, target);
}

/// Ask for what is needed next: a file time, and at last the target.
int vtkCloudTextureAdvection::Ask(vtkInformation* input, vtkInformation* output, double target)
{
  nephoscope::TextureAdvector& textures = this->Work->Textures;
  if (!this->Work->Running)
  {
    textures.begin(target);
  }
  const bool timed = input->Has(Pipeline::TIME_STEPS()) != 0;
  const bool last = textures.isReady() || !timed;
  this->Work->Cut = true;
  if (textures.isDivided())
  {
    const int ghosts = last ? output->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS()) : 0;
    this->Work->Cut = !nephoscope::askForPiece(input, output, ghosts);
  }
  else
  {
    nephoscope::askForWhole(input);
  }
  if (timed)
  {
    input->Set(Pipeline::UPDATE_TIME_STEP(), last ? target : textures.nextTime());
  }
  return 1;
}

int vtkCloudTextureAdvection::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkStructuredGrid* const input = vtkStructuredGrid::GetData(inputs[0]);
  vtkStructuredGrid* const output = vtkStructuredGrid::GetData(outputs);
  nephoscope::TextureAdvector& textures = this->Work->Textures;
  request->Remove(Pipeline::CONTINUE_EXECUTING());
  this->Work->Running = false;
  try
  {
    textures.require(nephoscope::whatInputLacks(this));
    if (!textures.isReady())
    {
      textures.take(input);
      this->UpdateProgress(textures.progress());
      if (!textures.everywhere(!this->GetAbortExecute()))
      {
        return 1;
      }
      if (inputs[0]->GetInformationObject(0)->Has(Pipeline::TIME_STEPS()))
      {
        this->Work->Running = true;
        request->Set(Pipeline::CONTINUE_EXECUTING(), 1);
        return 1;
      }
    }
    output->ShallowCopy(input);
    vtkInformation* const out = outputs->GetInformationObject(0);
    if (textures.isDivided() && this->Work->Cut)
    {
      nephoscope::cutPiece(output, out);
    }
    this->AddCoordinates(output);
    if (!textures.isDivided())
    {
      nephoscope::cutPiece(output, out);
    }
  }
  catch (const nephoscope::GridError& error)
  {
    output->Initialize();
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

void vtkCloudTextureAdvection::AddCoordinates(vtkStructuredGrid* output)
{
  nephoscope::TextureAdvector& textures = this->Work->Textures;
  const nephoscope::TextureAdvector::Result result = textures.finish(output);
  this->UsedRestartPeriod = textures.period();
  this->MedianStretch = result.medianStretch;
  this->MaximumStretch = result.maximumStretch;
  this->NumberOfSubsteps = textures.substeps();
  if (output->GetNumberOfPoints() == 0)
  {
    return; // more processes than columns
  }
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
  os << indent << "Controller: " << this->Controller.Get() << '\n';
  os << indent << "UsedRestartPeriod: " << this->UsedRestartPeriod << " s\n";
  os << indent << "MedianStretch: " << this->MedianStretch << '\n';
  os << indent << "MaximumStretch: " << this->MaximumStretch << '\n';
  os << indent << "NumberOfSubsteps: " << this->NumberOfSubsteps << '\n';
}
