// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudscape.h"

#include "Camera.h"
#include "RankedTiles.h"
#include "TileDrawer.h"
#include "vtkCamera.h"
#include "vtkCloudBackdrop.h"
#include "vtkCloudBody.h"
#include "vtkCommunicator.h"
#include "vtkDataSet.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <iterator>
#include <memory>

vtkStandardNewMacro(vtkCloudscape);

namespace
{
constexpr int MaximumSize = 32768;

nephoscope::Vector3 vector(const double v[3])
{
  return { v[0], v[1], v[2] };
}

/// In which order bodies are emitted.
int turn(const vtkCloudBody& body)
{
  return !body.IsOpaque() ? 2 : body.HidesAhead() ? 1 : 0;
}

}

vtkCloudscape::vtkCloudscape()
{
  this->SetNumberOfInputPorts(0);
}

vtkCloudscape::~vtkCloudscape() = default;

void vtkCloudscape::SetCamera(vtkCamera* camera)
{
  if (this->Camera != camera)
  {
    this->Camera = camera;
    this->Modified();
  }
}

vtkCamera* vtkCloudscape::GetCamera() const
{
  return this->Camera;
}

void vtkCloudscape::SetBackdrop(vtkCloudBackdrop* backdrop)
{
  if (this->Backdrop != backdrop)
  {
    this->Backdrop = backdrop;
    this->Modified();
  }
}

vtkCloudBackdrop* vtkCloudscape::GetBackdrop() const
{
  return this->Backdrop;
}

void vtkCloudscape::SetController(vtkMultiProcessController* controller)
{
  if (this->Controller != controller)
  {
    this->Controller = controller;
    this->Modified();
  }
}

vtkMultiProcessController* vtkCloudscape::GetController() const
{
  return this->Controller;
}

void vtkCloudscape::AddBody(vtkCloudBody* body)
{
  if (body)
  {
    this->Bodies.emplace_back(body);
    this->Modified();
  }
}

void vtkCloudscape::RemoveAllBodies()
{
  this->Bodies.clear();
  this->Modified();
}

int vtkCloudscape::GetNumberOfBodies() const
{
  return static_cast<int>(this->Bodies.size());
}

vtkCloudBody* vtkCloudscape::GetBody(int index) const
{
  return index >= 0 && index < this->GetNumberOfBodies() ? this->Bodies[index].Get() : nullptr;
}

nephoscope::Camera vtkCloudscape::GetRays() const
{
  const nephoscope::Vector3 eye = vector(this->Camera->GetPosition());
  const nephoscope::Vector3 target = vector(this->Camera->GetFocalPoint());
  const nephoscope::Vector3 up = vector(this->Camera->GetViewUp());
  const int across = this->Samples * this->Size[0];
  const int along = this->Samples * this->Size[1];
  if (this->CylinderAngle > 0)
  {
    return nephoscope::Camera::cylindrical(eye, target, up, this->CylinderAngle, across, along);
  }
  return this->Camera->GetParallelProjection()
    ? nephoscope::Camera::parallel(eye, target, up, this->Camera->GetParallelScale(), across, along)
    : nephoscope::Camera::perspective(eye, target, up, this->Camera->GetViewAngle(), across, along);
}

vtkMTimeType vtkCloudscape::GetMTime()
{
  vtkMTimeType newest = this->Superclass::GetMTime();
  if (this->Camera)
  {
    newest = std::max(newest, this->Camera->GetMTime());
  }
  if (this->Backdrop)
  {
    newest = std::max(newest, this->Backdrop->GetMTime());
  }
  for (const auto& body : this->Bodies)
  {
    newest = std::max(newest, body->GetMTime());
    // A change anywhere up a body's pipeline is a change of the picture.
    for (int port = 0; port < body->GetNumberOfInputPorts(); ++port)
    {
      for (int connection = 0; connection < body->GetNumberOfInputConnections(port); ++connection)
      {
        vtkAlgorithm* const source = body->GetInputAlgorithm(port, connection);
        source->UpdateInformation();
        auto* const pipeline =
          vtkDemandDrivenPipeline::SafeDownCast(body->GetInputExecutive(port, connection));
        newest = std::max(newest, pipeline ? pipeline->GetPipelineMTime() : source->GetMTime());
      }
    }
  }
  return newest;
}

