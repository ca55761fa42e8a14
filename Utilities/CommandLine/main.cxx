// SPDX-License-Identifier: BSD-3-Clause
// nephoscope: gridded cloudiness in, a cloud picture out. Each subcommand is a file of its own.
#include "Commands.h"
#include "Failure.h"
#include "Messages.h"
#include "Nearest.h"
#include "OutputFile.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <iostream>
#include <new>

namespace
{
using namespace nephoscope::program;

/// Read the command line and run the subcommand, which is a callback of the parser.
int run(CLI::App& app, int argc, char** argv)
{
  try
  {
    app.parse(argc, argv);
    return Success;
  }
  catch (const CLI::ParseError& error)
  {
    if (error.get_exit_code() == 0)
    {
      return app.exit(error); // --help, --version
    }
    const auto chosen = app.get_subcommands();
    const std::string first = argc > 1 && *argv[1] ? argv[1] : "-";
    if (chosen.empty() && first.front() != '-')
    {
      std::vector<std::string> commands;
      for (const CLI::App* const command : app.get_subcommands({}))
      {
        commands.push_back(command->get_name());
      }
      note("there is no command '" + first + "'; " + suggestion(first, commands) +
        "; see nephoscope --help");
      return UsageError;
    }
    note(std::string(error.what()) + "; see nephoscope " +
      (chosen.empty() ? std::string() : chosen.front()->get_name() + " ") + "--help");
    return UsageError;
  }
  catch (const Failure& failure)
  {
    note(failure.what());
    return failure.code();
  }
  catch (const std::bad_alloc&)
  {
    note("out of memory; try a smaller --size, or a part of the data");
  }
  catch (const std::exception& error)
  {
    note(bareMessage(error.what()));
  }
  return RunTimeError;
}

int program(int argc, char** argv)
{
  handleInterrupts();
  Messages::install();

  CLI::App app(
    "Clouds of climate and weather models as pictures whose light is right.", "nephoscope");
  app.set_version_flag("--version", "nephoscope " NEPHOSCOPE_VERSION);
  app.require_subcommand(1);
  app.footer("Examples:\n"
             "  nephoscope info climate.nc\n"
             "  nephoscope convert climate.nc contour.vtp --value 0.15\n"
             "  nephoscope render --data climate.nc --style texture -o clouds.png\n"
             "Exit codes: 0 done, 1 run-time error, 2 usage, 130 interrupted.");
  addInfo(app);
  addConvert(app);
  addRender(app);
  addAnimate(app);
  addChart(app);
  addFit(app);
  addCalibrate(app);
  const int code = run(app, argc, argv);
  std::cout.flush();
  if (!std::cout)
  {
    note("standard output cannot be written");
    return RunTimeError;
  }
  return code;
}
}

int main(int argc, char** argv)
{
  try
  {
    return program(argc, argv);
  }
  catch (...)
  {
    // Not even a message could be made.
    std::fputs("nephoscope: out of memory\n", stderr);
    return RunTimeError;
  }
}
