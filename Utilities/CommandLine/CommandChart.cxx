// SPDX-License-Identifier: BSD-3-Clause
// nephoscope chart: how fast and how exact, here and against VTK's own filters and mappers; what is hard, and what comes out.
#include "Commands.h"
#include "Failure.h"
#include "Report.h"
#include "Stability.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
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
    ->add_option("--threads", options->report.threads,
      "threads to compute with; default: as many as the machine has")
    ->type_name("N")
    ->check(CLI::Range(1, 1024));
  command->footer("Peers that draw in a window are left out where there is no display.\n"
                  "Examples:\n"
                  "  xvfb-run -a nephoscope chart -o chart --quick\n"
                  "  nephoscope chart --stability");
  command->callback([options] { runChart(*options); });
}
}
