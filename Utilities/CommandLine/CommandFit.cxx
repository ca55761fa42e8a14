// SPDX-License-Identifier: BSD-3-Clause
// nephoscope fit: constants of an approximation, fitted to its exact integrals; densities as sums of Gaussians.
#include "Commands.h"
#include "Failure.h"
#include "FitData.h"
#include "Messages.h"
#include "OutputFile.h"
#include "Progress.h"
#include "SceneFile.h"

#include <CLI/CLI.hpp>
#include <CalibrationFile.h>
#ifdef NEPHOSCOPE_FITS
#include <FitDensity.h>
#include <FitSubjects.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iomanip>
#include <iostream>
#include <memory>
#include <sstream>

namespace nephoscope::program
{
namespace
{
struct FitOptions
{
  std::string what;
  std::string range; ///< "a:b", or empty
  std::string output;
  std::string scene; ///< a file, or empty
  Data data;
  std::vector<double> column; ///< longitude and latitude, or empty
  std::vector<double> box;    ///< as Box, or empty
  std::optional<double> tolerance;
  std::optional<int> terms;
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

Scene sceneOf(const FitOptions& options)
{
  return options.scene.empty() ? sceneOfStyle("volume", options.data.file)
                               : readScene(options.scene);
}

/// The options that say where cases come from, as they were given.
std::string sourceOf(const FitOptions& options)
{
  std::ostringstream text;
  text.precision(12);
  text << (options.scene.empty() ? " --data " + options.data.file : " --scene " + options.scene);
  const auto list = [&text](const char* name, const std::vector<double>& numbers)
  {
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      text << (i ? "," : name) << numbers[i];
    }
  };
  list(" --column ", options.column);
  list(" --box ", options.box);
  text << (options.data.time ? " --time " + *options.data.time : "");
  return text.str();
}

DensityGrid densityOf(const FitOptions& options, Progress& progress)
{
  std::optional<Box> box;
  if (!options.box.empty())
  {
    box.emplace();
    std::copy(options.box.begin(), options.box.end(), box->begin());
  }
  if (!options.column.empty() && !options.data.file.empty())
  {
    if (!(std::abs(options.column[0]) <= 360) || !(std::abs(options.column[1]) <= 90))
    {
      throw UsageFailure("--column is LON,LAT: a longitude from -360 to 360 and a latitude from "
                         "-90 to 90 degrees, such as 30,10");
    }
    return columnOf(options.data, { options.column[0], options.column[1] });
  }
  if (!options.scene.empty() && box)
  {
    return volumeOf(readScene(options.scene), *box, progress);
  }
  if (extensionOf(options.data.file) == "vti")
  {
    return volumeOf(options.data.file, box);
  }
  throw UsageFailure("fit density needs a density: --data FILE.nc --column LON,LAT, or --data "
                     "FILE.vti, or --scene FILE --box X0,X1,Y0,Y1,Z0,Z1");
}

FitProgress barOf(Progress& progress)
{
  return [&progress](double done)
  {
    progress.show("fit", done);
    return true;
  };
}

Calibration fittedDensity(const FitOptions& options)
{
  Progress progress;
  const DensityGrid density = densityOf(options, progress);
  std::ostringstream command;
  const double tolerance = options.tolerance.value_or(0.05);
  const int terms = options.terms.value_or(32);
  command << "nephoscope fit density" << sourceOf(options) << " --tolerance " << tolerance
          << " --terms " << terms;
  return { "density", command.str(), fitDensity(density, { tolerance, terms }, barOf(progress)) };
}

Calibration fittedConstants(const FitOptions& options)
{
  const std::optional<FitRange> range = rangeOf(options.range);
  Progress progress;
  if (options.scene.empty() && options.data.file.empty())
  {
    return runFit(options.what, range, barOf(progress));
  }
  const std::vector<double> depths = depthsOf(sceneOf(options), progress);
  Calibration calibration = runFit(options.what, range, barOf(progress), depths);
  calibration.command += sourceOf(options);
  return calibration;
}

/// Whether a subject's cases can come from a scene or a file. @throw UsageFailure if there is no such subject
bool takesSource(const std::string& what)
{
  std::string known = "density";
  for (const FitSubject& subject : fitSubjects())
  {
    if (subject.name == what)
    {
      return static_cast<bool>(subject.runForDepths);
    }
    known += ", " + subject.name;
  }
  if (what != "density")
  {
    throw UsageFailure("there is no fit '" + what + "'; there are " + known);
  }
  return true;
}

/// Options that would change nothing are a mistake.
void refuseIdle(const FitOptions& options)
{
  const bool source = !options.scene.empty() || !options.data.file.empty();
  if (!takesSource(options.what) && source)
  {
    throw UsageFailure("fit " + options.what + " takes no --scene or --data");
  }
  if (options.data.file.empty() && (options.data.time || !options.data.variables.empty()))
  {
    throw UsageFailure("--time and --variable go with --data");
  }
  const bool ofDensity =
    !options.column.empty() || !options.box.empty() || options.tolerance || options.terms;
  if (options.what != "density" && ofDensity)
  {
    throw UsageFailure("--column, --box, --tolerance and --terms go with fit density");
  }
  if (options.what == "density" && !options.range.empty())
  {
    throw UsageFailure("fit density takes no --range");
  }
}

Calibration fitted(const FitOptions& options)
{
  refuseIdle(options);
  if (!options.scene.empty() && !options.data.file.empty())
  {
    throw UsageFailure("give either --scene or --data; see nephoscope fit --help");
  }
  try
  {
    return options.what == "density" ? fittedDensity(options) : fittedConstants(options);
  }
  catch (const FitError& error)
  {
    throw Failure(error.what());
  }
}

std::string subjectList()
{
  std::string text =
    "What can be fitted, and what --range means there:\n"
    "  density: the fewest Gaussians that meet a tolerance, to the extinction of a "
    "column or a volume; no range\n";
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
    if (fit.heldOut.cases > 0) // a part of a sum has no error of its own
    {
      std::cout << std::setprecision(3) << (fit.parameters.empty() ? " " : "; ") << fit.residual
                << " error rms " << fit.heldOut.rms << ", 95 % " << fit.heldOut.p95 << ", max "
                << fit.heldOut.max << "; " << fit.iterations << " iterations, " << fit.seconds
                << " s";
    }
    std::cout << '\n';
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
    checkWritable(options.output, { options.scene, options.data.file });
  }
  const Calibration calibration = fitted(options);
  print(calibration);
  if (!options.output.empty())
  {
    writeText(options.output, calibrationText(calibration));
  }
}
}

