// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudPicture.h"

#include "CloudArrays.h"
#include "DisplayTransfer.h"
#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkCloudBackdrop.h"
#include "vtkCloudBody.h"
#include "vtkCloudCellVolume.h"
#include "vtkCloudGlobe.h"
#include "vtkCloudSurface.h"
#include "vtkCloudVoxelVolume.h"
#include "vtkCloudscape.h"
#include "vtkCommand.h"
#include "vtkCommunicator.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

vtkStandardNewMacro(vtkCloudPicture);

namespace
{
constexpr double Margin = 1.1;

void addDisplayColor(vtkImageData* image)
{
  auto* const radiance =
    vtkFloatArray::SafeDownCast(image->GetPointData()->GetArray(nephoscope::arrays::Radiance));
  if (!radiance)
  {
    return;
  }
  const vtkNew<vtkUnsignedCharArray> color;
  color->SetName(nephoscope::arrays::DisplayColor);
  color->SetNumberOfComponents(3);
  color->SetNumberOfTuples(radiance->GetNumberOfTuples());
  std::transform(radiance->GetPointer(0), radiance->GetPointer(radiance->GetNumberOfValues()),
    color->GetPointer(0), [](float light) { return nephoscope::srgb8(light); });
  image->GetPointData()->AddArray(color);
  image->GetPointData()->SetActiveScalars(nephoscope::arrays::DisplayColor);
}

enum Kind
{
  KindNone = -1,
  KindGrid,
  KindSurface,
  KindVoxels
};

// In the order of Kind.
constexpr std::array<const char*, 3> Names = { "grids", "surfaces", "voxels" };
constexpr std::array<const char*, 3> Setters = { "SetVolume", "SetSurface", "SetVoxels" };

/// What the data say themselves: polygons of which there are none may be a piece of anything.
Kind kindOf(vtkDataSet* data)
{
  if (!data)
  {
    return KindNone;
  }
  if (!data->IsA("vtkPolyData"))
  {
    return KindGrid;
  }
  if (data->GetPointData()->HasArray(nephoscope::arrays::VoxelBricks))
  {
    return KindVoxels;
  }
  return data->GetNumberOfPoints() > 0 ? KindSurface : KindNone;
}

/// Widens the bounds of bricks' points, their first voxels, to where their density is 0.
void addReachOfVoxels(vtkDataSet* bricks, double bounds[6])
{
  vtkDataArray* const place = bricks->GetFieldData()->GetArray(nephoscope::arrays::VoxelToScene);
  // None have no bounds; what has another matrix the body refuses.
  const bool known = bricks->GetNumberOfPoints() > 0 && place && place->GetNumberOfValues() == 16;
  for (int row = 0; known && row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      const double edge = place->GetVariantValue(4 * row + column).ToDouble();
      bounds[2 * row] += std::min(-edge, 8 * edge);
      bounds[2 * row + 1] += std::max(-edge, 8 * edge);
    }
  }
}

/// Of the globe that the data are round, scene units; 0 if they are not.
double planetRadius(vtkInformationVector* input)
{
  vtkDataSet* const data = vtkDataSet::GetData(input);
  vtkFieldData* const fields = data ? data->GetFieldData() : nullptr;
  if (!fields)
  {
    return 0;
  }
  auto* const geometry =
    vtkStringArray::SafeDownCast(fields->GetAbstractArray(nephoscope::arrays::Geometry));
  vtkDataArray* const radius = fields->GetArray(nephoscope::arrays::PlanetRadius);
  return geometry && radius && geometry->GetValue(0) == "Globe" ? radius->GetComponent(0, 0) : 0;
}
}

vtkCloudPicture::vtkCloudPicture()
  : Volume(vtkSmartPointer<vtkCloudCellVolume>::New())
  , Surface(vtkSmartPointer<vtkCloudSurface>::New())
  , Voxels(vtkSmartPointer<vtkCloudVoxelVolume>::New())
  , Globe(vtkSmartPointer<vtkCloudGlobe>::New())
  , Controller(vtkMultiProcessController::GetGlobalController())
{
  this->SetNumberOfInputPorts(2);
}

