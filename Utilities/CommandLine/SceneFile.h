// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file SceneFile.h
 * @brief A scene from a YAML file, and the reference of such files.
 */
#ifndef SceneFile_h
#define SceneFile_h

#include "Scene.h"

#include <string>

namespace nephoscope::program
{
/**
 * A scene from YAML text.
 * @param text the file's contents, @param name the file's path, for messages; relative paths are relative to its folder
 * @throw UsageFailure "name:line: ..." for text that is not YAML, an unknown key (with the nearest known one), a wrong type or
 * a value out of range
 */
Scene parseScene(const std::string& text, const std::string& name);

/// The same from a file. @throw Failure if it cannot be read
Scene readScene(const std::string& path);

/// Every section and key with type, unit, default and meaning, as Markdown.
std::string sceneReference();
}
#endif
