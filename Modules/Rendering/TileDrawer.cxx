// SPDX-License-Identifier: BSD-3-Clause
#include "TileDrawer.h"

#include "CloudArrays.h"
#include "vtkCloudBackdrop.h"
#include "vtkCloudBody.h"
#include "vtkCloudscape.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSMPThreadLocal.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <atomic>
#include <thread>

TileDrawer::TileDrawer(const TileScene& scene)
  : Scene(scene)
  , TilesAcross((scene.Width + scene.Edge - 1) / scene.Edge)
{
}

vtkIdType TileDrawer::GetNumberOfTiles() const
{
  return static_cast<vtkIdType>(this->TilesAcross) *
    ((this->Scene.Height + this->Scene.Edge - 1) / this->Scene.Edge);
}

nephoscope::TileExtent TileDrawer::GetPixels(vtkIdType tile) const
{
  const int edge = this->Scene.Edge;
  const int x0 = static_cast<int>(tile % this->TilesAcross) * edge;
  const int y0 = static_cast<int>(tile / this->TilesAcross) * edge;
  return { x0, y0, std::min(edge, this->Scene.Width - x0),
    std::min(edge, this->Scene.Height - y0) };
}

void TileDrawer::Start(vtkIdType tile, TileWork& work) const
{
  const nephoscope::TileExtent pixels = this->GetPixels(tile);
  const int n = this->Scene.Samples;
  work.Tile.reset({ n * pixels.x0, n * pixels.y0, n * pixels.width, n * pixels.height });
  work.Tile.setDepthWanted(this->Scene.DepthWanted);
}

void TileDrawer::Finish(vtkIdType tile, TileWork& work) const
{
  work.Tile.composite(work.Light);
  this->Write(tile, work);
}

void TileDrawer::Write(vtkIdType tile, TileWork& work) const
{
  const nephoscope::TileExtent pixels = this->GetPixels(tile);
  work.Depths.resize(static_cast<std::size_t>(this->Scene.Samples) * this->Scene.Samples);
  work.Pixels.resize(static_cast<std::size_t>(ValuesOfPixel) * pixels.width * pixels.height);
  float* values = work.Pixels.data();
  for (int y = 0; y < pixels.height; ++y)
  {
    for (int x = 0; x < pixels.width; ++x, values += ValuesOfPixel)
    {
      this->WritePixel(pixels, x, y, work, values);
    }
  }
}

/// The mean of the pixel's samples, the backdrop behind them; the median of their depths.
void TileDrawer::WritePixel(
  const nephoscope::TileExtent& pixels, int x, int y, TileWork& work, float* values) const
{
  const int n = this->Scene.Samples;
  double radiance[3] = { 0, 0, 0 };
  double transmittance[3] = { 0, 0, 0 };
  std::size_t sample = 0;
  for (int j = n * y; j < n * (y + 1); ++j)
  {
    for (int i = n * x; i < n * (x + 1); ++i, ++sample)
    {
      const nephoscope::PixelLight& light =
        work.Light[static_cast<std::size_t>(j) * n * pixels.width + i];
      float behind[3] = { 0, 0, 0 };
      if (this->Scene.Backdrop)
      {
        const nephoscope::Ray ray =
          this->Scene.Camera.ray(n * pixels.x0 + i + 0.5, n * pixels.y0 + j + 0.5);
        this->Scene.Backdrop->GetRadiance(ray.direction.v, behind);
      }
      for (int c = 0; c < 3; ++c)
      {
        radiance[c] += light.radiance[c] + light.transmittance[c] * behind[c];
        transmittance[c] += light.transmittance[c];
      }
      work.Depths[sample] = light.depth;
    }
  }
  for (int c = 0; c < 3; ++c)
  {
    values[c] = static_cast<float>(radiance[c] / (n * n));
    values[3 + c] = static_cast<float>(transmittance[c] / (n * n));
  }
  const auto middle = work.Depths.begin() + (n * n - 1) / 2;
  std::nth_element(work.Depths.begin(), middle, work.Depths.end());
  values[6] = static_cast<float>(*middle);
}

namespace
{
float* newArray(vtkImageData* image, const char* name, int components)
{
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(image->GetNumberOfPoints());
  image->GetPointData()->AddArray(array);
  return array->GetPointer(0);
}
}

TilePicture::TilePicture(vtkImageData* image)
  : Width(image->GetDimensions()[0])
  , Radiance(newArray(image, nephoscope::arrays::Radiance, 3))
  , Transmittance(newArray(image, nephoscope::arrays::Transmittance, 3))
  , Depth(newArray(image, nephoscope::arrays::Depth, 1))
{
  image->GetPointData()->SetActiveScalars(nephoscope::arrays::Radiance);
}

void TilePicture::Place(const nephoscope::TileExtent& tile, const float* pixels)
{
  for (int y = tile.y0; y < tile.y0 + tile.height; ++y)
  {
    for (int x = tile.x0; x < tile.x0 + tile.width; ++x, pixels += TileDrawer::ValuesOfPixel)
    {
      const std::size_t at = static_cast<std::size_t>(y) * this->Width + x;
      std::copy_n(pixels, 3, this->Radiance + 3 * at);
      std::copy_n(pixels + 3, 3, this->Transmittance + 3 * at);
      this->Depth[at] = pixels[6];
    }
  }
}

namespace
{
/// Tile after tile; each thread has work of its own.
class AllTiles
{
public:
  AllTiles(vtkCloudscape* scape, const TileScene& scene, TilePicture& picture)
    : Scape(scape)
    , Scene(scene)
    , Picture(picture)
    , Drawer(scene)
    , Caller(std::this_thread::get_id())
  {
  }

  vtkIdType GetNumberOfTiles() const { return this->Drawer.GetNumberOfTiles(); }
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
        this->Scape->UpdateProgress(static_cast<double>(done) / this->Drawer.GetNumberOfTiles());
      }
    }
  }

private:
  void Draw(vtkIdType tile)
  {
    TileWork& work = this->Works.Local();
    this->Drawer.Start(tile, work);
    for (const vtkCloudBody* body : this->Scene.Bodies)
    {
      body->Hide(this->Scene.Camera, work.Tile);
    }
    for (std::size_t body = 0; body < this->Scene.Bodies.size(); ++body)
    {
      if (body + 1 == this->Scene.Bodies.size())
      {
        work.Tile.setLast();
      }
      this->Scene.Bodies[body]->Emit(this->Scene.Camera, work.Tile);
    }
    this->Segments += static_cast<vtkIdType>(work.Tile.numberOfSegments());
    this->Drawer.Finish(tile, work);
    this->Picture.Place(this->Drawer.GetPixels(tile), work.Pixels.data());
  }

  vtkCloudscape* Scape;
  const TileScene& Scene;
  TilePicture& Picture;
  TileDrawer Drawer;
  std::thread::id Caller;
  std::atomic<vtkIdType> Done{ 0 };
  std::atomic<vtkIdType> Segments{ 0 };
  vtkSMPThreadLocal<TileWork> Works;
};
}

vtkIdType drawTiles(vtkCloudscape* scape, const TileScene& scene, TilePicture& picture)
{
  AllTiles tiles(scape, scene, picture);
  vtkSMPTools::For(0, tiles.GetNumberOfTiles(), 1, tiles);
  return tiles.GetNumberOfSegments();
}
