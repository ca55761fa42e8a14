// SPDX-License-Identifier: BSD-3-Clause
#include "CalibrationPath.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <dlfcn.h>

namespace nephoscope
{
namespace
{
namespace fs = std::filesystem;

constexpr int Levels = 4; ///< lib/x86_64-linux-gnu/libX.so is three below its prefix

/// The file that this code was loaded from: the library, or a program that it was linked into.
fs::path ownFile()
{
  Dl_info info;
  const bool found = dladdr(reinterpret_cast<void*>(&calibrationFolders), &info) != 0;
  return found && info.dli_fname ? fs::path(info.dli_fname) : fs::path();
}

/// Adds the folders of a prefix to which a file may belong.
void addAbove(const fs::path& file, std::vector<std::string>& folders)
{
  std::error_code none;
  fs::path prefix = fs::weakly_canonical(file, none);
  for (int level = 0; level < Levels && prefix.has_relative_path(); ++level)
  {
    prefix = prefix.parent_path();
    const std::string folder = (prefix / NEPHOSCOPE_CALIBRATION_FOLDER).string();
    if (std::find(folders.begin(), folders.end(), folder) == folders.end())
    {
      folders.push_back(folder);
    }
  }
}
}

std::vector<std::string> calibrationFolders()
{
  std::vector<std::string> folders;
  const char* const wanted = std::getenv("NEPHOSCOPE_CALIBRATION");
  if (wanted && *wanted)
  {
    folders.emplace_back(wanted);
  }
  addAbove(ownFile(), folders);
  addAbove("/proc/self/exe", folders);
  return folders;
}

std::string calibrationPath(const std::string& what)
{
  const std::vector<std::string> folders = calibrationFolders();
  std::string looked;
  for (const std::string& folder : folders)
  {
    const fs::path path = fs::path(folder) / (what + ".json");
    std::error_code none;
    if (fs::is_regular_file(path, none))
    {
      return path.string();
    }
    looked += (looked.empty() ? "" : ", ") + folder;
  }
  throw ReadError("there is no calibration " + what + ".json in " + looked +
    "; set NEPHOSCOPE_CALIBRATION to the folder that has it");
}
}
