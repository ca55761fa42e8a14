// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudHeightFieldShadow
 * @brief What clouds between two height functions let through of the sun: their shadow, on a grid.
 *
 * Input    any vtkDataObject with the field data array HeightField (vtkCloudHeightFieldSource).
 * Output   vtkImageData of Dimensions points about Center with Spacing, z the cloud plane's; point array SunTransmittance (float).
 * Parameters: see the setters.
 * Method   exp(-Extinction (g - h)) where F > 0, else 1: the vertical thickness counts, for any sun (Max 1986 section 6, with the
 *          exponential in place of his quadratic).
 * Errors   no such array, fewer than 2 points either way or over 2^28, a Spacing that is not above 0: vtkErrorMacro, an
 *          empty output.
 * Cost     some 20 ns a point with 16 waves, in parallel; the same bits for any number of threads.
 * @sa nephoscope::HeightFieldShadow, vtkCloudHeightFieldVolume, vtkCloudTerrain, vtkCloudWater, vtkCloudHaze
 */
#ifndef vtkCloudHeightFieldShadow_h
#define vtkCloudHeightFieldShadow_h

#include "vtkCloudSourcesModule.h" // for export macro
#include "vtkImageAlgorithm.h"

class VTKCLOUDSOURCES_EXPORT vtkCloudHeightFieldShadow : public vtkImageAlgorithm
{
public:
  static vtkCloudHeightFieldShadow* New();
  vtkTypeMacro(vtkCloudHeightFieldShadow, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// 1/m, >= 0. Default 0.0093.
  vtkSetMacro(Extinction, double);
  vtkGetMacro(Extinction, double);
  ///@}
  ///@{
  /// Points along x and y. Default 1024 x 1024.
  vtkSetVector2Macro(Dimensions, int);
  vtkGetVector2Macro(Dimensions, int);
  ///@}
  ///@{
  /// The grid's middle, m. Default (0, 0).
  vtkSetVector2Macro(Center, double);
  vtkGetVector2Macro(Center, double);
  ///@}
  ///@{
  /// Distance of neighbours, m, > 0. Default 40.
  vtkSetMacro(Spacing, double);
  vtkGetMacro(Spacing, double);
  ///@}

protected:
  vtkCloudHeightFieldShadow() = default;
  ~vtkCloudHeightFieldShadow() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override
  {
    return 1; // the input has no extent
  }
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  double Extinction = 0.0093;
  int Dimensions[2] = { 1024, 1024 };
  double Center[2] = { 0, 0 };
  double Spacing = 40;

private:
  vtkCloudHeightFieldShadow(const vtkCloudHeightFieldShadow&) = delete;
  void operator=(const vtkCloudHeightFieldShadow&) = delete;

  double GetFirst(int axis) const
  {
    return this->Center[axis] - 0.5 * (this->Dimensions[axis] - 1) * this->Spacing;
  }
};
#endif