bool vtkCloudscape::Validate()
{
  if (!this->Camera)
  {
    vtkErrorMacro("There is no camera: call SetCamera first.");
    return false;
  }
  for (const int size : this->Size)
  {
    if (size < 1 || size > MaximumSize / this->Samples)
    {
      vtkErrorMacro("The picture's size " << this->Size[0] << " x " << this->Size[1]
                                          << " is not within 1 to " << MaximumSize / this->Samples
                                          << " pixels.");
      return false;
    }
  }
  return true;
}

/// Whether all processes can draw, and the same: by what follows they find each other's packets.
bool vtkCloudscape::AgreeOn(bool valid)
{
  if (!this->IsOfSeveralRanks())
  {
    return valid;
  }
  const auto bodies = std::count_if(this->Bodies.begin(), this->Bodies.end(),
    [](vtkCloudBody* body) { return body->GetVisibility(); });
  constexpr int Count = 6;
  const int settings[Count] = { this->Size[0], this->Size[1], this->Samples, this->TileSize,
    this->ComputeDepth ? 1 : 0, static_cast<int>(bodies) };
  // The least of each and, negative, the greatest.
  int own[2 * Count + 1] = { valid ? 1 : 0 };
  for (int n = 0; n < Count; ++n)
  {
    own[1 + n] = settings[n];
    own[1 + Count + n] = -settings[n];
  }
  int least[2 * Count + 1];
  this->Controller->AllReduce(own, least, 2 * Count + 1, vtkCommunicator::MIN_OP);
  if (least[0] == 0)
  {
    if (valid)
    {
      vtkErrorMacro("Another process cannot draw the picture; see its message.");
    }
    return false;
  }
  for (int n = 0; n < Count; ++n)
  {
    if (least[1 + n] != -least[1 + Count + n])
    {
      vtkErrorMacro("Processes differ in Size, Samples, TileSize, ComputeDepth or the number of "
                    "visible bodies; give all of them the same.");
      return false;
    }
  }
  return true;
}

bool vtkCloudscape::IsOfSeveralRanks() const
{
  return this->Controller && this->Controller->GetNumberOfProcesses() > 1;
}

void vtkCloudscape::UpdateBodies()
{
  for (const auto& body : this->Bodies)
  {
    this->UpdateInputs(body);
  }
}

/// Brings a body's inputs up to date: all of them, or this process's piece. Returns false if one cannot be.
bool vtkCloudscape::UpdateInputs(vtkCloudBody* body)
{
  bool updated = true;
  const bool pieces = this->IsOfSeveralRanks() && body->DrawsPieces();
  const int piece = pieces ? this->Controller->GetLocalProcessId() : 0;
  const int all = pieces ? this->Controller->GetNumberOfProcesses() : 1;
  for (int port = 0; body->GetVisibility() && port < body->GetNumberOfInputPorts(); ++port)
  {
    const int used = body->GetInputUse(port) ? body->GetNumberOfInputConnections(port) : 0;
    for (int connection = 0; connection < used; ++connection)
    {
      vtkAlgorithm* const source = body->GetInputAlgorithm(port, connection);
      if (this->IsOfSeveralRanks())
      {
        updated = source->UpdatePiece(piece, all, 0) && updated;
      }
      else
      {
        source->Update();
      }
    }
  }
  return updated;
}

/// Whether there is anything of a body in this process.
bool vtkCloudscape::HasPieceOf(vtkCloudBody* body) const
{
  auto* const data = body->GetNumberOfInputPorts() > 0
    ? vtkDataSet::SafeDownCast(body->GetInputDataObject(0, 0))
    : nullptr;
  return !this->IsOfSeveralRanks() || !body->DrawsPieces() || !data ||
    data->GetNumberOfPoints() > 0;
}

int vtkCloudscape::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  const int extent[6] = { 0, this->Size[0] - 1, 0, this->Size[1] - 1, 0, 0 };
  vtkInformation* const out = outputs->GetInformationObject(0);
  out->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  const double spacing[3] = { 1, 1, 1 };
  const double origin[3] = { 0, 0, 0 };
  out->Set(vtkDataObject::SPACING(), spacing, 3);
  out->Set(vtkDataObject::ORIGIN(), origin, 3);
  vtkDataObject::SetPointDataActiveScalarInfo(out, VTK_FLOAT, 3);
  return 1;
}

