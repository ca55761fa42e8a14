// SPDX-License-Identifier: BSD-3-Clause
// nephoscope fit: constants of an approximation, fitted to its exact integrals.
#include "Commands.h"
#include "Failure.h"
#include "Messages.h"
#include "OutputFile.h"

#include <CLI/CLI.hpp>
#include <CalibrationFile.h>
#ifdef NEPHOSCOPE_FITS
#include <FitSubjects.h>
#endif

#include <cstdio>
#include <iomanip>
#include <iostream>
#include <memory>

namespace nephoscope::program
{
namespace
{
struct FitOptions
{
  std::string what;
  std::string range; ///< "a:b", or empty
  std::string output;
};

#ifdef NEPHOSCOPE_FITS
std::optional<FitRange> rangeOf(const std::string& text)
{
  if (text.empty())
  {
    return std::nullopt;
  }
  FitRange range{};
  char rest = 0;
  if (std::sscanf(text.c_str(), "%lf:%lf%c", &range.from, &range.to, &rest) != 2)
  {
    throw UsageFailure("--range " + text + ": say two numbers as a:b, 0:2 for instance");
  }
  return range;
}

Calibration fitted(const FitOptions& options)
{
  try
  {
    return runFit(options.what, rangeOf(options.range));
  }
  catch (const FitError& error)
  {
    throw Failure(error.what());
  }
}

std::string subjectList()
{
  std::string text = "What can be fitted, and what --range means there:\n";
  for (const FitSubject& subject : fitSubjects())
  {
    text += "  " + subject.name + ": " + subject.about + "; " + subject.range + "\n";
  }
  return text;
}
#else
Calibration fitted(const FitOptions&)
{
  throw Failure("this nephoscope was built without Ceres; install libceres-dev and build again");
}

std::string subjectList()
{
  return "This nephoscope was built without Ceres and cannot fit.\n";
}
#endif

/// A line for each fit: its constants with their standard errors, and its error on held-out cases.
void print(const Calibration& calibration)
{
  for (const Fit& fit : calibration.fits)
  {
    std::cout << std::left << std::setw(40) << fit.name << std::setprecision(6);
    for (const FittedParameter& p : fit.parameters)
    {
      std::cout << ' ' << p.name << ' ' << p.value;
    }
    std::cout << std::setprecision(3) << "; " << fit.residual << " error rms " << fit.heldOut.rms
              << ", 95 % " << fit.heldOut.p95 << ", max " << fit.heldOut.max << "; "
              << fit.iterations << " iterations, " << fit.seconds << " s\n";
    for (const std::string& warning : fit.warnings)
    {
      note(fit.name + ": " + warning);
    }
  }
}

void runFitCommand(const FitOptions& options)
{
  if (!options.output.empty())
  {
    if (extensionOf(options.output) != "json")
    {
      throw UsageFailure(options.output + ": the name must end in .json");
    }
    checkWritable(options.output);
  }
  const Calibration calibration = fitted(options);
  print(calibration);
  if (!options.output.empty())
  {
    writeText(options.output, calibrationText(calibration));
  }
}
}

void addFit(CLI::App& app)
{
  auto options = std::make_shared<FitOptions>();
  CLI::App* const command =
    app.add_subcommand("fit", "Fit the constants of an approximation to its exact integrals.");
  command->add_option("what", options->what, "what to fit: see below")
    ->type_name("WHAT")
    ->required();
  command->add_option("--range", options->range, "range of the cases; default: see below")
    ->type_name("A:B");
  command
    ->add_option("-o,--output", options->output,
      "JSON file for the constants, with their errors; the same bytes in every run")
    ->type_name("FILE.json");
  command->footer(
    subjectList() + "Example:\n  nephoscope fit transmittance --range 0:3 -o transmittance.json");
  command->callback([options] { runFitCommand(*options); });
}
}
