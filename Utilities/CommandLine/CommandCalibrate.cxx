// SPDX-License-Identifier: BSD-3-Clause
// nephoscope calibrate: what methods cost on this machine and by how much they are wrong, as constants of models.
#include "Commands.h"
#include "Failure.h"
#include "Messages.h"
#include "MethodScenes.h"
#include "OutputFile.h"

#include <CLI/CLI.hpp>
#include <CalibrationFile.h>
#include <MethodChoice.h>
#ifdef NEPHOSCOPE_FITS
#include <FitMethods.h>
#include <FitProblem.h>
#endif
#include <SceneParts.h>
#include <vtkCloudModelSelector.h>

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <map>
#include <memory>
#include <unistd.h>

namespace nephoscope::program
{
namespace
{
struct CalibrateOptions
{
  std::string output;
  int scenes = 6;
  int width = 64;
  int runs = 2;
};

#ifdef NEPHOSCOPE_FITS
// Scenes of these seeds are fitted; those of the next ones are held out.
constexpr int FirstSeed = 1;
constexpr int FirstHeldOut = 1001;
constexpr int Pixels = 200;
constexpr double DearestSeconds = 0.4;

using Trials = std::map<std::string, TriedMethod>;

void addTrials(Trials& methods, int seed, bool heldOut, const CalibrateOptions& options)
{
  for (const MethodScene& scene : methodScenes(seed, options.width))
  {
    for (const TriedOption& tried : tryMethods(scene, Pixels, options.runs, DearestSeconds))
    {
      if (tried.bound > 0)
      {
        continue; // its error is another
      }
      methods[tried.model].trials.push_back(
        { tried.work, tried.coarseness, tried.seconds, tried.error, heldOut });
    }
    Messages::throwIfError("calibrate");
  }
}

Trials measured(const CalibrateOptions& options)
{
  Trials methods;
  for (const MethodModel& model : vtkCloudModelSelector::GetModels())
  {
    methods[model.name] = { model.name, model.work, model.scale > 0, {} };
  }
  for (int n = 0; n < options.scenes; ++n)
  {
    if (::isatty(STDERR_FILENO) != 0)
    {
      std::fprintf(stderr, "\r\033[K%d of %d", n, options.scenes);
    }
    addTrials(methods, FirstSeed + n, false, options);
    addTrials(methods, FirstHeldOut + n, true, options);
  }
  return methods;
}

Calibration calibrated(const CalibrateOptions& options)
{
  const Trials methods = measured(options);
  std::string left;
  Calibration calibration;
  calibration.what = "methods";
  calibration.command = "nephoscope calibrate --scenes " + std::to_string(options.scenes) +
    " --width " + std::to_string(options.width) + " --runs " + std::to_string(options.runs);
  for (const MethodModel& model : vtkCloudModelSelector::GetModels())
  {
    const TriedMethod& method = methods.at(model.name);
    const auto fitted = std::count_if(method.trials.begin(), method.trials.end(),
      [](const MethodTrial& trial) { return !trial.heldOut; });
    if (model.work.empty())
    {
      continue; // nothing costs nothing
    }
    if (fitted <= static_cast<long>(std::max<std::size_t>(2, model.work.size())))
    {
      left += (left.empty() ? "" : ", ") + model.name;
      continue;
    }
    try
    {
      for (Fit& fit : fitMethod(method))
      {
        calibration.fits.push_back(std::move(fit));
      }
    }
    catch (const FitError& error)
    {
      note(error.what());
      left += (left.empty() ? "" : ", ") + model.name;
    }
  }
  if (!left.empty())
  {
    note("too few measurements for these, whose built-in constants stay: " + left);
  }
  return calibration;
}
#else
Calibration calibrated(const CalibrateOptions&)
{
  throw Failure("this nephoscope was built without Ceres and cannot fit a calibration; install "
                "libceres-dev and build again, or use one that was made elsewhere");
}
#endif

void print(const Calibration& calibration)
{
  for (const Fit& fit : calibration.fits)
  {
    std::cout << std::left << std::setw(36) << fit.name << std::setprecision(3);
    for (const FittedParameter& p : fit.parameters)
    {
      std::cout << ' ' << p.name << ' ' << p.value;
    }
    std::cout << "; " << fit.training.cases << " + " << fit.heldOut.cases
              << " cases, held out 95 % " << fit.heldOut.p95 << '\n';
  }
}

void runCalibrate(const CalibrateOptions& options)
{
  if (!options.output.empty())
  {
    if (extensionOf(options.output) != "json")
    {
      throw UsageFailure(options.output + ": the name must end in .json");
    }
    checkWritable(options.output);
  }
  const Calibration calibration = calibrated(options);
  print(calibration);
  if (!options.output.empty())
  {
    writeText(options.output, calibrationText(calibration));
  }
}
}

void addCalibrate(CLI::App& app)
{
  auto options = std::make_shared<CalibrateOptions>();
  CLI::App* const command = app.add_subcommand(
    "calibrate", "Measure what methods cost on this machine and how exact they are.");
  command
    ->add_option("-o,--output", options->output,
      "JSON file; named methods.json in the folder of NEPHOSCOPE_CALIBRATION it is used")
    ->type_name("FILE.json");
  command
    ->add_option("--scenes", options->scenes, "sets of scenes to fit, as many to check; default 6")
    ->type_name("N")
    ->check(CLI::Range(3, 1000));
  command->add_option("--width", options->width, "of the small pictures, pixels; default 64")
    ->type_name("W")
    ->check(CLI::Range(16, 1024));
  command->add_option("--runs", options->runs, "of each method, the fastest counts; default 2")
    ->type_name("N")
    ->check(CLI::Range(1, 100));
  addThreadsOption(*command);
  command->footer("Nothing else should run meanwhile.\nExample:\n"
                  "  nephoscope calibrate -o methods.json && export NEPHOSCOPE_CALIBRATION=$PWD");
  command->callback([options] { runCalibrate(*options); });
}
}
