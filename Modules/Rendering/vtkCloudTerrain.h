// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudTerrain
 * @brief Opaque hills under the clouds: a height field, lit by sun and sky, in the shadow of itself and of the clouds.
 *
 * Input    port 0: vtkImageData of one layer, at least 2 x 2 points; point array Height, scene units times 1 / HeightScale.
 *          port 1, optional: vtkImageData of one layer; point array SunTransmittance, 0 to 1, what the clouds above each point
 *          let through of the sun; the image's z is the height of the cloud plane.
 * Method   each ray is intersected with the bilinear surface (nephoscope::HeightGrid). The normal is that of the heights as a
 *          pixel sees them, roughened by noise finer than the grid; Lambert's law and the sky's light
 *          (vtkCloudLitBody); the sun is dimmed by SunTransmittance where the ray towards it meets the cloud plane (Max 1986,
 *          section 6) and is gone where hills stand before it. Colours are mixed by height, slope and noise, each faded
 *          out before it gets finer than a pixel: sand at the water's edge, grass and wood, rock where it is steep.
 * Errors   no image, no such array, more than one layer, a HeightScale that is not above 0: vtkErrorMacro, nothing is drawn.
 * Cost     for a hit two rays of about log2 of the number of points; memory 12 bytes a point. Thread-safe; the same bits for any number of
 *          threads.
 * Limits   beyond the image there is no ground; its sides are walls. An eye below the ground sees only ground.
 * @sa vtkCloudTerrainSource, vtkCloudWater, nephoscope::HeightGrid, nephoscope::CloudShadow
 */
#ifndef vtkCloudTerrain_h
#define vtkCloudTerrain_h

#include "vtkCloudLitBody.h"
#include "vtkCloudRenderingModule.h" // for export macro

#include <memory> // for members

class VTKCLOUDRENDERING_EXPORT vtkCloudTerrain : public vtkCloudLitBody
{
public:
  static vtkCloudTerrain* New();
  vtkTypeMacro(vtkCloudTerrain, vtkCloudLitBody);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Factor on heights, > 0. Default 1.
  vtkSetMacro(HeightScale, double);
  vtkGetMacro(HeightScale, double);
  ///@}
  ///@{
  /// z of the water that washes the sand, scene units. Default 0.
  vtkSetMacro(WaterLevel, double);
  vtkGetMacro(WaterLevel, double);
  ///@}
  ///@{
  /// Reflectances, linear RGB. Defaults (0.3, 0.25, 0.18), (0.16, 0.13, 0.06), (0.035, 0.05, 0.02), (0.14, 0.12, 0.1).
  vtkSetVector3Macro(SandColor, double);
  vtkGetVector3Macro(SandColor, double);
  vtkSetVector3Macro(GrassColor, double);
  vtkGetVector3Macro(GrassColor, double);
  vtkSetVector3Macro(WoodColor, double);
  vtkGetVector3Macro(WoodColor, double);
  vtkSetVector3Macro(RockColor, double);
  vtkGetVector3Macro(RockColor, double);
  ///@}
  ///@{
  /// Standard slope of what is finer than the grid. Default 0.15.
  vtkSetClampMacro(Roughness, double, 0, 1);
  vtkGetMacro(Roughness, double);
  ///@}

  bool IsOpaque() const override { return true; }

#ifndef __VTK_WRAP__
  bool Prepare(const nephoscope::Camera& camera) override;
  void Emit(const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const override;
#endif

protected:
  vtkCloudTerrain();
  ~vtkCloudTerrain() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;

  double HeightScale = 1;
  double WaterLevel = 0;
  double SandColor[3] = { 0.3, 0.25, 0.18 };
  double GrassColor[3] = { 0.16, 0.13, 0.06 };
  double WoodColor[3] = { 0.035, 0.05, 0.02 };
  double RockColor[3] = { 0.14, 0.12, 0.1 };
  double Roughness = 0.15;

private:
  vtkCloudTerrain(const vtkCloudTerrain&) = delete;
  void operator=(const vtkCloudTerrain&) = delete;

  class Landscape;
  std::unique_ptr<Landscape> Ready;
};
#endif
