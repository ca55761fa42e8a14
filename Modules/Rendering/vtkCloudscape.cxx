// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudscape.h"

#include "Camera.h"
#include "CloudArrays.h"
#include "DeepTile.h"
#include "vtkCamera.h"
#include "vtkCloudBackdrop.h"
#include "vtkCloudBody.h"
#include "vtkExecutive.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSMPThreadLocal.h"
#include "vtkSMPTools.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <thread>

vtkStandardNewMacro(vtkCloudscape);

namespace
{
constexpr int MaximumSize = 32768;

nephoscope::Vector3 vector(const double v[3])
{
  return { v[0], v[1], v[2] };
}

nephoscope::Camera cameraOf(vtkCamera* camera, double cylinderAngle, const int size[2])
{
  const nephoscope::Vector3 eye = vector(camera->GetPosition());
  const nephoscope::Vector3 target = vector(camera->GetFocalPoint());
  const nephoscope::Vector3 up = vector(camera->GetViewUp());
  if (cylinderAngle > 0)
  {
    return nephoscope::Camera::cylindrical(eye, target, up, cylinderAngle, size[0], size[1]);
  }
  return camera->GetParallelProjection()
    ? nephoscope::Camera::parallel(eye, target, up, camera->GetParallelScale(), size[0], size[1])
    : nephoscope::Camera::perspective(eye, target, up, camera->GetViewAngle(), size[0], size[1]);
}

/// The picture's arrays, as plain rows of pixels.
struct Picture
{
  int Width;
  int Height;
  float* Radiance;
  float* Transmittance;
  float* Depth;

  static float* NewArray(vtkImageData* image, const char* name, int components)
  {
    vtkNew<vtkFloatArray> array;
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(image->GetNumberOfPoints());
    image->GetPointData()->AddArray(array);
    return array->GetPointer(0);
  }
};

/// Draws tile after tile; each thread has a deep tile of its own.
class TileDrawer
{
public:
  TileDrawer(vtkCloudscape* scape, const nephoscope::Camera& camera,
    const std::vector<vtkCloudBody*>& bodies, const Picture& picture)
    : Scape(scape)
    , Camera(camera)
    , Bodies(bodies)
    , Backdrop(scape->GetBackdrop())
    , Image(picture)
    , Edge(scape->GetTileSize())
    , Samples(scape->GetSamples())
    , TilesAcross((picture.Width + this->Edge - 1) / this->Edge)
    , Caller(std::this_thread::get_id())
  {
  }

  vtkIdType GetNumberOfTiles() const
  {
    return static_cast<vtkIdType>(this->TilesAcross) *
      ((this->Image.Height + this->Edge - 1) / this->Edge);
  }
  vtkIdType GetNumberOfSegments() const { return this->Segments; }

  void operator()(vtkIdType begin, vtkIdType end)
  {
    for (vtkIdType tile = begin; tile < end; ++tile)
    {
      if (this->Scape->GetAbortExecute())
      {
        return;
      }
      this->Draw(tile);
      const vtkIdType done = ++this->Done;
      if (std::this_thread::get_id() == this->Caller)
      {
        this->Scape->UpdateProgress(static_cast<double>(done) / this->GetNumberOfTiles());
      }
    }
  }

private:
  void Draw(vtkIdType number)
  {
    Local& local = this->Locals.Local();
    const int x0 = static_cast<int>(number % this->TilesAcross) * this->Edge;
    const int y0 = static_cast<int>(number / this->TilesAcross) * this->Edge;
    const nephoscope::TileExtent pixels{ x0, y0, std::min(this->Edge, this->Image.Width - x0),
      std::min(this->Edge, this->Image.Height - y0) };
    const int n = this->Samples;
    local.Tile.reset({ n * pixels.x0, n * pixels.y0, n * pixels.width, n * pixels.height });
    local.Tile.setDepthWanted(this->Scape->GetComputeDepth());
    for (std::size_t body = 0; body < this->Bodies.size(); ++body)
    {
      if (body + 1 == this->Bodies.size())
      {
        local.Tile.setLast();
      }
      this->Bodies[body]->Emit(this->Camera, local.Tile);
    }
    this->Segments += static_cast<vtkIdType>(local.Tile.numberOfSegments());
    local.Tile.composite(local.Light);
    local.Depths.resize(static_cast<std::size_t>(n) * n);
    for (int y = 0; y < pixels.height; ++y)
    {
      for (int x = 0; x < pixels.width; ++x)
      {
        this->WritePixel(pixels, x, y, local);
      }
    }
  }

