// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudVolumeMapper.h"

#include "Camera.h"
#include "DeepTile.h"
#include "VolumeCells.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkRayCastImageDisplayHelper.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSMPThreadLocal.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"
#include "vtkTimerLog.h"
#include "vtkUnstructuredGridBase.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

vtkStandardNewMacro(vtkCloudVolumeMapper);

namespace
{
constexpr int TileEdge = 32;
/// Each pixel is a square of so many texels: the display helper stretches the texture by one texel, and linear
/// interpolation between equal texels does not blur.
constexpr int Texels = 2;

nephoscope::Vector3 vector(const double v[3])
{
  return { v[0], v[1], v[2] };
}

/// A renderer's part of the window, pixels.
struct Viewport
{
  int Width = 0;
  int Height = 0;
  int Left = 0;
  int Bottom = 0;
  explicit Viewport(vtkRenderer* renderer)
  {
    renderer->GetTiledSizeAndOrigin(&this->Width, &this->Height, &this->Left, &this->Bottom);
  }
};

nephoscope::Camera cameraOf(vtkRenderer* renderer, const Viewport& viewport)
{
  vtkCamera* const camera = renderer->GetActiveCamera();
  const nephoscope::Vector3 eye = vector(camera->GetPosition());
  const nephoscope::Vector3 target = vector(camera->GetFocalPoint());
  const nephoscope::Vector3 up = vector(camera->GetViewUp());
  if (camera->GetParallelProjection())
  {
    return nephoscope::Camera::parallel(
      eye, target, up, camera->GetParallelScale(), viewport.Width, viewport.Height);
  }
  double angle = camera->GetViewAngle();
  if (camera->GetUseHorizontalViewAngle())
  {
    const double half = std::tan(vtkMath::RadiansFromDegrees(angle) / 2);
    angle =
      2 * vtkMath::DegreesFromRadians(std::atan(half * viewport.Height / double(viewport.Width)));
  }
  return nephoscope::Camera::perspective(eye, target, up, angle, viewport.Width, viewport.Height);
}

/// Whether the window's projection is the camera's: three points off the centre come to the same pixels.
bool projectsLike(const nephoscope::Camera& camera, vtkRenderer* renderer)
{
  vtkMatrix4x4* const matrix = renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(
    renderer->GetTiledAspectRatio(), -1, 1);
  constexpr double Probes[3][2] = { { 0.1, 0.2 }, { 0.9, 0.3 }, { 0.4, 0.8 } };
  for (const auto& at : Probes)
  {
    const double pixel[2] = { at[0] * camera.width(), at[1] * camera.height() };
    const nephoscope::Ray ray = camera.ray(pixel[0], pixel[1]);
    const double far = renderer->GetActiveCamera()->GetDistance();
    const nephoscope::Vector3 p = ray.origin + far * ray.direction;
    const double from[4] = { p[0], p[1], p[2], 1 };
    double to[4];
    matrix->MultiplyPoint(from, to);
    const double x = 0.5 * (to[0] / to[3] + 1) * camera.width();
    const double y = 0.5 * (to[1] / to[3] + 1) * camera.height();
    if (!(std::abs(x - pixel[0]) < 0.01 && std::abs(y - pixel[1]) < 0.01))
    {
      return false;
    }
  }
  return true;
}

/// Distances along the rays to what the window shows, and infinity where it shows nothing.
class OpaqueDistances
{
public:
  OpaqueDistances(vtkRenderer* renderer, const Viewport& viewport, const nephoscope::Camera& camera)
    : View(camera)
  {
    if (renderer->GetNumberOfPropsRendered() > 0)
    {
      renderer->GetRenderWindow()->GetZbufferData(viewport.Left, viewport.Bottom,
        viewport.Left + viewport.Width - 1, viewport.Bottom + viewport.Height - 1, this->Depths);
      this->Projection = renderer->GetActiveCamera()->GetProjectionTransformMatrix(
        renderer->GetTiledAspectRatio(), -1, 1);
    }
  }

