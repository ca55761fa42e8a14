// SPDX-License-Identifier: BSD-3-Clause
#include "Commands.h"
#include "Failure.h"

#include <CLI/CLI.hpp>
#include <NumberText.h>
#include <vtkSMPTools.h>

#include <algorithm>

namespace nephoscope::program
{
CLI::Validator numberFrom(double least, double most)
{
  const std::string words = numberText(least) + " to " + numberText(most);
  return CLI::Validator(
    [least, most, words](const std::string& text)
    {
      double value = 0;
      const bool good = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
      return good ? std::string() : "'" + text + "' is not a number from " + words;
    },
    "");
}

void addThreadsOption(CLI::App& command)
{
  command
    .add_option_function<int>(
      "--threads",
      [](int threads)
      { vtkSMPTools::Initialize(std::min(threads, vtkSMPTools::GetEstimatedNumberOfThreads())); },
      "threads to compute with; default, and most: as many as the machine has")
    ->type_name("N")
    ->check(CLI::Range(1, 1024))
    ->trigger_on_parse();
}

void addDataOptions(CLI::App& command, Data& data)
{
  command
    .add_option("--time", data.time,
      "time step: an ISO 8601 date, or its beginning; seconds on the file's time axis; or an index "
      "from 0. Default 0")
    ->type_name("T");
  command
    .add_option("--geometry", data.geometry,
      "how the grid lies in the scene; default: globe for global data, else by the file's "
      "projection")
    ->type_name("map|globe|local")
    ->check(CLI::IsMember({ "automatic", "map", "globe", "local" }).description(""));
  command
    .add_option("--exaggeration", data.exaggeration,
      "factor on heights; default: 1 in data, by extent in pictures")
    ->type_name("X")
    ->check(numberFrom(1e-3, 1e4));
  addVariableOption(command, data.variables);
}

void addVariableOption(CLI::App& command, std::map<std::string, std::string>& variables)
{
  command
    .add_option_function<std::vector<std::string>>(
      "--variable",
      [&variables](const std::vector<std::string>& choices)
      {
        for (const std::string& choice : choices)
        {
          const auto equals = choice.find('=');
          if (equals == std::string::npos || equals == 0 || equals + 1 == choice.size())
          {
            throw UsageFailure(
              "--variable " + choice + " is not ROLE=NAME, such as CloudFraction=CLDTOT");
          }
          variables[choice.substr(0, equals)] = choice.substr(equals + 1);
        }
      },
      "the file's variable for a role: CloudFraction, LiquidWater, IceWater, Temperature, ...; may "
      "be repeated")
    ->type_name("ROLE=NAME")
    ->allow_extra_args(false)
    ->take_all();
}
}