  struct Local;
  /// The mean of the pixel's samples, the backdrop behind them; the median of their depths.
  void WritePixel(const nephoscope::TileExtent& pixels, int x, int y, Local& local)
  {
    const int n = this->Samples;
    double radiance[3] = { 0, 0, 0 };
    double transmittance[3] = { 0, 0, 0 };
    std::size_t sample = 0;
    for (int j = n * y; j < n * (y + 1); ++j)
    {
      for (int i = n * x; i < n * (x + 1); ++i, ++sample)
      {
        const nephoscope::PixelLight& light =
          local.Light[static_cast<std::size_t>(j) * n * pixels.width + i];
        float behind[3] = { 0, 0, 0 };
        if (this->Backdrop)
        {
          const nephoscope::Ray ray =
            this->Camera.ray(n * pixels.x0 + i + 0.5, n * pixels.y0 + j + 0.5);
          this->Backdrop->GetRadiance(ray.direction.v, behind);
        }
        for (int c = 0; c < 3; ++c)
        {
          radiance[c] += light.radiance[c] + light.transmittance[c] * behind[c];
          transmittance[c] += light.transmittance[c];
        }
        local.Depths[sample] = light.depth;
      }
    }
    const std::size_t at =
      static_cast<std::size_t>(pixels.y0 + y) * this->Image.Width + pixels.x0 + x;
    for (int c = 0; c < 3; ++c)
    {
      this->Image.Radiance[3 * at + c] = static_cast<float>(radiance[c] / (n * n));
      this->Image.Transmittance[3 * at + c] = static_cast<float>(transmittance[c] / (n * n));
    }
    const auto middle = local.Depths.begin() + (n * n - 1) / 2;
    std::nth_element(local.Depths.begin(), middle, local.Depths.end());
    this->Image.Depth[at] = static_cast<float>(*middle);
  }

  struct Local
  {
    nephoscope::DeepTile Tile;
    std::vector<nephoscope::PixelLight> Light;
    std::vector<double> Depths;
  };

  vtkCloudscape* Scape;
  const nephoscope::Camera& Camera;
  const std::vector<vtkCloudBody*>& Bodies;
  const vtkCloudBackdrop* Backdrop;
  Picture Image;
  int Edge;
  int Samples;
  int TilesAcross;
  std::thread::id Caller;
  std::atomic<vtkIdType> Done{ 0 };
  std::atomic<vtkIdType> Segments{ 0 };
  vtkSMPThreadLocal<Local> Locals;
};
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

void vtkCloudscape::UpdateBodies()
{
  for (const auto& body : this->Bodies)
  {
    for (int port = 0; port < body->GetNumberOfInputPorts(); ++port)
    {
      for (int connection = 0; connection < body->GetNumberOfInputConnections(port); ++connection)
      {
        body->GetInputAlgorithm(port, connection)->Update();
      }
    }
  }
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
  if (!this->Validate())
  {
    return 0;
  }
  const double started = vtkTimerLog::GetUniversalTime();
  this->UpdateBodies();
  const double updated = vtkTimerLog::GetUniversalTime();

  const int rays[2] = { this->Samples * this->Size[0], this->Samples * this->Size[1] };
  const nephoscope::Camera camera = cameraOf(this->Camera, this->CylinderAngle, rays);
  std::vector<vtkCloudBody*> bodies(this->Bodies.begin(), this->Bodies.end());
  std::stable_partition(
    bodies.begin(), bodies.end(), [](const vtkCloudBody* body) { return body->IsOpaque(); });
  for (vtkCloudBody* body : bodies)
  {
    if (!body->Prepare(camera))
    {
      vtkErrorMacro("A " << body->GetClassName() << " cannot be drawn; see its own message.");
      return 0;
    }
  }
  const double prepared = vtkTimerLog::GetUniversalTime();

  vtkImageData* const image = vtkImageData::GetData(outputs);
  image->SetDimensions(this->Size[0], this->Size[1], 1);
  image->SetSpacing(1, 1, 1);
  image->SetOrigin(0, 0, 0);
  const Picture picture{ this->Size[0], this->Size[1],
    Picture::NewArray(image, nephoscope::arrays::Radiance, 3),
    Picture::NewArray(image, nephoscope::arrays::Transmittance, 3),
    Picture::NewArray(image, nephoscope::arrays::Depth, 1) };
  image->GetPointData()->SetActiveScalars(nephoscope::arrays::Radiance);

  TileDrawer drawer(this, camera, bodies, picture);
  vtkSMPTools::For(0, drawer.GetNumberOfTiles(), 1, drawer);
  this->NumberOfSegments = drawer.GetNumberOfSegments();
  this->PipelineSeconds = updated - started;
  this->PrepareSeconds = prepared - updated;
  this->TileSeconds = vtkTimerLog::GetUniversalTime() - prepared;
  if (this->GetAbortExecute())
  {
    image->Initialize();
    return 0;
  }
  return 1;
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
  os << indent << "Backdrop: " << this->Backdrop.Get() << '\n';
  os << indent << "Bodies: " << this->Bodies.size() << '\n';
  os << indent << "NumberOfSegments: " << this->NumberOfSegments << '\n';
}