  void Hide(nephoscope::DeepTile& tile) const
  {
    if (this->Depths->GetNumberOfValues() <
      static_cast<vtkIdType>(this->View.width()) * this->View.height())
    {
      return;
    }
    const nephoscope::TileExtent& e = tile.extent();
    for (int y = e.y0; y < e.y0 + e.height; ++y)
    {
      for (int x = e.x0; x < e.x0 + e.width; ++x)
      {
        const float z = this->Depths->GetValue(static_cast<vtkIdType>(y) * this->View.width() + x);
        if (z < 1)
        {
          const nephoscope::Ray ray = this->View.ray(x + 0.5, y + 0.5);
          tile.hideBeyond(
            x, y, this->DepthAt(z) / nephoscope::dot(ray.direction, this->View.forward()));
        }
      }
    }
  }

private:
  /// Along the viewing axis: the window's depth z solved for what the projection makes it of.
  double DepthAt(double z) const
  {
    const double ndc = 2 * z - 1;
    const auto& p = this->Projection->Element;
    return (p[2][3] - ndc * p[3][3]) / (p[2][2] - ndc * p[3][2]);
  }

  const nephoscope::Camera& View;
  vtkNew<vtkFloatArray> Depths;
  vtkSmartPointer<vtkMatrix4x4> Projection;
};
}

struct vtkCloudVolumeMapper::Internals
{
  VolumeCells Cells;
  // What the cells were read from.
  vtkDataSet* ReadData = nullptr;
  vtkVolumeProperty* ReadProperty = nullptr;
  std::array<double, 16> ReadMatrix{};
  vtkMTimeType ReadTime = 0;

  std::vector<std::uint16_t> Image; ///< RGBA, premultiplied
  vtkSmartPointer<vtkRayCastImageDisplayHelper> Display;

  /// A pixel of an image so many pixels wide.
  void Write(const nephoscope::PixelLight& light, int width, int x, int y)
  {
    const double alpha =
      1 - (light.transmittance[0] + light.transmittance[1] + light.transmittance[2]) / 3.0;
    const double rgba[4] = { light.radiance[0], light.radiance[1], light.radiance[2], alpha };
    for (int row = Texels * y; row < Texels * (y + 1); ++row)
    {
      std::uint16_t* texel =
        this->Image.data() + 4 * Texels * (static_cast<std::size_t>(row) * width + x);
      for (int t = 0; t < 4 * Texels; ++t)
      {
        texel[t] =
          static_cast<std::uint16_t>(std::lround(std::clamp(rgba[t % 4], 0.0, 1.0) * 65535));
      }
    }
  }
};

vtkCloudVolumeMapper::vtkCloudVolumeMapper()
  : Data(std::make_unique<Internals>())
{
}

vtkCloudVolumeMapper::~vtkCloudVolumeMapper() = default;

int vtkCloudVolumeMapper::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  return 1;
}

void vtkCloudVolumeMapper::SetInputData(vtkUnstructuredGridBase* cells)
{
  this->SetInputDataInternal(0, cells);
}

void vtkCloudVolumeMapper::SetInputData(vtkDataSet* cells)
{
  this->SetInputDataInternal(0, cells);
}

bool vtkCloudVolumeMapper::ReadCells(vtkVolume* volume)
{
  Internals& data = *this->Data;
  vtkDataSet* const cells = this->GetDataSetInput();
  vtkVolumeProperty* const property = volume->GetProperty();
  int ofCells = 0;
  vtkDataArray* const scalars = vtkAbstractMapper::GetScalars(
    cells, this->ScalarMode, this->ArrayAccessMode, this->ArrayId, this->ArrayName, ofCells);
  if (!scalars || ofCells || scalars->GetNumberOfComponents() != 1 ||
    scalars->GetNumberOfTuples() != cells->GetNumberOfPoints())
  {
    vtkErrorMacro("There is no array of one value for each point to draw; set active point scalars "
                  "or name an array with SelectScalarArray.");
    return false;
  }
  std::array<double, 16> matrix;
  volume->GetMatrix(matrix.data());
  const vtkMTimeType newest =
    std::max({ cells->GetMTime(), scalars->GetMTime(), property->GetMTime(), this->GetMTime() });
  if (data.ReadData == cells && data.ReadProperty == property && data.ReadMatrix == matrix &&
    data.ReadTime >= newest)
  {
    return true;
  }
  data.ReadData = nullptr;
  const std::string wrong = data.Cells.Read(cells, scalars, property, volume->GetMatrix());
  if (!wrong.empty())
  {
    vtkErrorMacro(<< wrong);
    return false;
  }
  data.ReadData = cells;
  data.ReadProperty = property;
  data.ReadMatrix = matrix;
  data.ReadTime = newest;
  return true;
}

