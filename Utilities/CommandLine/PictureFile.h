// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file PictureFile.h
 * @brief A picture's size as the command line says it, and the picture as a file.
 */
#ifndef PictureFile_h
#define PictureFile_h

#include <array>
#include <string>

class vtkCloudscape;

namespace nephoscope::program
{
/// "1024x768". @throw UsageFailure for anything else
std::array<int, 2> sizeOf(const std::string& text);

/// Write the picture that has been drawn, whole or not at all. @throw Failure
void writePicture(vtkCloudscape* scape, double exposure, const std::string& path);
}
#endif
