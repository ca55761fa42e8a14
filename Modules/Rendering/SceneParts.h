// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file SceneParts.h
 * @brief The parts of a picture that several methods can draw: the one table of methods, and what each would mean for a scene.
 *
 * A method has an entry in methodModels(), with what its time is proportional to and the constants that hold until a calibration
 * gives others; and a place where partsOf() offers it, with its settings and how they are made.
 *
 * Leaving a part out is a method too. Its error is not a model's but a bound that no pixel exceeds (nephoscope::errorOfLeavingOut).
 * @sa vtkCloudModelSelector, MethodChoice.h
 */
#ifndef SceneParts_h
#define SceneParts_h

#include <functional>
#include <string>
#include <vector>

class vtkCloudscape;

namespace nephoscope
{
/// A method's entry.
struct MethodModel
{
  std::string name; ///< as in a calibration, whose fits are "NAME seconds" and "NAME error"
  std::vector<std::string> work; ///< what its time is a sum of
  std::vector<double> seconds;   ///< for one of each
  double scale = 0;              ///< of its error
  double power = 0;
  bool isBounded =
    true; ///< false: no calibration's scenes bound the error, which stays as it is here
};

/// All methods.
const std::vector<MethodModel>& methodModels();

/// A method with settings for a part of a certain scene.
struct SceneOption
{
  std::string name;            ///< "March, steps of 5"
  std::string model;           ///< in methodModels()
  std::vector<double> work;    ///< as the model's
  double coarseness = 1;       ///< what the model's error grows with
  double bound = 0;            ///< of the error of what is left out, proven; added to the model's
  bool exact = false;          ///< the reference
  bool leavesOut = false;      ///< computes less than the whole
  std::function<void()> apply; ///< gives the bodies the method
};

struct ScenePart
{
  std::string name;
  std::vector<SceneOption> options;
};

/// The parts of a picture, those with one option only too: they cost time. @pre the scape has a camera
std::vector<ScenePart> partsOf(vtkCloudscape* scape);
}
#endif
