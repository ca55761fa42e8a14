// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudHeightField
 * @brief Clouds between two height functions in sunlight that is scattered once (Max 1986).
 *
 * The picture is cut into vertical half planes from the eye, slices, each of which is worked out at once and in parallel:
 *  1. Prepare gives every pixel to a slice. Where columns of pixels are vertical planes (a level perspective view, an upright
 *     cylinder) each column is one; else slices are SliceSpacing apart at the picture's widest, and each pixel goes to the
 *     nearest, at its own slope. A parallel view has a slice for every pixel.
 *  2. Each slice's rays get their segments from nephoscope::HeightFieldScattering.
 *  3. Emit puts them into deep pixels. A segment that something opaque ends is integrated anew up to there.
 *
 * Input    port 0: any vtkDataObject with the field data array HeightField (vtkCloudHeightFieldSource); lengths in metres, z up.
 * Parameters: see the setters.
 * Method   radiance = SunColor (1 - a) 4 pi p(angle) J + SkyColor a (1 - exp(-depth)), a = Ambient: the first term is Max's, with
 *          Henyey and Greenstein's phase function p; the second, which he does not have, stands for the light that has been
 *          scattered often. The sun is overhead for J; TowardSun counts for p alone, as Max found convincing.
 * Errors   no such array, an array that is no height field, an unknown method: vtkErrorMacro, nothing is drawn.
 * Cost     with Moments 0.3 to 0.6 us a ray and core: 0.06 s for Max's 510 x 384 pixels and 0.33 s for his 1764 x 1280 on two cores.
 *          A third is sampling the waves, whose roots bound it, the rest entering, leaving and summing each cloud; memory 32 bytes a segment and 20 a pixel. The same bits for any
 *          number of threads.
 * Limits   nothing is seen beyond FarDistance. Waves shorter than 4 pixels fade, those below 1.2 are gone; a parallel view has all of
 *          them.
 * @sa vtkCloudHeightFieldSource, nephoscope::HeightFieldScattering
 */
#ifndef vtkCloudHeightField_h
#define vtkCloudHeightField_h

#include "vtkCloudLitBody.h"
#include "vtkCloudRenderingModule.h" // for export macro

#include <memory> // for members
#include <string> // for members

#ifndef __VTK_WRAP__
namespace nephoscope
{
class CloudPanorama;
struct Vector3;
}
#endif

class VTKCLOUDRENDERING_EXPORT vtkCloudHeightField : public vtkCloudLitBody
{
public:
  static vtkCloudHeightField* New();
  vtkTypeMacro(vtkCloudHeightField, vtkCloudLitBody);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Exact, March, Sexp1986 or Moments. Default Moments.
  vtkSetMacro(Method, std::string);
  vtkGetMacro(Method, std::string);
  ///@}
  ///@{
  /// Extinctions, 1/m, >= 0: from the sun to the scatterer, from there to the eye, and of what lies behind. Defaults 0.0093, 0.0163
  /// and 0.0198, those of Max's figures.
  vtkSetMacro(SunExtinction, double);
  vtkGetMacro(SunExtinction, double);
  vtkSetMacro(ViewExtinction, double);
  vtkGetMacro(ViewExtinction, double);
  vtkSetMacro(BackgroundExtinction, double);
  vtkGetMacro(BackgroundExtinction, double);
  ///@}
  ///@{
  /// Mean cosine of the scattering angle, -0.95 to 0.95: 0 scatters evenly, water droplets have 0.85. Default 0.
  vtkSetClampMacro(Asymmetry, double, -0.95, 0.95);
  vtkGetMacro(Asymmetry, double);
  ///@}
  ///@{
  /// Horizontal distance from the eye where clouds end, m, > 0. Default 50000.
  vtkSetMacro(FarDistance, double);
  vtkGetMacro(FarDistance, double);
  ///@}
  ///@{
  /// March's step along the ray, m, > 0. Default 5.
  vtkSetMacro(Step, double);
  vtkGetMacro(Step, double);
  ///@}
  ///@{
  /// Samples of the shortest wave for Moments and Sexp1986, 2 to 1000, but none closer than 0.7 pixels. Default 12.
  vtkSetClampMacro(SamplesPerWave, double, 2, 1000);
  vtkGetMacro(SamplesPerWave, double);
  ///@}

  ///@{
  /// Distance of slices where columns of pixels are not vertical planes, pixels where they are widest apart, 0 to 1. Rays are turned by half of
  /// it at most: 0.8 adds a tenth to the error that one sample a pixel has of itself. With 0, or where there were more slices than
  /// pixels, each pixel has its own: none is displaced, but Moments is as dear as March. Default 0.8.
  vtkSetClampMacro(SliceSpacing, double, 0, 1);
  vtkGetMacro(SliceSpacing, double);
  ///@}

  ///@{
  /// Constants of Sexp1986, fitted to the exact light (Data/Calibration/heightfield.json, fits "printed ..."): factors on the
  /// extinctions in the exponentials' stand-ins, and on the light. > 0. Defaults 1, Max's own.
  vtkSetMacro(SunFactor, double);
  vtkGetMacro(SunFactor, double);
  vtkSetMacro(ViewFactor, double);
  vtkGetMacro(ViewFactor, double);
  vtkSetMacro(Gain, double);
  vtkGetMacro(Gain, double);
  ///@}

  ///@{
  /// Max 1986 asks for arguments of at most 2 of his quadratics: the largest delta (yR - yL) and rho g of the last picture. They limit
  /// Sexp1986 alone.
  vtkGetMacro(LargestViewArgument, double);
  vtkGetMacro(LargestSunArgument, double);
  ///@}

#ifndef __VTK_WRAP__
  bool Prepare(const nephoscope::Camera& camera) override;
  void Emit(const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const override;

  /// Where the clouds stand and how they look from a point below them, for water that mirrors them. The input is up to date. Returns
  /// false, after vtkErrorMacro, without an input that has a height field.
  bool Survey(const nephoscope::Vector3& eye, nephoscope::CloudPanorama& panorama);
  /// The radiance of clouds of a panorama.
  nephoscope::Vector3 RadianceOf(
    double light, double transmittance, const nephoscope::Vector3& direction) const;
#endif

protected:
  vtkCloudHeightField();
  ~vtkCloudHeightField() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;

  std::string Method = "Moments";
  double SunExtinction = 0.0093;
  double ViewExtinction = 0.0163;
  double BackgroundExtinction = 0.0198;
  double Asymmetry = 0;
  double FarDistance = 50000;
  double Step = 5;
  double SunFactor = 1;
  double ViewFactor = 1;
  double Gain = 1;
  double SamplesPerWave = 12;
  double SliceSpacing = 0.8;
  double LargestViewArgument = 0;
  double LargestSunArgument = 0;

private:
  vtkCloudHeightField(const vtkCloudHeightField&) = delete;
  void operator=(const vtkCloudHeightField&) = delete;

  struct Drawn;
  class SliceWorker;
  bool ReadField();
#ifndef __VTK_WRAP__
  void EmitPixel(int x, int y, std::size_t slice, std::size_t slot, double shine,
    nephoscope::DeepTile& tile) const;
#endif

  std::unique_ptr<Drawn> Ready;
};
#endif
