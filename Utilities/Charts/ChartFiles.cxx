// SPDX-License-Identifier: BSD-3-Clause
#include "ChartFiles.h"

#include "LogChart.h"
#include "SvgDrawing.h"

#include <fstream>
#include <functional>
#include <stdexcept>

namespace nephoscope
{
namespace charts
{
namespace
{
/// Writes beside and then renames, so that no file is ever half there.
void writeWhole(
  const std::filesystem::path& path, const std::function<void(const std::filesystem::path&)>& write)
{
  const std::filesystem::path beside = path.string() + ".part";
  write(beside);
  std::filesystem::rename(beside, path);
}
}

void makeFolder(const std::string& folder)
{
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (problem)
  {
    throw std::runtime_error("cannot make the folder " + folder + ": " + problem.message());
  }
}

void writeText(const std::filesystem::path& path, const std::string& text)
{
  writeWhole(path,
    [&text](const std::filesystem::path& beside)
    {
      std::ofstream file(beside, std::ios::binary);
      file << text;
      file.close();
      if (!file)
      {
        throw std::runtime_error(
          "cannot write " + beside.string() + "; is there room on the disk?");
      }
    });
}

void writeChartFiles(const LogChart& chart, const std::string& folder, const std::string& name)
{
  const std::string svg = drawChart(chart);
  const std::filesystem::path path = std::filesystem::path(folder) / name;
  writeText(path.string() + ".svg", svg);
  writeWhole(path.string() + ".png",
    [&svg](const std::filesystem::path& beside) { writePng(svg, beside.string(), 1.5); });
}
}
}
