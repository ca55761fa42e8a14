// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudFit
 * @brief Fits the constants of an approximation to its exact integrals: a subject's own, or those of the input.
 *
 * Least squares with bounds and one thread (nephoscope::FitProblem), with covariances, and errors on cases that the fit has not seen.
 *
 * Input    port 0, optional: of the subject density, which needs it, a vtkImageData or vtkRectilinearGrid with the point array Extinction (1/m,
 *          one component); axes with one point are those along which nothing varies. Of the subject transmittance a vtkTable
 *          whose first column is optical depths that occur, in place of the subject's own cases; those that are 0 are left out.
 * Output   port 0: vtkTable, a row for each parameter of each fit. Columns:
 *          Fit, Parameter (strings); Value, StandardError, Lower, Upper (double); AtBound, Determined (0 or 1);
 *          Covariance (double, with this and the fit's other parameters in their order; as many components as the largest fit has
 *          parameters, unused ones 0); of the whole fit, repeated in its rows: Residual (string: absolute, relative, perceptual),
 *          TrainingCases, TrainingBias, TrainingRMS, TrainingMedian, Training95, TrainingMax, the same with HeldOut, Iterations,
 *          Seconds, Warnings (string, joined by "; ").
 * Parameters: see the setters.
 * Method   Levenberg and Marquardt's; see FitProblem.h, and each subject's header for its cases and exact integrals.
 * Errors   no such subject; an input that the subject has no use for, or lacks; a tolerance that is not met; a range that is empty, negative or not finite; no solution: vtkErrorMacro, empty output.
 * Cost     A second to a minute by subject; one thread, the same bits in every run but for Seconds.
 * Limits   A parameter that the cases do not determine is reported in Warnings and Determined, with a standard error that says
 *          no more than its bounds.
 * @sa Utilities/Doc/fits.md, TestCloudFit.cxx
 */
#ifndef vtkCloudFit_h
#define vtkCloudFit_h

#include "vtkCloudFitsModule.h" // for export macro
#include "vtkTableAlgorithm.h"

#include <string> // for members

class VTKCLOUDFITS_EXPORT vtkCloudFit : public vtkTableAlgorithm
{
public:
  static vtkCloudFit* New();
  vtkTypeMacro(vtkCloudFit, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// What is fitted. Default "transmittance"; GetSubjectName has all.
  void SetSubject(const char* subject);
  const char* GetSubject() const { return this->Subject.c_str(); }
  ///@}

  ///@{
  /// The range of the subject's variable, 0 <= from < to. Default (0, 0): the subject's own.
  vtkSetVector2Macro(Range, double);
  vtkGetVector2Macro(Range, double);
  ///@}

  ///@{
  /// Of density: the largest error of line integrals, relative root mean square, above 0. Default 0.05.
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  ///@}
  ///@{
  /// Of density: Gaussians at most, 1 to 100. Default 32.
  vtkSetMacro(Terms, int);
  vtkGetMacro(Terms, int);
  ///@}

  ///@{
  /// What can be fitted.
  static int GetNumberOfSubjects();
  static const char* GetSubjectName(int index); ///< null if there is none
  ///@}

protected:
  vtkCloudFit();
  ~vtkCloudFit() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkCloudFit(const vtkCloudFit&) = delete;
  void operator=(const vtkCloudFit&) = delete;

  std::string Subject = "transmittance";
  double Range[2] = { 0, 0 };
  double Tolerance = 0.05;
  int Terms = 32;
};

#endif
