// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudHeightFieldSource
 * @brief Made-up clouds between two height functions (Max 1986 section 2), as numbers and as surfaces.
 *
 * Output   vtkPolyData with the field data array HeightField (double), by which vtkCloudHeightField, vtkCloudHeightFieldShadow and
 *          vtkCloudHeightFieldVolume know the clouds. With Dimensions of 2 x 2 or more also the surfaces, for any renderer: quadrangles of the tops, then of the
 *          bottoms, over the grid cells where a corner has F > 0, with point normals (float) outwards; heights below the
 *          edge are held at the cloud plane. Points are distances in metres, z up.
 * Parameters: see the setters.
 * Method   nephoscope::cumulusShape unless waves were added by AddWave, which then are the only ones; the polynomial is added in
 *          both cases. Frames are moments of a closed cycle (nephoscope::cycleFrame): the waves are first made to repeat along
 *          CycleVector.
 * Errors   a number that is no number or out of its range: vtkErrorMacro, an empty output.
 * Cost     nothing for the numbers; some 0.5 us a point of the surfaces, in parallel; the same bits for any number of threads.
 * Limits   surfaces are jagged by a grid cell at the clouds' edges, where they have a vertical tangent.
 * @sa vtkCloudHeightField, vtkCloudHeightFieldShadow, vtkCloudHeightFieldVolume, nephoscope::HeightField, nephoscope::Cumulus
 */
#ifndef vtkCloudHeightFieldSource_h
#define vtkCloudHeightFieldSource_h

#include "vtkCloudSourcesModule.h" // for export macro
#include "vtkPolyDataAlgorithm.h"

#include <memory> // for members

class VTKCLOUDSOURCES_EXPORT vtkCloudHeightFieldSource : public vtkPolyDataAlgorithm
{
public:
  static vtkCloudHeightFieldSource* New();
  vtkTypeMacro(vtkCloudHeightFieldSource, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// z of the cloud plane, m. Default 1000.
  vtkSetMacro(PlaneHeight, double);
  vtkGetMacro(PlaneHeight, double);
  ///@}
  ///@{
  /// c, roundness of the edges, m, >= 0. Default 30.
  vtkSetMacro(Roundness, double);
  vtkGetMacro(Roundness, double);
  ///@}
  ///@{
  /// D, how far bottoms reach below the plane, m, > 0. Default 80.
  vtkSetMacro(BaseDepth, double);
  vtkGetMacro(BaseDepth, double);
  ///@}
  ///@{
  /// Coefficients of 1, x, y, x^2, x y and y^2, added to the waves: m, 1, 1, 1/m, 1/m, 1/m. Default 0: clouds everywhere alike.
  vtkSetVector6Macro(Polynomial, double);
  vtkGetVector6Macro(Polynomial, double);
  ///@}

  ///@{
  /// Made-up waves: how many, 1 to 64, default 12; how many of the shortest are billows, default 7.
  vtkSetClampMacro(NumberOfWaves, int, 1, 64);
  vtkGetMacro(NumberOfWaves, int);
  vtkSetClampMacro(NumberOfBillows, int, 0, 64);
  vtkGetMacro(NumberOfBillows, int);
  ///@}
  ///@{
  /// Length of the longest, m, > 0. Default 1500.
  vtkSetMacro(Wavelength, double);
  vtkGetMacro(Wavelength, double);
  ///@}
  ///@{
  /// Length of each over that of the one before, 0 to 1. Default 0.72.
  vtkSetClampMacro(Shortening, double, 0.01, 1);
  vtkGetMacro(Shortening, double);
  ///@}
  ///@{
  /// Amplitude of the longest, m. Default 160. The others' are as their lengths to the power Smoothness, default 1.
  vtkSetMacro(Relief, double);
  vtkGetMacro(Relief, double);
  vtkSetMacro(Smoothness, double);
  vtkGetMacro(Smoothness, double);
  ///@}
  ///@{
  /// Share of the sky, 0 to 1. Default 0.4.
  vtkSetClampMacro(Cover, double, 0, 1);
  vtkGetMacro(Cover, double);
  ///@}
  ///@{
  /// Makes clouds with equal parameters different. Default 1.
  vtkSetMacro(Seed, int);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /// A wave of one's own: amplitude (m), wave numbers along x and y (rad/m), phase (rad), and 0 for its sine, 1 for the
  /// absolute value, 2 for the root of that.
  void AddWave(double amplitude, double p, double q, double phase, int shape);
  void RemoveAllWaves();
  ///@}

  ///@{
  /// By what waves travel in a cycle of Frames frames, m; Frame is which one this is. Default (0, 0), 0 of 1.
  vtkSetVector2Macro(CycleVector, double);
  vtkGetVector2Macro(CycleVector, double);
  vtkSetMacro(Frame, int);
  vtkGetMacro(Frame, int);
  vtkSetClampMacro(Frames, int, 1, VTK_INT_MAX);
  vtkGetMacro(Frames, int);
  ///@}

  ///@{
  /// Points of the surfaces along x and y, and the least and greatest x and y that they span, m. Default none, (-5000, 5000,
  /// -5000, 5000).
  vtkSetVector2Macro(Dimensions, int);
  vtkGetVector2Macro(Dimensions, int);
  vtkSetVector4Macro(Bounds, double);
  vtkGetVector4Macro(Bounds, double);
  ///@}

protected:
  vtkCloudHeightFieldSource();
  ~vtkCloudHeightFieldSource() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override;

  double PlaneHeight = 1000;
  double Roundness = 30;
  double BaseDepth = 80;
  double Polynomial[6] = { 0, 0, 0, 0, 0, 0 };
  int NumberOfWaves = 12;
  int NumberOfBillows = 7;
  double Wavelength = 1500;
  double Shortening = 0.72;
  double Relief = 160;
  double Smoothness = 1;
  double Cover = 0.4;
  int Seed = 1;
  double CycleVector[2] = { 0, 0 };
  int Frame = 0;
  int Frames = 1;
  int Dimensions[2] = { 0, 0 };
  double Bounds[4] = { -5000, 5000, -5000, 5000 };

private:
  vtkCloudHeightFieldSource(const vtkCloudHeightFieldSource&) = delete;
  void operator=(const vtkCloudHeightFieldSource&) = delete;

  bool Validate();

  struct Waves;
  std::unique_ptr<Waves> Added;
};
#endif
