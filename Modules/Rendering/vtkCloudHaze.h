// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudHaze
 * @brief Haze under a cloud plane, with shafts of sunlight through the clouds' gaps.
 *
 * Input    port 0, optional: vtkImageData of one layer; point array SunTransmittance, 0 to 1; the image's z is the height of
 *          the cloud plane, above which there is no haze. Without it there are no clouds, and haze up to Height.
 * Method   one segment a pixel, from the eye to the nearest opaque surface, the cloud plane or Range. Its radiance is
 *          that of sunlight scattered once (nephoscope::HazeShafts, Max 1986, section 5),
 *              pi SunColor Albedo p(V . TowardSun) G,   p by Henyey and Greenstein with Anisotropy,
 *          and SkyColor (1 - exp(-tau)), which stands for what the sky and all further scattering add.
 * Errors   an Extinction that is not a number from 0 up, a sun that is not above the horizon, another image, a parallel camera with
 *          Moments (whose tables are of one eye): vtkErrorMacro, nothing is drawn.
 * Cost     Moments: Radials squared lookups a frame, then a bounded time a pixel; March and Exact grow with the rays' length.
 * Limits   the light of a segment is taken as evenly spread along it where it overlaps others. What is more than an optical
 *          depth of 100 away in the thinnest channel is cut.
 * @sa nephoscope::HazeShafts, vtkCloudUniformMedium, vtkCloudTerrain
 */
#ifndef vtkCloudHaze_h
#define vtkCloudHaze_h

#include "vtkCloudBody.h"
#include "vtkCloudRenderingModule.h" // for export macro

#include <memory> // for members

class VTKCLOUDRENDERING_EXPORT vtkCloudHaze : public vtkCloudBody
{
public:
  static vtkCloudHaze* New();
  vtkTypeMacro(vtkCloudHaze, vtkCloudBody);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// nephoscope::HazeMethod
  enum Methods
  {
    Exact,
    March,
    Moments
  };

  ///@{
  /// How the light is summed along a ray. Default Moments.
  vtkSetClampMacro(Method, int, Exact, Moments);
  vtkGetMacro(Method, int);
  ///@}
  ///@{
  /// Moments: directions about the sun, and samples along each. Default 1024.
  vtkSetClampMacro(Radials, int, 4, 8192);
  vtkGetMacro(Radials, int);
  ///@}
  ///@{
  /// March: step along the ray, scene units, > 0. Default 20.
  vtkSetMacro(Step, double);
  vtkGetMacro(Step, double);
  ///@}
  ///@{
  /// Extinction per scene unit, RGB >= 0. Default 0: clear.
  vtkSetVector3Macro(Extinction, double);
  vtkGetVector3Macro(Extinction, double);
  ///@}
  ///@{
  /// The share of what is taken from a ray that is scattered, RGB. Default (0.95, 0.95, 0.95).
  vtkSetVector3Macro(Albedo, double);
  vtkGetVector3Macro(Albedo, double);
  ///@}
  ///@{
  /// Mean cosine of the angle of scattering, -0.99 to 0.99; above 0 the haze is brightest about the sun. Default 0.6.
  vtkSetClampMacro(Anisotropy, double, -0.99, 0.99);
  vtkGetMacro(Anisotropy, double);
  ///@}
  ///@{
  /// Direction from the scene to the sun, any length > 0. Default (0, 0, 1).
  vtkSetVector3Macro(TowardSun, double);
  vtkGetVector3Macro(TowardSun, double);
  ///@}
  ///@{
  /// Radiance of a white surface that faces the sun above the clouds, linear RGB. Default (1, 0.97, 0.91).
  vtkSetVector3Macro(SunColor, double);
  vtkGetVector3Macro(SunColor, double);
  ///@}
  ///@{
  /// Radiance that endless haze has without the sun, linear RGB. Default (0.1, 0.12, 0.15).
  vtkSetVector3Macro(SkyColor, double);
  vtkGetVector3Macro(SkyColor, double);
  ///@}
  ///@{
  /// Top of the haze if there is no input, scene units. Default 2000.
  vtkSetMacro(Height, double);
  vtkGetMacro(Height, double);
  ///@}
  ///@{
  /// How far from the eye it reaches, scene units. Default VTK_DOUBLE_MAX: without end.
  vtkSetClampMacro(Range, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(Range, double);
  ///@}

#ifndef __VTK_WRAP__
  bool Prepare(const nephoscope::Camera& camera) override;
  void Emit(const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const override;
#endif

protected:
  vtkCloudHaze();
  ~vtkCloudHaze() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;

  int Method = Moments;
  int Radials = 1024;
  double Step = 20;
  double Extinction[3] = { 0, 0, 0 };
  double Albedo[3] = { 0.95, 0.95, 0.95 };
  double Anisotropy = 0.6;
  double TowardSun[3] = { 0, 0, 1 };
  double SunColor[3] = { 1, 0.97, 0.91 };
  double SkyColor[3] = { 0.1, 0.12, 0.15 };
  double Height = 2000;
  double Range = VTK_DOUBLE_MAX;

private:
  vtkCloudHaze(const vtkCloudHaze&) = delete;
  void operator=(const vtkCloudHaze&) = delete;

  bool Validate(const nephoscope::Camera& camera);

  struct Air;
  std::unique_ptr<Air> Ready;
};
#endif