vtkCloudPicture::~vtkCloudPicture() = default;

void vtkCloudPicture::SetVolume(vtkCloudCellVolume* volume)
{
  if (this->Volume != volume)
  {
    this->Volume = volume;
    this->Modified();
  }
}

vtkCloudCellVolume* vtkCloudPicture::GetVolume() const
{
  return this->Volume;
}

void vtkCloudPicture::SetSurface(vtkCloudSurface* surface)
{
  if (this->Surface != surface)
  {
    this->Surface = surface;
    this->Modified();
  }
}

vtkCloudSurface* vtkCloudPicture::GetSurface() const
{
  return this->Surface;
}

void vtkCloudPicture::SetVoxels(vtkCloudVoxelVolume* voxels)
{
  if (this->Voxels != voxels)
  {
    this->Voxels = voxels;
    this->Modified();
  }
}

vtkCloudVoxelVolume* vtkCloudPicture::GetVoxels() const
{
  return this->Voxels;
}

void vtkCloudPicture::SetGround(vtkCloudBody* ground)
{
  if (this->Ground != ground)
  {
    this->Ground = ground;
    this->Modified();
  }
}

vtkCloudBody* vtkCloudPicture::GetGround() const
{
  return this->Ground;
}

void vtkCloudPicture::SetBackdrop(vtkCloudBackdrop* backdrop)
{
  if (this->Backdrop != backdrop)
  {
    this->Backdrop = backdrop;
    this->Modified();
  }
}

vtkCloudBackdrop* vtkCloudPicture::GetBackdrop() const
{
  return this->Backdrop;
}

void vtkCloudPicture::SetController(vtkMultiProcessController* controller)
{
  if (this->Controller != controller)
  {
    this->Controller = controller;
    this->Modified();
  }
}

vtkMultiProcessController* vtkCloudPicture::GetController() const
{
  return this->Controller;
}

vtkMTimeType vtkCloudPicture::GetMTime()
{
  vtkMTimeType newest = this->Superclass::GetMTime();
  const std::initializer_list<vtkObject*> parts = { this->Volume, this->Surface, this->Voxels,
    this->Ground, this->Backdrop };
  for (vtkObject* part : parts)
  {
    newest = part ? std::max(newest, part->GetMTime()) : newest;
  }
  return newest;
}

int vtkCloudPicture::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), port == 1);
  return 1;
}

int vtkCloudPicture::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  const int extent[6] = { 0, this->Size[0] - 1, 0, this->Size[1] - 1, 0, 0 };
  const double spacing[3] = { 1, 1, 1 };
  const double origin[3] = { 0, 0, 0 };
  vtkInformation* const out = outputs->GetInformationObject(0);
  out->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  out->Set(vtkDataObject::SPACING(), spacing, 3);
  out->Set(vtkDataObject::ORIGIN(), origin, 3);
  vtkDataObject::SetPointDataActiveScalarInfo(out, VTK_UNSIGNED_CHAR, 3);
  return 1;
}

int vtkCloudPicture::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    vtkInformation* const in = inputs[port]->GetInformationObject(0);
    if (in && in->Has(Pipeline::WHOLE_EXTENT()))
    {
      // The picture's extent says nothing about the clouds'.
      in->Set(Pipeline::UPDATE_EXTENT(), in->Get(Pipeline::WHOLE_EXTENT()), 6);
    }
  }
  return 1;
}

bool vtkCloudPicture::IsOfSeveralRanks() const
{
  return this->Controller && this->Controller->GetNumberOfProcesses() > 1;
}

