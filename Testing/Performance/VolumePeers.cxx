// SPDX-License-Identifier: BSD-3-Clause
// Volume mappers on the shell, VTK's and ours. Each draws white cloud before black in an off-screen window; what it lets through is
// 1 - the red that is read back, 8 bits a channel, as a user of VTK sees it: half a step is an error of 2e-3 whatever is drawn. For
// orders of cells the cloud is dark where it is dense, and red is its light. A run is a frame after the camera was touched.
// vtkUnstructuredGridVolumeRayCastMapper's rays miss the pixels' middles by half a pixel, which is part of its error here.
#include "ShellCase.h"
#include "VolumeTruth.h"

#include "vtkCamera.h"
#include "vtkCloudVolumeMapper.h"
#include "vtkColorTransferFunction.h"
#include "vtkFixedPointVolumeRayCastMapper.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkProjectedTetrahedraMapper.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkUnstructuredGridVolumeRayCastMapper.h"
#include "vtkUnstructuredGridVolumeZSweepMapper.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <cmath>

namespace nephoscope
{
namespace performance
{
namespace
{
/// What a mapper takes opacity 1 for: attenuation 1 a unit distance, or nothing let through over one.
enum class OpacityIs
{
  Attenuation,
  Blocked
};

/// The cloud's source: 1, or shell::sourceOf.
enum class Light
{
  White,
  Ordered
};

/// A window with one volume in it.
class WindowJob : public Job
{
public:
  WindowJob(const Situation& situation, vtkAbstractVolumeMapper* mapper, OpacityIs meaning,
    Light light = Light::White)
    : At(situation)
    , Of(light)
  {
    vtkNew<vtkPiecewiseFunction> opacity;
    for (int n = 0; n <= 256; ++n)
    {
      const double c = n / 256.0;
      opacity->AddPoint(c, meaning == OpacityIs::Attenuation ? c : -std::expm1(-c));
    }
    vtkNew<vtkColorTransferFunction> color;
    for (const double c : { 0.0, 1.0 })
    {
      const double grey = light == Light::White ? 1 : shell::sourceOf(c);
      color->AddRGBPoint(c, grey, grey, grey);
    }
    vtkNew<vtkVolumeProperty> property;
    property->SetScalarOpacity(opacity);
    property->SetColor(color);
    property->SetScalarOpacityUnitDistance(1 / shell::Extinction);
    property->SetInterpolationTypeToLinear();
    property->ShadeOff();
    vtkNew<vtkVolume> volume;
    volume->SetMapper(mapper);
    volume->SetProperty(property);
    this->Renderer->AddVolume(volume);
    this->Renderer->SetBackground(0, 0, 0);
    this->Renderer->SetActiveCamera(shell::vtkView());
    this->Window->SetOffScreenRendering(1);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(situation.pixels[0], situation.pixels[1]);
    this->Window->SetDesiredUpdateRate(0.001); // whoever adapts its sampling must not
    this->Window->AddRenderer(this->Renderer);
  }

  /// For a mapper whose first frame shows nothing: its first run draws two.
  void drawFirstTwice() { this->Frames = 2; }

  void run() override
  {
    for (; this->Frames > 0; --this->Frames)
    {
      this->Renderer->GetActiveCamera()->Modified();
      this->Window->Render();
    }
    this->Frames = 1;
    this->Window->WaitForCompletion();
    // Reading a pixel waits for drawing that was put off.
    vtkNew<vtkUnsignedCharArray> pixel;
    this->Window->GetPixelData(0, 0, 0, 0, 0, pixel);
  }

