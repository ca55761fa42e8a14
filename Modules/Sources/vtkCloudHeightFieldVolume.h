// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudHeightFieldVolume
 * @brief Clouds between two height functions as voxels of extinction, to compare methods for volumes with.
 *
 * Input    any vtkDataObject with the field data array HeightField (vtkCloudHeightFieldSource).
 * Output   vtkImageData of Dimensions points that span Bounds; point array Extinction (float, 1/m).
 * Parameters: see the setters.
 * Method   a point at height z gets Extinction |[z - dz/2, z + dz/2] cut [H + h, H + g]| / dz where F > 0, else 0: the share of
 *          its voxel's column that is cloud, exact in z (a box filter); a sample in x and y. H is the cloud plane's height, dz the
 *          distance of layers. In each column the sum times dz is Extinction (g - h), if the layers hold the cloud.
 * Errors   no such array; fewer than 2 points along an axis or over 2^28; Bounds of no extent or not finite; an Extinction out of
 *          range: vtkErrorMacro, an empty output. After an abort the output is empty, too.
 * Cost     some 0.3 us a column and 5 ns a voxel, in parallel; the same bits for any number of threads. Memory is 4 bytes a
 *          voxel.
 * Limits   what reaches past the outermost layers by over dz/2 is cut off. Edges are jagged by a voxel; optical depths of slanted
 *          rays through the interpolated voxels converge with first order.
 * @sa vtkCloudHeightFieldShadow, nephoscope::HeightField, TestCloudHeightFieldVolume.cxx
 */
#ifndef vtkCloudHeightFieldVolume_h
#define vtkCloudHeightFieldVolume_h

#include "vtkCloudSourcesModule.h" // for export macro
#include "vtkImageAlgorithm.h"

class VTKCLOUDSOURCES_EXPORT vtkCloudHeightFieldVolume : public vtkImageAlgorithm
{
public:
  static vtkCloudHeightFieldVolume* New();
  vtkTypeMacro(vtkCloudHeightFieldVolume, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Of the cloud, 1/m, 0 to 1e9. Default 0.0093.
  vtkSetMacro(Extinction, double);
  vtkGetMacro(Extinction, double);
  ///@}
  ///@{
  /// Points along x, y and z, 2 or more each. Default 256 x 256 x 64.
  vtkSetVector3Macro(Dimensions, int);
  vtkGetVector3Macro(Dimensions, int);
  ///@}
  ///@{
  /// The least and greatest x, y and z of points, m. Default (-5000, 5000, -5000, 5000, 900, 1500).
  vtkSetVector6Macro(Bounds, double);
  vtkGetVector6Macro(Bounds, double);
  ///@}

protected:
  vtkCloudHeightFieldVolume() = default;
  ~vtkCloudHeightFieldVolume() override = default;

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
  int Dimensions[3] = { 256, 256, 64 };
  double Bounds[6] = { -5000, 5000, -5000, 5000, 900, 1500 };

private:
  vtkCloudHeightFieldVolume(const vtkCloudHeightFieldVolume&) = delete;
  void operator=(const vtkCloudHeightFieldVolume&) = delete;

  bool Validate();
  void GetGrid(double origin[3], double spacing[3]) const;
};
#endif
