// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudTerrainSource
 * @brief Made-up hills as heights on a horizontal grid.
 *
 * Output   vtkImageData of Dimensions points about Center with Spacing, z = 0; point array Height (float, 1 component, m above
 *          the sea; the sea's bottom is below 0).
 * Parameters: see the setters.
 * Method   nephoscope::FractalHills: octaves of gradient noise, worn where they are steep. Rows are made in parallel.
 * Errors   fewer than 2 points either way, or over 2^28 in all; a Spacing or Wavelength that is not a number above 0; points over
 *          2^19 Wavelengths from (0, 0): vtkErrorMacro, an empty output.
 * Cost     some 0.12 us a point; the same bits for any number of threads. Reports no progress: 1000 x 1000 points take less than
 *          a second.
 * Limits   hills, not a likeness of any place on Earth: no rivers, no coasts but where the sea drowns them.
 * @sa vtkCloudTerrain, nephoscope::FractalHills
 */
#ifndef vtkCloudTerrainSource_h
#define vtkCloudTerrainSource_h

#include "vtkCloudSourcesModule.h" // for export macro
#include "vtkImageAlgorithm.h"

class VTKCLOUDSOURCES_EXPORT vtkCloudTerrainSource : public vtkImageAlgorithm
{
public:
  static vtkCloudTerrainSource* New();
  vtkTypeMacro(vtkCloudTerrainSource, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Points from west to east and from south to north. Default 1024 x 1024.
  vtkSetVector2Macro(Dimensions, int);
  vtkGetVector2Macro(Dimensions, int);
  ///@}
  ///@{
  /// The grid's middle, m. Default (0, 0).
  vtkSetVector2Macro(Center, double);
  vtkGetVector2Macro(Center, double);
  ///@}
  ///@{
  /// Distance of neighbours, m, > 0. Default 30.
  vtkSetMacro(Spacing, double);
  vtkGetMacro(Spacing, double);
  ///@}
  ///@{
  /// Of the largest hills, m, > 0. Default 12000.
  vtkSetMacro(Wavelength, double);
  vtkGetMacro(Wavelength, double);
  ///@}
  ///@{
  /// Heights lie within about half of this from the mean, m. Default 1800.
  vtkSetMacro(Relief, double);
  vtkGetMacro(Relief, double);
  ///@}
  ///@{
  /// Mean height, m; a negative one floods more land. Default 60.
  vtkSetMacro(Mean, double);
  vtkGetMacro(Mean, double);
  ///@}
  ///@{
  /// How rough: the amplitude of an octave over that of the one before, 0 to 1. Default 0.5.
  vtkSetClampMacro(Gain, double, 0, 1);
  vtkGetMacro(Gain, double);
  ///@}
  ///@{
  /// Makes hills with equal parameters different. Default 1.
  vtkSetMacro(Seed, int);
  vtkGetMacro(Seed, int);
  ///@}

protected:
  vtkCloudTerrainSource();
  ~vtkCloudTerrainSource() override = default;

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override;

private:
  vtkCloudTerrainSource(const vtkCloudTerrainSource&) = delete;
  void operator=(const vtkCloudTerrainSource&) = delete;

  bool Validate();
  void GetOrigin(double origin[3]) const;

  int Dimensions[2] = { 1024, 1024 };
  double Center[2] = { 0, 0 };
  double Spacing = 30;
  double Wavelength = 12000;
  double Relief = 1800;
  double Mean = 60;
  double Gain = 0.5;
  int Seed = 1;
};
#endif
