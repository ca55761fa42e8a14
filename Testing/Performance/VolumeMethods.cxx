// SPDX-License-Identifier: BSD-3-Clause
// Our volume methods on the shell, without a window. What is let through is the picture's transmittance, float.
#include "ShellCase.h"
#include "VolumeTruth.h"

#include "CloudArrays.h"
#include "vtkCamera.h"
#include "vtkCloudCellVolume.h"
#include "vtkCloudscape.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkStructuredGrid.h"

namespace nephoscope
{
namespace performance
{
namespace
{
/// A cloudscape with one cell volume in it. A run is a frame after the camera was touched.
class CellVolumeJob : public Job
{
public:
  CellVolumeJob(const Situation& situation, bool depth)
    : At(situation)
  {
    this->Scape->SetComputeDepth(depth);
    vtkNew<vtkCloudCellVolume> volume;
    volume->SetInputData(shell::structuredGrid(situation));
    volume->SetFullCoverExtinction(shell::Extinction);
    this->Scape->AddBody(volume);
    this->Scape->SetCamera(shell::vtkView());
    this->Scape->SetSize(situation.pixels[0], situation.pixels[1]);
  }

  void run() override
  {
    this->Scape->GetCamera()->Modified();
    this->Scape->Update();
  }

  Figures figures() override
  {
    const int width = this->At.pixels[0];
    vtkDataArray* const through =
      this->Scape->GetOutput()->GetPointData()->GetArray(arrays::Transmittance);
    Figures figures = volumeFigures(this->At,
      [&](int x, int y)
      { return through->GetComponent(static_cast<vtkIdType>(y) * width + x, 0); });
    figures["segments"] = static_cast<double>(this->Scape->GetNumberOfSegments());
    return figures;
  }

private:
  Situation At;
  vtkNew<vtkCloudscape> Scape;
};

const Registration cellVolume({ "vtkCloudCellVolume", "volume", { { "order", "any: summed" } },
  true, false, 0, [](const Situation& s) { return std::make_unique<CellVolumeJob>(s, false); } });

const Registration cellVolumeAndDepth(
  { "vtkCloudCellVolume", "volume", { { "order", "per pixel" }, { "depth", "too" } }, true, false,
    0, [](const Situation& s) { return std::make_unique<CellVolumeJob>(s, true); } });
}
}
}
