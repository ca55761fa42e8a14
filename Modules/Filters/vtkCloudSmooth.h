// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudSmooth
 * @brief Smooths fields along the layers of a grid by a stated length: rounder clouds before contouring.
 *
 * Max applied "a smoothing filter to the simulation output, before generating the contour polygons, to get rounder clouds"
 * (1994). Here it is diffusion along the layers i, j, measured by the points' distances and not by index, so that it is the
 * same in metres at every latitude of a globe. Each pass takes an implicit step along all lines j and one along all lines i.
 * Layers do not mix.
 *
 * Input    port 0: vtkStructuredGrid, vtkRectilinearGrid or vtkImageData.
 *          Point arrays named by AddSmoothedArray, any number of components; CloudFraction if none is named.
 * Output   a data set of the same kind with these arrays smoothed (float; double where they were), all else passed.
 * Parameters: see the setters.
 * Method   For each array f, n = Passes times: (1 - s D_j)(1 - s D_i) f' = f with s = Length^2 / (2 n) and D the finite-volume
 *          second derivative along a line. Where steps d are uniform, a wave exp(i kappa x) is multiplied by
 *              [1 + (Length^2 / (2 n)) (4 / d^2) sin^2(kappa d / 2)]^-n
 *          which for small d and many passes is exp(-kappa^2 Length^2 / 2), a Gaussian with the standard deviation Length.
 *          Two passes are close to that where it matters: half of the amplitude remains at a wavelength of 4.9 Length (a Gaussian: 5.3).
 *          The sum of area times value over a layer is conserved, and values stay in the range they had. A point's
 *          area is the product of the half-steps along i and along j.
 *          A globe's seam, where the first and last points of every row along i coincide to 1e-4 of a step, is closed: lines
 *          along i are rings. Towards a pole steps along i vanish; one shorter than 1/1000 of that along j counts as that, so
 *          that a pole's row becomes one value. Nothing passes over a pole.
 * Errors   no such point array: vtkErrorMacro, empty output.
 * Cost     O(points * Passes) for each component; all threads, the same bits for any number of them; 40 bytes a point.
 * Pieces   implicit steps join whole lines: each piece asks for the whole extent, smooths it and gives its block of columns.
 * Limits   NaN stays NaN, and nothing flows to or from there; so do hidden points. Distances are those in the scene: an
 *          exaggerated terrain's slopes are longer. Vector components are smoothed one by one.
 * @sa nephoscope::DiffusionLine, vtkCloudContour, TestCloudSmooth.cxx
 */
#ifndef vtkCloudSmooth_h
#define vtkCloudSmooth_h

#include "vtkCloudFiltersModule.h" // for export macro
#include "vtkDataSetAlgorithm.h"

#include <string> // for members
#include <vector> // for members

class VTKCLOUDFILTERS_EXPORT vtkCloudSmooth : public vtkDataSetAlgorithm
{
public:
  static vtkCloudSmooth* New();
  vtkTypeMacro(vtkCloudSmooth, vtkDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The standard deviation of the smoothing, in the unit of the points' coordinates, >= 0. 0 changes nothing. Default
  /// 150,000: m, for global data of about a degree.
  vtkSetClampMacro(Length, double, 0.0, 1e30);
  vtkGetMacro(Length, double);
  ///@}

  ///@{
  /// Number of passes, 1 to 100: more come closer to a Gaussian, at the same Length. Default 2.
  vtkSetClampMacro(Passes, int, 1, 100);
  vtkGetMacro(Passes, int);
  ///@}

  ///@{
  /// The point arrays to smooth; CloudFraction if none is named.
  void AddSmoothedArray(const char* name);
  void ClearSmoothedArrays();
  ///@}

protected:
  vtkCloudSmooth();
  ~vtkCloudSmooth() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkCloudSmooth(const vtkCloudSmooth&) = delete;
  void operator=(const vtkCloudSmooth&) = delete;

  bool Smooth(vtkDataSet* input, vtkDataSet* output);

  double Length = 150e3;
  int Passes = 2;
  std::vector<std::string> Names;
};

#endif
