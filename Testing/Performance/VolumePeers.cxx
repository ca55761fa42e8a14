// SPDX-License-Identifier: BSD-3-Clause
// VTK's volume mappers on the shell. Each draws white cloud before black in an off-screen window; what it lets through is
// 1 - the red that is read back, 8 bits a channel, as a user of VTK sees it. A run is a frame after the camera was touched.
// vtkUnstructuredGridVolumeRayCastMapper's rays miss the pixels' middles by half a pixel, which is part of its error here.
#include "ShellCase.h"
#include "VolumeTruth.h"

#include "vtkCamera.h"
#include "vtkColorTransferFunction.h"
#include "vtkFixedPointVolumeRayCastMapper.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkProjectedTetrahedraMapper.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
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

/// A window with one volume in it.
class WindowJob : public Job
{
public:
  WindowJob(const Situation& situation, vtkAbstractVolumeMapper* mapper, OpacityIs meaning)
    : At(situation)
  {
    vtkNew<vtkPiecewiseFunction> opacity;
    for (int n = 0; n <= 256; ++n)
    {
      const double c = n / 256.0;
      opacity->AddPoint(c, meaning == OpacityIs::Attenuation ? c : -std::expm1(-c));
    }
    vtkNew<vtkColorTransferFunction> color;
    color->AddRGBPoint(0, 1, 1, 1);
    color->AddRGBPoint(1, 1, 1, 1);
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

  void run() override
  {
    this->Renderer->GetActiveCamera()->Modified();
    this->Window->Render();
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
    return volumeFigures(this->At,
      [&](int x, int y)
      { return 1 - rgb->GetValue(3 * (static_cast<vtkIdType>(y) * width + x)) / 255.0; });
  }

private:
  Situation At;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
};

template <class Mapper>
std::unique_ptr<Job> onTetrahedra(
  const Situation& situation, const std::function<void(Mapper*)>& setUp)
{
  vtkNew<Mapper> mapper;
  mapper->SetInputDataObject(shell::tetrahedra(situation));
  setUp(mapper);
  return std::make_unique<WindowJob>(situation, mapper, OpacityIs::Attenuation);
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

const Registration rayCast(
  { "vtkUnstructuredGridVolumeRayCastMapper", "volume", {}, false, true, 1000000,
    [](const Situation& s)
    {
      return onTetrahedra<vtkUnstructuredGridVolumeRayCastMapper>(s,
        [&s](vtkUnstructuredGridVolumeRayCastMapper* mapper)
        {
          sampleEveryPixel(mapper);
          mapper->SetNumberOfThreads(s.threads);
        });
    } });

const Registration projectedTetrahedra(
  { "vtkProjectedTetrahedraMapper", "volume", {}, false, true, 1000000, [](const Situation& s) {
     return onTetrahedra<vtkProjectedTetrahedraMapper>(s, [](vtkProjectedTetrahedraMapper*) {});
   } });

const Registration zSweep(
  { "vtkUnstructuredGridVolumeZSweepMapper", "volume", {}, false, true, 20000,
    [](const Situation& s)
    {
      return onTetrahedra<vtkUnstructuredGridVolumeZSweepMapper>(
        s, sampleEveryPixel<vtkUnstructuredGridVolumeZSweepMapper>);
    } });

const Registration fixedPoint128({ "vtkFixedPointVolumeRayCastMapper", "volume",
  { { "image", "128^3" } }, false, true, 0, [](const Situation& s) { return onImage(s, 128); } });

const Registration fixedPoint256({ "vtkFixedPointVolumeRayCastMapper", "volume",
  { { "image", "256^3" } }, false, true, 0, [](const Situation& s) { return onImage(s, 256); } });
}
}
}
