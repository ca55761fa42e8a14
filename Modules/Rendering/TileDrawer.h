// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file TileDrawer.h
 * @brief The tiles of a picture: bodies' segments into deep pixels, deep pixels into the picture's values.
 *
 * A picture is drawn by one process tile after tile, or by several, each with its part of the bodies (RankedTiles): both make
 * use of the steps here.
 */
#ifndef TileDrawer_h
#define TileDrawer_h

#include "Camera.h"
#include "DeepTile.h"

#include "vtkType.h"

#include <vector>

class vtkCloudBackdrop;
class vtkCloudBody;
class vtkCloudscape;
class vtkImageData;

/// What there is to draw, and how.
struct TileScene
{
  nephoscope::Camera Camera;         ///< of the rays, Samples x Samples for each pixel
  std::vector<vtkCloudBody*> Bodies; ///< ready; the opaque ones first
  const vtkCloudBackdrop* Backdrop = nullptr;
  int Width = 0;
  int Height = 0;
  int Edge = 0; ///< of a tile, pixels
  int Samples = 1;
  bool DepthWanted = true;
};

/// A tile and what is needed to make pixels of it; one for each thread.
struct TileWork
{
  nephoscope::DeepTile Tile;
  std::vector<nephoscope::PixelLight> Light;
  std::vector<double> Depths;
  std::vector<float> Pixels; ///< of the finished tile: ValuesOfPixel for each
};

class TileDrawer
{
public:
  /// Radiance 3, transmittance 3, depth 1.
  static constexpr int ValuesOfPixel = 7;

  explicit TileDrawer(const TileScene& scene);

  vtkIdType GetNumberOfTiles() const;
  nephoscope::TileExtent GetPixels(vtkIdType tile) const;

  /// Empty the work's tile and move it.
  void Start(vtkIdType tile, TileWork& work) const;
  /// Composite it; the backdrop is put behind. Fills the work's Pixels.
  void Finish(vtkIdType tile, TileWork& work) const;
  /// The same of Light that is there already.
  void Write(vtkIdType tile, TileWork& work) const;

private:
  void WritePixel(
    const nephoscope::TileExtent& pixels, int x, int y, TileWork& work, float* values) const;

  const TileScene& Scene;
  int TilesAcross;
};

/// The picture's arrays; the image gets them.
class TilePicture
{
public:
  explicit TilePicture(vtkImageData* image);
  void Place(const nephoscope::TileExtent& tile, const float* pixels);

private:
  int Width;
  float* Radiance;
  float* Transmittance;
  float* Depth;
};

/// Draw all tiles in this process. Returns the number of segments. Reports progress and stops when the picture is aborted.
vtkIdType drawTiles(vtkCloudscape* scape, const TileScene& scene, TilePicture& picture);
#endif
