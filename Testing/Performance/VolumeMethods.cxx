// SPDX-License-Identifier: BSD-3-Clause
// Our volume methods on the shell, without a window. What is compared is the picture's transmittance, float; for orders of cells its
// radiance, of cloud that is dark where it is dense.
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
  CellVolumeJob(const Situation& situation, vtkStructuredGrid* grid)
    : At(situation)
  {
    this->Volume->SetInputData(grid);
    this->Volume->SetFullCoverExtinction(shell::Extinction);
    this->Scape->AddBody(this->Volume);
    this->Scape->SetCamera(shell::vtkView());
    this->Scape->SetSize(situation.pixels[0], situation.pixels[1]);
  }

  void run() override
  {
    this->Scape->GetCamera()->Modified();
    this->Scape->Update();
  }

protected:
  Figures compare(const char* array, double TruePixel::*quantity)
  {
    const int width = this->At.pixels[0];
    vtkDataArray* const drawn = this->Scape->GetOutput()->GetPointData()->GetArray(array);
    Figures figures = volumeFigures(this->At, quantity,
      [&](int x, int y) { return drawn->GetComponent(static_cast<vtkIdType>(y) * width + x, 0); });
    figures["segments"] = static_cast<double>(this->Scape->GetNumberOfSegments());
    return figures;
  }

  vtkNew<vtkCloudCellVolume> Volume;
  vtkNew<vtkCloudscape> Scape;

private:
  Situation At;
};

class WhiteVolumeJob : public CellVolumeJob
{
public:
  WhiteVolumeJob(const Situation& situation, bool depth)
    : CellVolumeJob(situation, shell::structuredGrid(situation))
  {
    this->Scape->SetComputeDepth(depth);
  }
  Figures figures() override
  {
    return this->compare(arrays::Transmittance, &TruePixel::transmittance);
  }
};

class OrderedVolumeJob : public CellVolumeJob
{
public:
  OrderedVolumeJob(const Situation& situation, int order)
    : CellVolumeJob(situation, shell::paintedGrid(situation))
  {
    this->Volume->SetOrder(order);
  }
  Figures figures() override
  {
    Figures figures = this->compare(arrays::Radiance, &TruePixel::radiance);
    figures["cycles"] = static_cast<double>(this->Volume->GetNumberOfCycles());
    return figures;
  }
};

const Registration cellVolume({ "vtkCloudCellVolume", "volume", { { "order", "any: summed" } },
  true, false, 0, [](const Situation& s) { return std::make_unique<WhiteVolumeJob>(s, false); } });

const Registration cellVolumeAndDepth(
  { "vtkCloudCellVolume", "volume", { { "order", "per pixel" }, { "depth", "too" } }, true, false,
    0, [](const Situation& s) { return std::make_unique<WhiteVolumeJob>(s, true); } });

Method ordered(const char* name, int order)
{
  return { "vtkCloudCellVolume", "order", { { "order", name } }, true, false, 0,
    [order](const Situation& s) { return std::make_unique<OrderedVolumeJob>(s, order); } };
}
const Registration byPixel(ordered("per pixel", vtkCloudCellVolume::PixelDepth));
const Registration byVisibility(ordered("visibility", vtkCloudCellVolume::Visibility));
const Registration byCentroid(ordered("centroid", vtkCloudCellVolume::Centroid));
}
}
}