/// @param own what the inputs are in this process @param kinds what they are in all
bool vtkCloudPicture::CanDraw(const std::array<int, 2>& own, const std::array<int, 2>& kinds)
{
  const std::array<vtkCloudBody*, 3> bodies = { this->Volume, this->Surface, this->Voxels };
  for (std::size_t port = 0; port < kinds.size(); ++port)
  {
    const int kind = kinds[port];
    if (kind == KindNone)
    {
      continue;
    }
    if (own[port] != kind && own[port] != KindNone)
    {
      vtkErrorMacro("Input " << port << " has " << Names[own[port]] << " in this process and "
                             << Names[kind] << " in another; give all the same kind.");
      return false;
    }
    if (port > 0 && kind == kinds[0])
    {
      vtkErrorMacro("Both inputs are "
        << Names[kind] << "; one of each is drawn."
        << (kind == KindSurface ? " Append them to one another." : ""));
      return false;
    }
    if (!bodies[kind])
    {
      vtkErrorMacro(
        "There is nothing to draw " << Names[kind] << " with; call " << Setters[kind] << '.');
      return false;
    }
  }
  return true;
}

/// What the inputs are, the same in all processes; KindNone where none has anything. False, in all, if one cannot draw them.
bool vtkCloudPicture::AgreeOnKinds(vtkInformationVector** inputs, std::array<int, 2>& kinds)
{
  const std::array<int, 2> own = { kindOf(vtkDataSet::GetData(inputs[0])),
    kindOf(vtkDataSet::GetData(inputs[1])) };
  kinds = own;
  if (!this->IsOfSeveralRanks())
  {
    return this->CanDraw(own, kinds);
  }
  this->Controller->AllReduce(own.data(), kinds.data(), 2, vtkCommunicator::MAX_OP);
  const int ready = this->CanDraw(own, kinds) ? 1 : 0;
  int allReady = 0;
  this->Controller->AllReduce(&ready, &allReady, 1, vtkCommunicator::MIN_OP);
  if (ready != 0 && allReady == 0)
  {
    vtkErrorMacro("Another process cannot draw its inputs; see its message.");
  }
  return allReady != 0;
}

bool vtkCloudPicture::AddInputs(
  vtkCloudscape* scape, vtkInformationVector** inputs, double bounds[6])
{
  std::array<int, 2> kinds;
  if (!this->AgreeOnKinds(inputs, kinds))
  {
    return false;
  }
  // In the order of Kind.
  const std::array<vtkCloudBody*, 3> bodies = { this->Volume, this->Surface, this->Voxels };
  vtkBoundingBox box;
  for (std::size_t port = 0; port < kinds.size(); ++port)
  {
    if (kinds[port] == KindNone)
    {
      continue;
    }
    // A process that has nothing of it takes part with an empty piece.
    vtkDataSet* const data = vtkDataSet::GetData(inputs[port]);
    vtkCloudBody* const body = bodies[kinds[port]];
    body->SetInputData(data);
    scape->AddBody(body);
    if (data)
    {
      data->GetBounds(bounds);
      if (kinds[port] == KindVoxels)
      {
        addReachOfVoxels(data, bounds);
      }
      box.AddBounds(bounds);
    }
  }
  box.GetBounds(bounds);
  this->GatherBounds(bounds);
  return true;
}

/// The bounds of all processes' pieces.
void vtkCloudPicture::GatherBounds(double bounds[6]) const
{
  if (this->IsOfSeveralRanks())
  {
    double least[3] = { bounds[0], bounds[2], bounds[4] };
    double greatest[3] = { bounds[1], bounds[3], bounds[5] };
    double allLeast[3];
    double allGreatest[3];
    this->Controller->AllReduce(least, allLeast, 3, vtkCommunicator::MIN_OP);
    this->Controller->AllReduce(greatest, allGreatest, 3, vtkCommunicator::MAX_OP);
    for (int axis = 0; axis < 3; ++axis)
    {
      bounds[2 * axis] = allLeast[axis];
      bounds[2 * axis + 1] = allGreatest[axis];
    }
  }
}

vtkCloudBody* vtkCloudPicture::ChooseGround(vtkInformationVector** inputs)
{
  if (this->Ground || !this->AutomaticGround)
  {
    return this->Ground;
  }
  double radius = std::max(planetRadius(inputs[0]), planetRadius(inputs[1]));
  if (this->IsOfSeveralRanks())
  {
    const double own = radius; // an empty piece does not know
    this->Controller->AllReduce(&own, &radius, 1, vtkCommunicator::MAX_OP);
  }
  this->Globe->SetRadius(radius);
  return radius > 0 ? this->Globe.Get() : nullptr;
}

