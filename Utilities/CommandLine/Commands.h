// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Commands.h
 * @brief The subcommands: one file each, which adds its options to the command line and does its work when it is chosen.
 */
#ifndef Commands_h
#define Commands_h

#include "Scene.h"

namespace CLI
{
class App;
class Validator;
}

namespace nephoscope::program
{
void addInfo(CLI::App& app);
void addConvert(CLI::App& app);
void addRender(CLI::App& app);
void addAnimate(CLI::App& app);
void addChart(CLI::App& app);
void addFit(CLI::App& app);
void addCalibrate(CLI::App& app);

/// Accepts numbers of a range, ends included; CLI::Range lets NaN pass.
CLI::Validator numberFrom(double least, double most);

/// Options that several subcommands share. What is not given on the command line stays as it is.
void addThreadsOption(CLI::App& command);
void addDataOptions(
  CLI::App& command, Data& data); ///< --time, --geometry, --exaggeration, --variable
void addVariableOption(CLI::App& command, std::map<std::string, std::string>& variables);
}
#endif
