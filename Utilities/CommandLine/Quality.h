// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Quality.h
 * @brief A scene's quality: the methods that meet it, and how good the picture has become.
 * @sa vtkCloudModelSelector, vtkCloudPictureCheck, Utilities/Doc/choosing.md
 */
#ifndef Quality_h
#define Quality_h

#include "Scene.h"

class vtkCloudModelSelector;
class vtkCloudscape;

namespace nephoscope::program
{
class Progress;

/// Give a selector the calibration `methods`; without one that can be read it keeps the built-in constants, which is said on standard error.
void useCalibration(vtkCloudModelSelector* selector);

/**
 * Give the bodies methods by the calibration `methods`; without one that can be read, by built-in constants, which is said on
 * standard error.
 * @return what was chosen and why; nothing if no quality is asked for, and then nothing is changed
 * @throw Failure if the quality cannot be reached, with what can
 */
std::string chooseMethods(const Quality& quality, vtkCloudscape* scape);

/// Check pixels of a picture that has been drawn, and tell. Its bodies keep the exact methods.
std::string verified(const Quality& quality, vtkCloudscape* scape, int pixels, Progress& progress);
}
#endif
