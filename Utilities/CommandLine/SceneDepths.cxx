// SPDX-License-Identifier: BSD-3-Clause
#include "FitData.h"

#include "Failure.h"
#include "Messages.h"
#include "Progress.h"
#include "SceneBuilder.h"

#include <Camera.h>
#include <DeepTile.h>
#include <vtkCloudBody.h>
#include <vtkCloudCellVolume.h>
#include <vtkCloudHeightField.h>
#include <vtkCloudscape.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>

#include <algorithm>
#include <cmath>

namespace nephoscope::program
{
namespace
{
constexpr int MostPixels = 256;

/// Stands for another body, and adds the optical depth of each ray in it, up to what is opaque, to a picture of depths.
class DepthRecorder : public vtkCloudBody
{
public:
  static DepthRecorder* New();
  vtkTypeMacro(DepthRecorder, vtkCloudBody);

  void Record(vtkCloudBody* body, int width, std::vector<double>* depths)
  {
    this->Body = body;
    this->Width = width;
    this->Depths = depths;
  }

  bool Prepare(const Camera& camera) override { return this->Body->Prepare(camera); }

  /// Each pixel belongs to one tile, and each tile to one thread.
  void Emit(const Camera& camera, DeepTile& tile) const override
  {
    const TileExtent& extent = tile.extent();
    DeepTile own;
    own.reset(extent);
    own.setDepthWanted(false);
    const auto eachPixel = [&extent](const auto& work)
    {
      for (int i = 0; i < extent.width * extent.height; ++i)
      {
        work(extent.x0 + i % extent.width, extent.y0 + i / extent.width, i);
      }
    };
    eachPixel([&](int x, int y, int) { own.hideBeyond(x, y, tile.opaqueAt(x, y)); });
    this->Body->Emit(camera, own);
    std::vector<PixelLight> light;
    own.composite(light);
    eachPixel(
      [&](int x, int y, int i)
      {
        // Beyond a depth of 87 a float is 0: as if it were 87.
        const double through = std::max(light[i].transmittance[1], 1e-38F);
        (*this->Depths)[static_cast<std::size_t>(y) * this->Width + x] -= std::log(through);
      });
  }

protected:
  DepthRecorder() { this->SetNumberOfInputPorts(0); }

private:
  vtkSmartPointer<vtkCloudBody> Body;
  int Width = 0;
  std::vector<double>* Depths = nullptr;
};

vtkStandardNewMacro(DepthRecorder);

/// Puts recorders in the place of clouds, and takes away other things that are translucent. @return whether there are clouds
bool record(vtkCloudscape* scape, std::vector<double>& depths)
{
  std::vector<vtkSmartPointer<vtkCloudBody>> kept;
  bool clouds = false;
  for (int i = 0; i < scape->GetNumberOfBodies(); ++i)
  {
    vtkCloudBody* const body = scape->GetBody(i);
    if (body->IsOpaque())
    {
      kept.emplace_back(body);
    }
    else if (vtkCloudCellVolume::SafeDownCast(body) || vtkCloudHeightField::SafeDownCast(body))
    {
      const vtkNew<DepthRecorder> recorder;
      recorder->Record(body, scape->GetSize()[0], &depths);
      kept.emplace_back(recorder.Get());
      clouds = true;
    }
  }
  scape->RemoveAllBodies();
  for (const auto& body : kept)
  {
    scape->AddBody(body);
  }
  return clouds;
}
}

std::vector<double> depthsOf(Scene scene, Progress& progress)
{
  const int longer = std::max({ scene.picture.size[0], scene.picture.size[1], MostPixels });
  for (int& size : scene.picture.size)
  {
    size = std::max(1, size * MostPixels / longer);
  }
  scene.picture.samples = 1;
  const BuiltScene built = buildScene(scene, false, progress);
  std::vector<double> depths(
    static_cast<std::size_t>(scene.picture.size[0]) * scene.picture.size[1], 0.0);
  if (!record(built.scape, depths))
  {
    throw Failure("the scene has no clouds with an optical depth: no volume and no heightField");
  }
  progress.watch(built.scape, "draw");
  built.scape->Update();
  progress.forget();
  Messages::throwIfError(scene.subject());
  // Rays that miss all cloud have exactly 0, and nothing to say.
  depths.erase(
    std::remove_if(depths.begin(), depths.end(), [](double depth) { return !(depth > 0); }),
    depths.end());
  if (depths.empty())
  {
    throw Failure("no ray of the scene's camera meets cloud; look elsewhere");
  }
  return depths;
}
}
