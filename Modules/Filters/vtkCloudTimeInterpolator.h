// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudTimeInterpolator
 * @brief Clouds between two file times: carried along the wind from both, instead of one fading into the other.
 *
 * Where a requested time lies between two of the input's, the filter
 *  1. asks its input for both,
 *  2. follows the air of each point back to the earlier and on to the later time,
 *  3. reads the cloud arrays there and blends the two linearly in time (nephoscope::carriedValue),
 *  4. makes all else, points included, linear in time.
 *
 * Input    vtkStructuredGrid, of the same size at all times, with Wind (m/s, along the scene's axes), Height (m) and the field data
 *          Geometry, PlanetRadius, HeightScale as vtkCloudNetCDFReader gives them; time keys in seconds.
 * Output   the grid at the requested time, any in the input's range. Carried: CloudFraction, LiquidWater, IceWater. Linear in time:
 *          points and all other arrays of real numbers. What both times do not have alike is that of the nearer, and so are other
 *          arrays and which points are hidden. At a time of the input the input passes unchanged, to the bit.
 * Parameters: see the setters.
 * Method   f = (1 - a) f_0(x_0) + a f_1(x_1), see CarriedField.h. No value lies outside those that both times have there: readings
 *          are linear, or cubic and clamped. A value that is not finite is left out; a visible point always has one. The result
 *          depends on the requested time and the input alone.
 * Errors   no Wind or Height, a grid whose lines do not run along meridians and parallels (or x and y), times that do not rise, a time
 *          outside the range, a grid that changes its size, an input that fails: vtkErrorMacro, return 0.
 * Cost     two trajectories a point, and 8 (linear) or 72 (cubic) reads an array and time. Spread over threads, the same bits for any
 *          number. Memory: the grids of two times and their wind.
 * Pieces   each asks for the whole extent, as winds may reach any part of it, and gives its block of columns.
 * Limits   Air from beyond the edge of a regional grid is read at the edge. A cloud that stays while the
 *          air blows through it (over a mountain, at a front) is not carried by the wind; see below.
 *          An input that fails at the second time ends the update in VTK's own pipelines; ParaView gives filters executives of its
 *          own, which do not call a filter then: the update goes on without end.
 *
 * Whether carrying is better than fading depends on whether the clouds go with the air. Steps that were left out and interpolated
 * from their neighbours, carried against faded (`nephoscope chart --interpolation`): root mean square error; correlation of the gradients
 * with the true ones; energy of the gradients over the true one.
 *
 *                                                          error             correlation     energy
 *   ERA5, 200-300 hPa, 1 h: fraction, 1 of 2 steps         0.053  : 0.059    0.84 :  0.70    0.45 : 0.55
 *                           fraction, 1 of 3               0.057  : 0.081    0.82 :  0.50    0.41 : 0.54
 *                           ice,      1 of 2               0.81e-6: 0.78e-6  0.75 :  0.74    0.41 : 0.67
 *                           ice,      1 of 3               0.93e-6: 1.05e-6  0.74 :  0.58    0.32 : 0.58
 *   WRF, hurricane, 3 h:    liquid,   1 of 2               82e-6  : 54e-6    -0.01:  0.29    0.82 : 0.62
 *                           fraction, 1 of 2               0.20   : 0.15     0.01 :  0.08    0.68 : 0.60
 *
 * In the upper troposphere's drift carrying wins, the more the longer the steps, but for the error of ice an hour from both times;
 * it blurs more than fading does, which shows each structure twice. In a hurricane, where convection lives for less than a step and
 * the air goes half the picture in one, it loses: turn CarryClouds off.
 * @sa CarriedField.h, vtkCloudTextureAdvection, TestCloudTimeInterpolator.cxx
 */
#ifndef vtkCloudTimeInterpolator_h
#define vtkCloudTimeInterpolator_h

#include "vtkCloudFiltersModule.h" // for export macro
#include "vtkStructuredGridAlgorithm.h"

#include <memory> // for members

class VTKCLOUDFILTERS_EXPORT vtkCloudTimeInterpolator : public vtkStructuredGridAlgorithm
{
public:
  static vtkCloudTimeInterpolator* New();
  vtkTypeMacro(vtkCloudTimeInterpolator, vtkStructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Whether clouds are carried by the wind. Off: they fade, like all else, and no Wind is needed. Default on.
  vtkSetMacro(CarryClouds, bool);
  vtkGetMacro(CarryClouds, bool);
  vtkBooleanMacro(CarryClouds, bool);
  ///@}

  enum InterpolationType
  {
    Linear = 0,
    Cubic
  };
  ///@{
  /// How cloud arrays are read between the points; linear blurs more. Default Cubic.
  vtkSetClampMacro(Interpolation, int, Linear, Cubic);
  vtkGetMacro(Interpolation, int);
  void SetInterpolationToLinear() { this->SetInterpolation(Linear); }
  void SetInterpolationToCubic() { this->SetInterpolation(Cubic); }
  ///@}

  ///@{
  /// Error that a trajectory may have over an interval, m; sets the number of substeps. Default 5000, 0.001 to 1e7.
  vtkSetClampMacro(Tolerance, double, 1e-3, 1e7);
  vtkGetMacro(Tolerance, double);
  ///@}

protected:
  vtkCloudTimeInterpolator();
  ~vtkCloudTimeInterpolator() override;

  vtkExecutive* CreateDefaultExecutive() override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkCloudTimeInterpolator(const vtkCloudTimeInterpolator&) = delete;
  void operator=(const vtkCloudTimeInterpolator&) = delete;

  void Interpolate(vtkStructuredGrid* output);

  bool CarryClouds = true;
  int Interpolation = Cubic;
  double Tolerance = 5000;

  struct Interval;
  std::unique_ptr<Interval> Between;
};
#endif