void vtkCloudPicture::SetUpCamera(vtkCamera* camera, const double bounds[6]) const
{
  camera->SetPosition(this->Position);
  camera->SetFocalPoint(this->FocalPoint);
  camera->SetViewUp(this->ViewUp);
  camera->SetViewAngle(this->ViewAngle);
  camera->SetParallelProjection(this->ParallelProjection);
  camera->SetParallelScale(this->ParallelScale);
  const vtkBoundingBox box(bounds);
  if (!this->FitToInputs || !box.IsValid())
  {
    return;
  }
  double middle[3];
  double sight[3];
  box.GetCenter(middle);
  camera->GetDirectionOfProjection(sight);
  const double radius = Margin * std::max(box.GetMaxLength() / 2, 1e-12);
  const double across = std::min(1.0, static_cast<double>(this->Size[0]) / this->Size[1]);
  const double half =
    std::atan(across * std::tan(vtkMath::RadiansFromDegrees(this->ViewAngle) / 2));
  const double distance = radius / std::sin(half);
  camera->SetFocalPoint(middle);
  camera->SetPosition(middle[0] - distance * sight[0], middle[1] - distance * sight[1],
    middle[2] - distance * sight[2]);
  camera->SetParallelScale(radius / across);
}

void vtkCloudPicture::Forward(vtkObject* scape, unsigned long, void*)
{
  auto* const drawing = static_cast<vtkCloudscape*>(scape);
  this->UpdateProgress(drawing->GetProgress());
  drawing->SetAbortExecute(this->GetAbortExecute());
}

int vtkCloudPicture::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const vtkNew<vtkCloudscape> scape;
  double bounds[6];
  if (!this->AddInputs(scape, inputs, bounds))
  {
    return 0;
  }
  const vtkNew<vtkCamera> camera;
  this->SetUpCamera(camera, bounds);
  scape->SetCamera(camera);
  scape->SetSize(this->Size);
  scape->SetSamples(this->Samples);
  scape->SetBackdrop(this->Backdrop);
  scape->SetController(this->Controller);
  scape->AddBody(this->ChooseGround(inputs));
  scape->AddObserver(vtkCommand::ProgressEvent, this, &vtkCloudPicture::Forward);
  const bool drawn = scape->GetExecutive()->Update(0) != 0;
  vtkImageData* const picture = vtkImageData::GetData(outputs);
  picture->ShallowCopy(scape->GetOutput());
  addDisplayColor(picture);
  return drawn;
}

void vtkCloudPicture::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Volume: " << this->Volume.Get() << '\n';
  os << indent << "Surface: " << this->Surface.Get() << '\n';
  os << indent << "Voxels: " << this->Voxels.Get() << '\n';
  os << indent << "Ground: " << this->Ground.Get() << '\n';
  os << indent << "Backdrop: " << this->Backdrop.Get() << '\n';
  os << indent << "Size: " << this->Size[0] << " x " << this->Size[1] << '\n';
  os << indent << "Samples: " << this->Samples << '\n';
  os << indent << "AutomaticGround: " << this->AutomaticGround << '\n';
  os << indent << "FitToInputs: " << this->FitToInputs << '\n';
  os << indent << "Position: " << this->Position[0] << ' ' << this->Position[1] << ' '
     << this->Position[2] << '\n';
  os << indent << "FocalPoint: " << this->FocalPoint[0] << ' ' << this->FocalPoint[1] << ' '
     << this->FocalPoint[2] << '\n';
  os << indent << "ViewUp: " << this->ViewUp[0] << ' ' << this->ViewUp[1] << ' ' << this->ViewUp[2]
     << '\n';
  os << indent << "ViewAngle: " << this->ViewAngle << '\n';
  os << indent << "ParallelProjection: " << this->ParallelProjection << '\n';
  os << indent << "ParallelScale: " << this->ParallelScale << '\n';
}