namespace
{
void addSources(CLI::App& command, FitOptions& options)
{
  command
    .add_option("--scene", options.scene,
      "scene whose rays' optical depths are the cases (transmittance), or whose heightField is the "
      "density")
    ->type_name("FILE.yaml");
  command
    .add_option("--data", options.data.file,
      "data file instead: NetCDF, seen as a volume (transmittance) or its column (density); or VTK "
      "image with an array Extinction (density)")
    ->type_name("FILE");
  command.add_option("--time", options.data.time, "time step of the data file; default 0")
    ->type_name("T");
  command.add_option("--column", options.column, "longitude and latitude of the column, degrees")
    ->type_name("LON,LAT")
    ->delimiter(',')
    ->expected(2);
  command.add_option("--box", options.box, "part of the scene or the image, m")
    ->type_name("X0,X1,Y0,Y1,Z0,Z1")
    ->delimiter(',')
    ->expected(6);
  command
    .add_option("--tolerance", options.tolerance,
      "of the density's line integrals, relative rms; default 0.05")
    ->type_name("E")
    ->check(numberFrom(1e-6, 1));
  command.add_option("--terms", options.terms, "Gaussians at most; default 32")
    ->type_name("N")
    ->check(CLI::Range(1, 100));
  addVariableOption(command, options.data.variables);
}
}

void addFit(CLI::App& app)
{
  auto options = std::make_shared<FitOptions>();
  CLI::App* const command =
    app.add_subcommand("fit", "Fit the constants of an approximation to its exact integrals.");
  command->add_option("WHAT", options->what, "what to fit: see below")->type_name("")->required();
  command->add_option("--range", options->range, "range of the cases; default: see below")
    ->type_name("A:B");
  addSources(*command, *options);
  command
    ->add_option("-o,--output", options->output,
      "JSON file for the constants, with their errors; the same bytes in every run")
    ->type_name("FILE.json");
  command->footer(subjectList() +
    "Examples:\n  nephoscope fit transmittance --range 0:3 -o transmittance.json\n"
    "  nephoscope fit transmittance --scene clouds.yaml\n"
    "  nephoscope fit density --data climate.nc --column 30,10 --tolerance 0.01 -o column.json");
  command->callback([options] { runFitCommand(*options); });
}
}
