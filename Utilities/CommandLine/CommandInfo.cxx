// SPDX-License-Identifier: BSD-3-Clause
// nephoscope info: what a file holds and how it is understood.
#include "Commands.h"
#include "Messages.h"
#include "ModelFile.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <vtkCloudNetCDFReader.h>

#include <iomanip>
#include <iostream>
#include <memory>

namespace nephoscope::program
{
namespace
{
using Json = nlohmann::ordered_json;

struct InfoOptions
{
  Data data;
  bool json = false;
};

Json timesOf(vtkCloudNetCDFReader* reader)
{
  Json times = Json::array();
  for (int i = 0; i < reader->GetNumberOfTimeSteps(); ++i)
  {
    times.push_back(reader->GetTimeLabel(i));
  }
  return times;
}

/// "Height: hypsometric, from ..." as { "Height": "hypsometric, from ..." }.
Json derivationsOf(vtkCloudNetCDFReader* reader)
{
  Json derived = Json::object();
  for (int i = 0; i < reader->GetNumberOfDerivations(); ++i)
  {
    const std::string text = reader->GetDerivation(i);
    const auto colon = text.find(": ");
    if (colon == std::string::npos)
    {
      derived[text] = "";
    }
    else
    {
      derived[text.substr(0, colon)] = text.substr(colon + 2);
    }
  }
  return derived;
}

Json describe(vtkCloudNetCDFReader* reader)
{
  const int* const boxes = reader->GetFileDimensions();
  Json variables = Json::object();
  for (int i = 0; i < reader->GetNumberOfRoles(); ++i)
  {
    variables[reader->GetRoleName(i)] = reader->GetVariableOfRole(i);
  }
  Json warnings = Json::array();
  for (int i = 0; i < reader->GetNumberOfWarnings(); ++i)
  {
    warnings.push_back(reader->GetWarning(i));
  }
  return { { "file", reader->GetFileName() }, { "dimensions", { boxes[0], boxes[1], boxes[2] } },
    { "times", timesOf(reader) }, { "timeUnits", reader->GetTimeUnits() },
    { "calendar", reader->GetCalendar() },
    { "verticalCoordinate", reader->GetVerticalCoordinate() },
    { "geometry", reader->GetChosenGeometryAsString() }, { "variables", variables },
    { "derived", derivationsOf(reader) }, { "warnings", warnings } };
}

void printLine(const std::string& name, const std::string& text)
{
  std::cout << std::left << std::setw(26) << name << ' ' << text << '\n';
}

void printPairs(const std::string& name, const Json& pairs)
{
  std::cout << name << '\n';
  for (const auto& [key, value] : pairs.items())
  {
    printLine("  " + key, value.get<std::string>());
  }
}

void printTable(const Json& info)
{
  const Json& n = info["dimensions"];
  printLine("file", info["file"]);
  printLine("dimensions",
    n[0].dump() + " x " + n[1].dump() + " x " + n[2].dump() + " boxes (east, north, up)");
  printLine("vertical coordinate", info["verticalCoordinate"]);
  printLine("geometry", info["geometry"]);
  const Json& times = info["times"];
  printLine("times",
    times.empty() ? "none"
                  : std::to_string(times.size()) + ", " + times.front().get<std::string>() +
        (times.size() > 1 ? " to " + times.back().get<std::string>() : std::string()));
  printPairs("variables", info["variables"]);
  if (!info["derived"].empty())
  {
    printPairs("derived", info["derived"]);
  }
  for (const Json& warning : info["warnings"])
  {
    printLine("warning", warning);
  }
}

void runInfo(const InfoOptions& options)
{
  const auto reader = openModelFile(options.data);
  const Json info = describe(reader);
  Messages::takeWarnings(); // they are part of the information
  if (options.json)
  {
    // A name in a file need not be UTF-8.
    std::cout << info.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
  }
  else
  {
    printTable(info);
  }
}
}

void addInfo(CLI::App& app)
{
  auto options = std::make_shared<InfoOptions>();
  CLI::App* const command =
    app.add_subcommand("info", "Say what a NetCDF file holds and how it is understood.");
  command->add_option("file", options->data.file, "NetCDF file")->type_name("FILE")->required();
  command->add_flag("--json", options->json, "print JSON instead of a table");
  addVariableOption(*command, options->data.variables);
  command->footer("Example:\n  nephoscope info climate.nc --json");
  command->callback([options] { runInfo(*options); });
}
}
