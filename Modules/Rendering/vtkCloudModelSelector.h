// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudModelSelector
 * @brief Gives the bodies of a vtkCloudscape the cheapest methods that are exact enough, or the most exact ones in a given time.
 *
 *  1. Each part of the scene that can be drawn in several ways offers them: light in height-field clouds, light in haze, cells and
 *     their order, shadows, uniform haze; and to be left out, with an error that is proven. Other bodies only take their time.
 *  2. Models say what each would cost and by how much it would be wrong, from the picture's size and the bodies' data.
 *  3. The errors of the parts may add up to the tolerance; how it is split among them is what makes the sum of their times least
 *     (nephoscope::MethodChoice). The bodies get their methods.
 *
 * Input    a vtkCloudscape with its camera and bodies. Bodies' inputs are brought up to date where their data matter.
 * Parameters: see the setters.
 * Method   An error is that of a pixel's radiance, relative (nephoscope/RadianceError.h). A method's predicted error is what 95 % of the
 *          pixels do not exceed, in at least 95 % of scenes like those of the calibration; what is left out changes no pixel by more.
 *          Rays are compared: how many there are in a pixel (Samples) is not chosen.
 * Errors   no scape, no camera, neither or both of Tolerance and Seconds, a tolerance or time that cannot be reached (which says what
 *          can): vtkErrorMacro, and all methods stay as they were.
 * Cost     milliseconds, and an evaluation of each point's extinction of a cell volume.
 * Limits   seconds are those of the machine of the calibration, with nothing else running on it. A part that is left out is
 *          judged by bounds that hold for any view, so that much stays in that cannot be seen. A shadow is taken to be of clouds with the
 *          SunExtinction of the scene's vtkCloudHeightField; without one it stays.
 *          Bodies that it does not know are drawn as they are, and neither their time nor their error is counted.
 * @sa vtkCloudPictureCheck, nephoscope::MethodChoice, nephoscope::partsOf, Utilities/Doc/choosing.md
 */
#ifndef vtkCloudModelSelector_h
#define vtkCloudModelSelector_h

#include "vtkCloudRenderingModule.h" // for export macro
#include "vtkObject.h"

#include <memory> // for members
#include <string> // for members

class vtkCloudscape;

#ifndef __VTK_WRAP__
namespace nephoscope
{
struct Calibration;
struct MethodModel;
struct ScenePart;
}
#include <vector> // for parts
#endif

class VTKCLOUDRENDERING_EXPORT vtkCloudModelSelector : public vtkObject
{
public:
  static vtkCloudModelSelector* New();
  vtkTypeMacro(vtkCloudModelSelector, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Whose bodies are given methods. Required.
  void SetCloudscape(vtkCloudscape* scape);
  vtkCloudscape* GetCloudscape() const;
  ///@}
  ///@{
  /// Largest error, relative radiance, > 0. Default 0: not asked for.
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  ///@}
  ///@{
  /// Longest time of a picture, s, > 0. Default 0: not asked for.
  vtkSetMacro(Seconds, double);
  vtkGetMacro(Seconds, double);
  ///@}

  /// Choose and set the methods. False, after vtkErrorMacro, if there is no choice.
  bool Select();

  /// The exact method for each part, and nothing left out.
  void SelectExact();

  ///@{
  /// Of the last Select.
  vtkGetMacro(PredictedError, double);
  vtkGetMacro(PredictedSeconds, double);
  /// A line for each part: what was taken, why, and what was not; and what was left out.
  std::string Explain() const;
  /// The method that a part was given, "March, steps of 5 m" of "light in haze" say; empty if there is no such part.
  std::string GetTaken(const std::string& part) const;
  ///@}

#ifndef __VTK_WRAP__
  /// Constants for the models, fits "NAME seconds" and "NAME error" of nephoscope::methodModels(). A model without its fits keeps
  /// the constants that are built in; Explain says so. Default none.
  void SetCalibration(const nephoscope::Calibration& calibration);

  /// What there is to choose from; for calibrations.
  std::vector<nephoscope::ScenePart> GetParts() const;
  /// All methods there are.
  static const std::vector<nephoscope::MethodModel>& GetModels();
#endif

protected:
  vtkCloudModelSelector();
  ~vtkCloudModelSelector() override;

private:
  vtkCloudModelSelector(const vtkCloudModelSelector&) = delete;
  void operator=(const vtkCloudModelSelector&) = delete;

  bool IsReady();

  double Tolerance = 0;
  double Seconds = 0;
  double PredictedError = 0;
  double PredictedSeconds = 0;
  struct Internals;
  std::unique_ptr<Internals> Data;
};
#endif