  Figures figures() override
  {
    const int width = this->At.pixels[0];
    vtkNew<vtkUnsignedCharArray> rgb;
    this->Window->GetPixelData(0, 0, width - 1, this->At.pixels[1] - 1, 0, rgb);
    const bool white = this->Of == Light::White;
    return volumeFigures(this->At, white ? &TruePixel::transmittance : &TruePixel::radiance,
      [&](int x, int y)
      {
        const double red = rgb->GetValue(3 * (static_cast<vtkIdType>(y) * width + x)) / 255.0;
        return white ? 1 - red : red;
      });
  }

private:
  Situation At;
  Light Of;
  int Frames = 1; ///< to draw in the next run
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
};

template <class Mapper>
std::unique_ptr<WindowJob> onTetrahedra(
  const Situation& situation, Light light, const std::function<void(Mapper*)>& setUp)
{
  vtkNew<Mapper> mapper;
  mapper->SetInputDataObject(shell::tetrahedra(situation));
  setUp(mapper);
  return std::make_unique<WindowJob>(situation, mapper, OpacityIs::Attenuation, light);
}

std::unique_ptr<Job> onCells(const Situation& situation, Light light)
{
  vtkNew<vtkCloudVolumeMapper> mapper;
  mapper->SetInputData(shell::structuredGrid(situation).Get());
  return std::make_unique<WindowJob>(situation, mapper, OpacityIs::Attenuation, light);
}

template <class Mapper>
void sampleEveryPixel(Mapper* mapper)
{
  mapper->SetAutoAdjustSampleDistances(0);
  mapper->SetImageSampleDistance(1);
}

std::unique_ptr<Job> onImage(const Situation& situation, int samples)
{
  vtkNew<vtkFixedPointVolumeRayCastMapper> mapper;
  const auto image = shell::resampledImage(situation, samples);
  mapper->SetInputData(image);
  sampleEveryPixel(mapper.Get());
  mapper->SetSampleDistance(static_cast<float>(image->GetSpacing()[0] / 2));
  mapper->SetInteractiveSampleDistance(static_cast<float>(image->GetSpacing()[0] / 2));
  mapper->SetNumberOfThreads(situation.threads);
  return std::make_unique<WindowJob>(situation, mapper, OpacityIs::Blocked);
}

Method cloudMapper(const char* group, Light light)
{
  return { "vtkCloudVolumeMapper", group, { { "order", "per pixel" }, { "window", "8 bits" } },
    true, true, 0, [light](const Situation& s) { return onCells(s, light); } };
}

Method rayCast(const char* group, Light light)
{
  return { "vtkUnstructuredGridVolumeRayCastMapper", group, {}, false, true, 1000000,
    [light](const Situation& s)
    {
      return onTetrahedra<vtkUnstructuredGridVolumeRayCastMapper>(s, light,
        [&s](vtkUnstructuredGridVolumeRayCastMapper* mapper)
        {
          sampleEveryPixel(mapper);
          mapper->SetNumberOfThreads(s.threads);
        });
    } };
}

/// VTK 9.1 shows nothing in the first frame of a vtkProjectedTetrahedraMapper, whatever the window and with or without its
/// floating point frame buffer; from the second on it shows the volume.
Method projectedTetrahedra(const char* group, Light light)
{
  return { "vtkProjectedTetrahedraMapper", group, { { "order", "centroid" } }, false, true, 1000000,
    [light](const Situation& s)
    {
      auto job =
        onTetrahedra<vtkProjectedTetrahedraMapper>(s, light, [](vtkProjectedTetrahedraMapper*) {});
      job->drawFirstTwice();
      return job;
    } };
}

const Registration inBothGroups[] = {
  Registration(cloudMapper("volume", Light::White)),
  Registration(cloudMapper("order", Light::Ordered)),
  Registration(rayCast("volume", Light::White)),
  Registration(rayCast("order", Light::Ordered)),
  Registration(projectedTetrahedra("volume", Light::White)),
  Registration(projectedTetrahedra("order", Light::Ordered)),
};

const Registration zSweep(
  { "vtkUnstructuredGridVolumeZSweepMapper", "volume", {}, false, true, 20000,
    [](const Situation& s)
    {
      return onTetrahedra<vtkUnstructuredGridVolumeZSweepMapper>(
        s, Light::White, sampleEveryPixel<vtkUnstructuredGridVolumeZSweepMapper>);
    } });

const Registration fixedPoint128({ "vtkFixedPointVolumeRayCastMapper", "volume",
  { { "image", "128^3" } }, false, true, 0, [](const Situation& s) { return onImage(s, 128); } });

const Registration fixedPoint256({ "vtkFixedPointVolumeRayCastMapper", "volume",
  { { "image", "256^3" } }, false, true, 0, [](const Situation& s) { return onImage(s, 256); } });
}
}
}
