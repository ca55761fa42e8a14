// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file ChartFiles.h
 * @brief Charts and texts as whole files in a folder. All throw std::runtime_error.
 */
#ifndef ChartFiles_h
#define ChartFiles_h

#include <filesystem>
#include <string>

namespace nephoscope
{
namespace charts
{
struct LogChart;

/// A folder, made if it is not there.
void makeFolder(const std::string& folder);

/// A text, written beside and renamed, so that no file is ever half there.
void writeText(const std::filesystem::path& path, const std::string& text);

/// FOLDER/NAME.svg and FOLDER/NAME.png.
void writeChartFiles(const LogChart& chart, const std::string& folder, const std::string& name);
}
}
#endif
