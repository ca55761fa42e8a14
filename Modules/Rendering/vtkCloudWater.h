// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudWater
 * @brief A sea under the clouds: waves that reflect sky, clouds, hills and sun, over water lit from above.
 *
 * Input    port 0, optional: vtkImageData of one layer; point array SunTransmittance, 0 to 1; the image's z is the height of
 *          the cloud plane. Its clouds shade the water and are seen in it.
 *          port 1, optional: vtkImageData of one layer; point array Height, metres times HeightScale: hills that are seen in it.
 * Method   the plane z = Level, with slopes of nephoscope::WaterWaves as a pixel sees them: those it resolves, and the rest as
 *          roughness. Over the rough slopes, by Gauss-Hermite quadrature (5 nodes along the line of sight) and by lot across weighted by the area that the eye sees of each,
 *              F (what is reflected) + (1 - F) WaterColor (light of sun and sky),   F by Fresnel with index 1.34
 *          Reflected rays see the Backdrop, the hills in one colour, and the Clouds in the light that they send
 *          to the eye's mirror image (CloudPanorama.h). Without Clouds they see them as Max 1986, section 6 has them: where they meet
 *          the cloud plane its transmittance c mixes CloudEdgeColor with CloudCoreColor, and that with the sky behind.
 *          The sun's glitter is pi SunColor c F p / (4 V_z n_z^4), p the density of the slopes that mirror it (Cox and Munk 1954).
 *          Light that comes back out of the water is dimmed by the clouds' shadow.
 * Errors   another image, a sun without direction: vtkErrorMacro, nothing is drawn.
 * Cost     some 3 us a pixel with 72 waves where no other opaque body stands before it. Thread-safe; the same bits for any number of threads.
 * Limits   a parallel picture has clouds as without Clouds. There is no haze before what is mirrored. Waves have slopes but no height: they hide nothing, and a resolved face counts by its place on the plane, not by the area
 *          that the eye sees of it. Rays that are mirrored downward see the horizon.
 *          From below the surface nothing is seen of it.
 * @sa nephoscope::WaterWaves, vtkCloudTerrain
 */
#ifndef vtkCloudWater_h
#define vtkCloudWater_h

#include "vtkCloudLitBody.h"
#include "vtkCloudRenderingModule.h" // for export macro
#include "vtkSmartPointer.h"         // for members

#include <memory> // for members

class vtkCloudBackdrop;
class vtkCloudHeightField;

class VTKCLOUDRENDERING_EXPORT vtkCloudWater : public vtkCloudLitBody
{
public:
  static vtkCloudWater* New();
  vtkTypeMacro(vtkCloudWater, vtkCloudLitBody);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// z of the water, scene units. Default 0.
  vtkSetMacro(Level, double);
  vtkGetMacro(Level, double);
  ///@}
  ///@{
  /// Wind over the water, m/s, 0 to 30: makes it rough; 0 is a calm, without waves. Default 5.
  vtkSetClampMacro(WindSpeed, double, 0, 30);
  vtkGetMacro(WindSpeed, double);
  ///@}
  ///@{
  /// Where the wind blows to; z does not count. Default (1, 0.3, 0).
  vtkSetVector3Macro(Wind, double);
  vtkGetVector3Macro(Wind, double);
  ///@}
  ///@{
  /// Longest wave, m, 0.1 to 1000. Default 40.
  vtkSetClampMacro(Wavelength, double, 0.1, 1000);
  vtkGetMacro(Wavelength, double);
  ///@}
  ///@{
  /// Moment of the waves, s; they repeat after Period seconds if that is above 0. Defaults 0, 0.
  vtkSetMacro(Time, double);
  vtkGetMacro(Time, double);
  vtkSetClampMacro(Period, double, 0, 1e9);
  vtkGetMacro(Period, double);
  ///@}
  ///@{
  /// Reflectance of the water's depth, linear RGB. Default (0.008, 0.03, 0.04).
  vtkSetVector3Macro(WaterColor, double);
  vtkGetVector3Macro(WaterColor, double);
  ///@}
  ///@{
  /// Radiance of clouds that are seen in the water, linear RGB: where they are thin, and where they are thick. Defaults (0.8, 0.8, 0.8)
  /// and (0.35, 0.37, 0.4).
  vtkSetVector3Macro(CloudEdgeColor, double);
  vtkGetVector3Macro(CloudEdgeColor, double);
  vtkSetVector3Macro(CloudCoreColor, double);
  vtkGetVector3Macro(CloudCoreColor, double);
  ///@}
  ///@{
  /// Reflectance of hills that are seen in the water, linear RGB. Default (0.1, 0.09, 0.045).
  vtkSetVector3Macro(LandColor, double);
  vtkGetVector3Macro(LandColor, double);
  ///@}
  ///@{
  /// Factor on the hills' heights. Default 1.
  vtkSetMacro(HeightScale, double);
  vtkGetMacro(HeightScale, double);
  ///@}
  ///@{
  /// The clouds that are reflected, a body of the same vtkCloudscape: with the light that they send. Default none: those of port 0, in
  /// CloudEdgeColor and CloudCoreColor.
  void SetClouds(vtkCloudHeightField* clouds);
  vtkCloudHeightField* GetClouds() const;
  ///@}
  ///@{
  /// The sky that is reflected. Default none: SkyColor everywhere.
  void SetBackdrop(vtkCloudBackdrop* backdrop);
  vtkCloudBackdrop* GetBackdrop() const;
  ///@}

  bool IsOpaque() const override { return true; }
  bool HidesAhead() const override { return true; }

#ifndef __VTK_WRAP__
  bool Prepare(const nephoscope::Camera& camera) override;
  void Hide(const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const override;
  void Emit(const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const override;
#endif

protected:
  vtkCloudWater();
  ~vtkCloudWater() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;

  double Level = 0;
  double WindSpeed = 5;
  double Wind[3] = { 1, 0.3, 0 };
  double Wavelength = 40;
  double Time = 0;
  double Period = 0;
  double WaterColor[3] = { 0.008, 0.03, 0.04 };
  double CloudEdgeColor[3] = { 0.8, 0.8, 0.8 };
  double CloudCoreColor[3] = { 0.35, 0.37, 0.4 };
  double LandColor[3] = { 0.1, 0.09, 0.045 };
  double HeightScale = 1;

private:
  vtkCloudWater(const vtkCloudWater&) = delete;
  void operator=(const vtkCloudWater&) = delete;

#ifndef __VTK_WRAP__
  double DistanceOf(const nephoscope::Ray& ray) const;
#endif

  class Sea;
  std::unique_ptr<Sea> Ready;
  vtkSmartPointer<vtkCloudBackdrop> Backdrop;
  vtkSmartPointer<vtkCloudHeightField> Clouds;
};
#endif
