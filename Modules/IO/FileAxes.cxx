// SPDX-License-Identifier: BSD-3-Clause
#include "FileAxes.h"

#include "CloudRoles.h"
#include "Units.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>
#include <utility>

namespace nephoscope
{
namespace
{
std::string lowered(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool oneOf(const std::string& text, std::initializer_list<const char*> list)
{
  return std::any_of(list.begin(), list.end(), [&](const char* item) { return text == item; });
}

Axis axisOfStandardName(const std::string& name)
{
  if (oneOf(name, { "longitude", "grid_longitude", "projection_x_coordinate" }))
  {
    return Axis::X;
  }
  if (oneOf(name, { "latitude", "grid_latitude", "projection_y_coordinate" }))
  {
    return Axis::Y;
  }
  if (name == "time")
  {
    return Axis::Time;
  }
  const bool vertical = oneOf(name,
                          { "air_pressure", "altitude", "height", "alevel", "alevhalf",
                            "model_level_number", "geopotential_height" }) ||
    name.rfind("atmosphere_", 0) == 0 || name.rfind("height_above_", 0) == 0;
  return vertical ? Axis::Vertical : Axis::None;
}

Axis axisOfAttributes(const FileVariable& variable)
{
  const std::string axis = variable.text("axis");
  static const std::vector<std::pair<const char*, Axis>> letters = { { "X", Axis::X },
    { "Y", Axis::Y }, { "Z", Axis::Vertical }, { "T", Axis::Time } };
  for (const auto& [letter, value] : letters)
  {
    if (axis == letter)
    {
      return value;
    }
  }
  const Axis standard = axisOfStandardName(variable.text("standard_name"));
  if (standard != Axis::None)
  {
    return standard;
  }
  const std::string units = lowered(variable.text("units"));
  if (units.find(" since ") != std::string::npos)
  {
    return Axis::Time;
  }
  if (oneOf(units, { "degrees_east", "degree_east", "degrees_e", "degree_e", "degreee" }))
  {
    return Axis::X;
  }
  if (oneOf(units, { "degrees_north", "degree_north", "degrees_n", "degree_n", "degreen" }))
  {
    return Axis::Y;
  }
  const bool vertical = !variable.text("positive").empty() ||
    (!units.empty() && unitConversion(units, "Pa").has_value());
  return vertical ? Axis::Vertical : Axis::None;
}

Axis axisOfName(std::string name)
{
  name = lowered(name);
  while (name.size() > 2 && std::isdigit(static_cast<unsigned char>(name.back())))
  {
    name.pop_back();
  }
  name.erase(name.find_last_not_of('_') + 1);
  if (oneOf(name,
        { "lon", "longitude", "x", "west_east", "west_east_stag", "rlon", "srlon", "slon",
          "grid_longitude", "nx", "i", "ni", "xc", "xt", "xm", "xh", "lons", "nlon", "longitude_u",
          "xu", "xlon" }))
  {
    return Axis::X;
  }
  if (oneOf(name,
        { "lat", "latitude", "y", "south_north", "south_north_stag", "rlat", "srlat", "slat",
          "grid_latitude", "ny", "j", "nj", "yc", "yt", "ym", "yh", "lats", "nlat", "latitude_v",
          "yv", "ylat" }))
  {
    return Axis::Y;
  }
  if (oneOf(name,
        { "lev", "level", "plev", "z", "height", "bottom_top", "bottom_top_stag", "ilev",
          "model_level_number", "half_level", "level_interface", "hybrid", "altitude",
          "pressure_level", "isobaric", "isobaricinhpa", "zt", "zm", "zw", "zf", "zh", "nz", "k",
          "mlev", "nhym", "nhyi", "nlev", "levels", "sigma", "pressure", "full_level",
          "model_level", "height_half", "lev_half", "pfull", "phalf", "air_pressure" }))
  {
    return Axis::Vertical;
  }
  if (oneOf(name, { "time", "record", "t", "times", "valid_time", "xtime" }))
  {
    return Axis::Time;
  }
  if (oneOf(name,
        { "column", "col", "ncol", "ncells", "ncell", "cell", "cells", "values", "rgrid",
          "gridpoint", "ncolumn", "profile", "nprof", "station", "columns" }))
  {
    return Axis::Column;
  }
  return Axis::None;
}

bool plays(const FileVariable& variable, Role role)
{
  const RoleRule& rule = ruleOf(role);
  const std::string standard = variable.text("standard_name");
  const auto is = [&](const std::string& name) { return name == variable.name; };
  return (!standard.empty() && standard == rule.standardNames.front()) ||
    std::any_of(rule.names.begin(), rule.names.end(), is) ||
    (!variable.text("units").empty() && variable.text("units") == rule.units);
}
}

const FileVariable* coordinateVariable(const NetCDFFile& file, int dimension)
{
  const FileVariable* variable =
    file.find(file.dimensions()[static_cast<std::size_t>(dimension)].name);
  const bool is = variable && variable->dimensions.size() == 1 &&
    variable->dimensions[0] == dimension && variable->isNumeric();
  return is ? variable : nullptr;
}

FileAxes::FileAxes(const NetCDFFile& file)
  : File(file)
  , Axes(file.dimensions().size(), Axis::None)
{
  for (std::size_t d = 0; d < this->Axes.size(); ++d)
  {
    const FileVariable* coordinate = coordinateVariable(file, static_cast<int>(d));
    this->Axes[d] = coordinate ? axisOfAttributes(*coordinate) : Axis::None;
    if (this->Axes[d] == Axis::None)
    {
      this->Axes[d] = axisOfName(file.dimensions()[d].name);
    }
  }
  // Longitudes and latitudes that are not coordinate variables: of two dimensions, or both of one and the same.
  std::vector<int> longitudes;
  std::vector<int> latitudes;
  for (const FileVariable& variable : file.variables())
  {
    const bool longitude = plays(variable, Role::Longitude);
    if (!longitude && !plays(variable, Role::Latitude))
    {
      continue;
    }
    const std::size_t n = variable.dimensions.size();
    if (n == 1 &&
      variable.name != file.dimensions()[static_cast<std::size_t>(variable.dimensions[0])].name)
    {
      (longitude ? longitudes : latitudes).push_back(variable.dimensions[0]);
    }
    if (n >= 2 && this->of(variable.dimensions[n - 1]) == Axis::None &&
      this->of(variable.dimensions[n - 2]) == Axis::None)
    {
      this->set(variable.dimensions[n - 1], Axis::X);
      this->set(variable.dimensions[n - 2], Axis::Y);
    }
  }
  for (int d : longitudes)
  {
    if (std::find(latitudes.begin(), latitudes.end(), d) != latitudes.end())
    {
      this->set(d, Axis::Column);
    }
  }
}

int FileAxes::dimensionAlong(const FileVariable& variable, Axis axis) const
{
  for (int d : variable.dimensions)
  {
    if (this->of(d) == axis)
    {
      return d;
    }
  }
  return -1;
}

std::string FileAxes::guess(const FileVariable& variable)
{
  std::string said;
  const bool columns = this->dimensionAlong(variable, Axis::Column) >= 0;
  static const std::array<std::pair<Axis, const char*>, 3> order = { { { Axis::X, "x" },
    { Axis::Y, "y" }, { Axis::Vertical, "the vertical" } } };
  for (const auto& [axis, name] : order)
  {
    if (this->dimensionAlong(variable, axis) >= 0 || (columns && axis != Axis::Vertical))
    {
      continue;
    }
    for (auto d = variable.dimensions.rbegin(); d != variable.dimensions.rend(); ++d)
    {
      if (this->of(*d) == Axis::None)
      {
        this->set(*d, axis);
        said += (said.empty() ? "" : ", ") +
          this->File.dimensions()[static_cast<std::size_t>(*d)].name + " taken for " + name;
        break;
      }
    }
  }
  return said;
}
}
