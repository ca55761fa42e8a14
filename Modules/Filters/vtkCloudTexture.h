// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudTexture
 * @brief Gardner's transparency texture at points: opacity from a position in three dimensions.
 *
 * Gives each point the opacity 0 to 1 that a cloud surface has there: 1 where the cloud is, 0 where it is torn open. The
 * function is one of space, so surfaces that meet agree, nothing is stretched anywhere on a globe, and no texture map is
 * needed (Max 1994, "Clouds with textured surfaces"). A renderer that evaluates it for every fragment uses
 * nephoscope::CloudTexture with the same parameters; this filter's points must be dense to show fine terms.
 *
 * Input    port 0: vtkDataSet. Coordinates are the point array TextureCoordinates (3 components, m), as advected texture has
 *          it, or where there is none the points themselves, times MetersPerUnit. With OtherTextureCoordinates (3, m) and the
 *          field data TextureWeights (2) two textures are cross-faded, as vtkCloudTextureAdvection means it.
 * Output   a data set of the same kind, all arrays passed, and the point array Opacity (1 float, 0 to 1).
 * Parameters: see the setters; nephoscope::CloudTexture says what they look like.
 * Method   Gardner 1985 eq. 3 to 7, 9; Max 1994 eq. 3. See nephoscope::CloudTexture.
 * Errors   TextureCoordinates without 3 components: vtkErrorMacro, empty output; the same for OtherTextureCoordinates.
 * Cost     0.1 us a point, all threads; the same bits for any number of them.
 * Limits   Coordinates that are not finite have the texture's mean.
 * @sa nephoscope::CloudTexture, vtkCloudTextureAdvection, vtkCloudContour, TestCloudTextureFilter.cxx
 */
#ifndef vtkCloudTexture_h
#define vtkCloudTexture_h

#include "vtkCloudFiltersModule.h" // for export macro
#include "vtkDataSetAlgorithm.h"

class VTKCLOUDFILTERS_EXPORT vtkCloudTexture : public vtkDataSetAlgorithm
{
public:
  static vtkCloudTexture* New();
  vtkTypeMacro(vtkCloudTexture, vtkDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Wavelength of the first, coarsest term, m, > 0. Default 1,500,000, for global data; about a fifth of the largest
  /// cloud to be textured is a good choice.
  vtkSetClampMacro(Wavelength, double, 1e-6, 1e12);
  vtkGetMacro(Wavelength, double);
  ///@}

  ///@{
  /// Number of terms, each of half the wavelength before it, 1 to 8. More give finer wisps. Default 7.
  vtkSetClampMacro(Octaves, int, 1, 8);
  vtkGetMacro(Octaves, int);
  ///@}

  ///@{
  /// Amplitude of a term over that before it, 0 to 1. Lower is smoother. Default 0.7071 (eq. 5).
  vtkSetClampMacro(AmplitudeRatio, double, 0.0, 1.0);
  vtkGetMacro(AmplitudeRatio, double);
  ///@}

  ///@{
  /// T0 of eq. 3, >= 0. 0.1 gives scattered puffs, 0.5 a nearly closed sheet. Default 0.22.
  vtkSetClampMacro(Offset, double, 0.0, 1e3);
  vtkGetMacro(Offset, double);
  ///@}

  ///@{
  /// T1 of eq. 9, -1 to 1: what lies below is clear. Default 0.03.
  vtkSetClampMacro(Threshold, double, -1.0, 1.0);
  vtkGetMacro(Threshold, double);
  ///@}

  ///@{
  /// D of eq. 9, > 0: from clear to opaque. Small for hard edges (cumulus), large for soft ones (cirrus). Default 0.25.
  vtkSetClampMacro(Range, double, 1e-6, 1e3);
  vtkGetMacro(Range, double);
  ///@}

  ///@{
  /// Whether each term has its own frame, so that the pattern has no rows and does not repeat. Off is the published formula.
  /// Default on.
  vtkSetMacro(Turned, bool);
  vtkGetMacro(Turned, bool);
  vtkBooleanMacro(Turned, bool);
  ///@}

  ///@{
  /// Chooses among equally good patterns when Turned. Default 1.
  vtkSetMacro(Seed, unsigned int);
  vtkGetMacro(Seed, unsigned int);
  ///@}

  ///@{
  /// Distance between samples, m: terms with less than 4 samples a wave are left out, those with less than 8 fade. 0, the
  /// default, for all terms.
  vtkSetClampMacro(SamplingDistance, double, 0.0, 1e12);
  vtkGetMacro(SamplingDistance, double);
  ///@}

  ///@{
  /// Metres in one unit of the points' coordinates, > 0; of no effect with TextureCoordinates. Default 1.
  vtkSetClampMacro(MetersPerUnit, double, 1e-12, 1e12);
  vtkGetMacro(MetersPerUnit, double);
  ///@}

protected:
  vtkCloudTexture();
  ~vtkCloudTexture() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkCloudTexture(const vtkCloudTexture&) = delete;
  void operator=(const vtkCloudTexture&) = delete;

  double Wavelength;
  int Octaves;
  double AmplitudeRatio;
  double Offset;
  double Threshold;
  double Range;
  bool Turned;
  unsigned int Seed;
  double SamplingDistance = 0;
  double MetersPerUnit = 1;
};

#endif
