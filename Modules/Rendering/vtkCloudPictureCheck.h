// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudPictureCheck
 * @brief Works some pixels of a drawn vtkCloudscape out anew by exact methods, and says by how much the picture is wrong.
 *
 *  1. Draws pixels at random, the same for the same Seed.
 *  2. Gives all parts their exact methods, nothing left out (vtkCloudModelSelector::SelectExact).
 *  3. Draws each ray of each pixel as a picture of its own, so that nothing is shared between rays.
 *
 * Input    a vtkCloudscape whose output is up to date. Its bodies keep the exact methods; its output stays.
 * Output   errors of radiance, relative (nephoscope/RadianceError.h): median, 95 %, largest.
 * Events   ProgressEvent after each pixel, with the share of them that is done.
 * Errors   no cloudscape with a picture: vtkErrorMacro, false.
 * Cost     that of getting every body ready for each ray: milliseconds, a tenth of a second for a large cell volume.
 * Limits   textures and terrain are drawn as they are: what they show is their method.
 * @sa vtkCloudModelSelector
 */
#ifndef vtkCloudPictureCheck_h
#define vtkCloudPictureCheck_h

#include "vtkCloudRenderingModule.h" // for export macro
#include "vtkObject.h"

#include <vector> // for members

class vtkCloudscape;

class VTKCLOUDRENDERING_EXPORT vtkCloudPictureCheck : public vtkObject
{
public:
  static vtkCloudPictureCheck* New();
  vtkTypeMacro(vtkCloudPictureCheck, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// How many pixels, each drawn once at most. Default 100.
  vtkSetClampMacro(NumberOfPixels, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfPixels, int);
  ///@}
  ///@{
  /// Of the choice of pixels. Default 1.
  vtkSetMacro(Seed, int);
  vtkGetMacro(Seed, int);
  ///@}

  /// Work out the pixels. False, after vtkErrorMacro, if there is no picture.
  bool Check(vtkCloudscape* scape);

  ///@{
  /// Of the last Check.
  vtkGetMacro(MedianError, double);
  vtkGetMacro(Error95, double);
  vtkGetMacro(LargestError, double);
  int GetNumberOfChecked() const { return static_cast<int>(this->Errors.size()); }
  /// The share of pixels whose error is larger.
  double GetShareAbove(double error) const;
  ///@}

#ifndef __VTK_WRAP__
  /// The exact radiance of the pixels checked, three numbers each, and their indices in the picture.
  const std::vector<double>& GetExact() const
  {
    return this->Exact;
  }
  const std::vector<vtkIdType>& GetPixels() const
  {
    return this->Pixels;
  }
#endif

protected:
  vtkCloudPictureCheck() = default;
  ~vtkCloudPictureCheck() override = default;

private:
  vtkCloudPictureCheck(const vtkCloudPictureCheck&) = delete;
  void operator=(const vtkCloudPictureCheck&) = delete;

  void ChoosePixels(vtkIdType count);

  int NumberOfPixels = 100;
  int Seed = 1;
  double MedianError = 0;
  double Error95 = 0;
  double LargestError = 0;
  std::vector<vtkIdType> Pixels;
  std::vector<double> Exact;
  std::vector<double> Errors;
};
#endif
