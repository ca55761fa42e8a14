// SPDX-License-Identifier: BSD-3-Clause
// nephoscope chart: how fast and how exact, here and against VTK's own filters and mappers; what is hard, and what comes out.
#include "ChartFiles.h"
#include "Commands.h"
#include "Failure.h"
#include "LeftOutSteps.h"
#include "Messages.h"
#include "ModelFile.h"
#include "Report.h"
#include "Stability.h"

#include <CLI/CLI.hpp>
#include <CloudArrays.h>
#include <vtkCloudNetCDFReader.h>
#include <vtkPointData.h>
#include <vtkStructuredGrid.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <thread>
#include <unistd.h>

namespace nephoscope::program
{
namespace
{
struct ChartOptions
{
  charts::ReportOptions report;
  bool stability = false;
  std::vector<std::string> interpolation; ///< files
};

/// What is being done, on one line that is written over; only on a terminal.
void showOnTerminal(const std::string& what)
{
  if (::isatty(STDERR_FILENO) != 0)
  {
    std::fprintf(stderr, "\r\033[K%s", what.substr(0, 79).c_str());
    std::fflush(stderr);
  }
}

void printStability()
{
  const int failures = stability::printTable(std::cout);
  if (failures > 0)
  {
    throw Failure(std::to_string(failures) +
      " situations do not have their defined answer; see the rows that say NO");
  }
}

/// Every cloud quantity of a file, one of two and one of three steps kept. What cannot be compared is told and left out.
void leaveOutSteps(const std::string& file, std::vector<charts::LeftOutSteps>& compared)
{
  Data data;
  data.file = file;
  const auto reader = openModelFile(data);
  const auto first = readStep(reader, std::nullopt, true);
  for (const char* const quantity :
    { arrays::CloudFraction, arrays::LiquidWater, arrays::IceWater })
  {
    for (const int stride : { 2, 3 })
    {
      if (!first->GetPointData()->GetArray(quantity))
      {
        continue;
      }
      showOnTerminal(file + ": " + quantity + ", 1 of " + std::to_string(stride) + " steps");
      const std::string name = std::filesystem::path(file).filename().string();
      try
      {
        compared.push_back(charts::leaveOut(reader, name, quantity, stride));
      }
      catch (const std::runtime_error& reason)
      {
        note(std::string("left out: ") + reason.what());
      }
      Messages::throwIfError(file);
    }
  }
}

void chartInterpolation(const ChartOptions& options)
{
  std::vector<charts::LeftOutSteps> compared;
  for (const std::string& file : options.interpolation)
  {
    leaveOutSteps(file, compared);
  }
  showOnTerminal("");
  Messages::takeWarnings();
  if (compared.empty())
  {
    throw Failure("no file has clouds that vary and three time steps; there is nothing to compare");
  }
  charts::makeFolder(options.report.folder);
  charts::writeInterpolationChart(compared, options.report.folder);
  std::printf("%-24s %-14s %-6s %10s %10s %7s  %-14s %s\n", "file", "quantity", "kept", "carried",
    "faded", "ratio", "  correlation", "  energy");
  for (const charts::LeftOutSteps& c : compared)
  {
    std::printf("%-24s %-14s 1 of %d %10.3g %10.3g %7.3f %7.3f %7.3f %7.3f %7.3f\n", c.name.c_str(),
      c.quantity.c_str(), c.stride, c.carried.error, c.faded.error, c.carried.error / c.faded.error,
      c.carried.pattern, c.faded.pattern, c.carried.energy, c.faded.energy);
  }
  std::cout << std::flush << options.report.folder << "/interpolation.svg\n";
}

void runChart(ChartOptions& options)
{
  if (options.stability)
  {
    printStability();
    return;
  }
  if (options.report.folder.empty())
  {
    throw UsageFailure("where to? Say -o DIR, or --stability for the table");
  }
  if (!options.interpolation.empty())
  {
    chartInterpolation(options);
    return;
  }
  options.report.progress = showOnTerminal;
  charts::writeReport(options.report);
  showOnTerminal("");
  std::cout << options.report.folder << "/index.html\n";
}
}

void addChart(CLI::App& app)
{
  auto options = std::make_shared<ChartOptions>();
  options->report.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  CLI::App* const command = app.add_subcommand("chart",
    "Measure contours, volumes and trajectories against VTK's own, and chart speed against "
    "accuracy.");
  command
    ->add_option("-o,--output", options->report.folder,
      "folder for chart.json, SVG and PNG charts and index.html")
    ->type_name("DIR");
  command->add_flag("--quick", options->report.quick,
    "small sizes, under a minute; else the full selection, some minutes and 3 GB of memory");
  command->add_flag("--stability", options->stability,
    "print the table of situations where such methods fail: naive, ours, defined answer");
  command
    ->add_option("--interpolation", options->interpolation,
      "instead, leave out time steps of these NetCDF files and chart how well clouds carried along "
      "the wind, and clouds that fade, replace them")
    ->type_name("FILE");
  command
    ->add_option("--threads", options->report.threads,
      "threads to compute with; default: as many as the machine has")
    ->type_name("N")
    ->check(CLI::Range(1, 1024));
  command->footer("Peers that draw in a window are left out where there is no display.\n"
                  "Examples:\n"
                  "  xvfb-run -a nephoscope chart -o chart --quick\n"
                  "  nephoscope chart --stability\n"
                  "  nephoscope chart -o chart --interpolation day.nc");
  command->callback([options] { runChart(*options); });
}
}