void vtkCloudVolumeMapper::DrawTiles(vtkRenderer* renderer)
{
  const Viewport viewport(renderer);
  const nephoscope::Camera camera = cameraOf(renderer, viewport);
  const OpaqueDistances opaque(renderer, viewport, camera);
  Internals& data = *this->Data;
  data.Cells.Look(camera);
  data.Image.resize(
    4 * static_cast<std::size_t>(Texels * viewport.Width) * Texels * viewport.Height);
  struct Local
  {
    nephoscope::DeepTile Tile;
    std::vector<nephoscope::PixelLight> Light;
  };
  vtkSMPThreadLocal<Local> locals;
  const int across = (viewport.Width + TileEdge - 1) / TileEdge;
  const int up = (viewport.Height + TileEdge - 1) / TileEdge;
  vtkSMPTools::For(0, static_cast<vtkIdType>(across) * up, 1,
    [&data, &locals, &opaque, &camera, &viewport, across](vtkIdType begin, vtkIdType end)
    {
      Local& local = locals.Local();
      for (vtkIdType number = begin; number < end; ++number)
      {
        const int x0 = static_cast<int>(number % across) * TileEdge;
        const int y0 = static_cast<int>(number / across) * TileEdge;
        const int width = std::min(TileEdge, viewport.Width - x0);
        const int height = std::min(TileEdge, viewport.Height - y0);
        local.Tile.reset({ x0, y0, width, height });
        local.Tile.setDepthWanted(false);
        local.Tile.setLast();
        opaque.Hide(local.Tile);
        data.Cells.Emit(camera, local.Tile);
        local.Tile.composite(local.Light);
        for (int p = 0; p < width * height; ++p)
        {
          data.Write(local.Light[p], viewport.Width, x0 + p % width, y0 + p / width);
        }
      }
    });
}

bool vtkCloudVolumeMapper::CanProject(vtkRenderer* renderer)
{
  const Viewport viewport(renderer);
  if (this->BlendMode != COMPOSITE_BLEND)
  {
    vtkErrorMacro("The blend mode is maximum intensity; call SetBlendModeToComposite.");
    return false;
  }
  if (!projectsLike(cameraOf(renderer, viewport), renderer))
  {
    vtkErrorMacro(
      "The camera's projection is off-centre, oblique, transformed or given as a matrix; "
      "use position, focal point, view-up and view angle or parallel scale alone.");
    return false;
  }
  return true;
}

void vtkCloudVolumeMapper::Render(vtkRenderer* renderer, vtkVolume* volume)
{
  const Viewport viewport(renderer);
  if (viewport.Width < 1 || viewport.Height < 1 || !this->GetDataSetInput() ||
    !this->CanProject(renderer) || !this->ReadCells(volume))
  {
    return;
  }
  Internals& data = *this->Data;
  if (!data.Display)
  {
    data.Display.TakeReference(vtkRayCastImageDisplayHelper::New());
  }
  if (!data.Display)
  {
    vtkErrorMacro("Nothing can draw a picture in this window; link VTK::RenderingVolumeOpenGL2 and "
                  "initialise it (vtk_module_autoinit, or import vtkRenderingVolumeOpenGL2).");
    return;
  }
  const double started = vtkTimerLog::GetUniversalTime();
  this->DrawTiles(renderer);
  data.Display->PreMultipliedColorsOn();
  data.Display->SetPixelScale(1);
  int size[2] = { Texels * viewport.Width, Texels * viewport.Height };
  int origin[2] = { 0, 0 };
  constexpr float BeforeEverything = 1e-6F;
  data.Display->RenderTexture(
    volume, renderer, size, size, size, origin, BeforeEverything, data.Image.data());
  this->TimeToDraw = std::max(vtkTimerLog::GetUniversalTime() - started, 1e-4);
}

void vtkCloudVolumeMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  if (this->Data->Display)
  {
    this->Data->Display->ReleaseGraphicsResources(window);
  }
}

void vtkCloudVolumeMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