int vtkCloudscape::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  if (!this->AgreeOn(this->Validate()))
  {
    return 0;
  }
  const double started = vtkTimerLog::GetUniversalTime();
  this->UpdateBodies();
  const double updated = vtkTimerLog::GetUniversalTime();

  TileScene scene{ this->GetRays(), {}, this->Backdrop, this->Size[0], this->Size[1],
    this->TileSize, this->Samples, this->ComputeDepth };
  std::copy_if(this->Bodies.begin(), this->Bodies.end(), std::back_inserter(scene.Bodies),
    [](vtkCloudBody* body) { return body->GetVisibility(); });
  std::stable_sort(scene.Bodies.begin(), scene.Bodies.end(),
    [](const vtkCloudBody* a, const vtkCloudBody* b) { return turn(*a) < turn(*b); });
  bool sums = sumsMayBeSent(scene);
  if (!this->PrepareBodies(scene, sums))
  {
    return 0;
  }
  const double prepared = vtkTimerLog::GetUniversalTime();

  vtkImageData* const image = vtkImageData::GetData(outputs);
  const bool drawn = this->DrawAll(scene, sums, image);
  this->PipelineSeconds = updated - started;
  this->PrepareSeconds = prepared - updated;
  this->TileSeconds = vtkTimerLog::GetUniversalTime() - prepared;
  if (!drawn)
  {
    image->Initialize();
    return 0;
  }
  return 1;
}

/// Gets bodies ready; leaves in the scene those that have something in this process, and `sums` if all processes may send them.
bool vtkCloudscape::PrepareBodies(TileScene& scene, bool& sums)
{
  std::vector<vtkCloudBody*> here;
  int own[2] = { 1, sums ? 1 : 0 };
  for (vtkCloudBody* body : scene.Bodies)
  {
    // Another body may have asked the same pipeline for another piece.
    if (this->IsOfSeveralRanks() && !this->UpdateInputs(body))
    {
      vtkErrorMacro("The input of a " << body->GetClassName() << " fails; see its own message.");
      own[0] = 0;
    }
    if (!this->HasPieceOf(body))
    {
      continue;
    }
    here.push_back(body);
    // The others' inputs are updated all the same: processes may meet in their pipelines.
    if (own[0] != 0 && !body->Prepare(scene.Camera))
    {
      vtkErrorMacro("A " << body->GetClassName() << " cannot be drawn; see its own message.");
      own[0] = 0;
    }
  }
  scene.Bodies = here;
  int all[2] = { own[0], own[1] };
  if (this->IsOfSeveralRanks())
  {
    this->Controller->AllReduce(own, all, 2, vtkCommunicator::MIN_OP);
  }
  if (own[0] != 0 && all[0] == 0)
  {
    vtkErrorMacro("Another process cannot draw its piece; see its message.");
  }
  sums = all[1] != 0;
  return all[0] != 0;
}

/// Returns false if it was aborted.
bool vtkCloudscape::DrawAll(const TileScene& scene, bool sums, vtkImageData* image)
{
  std::unique_ptr<TilePicture> picture;
  if (!this->IsOfSeveralRanks() || this->Controller->GetLocalProcessId() == 0)
  {
    image->SetDimensions(this->Size[0], this->Size[1], 1);
    image->SetSpacing(1, 1, 1);
    image->SetOrigin(0, 0, 0);
    picture = std::make_unique<TilePicture>(image);
  }
  if (this->IsOfSeveralRanks())
  {
    RankedFigures figures;
    const bool drawn = drawRankedTiles(this, this->Controller, scene, sums, picture.get(), figures);
    this->NumberOfSegments = figures.Segments;
    this->BytesSent = figures.BytesSent;
    return drawn;
  }
  this->BytesSent = 0;
  this->NumberOfSegments = drawTiles(this, scene, *picture);
  return !this->GetAbortExecute();
}

void vtkCloudscape::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Size: " << this->Size[0] << " x " << this->Size[1] << '\n';
  os << indent << "CylinderAngle: " << this->CylinderAngle << '\n';
  os << indent << "TileSize: " << this->TileSize << '\n';
  os << indent << "Samples: " << this->Samples << '\n';
  os << indent << "ComputeDepth: " << this->ComputeDepth << '\n';
  os << indent << "Camera: " << this->Camera.Get() << '\n';
  os << indent << "Controller: " << this->Controller.Get() << '\n';
  os << indent << "Backdrop: " << this->Backdrop.Get() << '\n';
  os << indent << "Bodies: " << this->Bodies.size() << '\n';
  os << indent << "NumberOfSegments: " << this->NumberOfSegments << '\n';
  os << indent << "BytesSent: " << this->BytesSent << '\n';
}
