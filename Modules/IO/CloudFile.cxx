// SPDX-License-Identifier: BSD-3-Clause
#include "CloudFile.h"

#include "ReadError.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace nephoscope
{
namespace
{
/// A statistic that is not the state itself.
bool isSpread(const FileVariable& variable)
{
  const std::string methods = variable.text("cell_methods");
  for (const char* method :
    { ": variance", ": standard_deviation", ": maximum", ": minimum", ": range" })
  {
    if (methods.find(method) != std::string::npos)
    {
      return true;
    }
  }
  return false;
}

std::string quoted(const std::string& text)
{
  std::string line = "'" + text.substr(0, 80) + "'";
  std::replace_if(
    line.begin(), line.end(), [](unsigned char c) { return c < 32; }, ' ');
  return line;
}
}

CloudFile::CloudFile(const std::string& path, const std::map<Role, std::string>& choices)
  : File(path)
  , Axes(File)
  , Choices(choices)
{
  const auto hasBottomTop = [](const FileDimension& d) { return d.name == "bottom_top"; };
  const auto& dimensions = this->File.dimensions();
  this->WRF = std::any_of(dimensions.begin(), dimensions.end(), hasBottomTop);
  this->findMaster();
  this->layAxes();
  this->findRoles();
  this->findTimes();
}

void CloudFile::warn(const std::string& text)
{
  if (std::find(this->Warnings.begin(), this->Warnings.end(), text) == this->Warnings.end())
  {
    this->Warnings.push_back(text);
  }
}

const RoleVariable* CloudFile::find(Role role) const
{
  const auto found = this->Variables.find(role);
  return found == this->Variables.end() ? nullptr : &found->second;
}

const FileVariable& CloudFile::require(const std::string& name, const std::string& wantedBy) const
{
  const FileVariable* variable = this->File.find(name);
  if (!variable)
  {
    throw ReadError("variable " + wantedBy + ": it needs " + quoted(name) +
      ", which is not in the file; add it to the file");
  }
  return *variable;
}

bool CloudFile::chosenName(Role role, std::string& name) const
{
  const auto choice = this->Choices.find(role);
  if (choice == this->Choices.end())
  {
    return false;
  }
  name = choice->second;
  return true;
}

std::vector<const FileVariable*> CloudFile::candidates(Role role) const
{
  std::vector<const FileVariable*> list;
  const RoleRule& rule = ruleOf(role);
  const auto add = [&](const FileVariable& variable)
  {
    if (variable.isNumeric() && std::find(list.begin(), list.end(), &variable) == list.end())
    {
      list.push_back(&variable);
    }
  };
  for (const std::string& standard : rule.standardNames)
  {
    for (const FileVariable& variable : this->File.variables())
    {
      if (variable.text("standard_name") == standard && !isSpread(variable))
      {
        add(variable);
      }
    }
  }
  for (const std::string& name : rule.names)
  {
    const FileVariable* variable = this->File.find(name);
    if (variable && !isSpread(*variable))
    {
      add(*variable);
    }
  }
  return list;
}

bool CloudFile::unitsFit(const FileVariable& variable, Role role) const
{
  const std::string target = ruleOf(role).units;
  return target.empty() || !variable.has("units") ||
    unitConversion(variable.text("units"), target).has_value();
}

RoleVariable CloudFile::take(const FileVariable& variable, Role role, bool chosen) const
{
  RoleVariable taken;
  taken.variable = &variable;
  taken.chosen = chosen;
  const std::string target = ruleOf(role).units;
  if (target.empty())
  {
    return taken;
  }
  taken.unitless = !variable.has("units");
  const std::string units = variable.has("units") ? variable.text("units") : target;
  const auto conversion = unitConversion(units, target);
  if (!conversion)
  {
    throw ReadError("variable " + variable.name + ": its units " + quoted(units) +
      " do not convert to '" + target + "' of " + ruleOf(role).name +
      "; correct them, or name another variable with SetVariableName");
  }
  taken.conversion = *conversion;
  return taken;
}

std::string CloudFile::fieldNames() const
{
  std::string list;
  int listed = 0;
  for (const FileVariable& variable : this->File.variables())
  {
    if (variable.isNumeric() && variable.dimensions.size() >= 2 && listed < 40)
    {
      list += (list.empty() ? "" : ", ") + variable.name;
      ++listed;
    }
  }
  return list.empty() ? "no field" : list;
}

void CloudFile::findMaster()
{
  const auto deep = [this](const FileVariable& v)
  { return this->Axes.dimensionAlong(v, Axis::Vertical) >= 0 || v.dimensions.size() >= 3; };
  for (int pass = 0; pass < 2 && !this->Master; ++pass)
  {
    for (int r = 0; isField(static_cast<Role>(r)) && !this->Master; ++r)
    {
      const Role role = static_cast<Role>(r);
      const bool cloud = role <= Role::IceWater;
      std::string name;
      if (this->chosenName(role, name))
      {
        if (!name.empty() && (cloud || pass == 1))
        {
          this->Master = &this->require(name, std::string("of role ") + ruleOf(role).name);
        }
      }
      else if (cloud && pass == 0)
      {
        const auto list = this->candidates(role);
        const auto best =
          std::find_if(list.begin(), list.end(), [&](const FileVariable* v) { return deep(*v); });
        this->Master = best != list.end() ? *best : nullptr;
      }
      this->MasterRole = this->Master ? role : this->MasterRole;
    }
  }
  if (!this->Master)
  {
    for (Role role : { Role::CloudFraction, Role::LiquidWater, Role::IceWater })
    {
      const auto list = this->candidates(role);
      if (!list.empty())
      {
        throw ReadError("variable " + list.front()->name +
          ": it has no vertical axis, one level only; a field of at least 2 levels is needed");
      }
    }
    throw ReadError("no variable of cloud fraction, liquid or ice was found among: " +
      this->fieldNames() + "; name one with SetVariableName");
  }
}

void CloudFile::layAxes()
{
  const FileVariable& master = *this->Master;
  const std::string who = "variable " + master.name + ": ";
  const std::string guessed = this->Axes.guess(master);
  if (!guessed.empty())
  {
    this->warn(who + "dimensions without coordinates: " + guessed);
  }
  const auto along = [&](Axis axis) { return this->Axes.dimensionAlong(master, axis); };
  const auto size = [&](int d)
  { return d < 0 ? std::size_t(1) : this->File.dimensions()[static_cast<std::size_t>(d)].size; };
  GridAxes& grid = this->Grid;
  grid.time = along(Axis::Time);
  grid.z = along(Axis::Vertical);
  grid.x = along(Axis::X);
  grid.y = along(Axis::Y);
  const int column = along(Axis::Column);
  if (column >= 0)
  {
    (grid.y < 0 ? grid.y : grid.x) = column; // a curtain, if HorizontalGrid finds that it is one
  }
  grid.nz = size(grid.z);
  grid.ny = size(grid.y);
  grid.nx = size(grid.x);
  for (int d : master.dimensions)
  {
    const bool own = d == grid.time || d == grid.z || d == grid.y || d == grid.x;
    if (!own && size(d) > 1)
    {
      this->warn(who + "the first of " + std::to_string(size(d)) + " along " +
        this->File.dimensions()[static_cast<std::size_t>(d)].name + " is read");
    }
  }
  for (int d : master.dimensions)
  {
    if (size(d) == 0)
    {
      throw ReadError(who + "its dimension " +
        this->File.dimensions()[static_cast<std::size_t>(d)].name +
        " is empty; the file holds no data");
    }
  }
  if (grid.nz < 2)
  {
    throw ReadError(who + "it has one level only; a field of at least 2 levels is needed");
  }
  if (grid.nx * grid.ny < 2)
  {
    throw ReadError(who + "it has one column only; a field of at least 2 columns is needed");
  }
  if (grid.nx > 2147483000 || grid.ny > 2147483000 || grid.nz > 2147483000)
  {
    throw ReadError(
      who + "it is larger than the 2^31 points a side that VTK addresses; cut it into pieces");
  }
  this->File.checkSize(master, { grid.nz, grid.ny, grid.nx });
}

bool CloudFile::liesOnGrid(const FileVariable& variable, bool vertical) const
{
  bool has[3] = { false, false, false };
  for (std::size_t axis = 0; axis < variable.dimensions.size(); ++axis)
  {
    const int d = variable.dimensions[axis];
    const std::size_t n = this->File.sizeOf(variable, axis);
    const auto near = [n](std::size_t m) { return n + 1 == m || n == m || n == m + 1; };
    const Axis kind = this->Axes.of(d);
    if (d == this->Grid.z || (kind == Axis::Vertical && this->Grid.z >= 0))
    {
      has[2] = true;
      if (!vertical || (n != this->Grid.nz && n != this->Grid.nz + 1))
      {
        return false;
      }
    }
    else if (d == this->Grid.y || (kind == Axis::Y && this->Grid.y >= 0))
    {
      has[1] = true;
      if (!near(this->Grid.ny))
      {
        return false;
      }
    }
    else if (d == this->Grid.x || (kind == Axis::X && this->Grid.x >= 0))
    {
      has[0] = true;
      if (!near(this->Grid.nx))
      {
        return false;
      }
    }
    else if (d != this->Grid.time && kind != Axis::Time && n != 1 &&
      std::find(this->Master->dimensions.begin(), this->Master->dimensions.end(), d) ==
        this->Master->dimensions.end())
    {
      return false;
    }
  }
  return has[2] == vertical && has[1] == (this->Grid.y >= 0) && has[0] == (this->Grid.x >= 0);
}

bool CloudFile::suits(const FileVariable& variable, Role role) const
{
  if (isField(role))
  {
    return this->liesOnGrid(variable, true);
  }
  if (isSurface(role))
  {
    return this->liesOnGrid(variable, false);
  }
  if (role == Role::ReferencePressure)
  {
    return variable.dimensions.empty() || this->File.sizeOf(variable, 0) == 1;
  }
  if (role == Role::HybridA || role == Role::HybridB)
  {
    return !variable.dimensions.empty() && this->File.sizeOf(variable, 0) == this->Grid.nz;
  }
  if (role == Role::Longitude || role == Role::Latitude)
  {
    const auto onGrid = [this](int d)
    { return d == this->Grid.time || d == this->Grid.y || d == this->Grid.x; };
    const auto& d = variable.dimensions;
    return std::all_of(d.begin(), d.end(), onGrid);
  }
  return true;
}

void CloudFile::findRoles()
{
  for (int r = 0; r < static_cast<int>(Role::Count); ++r)
  {
    const Role role = static_cast<Role>(r);
    const RoleRule& rule = ruleOf(role);
    std::string name;
    if (this->chosenName(role, name))
    {
      if (!name.empty())
      {
        const FileVariable& variable = this->require(name, std::string("of role ") + rule.name);
        if (&variable != this->Master && !this->suits(variable, role))
        {
          throw ReadError("variable " + name + ": its dimensions are not those of " +
            this->Master->name + " as role " + rule.name +
            " needs them; name another variable with SetVariableName");
        }
        this->Variables[role] = this->take(variable, role, true);
      }
      continue;
    }
    if (role == this->MasterRole)
    {
      this->Variables[role] = this->take(*this->Master, role, false);
      continue;
    }
    // WRF calls the perturbation of the potential temperature T, and a grid-relative wind U and V.
    const bool perturbation = this->WRF && role == Role::Temperature;
    for (const FileVariable* variable : this->candidates(role))
    {
      const bool skip = (perturbation && variable->name == "T") ||
        (role == Role::PotentialTemperature && variable->name == "T" && !this->WRF) ||
        ((role == Role::UpwardWind || role == Role::PressureVelocity) && !variable->has("units"));
      if (!skip && this->suits(*variable, role) && this->unitsFit(*variable, role))
      {
        this->Variables[role] = this->take(*variable, role, false);
        break;
      }
    }
  }
  this->checkBaseStates();
}

void CloudFile::checkBaseStates()
{
  // WRF's P and PH are perturbations of PB and PHB.
  const std::pair<Role, Role> pairs[] = { { Role::Pressure, Role::BasePressure },
    { Role::Geopotential, Role::BaseGeopotential } };
  for (const auto& [role, base] : pairs)
  {
    const RoleVariable* own = this->find(role);
    const bool perturbation =
      this->WRF && own && (own->variable->name == "P" || own->variable->name == "PH");
    if (!perturbation)
    {
      this->Variables.erase(base);
    }
    else if (!this->find(base))
    {
      this->warn("variable " + own->variable->name + ": it is a perturbation, and its base state " +
        own->variable->name + "B is not in the file: not used");
      this->Variables.erase(role);
    }
  }
}

/// WRF writes its times as text, "2005-08-28_12:00:00", one line a step.
bool CloudFile::findWrittenTimes(std::size_t steps)
{
  const FileVariable* const variable = this->File.find("Times");
  if (!variable || variable->dimensions.size() != 2 || variable->dimensions[0] != this->Grid.time)
  {
    return false;
  }
  const std::vector<std::string> lines = this->File.readText(*variable);
  if (lines.size() != steps || lines.empty())
  {
    return false;
  }
  this->Clock = TimeAxis("seconds since " + lines[0], "");
  for (const std::string& line : lines)
  {
    this->Times.push_back(this->Clock.secondsTo(TimeAxis("seconds since " + line, "")));
  }
  this->HasClock = true;
  return true;
}

void CloudFile::findTimes()
{
  const FileVariable* variable =
    this->find(Role::Time) ? this->find(Role::Time)->variable : nullptr;
  if (this->Grid.time >= 0)
  {
    const FileVariable* coordinate = coordinateVariable(this->File, this->Grid.time);
    const bool fits = variable && variable->dimensions == std::vector<int>{ this->Grid.time };
    variable = coordinate ? coordinate : fits ? variable : nullptr;
  }
  else if (variable && !variable->dimensions.empty() && this->File.sizeOf(*variable, 0) != 1)
  {
    variable = nullptr;
  }
  const std::size_t steps = this->Grid.time < 0
    ? 1
    : this->File.dimensions()[static_cast<std::size_t>(this->Grid.time)].size;
  if (variable && variable->text("units").find(" since ") != std::string::npos)
  {
    this->Clock = TimeAxis(variable->text("units"), variable->text("calendar"));
    for (double value : this->File.readAll(*variable))
    {
      this->Times.push_back(this->Clock.seconds(value));
    }
    this->HasClock = true;
  }
  else if (this->Grid.time >= 0 && !this->findWrittenTimes(steps))
  {
    this->warn("dimension " +
      this->File.dimensions()[static_cast<std::size_t>(this->Grid.time)].name +
      " has no time unit: its steps are numbered 0, 1, ... as seconds");
    this->File.checkSize(*this->Master, { steps });
    for (std::size_t i = 0; i < steps; ++i)
    {
      this->Times.push_back(static_cast<double>(i));
    }
  }
  for (std::size_t i = 0; i < this->Times.size(); ++i)
  {
    if (!std::isfinite(this->Times[i]) || (i > 0 && this->Times[i] <= this->Times[i - 1]))
    {
      throw ReadError("variable " + (variable ? variable->name : std::string("time")) +
        ": its times do not increase at step " + std::to_string(i) + "; sort the file by time");
    }
  }
}
}
