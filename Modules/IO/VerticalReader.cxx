// SPDX-License-Identifier: BSD-3-Clause
// How the vertical coordinate is found. VerticalFields.cxx evaluates it.
#include "VerticalReader.h"

#include "NumberText.h"
#include "ReadError.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace nephoscope
{
namespace
{
constexpr double UsualReferencePressure = 1e5; // Pa

std::map<std::string, std::string> parseTerms(const std::string& text)
{
  std::map<std::string, std::string> terms;
  std::istringstream words(text);
  std::string key;
  std::string word;
  while (words >> word)
  {
    if (word.back() == ':')
    {
      key = word.substr(0, word.size() - 1);
    }
    else if (!key.empty())
    {
      terms[key] = word;
      key.clear();
    }
  }
  return terms;
}

/// Values along the vertical at the centres, in file order: of the levels, of their bounds, or of half levels.
std::vector<double> levelTerm(
  const CloudFile& file, const FileVariable& variable, const std::string& owner, const char* units)
{
  const std::size_t nz = file.Grid.nz;
  std::vector<double> values = file.File.readAll(variable);
  if (values.size() == 2 * nz && variable.dimensions.size() == 2 &&
    file.File.sizeOf(variable, 1) == 2)
  {
    for (std::size_t k = 0; k < nz; ++k)
    {
      values[k] = 0.5 * (values[2 * k] + values[2 * k + 1]);
    }
  }
  else if (values.size() == nz + 1)
  {
    for (std::size_t k = 0; k < nz; ++k)
    {
      values[k] = 0.5 * (values[k] + values[k + 1]);
    }
  }
  else if (values.size() != nz)
  {
    throw ReadError("variable " + owner + ": its term " + variable.name + " has " +
      std::to_string(values.size()) + " values for " + std::to_string(nz) +
      " levels; correct formula_terms");
  }
  values.resize(nz);
  const auto conversion =
    variable.has("units") ? unitConversion(variable.text("units"), units) : UnitConversion();
  if (!conversion)
  {
    throw ReadError("variable " + variable.name + ": its units '" +
      variable.text("units").substr(0, 80) + "' do not convert to '" + units + "' as a term of " +
      owner + "; correct them");
  }
  for (double& value : values)
  {
    value = conversion->scale * value + conversion->offset;
    if (!std::isfinite(value))
    {
      throw ReadError("variable " + variable.name + ": it has missing values, which a term of " +
        owner + " must not have; correct it");
    }
  }
  return values;
}

double scalarTerm(
  const CloudFile& file, const FileVariable& variable, const std::string& owner, const char* units)
{
  const std::vector<std::size_t> one(variable.dimensions.size(), 1);
  const std::vector<std::size_t> zero(variable.dimensions.size(), 0);
  const std::vector<double> value = file.File.read(variable, zero, one);
  const auto conversion =
    variable.has("units") ? unitConversion(variable.text("units"), units) : UnitConversion();
  const double converted = conversion ? conversion->scale * value[0] + conversion->offset : NAN;
  if (!std::isfinite(converted))
  {
    throw ReadError("variable " + variable.name + ": it is missing or not in '" + units +
      "' as a term of " + owner + "; correct it");
  }
  return converted;
}

const std::string& term(
  const std::map<std::string, std::string>& terms, const char* name, const std::string& owner)
{
  const auto found = terms.find(name);
  if (found == terms.end())
  {
    throw ReadError("variable " + owner + ": its formula_terms have no '" + name + "'; add it");
  }
  return found->second;
}

bool consecutive(const std::vector<double>& values)
{
  for (std::size_t i = 1; i < values.size(); ++i)
  {
    if (std::abs(values[i] - values[i - 1]) != 1)
    {
      return false;
    }
  }
  return true;
}
}

VerticalReader::VerticalReader(CloudFile& file)
  : File(file)
{
  const bool fields =
    file.find(Role::Pressure) || file.find(Role::Height) || file.find(Role::Geopotential);
  if (!this->fromFormula(file) && !this->fromHybridNames(file) && !this->fromAxis(file))
  {
    if (!fields)
    {
      const std::string name = file.File.dimensions()[static_cast<std::size_t>(file.Grid.z)].name;
      throw ReadError("variable " + file.master().name + ": the vertical coordinate '" + name +
        "' is not known; give " + name +
        " units of pressure or height or formula_terms, or the file a pressure or height field");
    }
    this->Kind = file.isWRF()      ? "WRF, pressure and geopotential fields"
      : !file.find(Role::Pressure) ? "height field"
      : file.find(Role::Height) || file.find(Role::Geopotential) ? "pressure and height fields"
                                                                 : "pressure field";
  }
  this->findDirection(file);
  this->describe(file);
}

bool VerticalReader::fromFormula(CloudFile& file)
{
  const int z = file.Grid.z;
  std::vector<const FileVariable*> owners;
  const auto add = [&](const FileVariable* v)
  {
    if (v && v->has("formula_terms"))
    {
      owners.push_back(v);
    }
  };
  const RoleVariable* chosen = file.find(Role::VerticalCoordinate);
  add(chosen ? chosen->variable : nullptr);
  const FileVariable* axis = coordinateVariable(file.File, z);
  add(axis);
  for (const FileVariable& v : file.File.variables()) // an auxiliary coordinate, or bounds
  {
    const bool along = !v.dimensions.empty() && v.dimensions[0] == z && v.dimensions.size() <= 2;
    add(along ? &v : nullptr);
  }
  for (const FileVariable* owner : owners)
  {
    const Terms terms = parseTerms(owner->text("formula_terms"));
    const std::string own = owner->text("standard_name");
    this->readTerms(file, *owner, own.empty() && axis ? axis->text("standard_name") : own, terms);
    return true;
  }
  return false;
}

void VerticalReader::readTerms(
  CloudFile& file, const FileVariable& owner, const std::string& standard, const Terms& terms)
{
  const auto has = [&terms](const char* name) { return terms.count(name) != 0; };
  if (standard == "atmosphere_hybrid_height_coordinate" || has("orog"))
  {
    this->readHeightTerms(file, owner, terms, false);
  }
  else if (standard == "atmosphere_sleve_coordinate" || has("zsurf1"))
  {
    this->readHeightTerms(file, owner, terms, true);
  }
  else if (standard == "atmosphere_sigma_coordinate" || has("ptop"))
  {
    this->readSigmaTerms(file, owner, terms);
  }
  else if (standard == "atmosphere_ln_pressure_coordinate" || (has("p0") && has("lev")))
  {
    const double p0 =
      scalarTerm(file, file.require(term(terms, "p0", owner.name), owner.name), owner.name, "Pa");
    this->A =
      levelTerm(file, file.require(term(terms, "lev", owner.name), owner.name), owner.name, "1");
    std::transform(this->A.begin(), this->A.end(), this->A.begin(),
      [p0](double lev) { return p0 * std::exp(-lev); });
    this->Form = Coordinate::LnPressure;
    this->Kind = "ln-pressure";
  }
  else if (standard == "atmosphere_hybrid_sigma_pressure_coordinate" || (has("b") && has("ps")))
  {
    this->readPressureTerms(file, owner, terms);
  }
  else
  {
    throw ReadError("variable " + owner.name + ": the vertical coordinate '" +
      standard.substr(0, 80) +
      "' is not known; give the file a pressure or height field, or name one with SetVariableName");
  }
}

void VerticalReader::readPressureTerms(
  CloudFile& file, const FileVariable& owner, const Terms& terms)
{
  const bool product = terms.count("ap") == 0;
  const FileVariable& a = file.require(term(terms, product ? "a" : "ap", owner.name), owner.name);
  const bool pressure = !product || (a.has("units") && unitConversion(a.text("units"), "Pa"));
  this->A = levelTerm(file, a, owner.name, pressure ? "Pa" : "1");
  this->B =
    levelTerm(file, file.require(term(terms, "b", owner.name), owner.name), owner.name, "1");
  if (!pressure)
  {
    const double p0 =
      scalarTerm(file, file.require(term(terms, "p0", owner.name), owner.name), owner.name, "Pa");
    for (double& value : this->A)
    {
      value *= p0;
    }
  }
  this->Form = Coordinate::HybridPressure;
  this->Kind = "hybrid sigma-pressure";
  this->setSurface(file, owner, term(terms, "ps", owner.name), "Pa", 0);
  this->alignWithAxis(file, owner);
}

void VerticalReader::readSigmaTerms(CloudFile& file, const FileVariable& owner, const Terms& terms)
{
  // p = ptop + sigma (ps - ptop) is hybrid with A = ptop (1 - sigma), B = sigma.
  this->B =
    levelTerm(file, file.require(term(terms, "sigma", owner.name), owner.name), owner.name, "1");
  const double top =
    scalarTerm(file, file.require(term(terms, "ptop", owner.name), owner.name), owner.name, "Pa");
  this->A.clear();
  for (double sigma : this->B)
  {
    this->A.push_back(top * (1 - sigma));
  }
  this->Form = Coordinate::HybridPressure;
  this->Kind = "sigma";
  this->setSurface(file, owner, term(terms, "ps", owner.name), "Pa", 0);
}

void VerticalReader::readHeightTerms(
  CloudFile& file, const FileVariable& owner, const Terms& terms, bool sleve)
{
  const auto level = [&](const char* name, const char* units)
  {
    return levelTerm(
      file, file.require(term(terms, name, owner.name), owner.name), owner.name, units);
  };
  this->A = level("a", sleve ? "1" : "m");
  this->B = level(sleve ? "b1" : "b", "1");
  if (!sleve)
  {
    this->Form = Coordinate::HybridHeight;
    this->Kind = "hybrid height";
    this->setSurface(file, owner, term(terms, "orog", owner.name), "m", 0);
    return;
  }
  this->C = level("b2", "1");
  const double top =
    scalarTerm(file, file.require(term(terms, "ztop", owner.name), owner.name), owner.name, "m");
  for (double& value : this->A)
  {
    value *= top;
  }
  this->Form = Coordinate::Sleve;
  this->Kind = "SLEVE";
  this->setSurface(file, owner, term(terms, "zsurf1", owner.name), "m", 0);
  this->setSurface(file, owner, term(terms, "zsurf2", owner.name), "m", 1);
}

void VerticalReader::setSurface(
  CloudFile& file, const FileVariable& owner, const std::string& name, const char* units, int which)
{
  const RoleVariable* chosen = file.find(Role::SurfacePressure);
  const bool useChosen = which == 0 && chosen && chosen->chosen && std::string(units) == "Pa";
  RoleVariable& surface = this->Surface[which];
  surface.variable = useChosen ? chosen->variable : &file.require(name, owner.name);
  const std::string own = surface.variable->has("units") ? surface.variable->text("units") : units;
  const auto conversion = unitConversion(own, units);
  if (!conversion || !file.liesOnGrid(*surface.variable, false))
  {
    throw ReadError("variable " + surface.variable->name + ": as a term of " + owner.name +
      " it must lie on the horizontal grid and be in '" + units +
      "'; correct its dimensions or units");
  }
  surface.conversion = *conversion;
}

void VerticalReader::alignWithAxis(CloudFile& file, const FileVariable& owner)
{
  // Some files store the terms of the bounds in the opposite order to the levels: the axis's own values tell.
  const FileVariable* axis = coordinateVariable(file.File, file.Grid.z);
  if (!axis || !axis->has("units") || !unitConversion(axis->text("units"), "Pa"))
  {
    return;
  }
  const std::vector<double> levels = file.File.readAll(*axis);
  const std::vector<double> pressure = this->nominal();
  const bool falls = std::abs(levels.back()) < std::abs(levels.front());
  if (falls != (pressure.back() < pressure.front()))
  {
    std::reverse(this->A.begin(), this->A.end());
    std::reverse(this->B.begin(), this->B.end());
    file.warn("variable " + owner.name + ": the terms of its formula run against " + axis->name +
      " and were turned round");
  }
}

bool VerticalReader::findSurfacePressure(CloudFile& file, const std::string& wantedBy)
{
  const RoleVariable* surface = file.find(Role::SurfacePressure);
  this->LogSurface = !surface;
  surface = surface ? surface : file.find(Role::LogSurfacePressure);
  if (!surface)
  {
    throw ReadError("variable " + wantedBy +
      ": its levels need the surface pressure, which is not in the file; add it or name it with "
      "SetVariableName");
  }
  this->Surface[0] = *surface;
  return true;
}

bool VerticalReader::fromHybridNames(CloudFile& file)
{
  const RoleVariable* a = file.find(Role::HybridA);
  const RoleVariable* b = file.find(Role::HybridB);
  const FileVariable* va = a ? a->variable : file.File.find("hyai");
  const FileVariable* vb = b ? b->variable : file.File.find("hybi");
  if (!va || !vb)
  {
    return false;
  }
  const bool named = va->has("units");
  if (named && !unitConversion(va->text("units"), "Pa") && !unitConversion(va->text("units"), "1"))
  {
    return false;
  }
  bool pressure = named && unitConversion(va->text("units"), "Pa").has_value();
  this->A = levelTerm(file, *va, va->name, pressure ? "Pa" : "1");
  this->B = levelTerm(file, *vb, vb->name, "1");
  const double largest = *std::max_element(this->A.begin(), this->A.end());
  if (!pressure && largest > 10)
  {
    file.warn(
      "variable " + va->name + ": values up to " + numberText(largest) + " are taken for Pa");
    pressure = true;
  }
  if (!pressure)
  {
    const RoleVariable* p0 = file.find(Role::ReferencePressure);
    if (!p0)
    {
      file.warn("variable " + va->name + ": the file has no P0; 100000 Pa are taken");
    }
    const double reference =
      p0 ? scalarTerm(file, *p0->variable, va->name, "Pa") : UsualReferencePressure;
    for (double& value : this->A)
    {
      value *= reference;
    }
  }
  this->Form = Coordinate::HybridPressure;
  this->Kind = "hybrid sigma-pressure";
  return this->findSurfacePressure(file, va->name);
}

bool VerticalReader::fromAxis(CloudFile& file)
{
  const RoleVariable* chosen = file.find(Role::VerticalCoordinate);
  if (chosen)
  {
    return this->fromAxis(file, *chosen->variable);
  }
  const FileVariable* own = coordinateVariable(file.File, file.Grid.z);
  if (own && this->fromAxis(file, *own))
  {
    return true;
  }
  std::istringstream names(file.master().text("coordinates"));
  std::string name;
  while (names >> name)
  {
    const FileVariable* v = file.File.find(name);
    if (v && v->dimensions == std::vector<int>{ file.Grid.z } && this->fromAxis(file, *v))
    {
      return true;
    }
  }
  return false;
}

bool VerticalReader::fromAxis(CloudFile& file, const FileVariable& axis)
{
  const std::string units = axis.text("units");
  const std::string about = axis.text("long_name") + axis.text("standard_name");
  if (about.find("hybrid") != std::string::npos || about.find("alevel") != std::string::npos ||
    about.find("model_level") != std::string::npos || !axis.isNumeric())
  {
    return false; // a nominal pressure only
  }
  if (axis.text("standard_name") == "atmosphere_sigma_coordinate")
  {
    return false;
  }
  if (!units.empty() && unitConversion(units, "Pa"))
  {
    this->A = levelTerm(file, axis, axis.name, "Pa");
    this->Form = Coordinate::Pressure;
    this->Kind = "pressure";
    return true;
  }
  if (!units.empty() && unitConversion(units, "m"))
  {
    this->A = levelTerm(file, axis, axis.name, "m");
    this->Form = Coordinate::Height;
    this->Kind = "height";
    return true;
  }
  if (!units.empty() && !unitConversion(units, "1"))
  {
    return false;
  }
  const std::vector<double> values = levelTerm(file, axis, axis.name, "1");
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const bool name = axis.name == "level" || axis.name == "lev" || axis.name == "plev" ||
    axis.name == "pressure_level" || axis.name == "pressure" || axis.name.rfind("isobaric", 0) == 0;
  if (!name || consecutive(values) || *low <= 0 || *high > 1100 || *high < 10)
  {
    return false;
  }
  file.warn("variable " + axis.name + ": it has no units; its values " + numberText(*low) + " to " +
    numberText(*high) + " are taken for pressures in hPa");
  this->A = values;
  std::for_each(this->A.begin(), this->A.end(), [](double& v) { v *= 100; });
  this->Form = Coordinate::Pressure;
  this->Kind = "pressure";
  return true;
}

bool VerticalReader::isPressure() const
{
  return this->Form == Coordinate::HybridPressure || this->Form == Coordinate::LnPressure ||
    this->Form == Coordinate::Pressure;
}

std::vector<double> VerticalReader::nominal() const
{
  std::vector<double> values = this->A;
  for (std::size_t k = 0; this->Form == Coordinate::HybridPressure && k < values.size(); ++k)
  {
    values[k] += this->B[k] * UsualReferencePressure;
  }
  return values;
}

namespace
{
/// Levels that no atmosphere has would turn into heights without end.
void requirePlausible(const std::vector<double>& levels, bool pressure, const std::string& name)
{
  const double least = pressure ? 0 : -1e6;
  const double most = pressure ? 1e8 : 1e7;
  for (double level : levels)
  {
    if (!(level >= least && level <= most))
    {
      std::ostringstream text;
      text << "variable " << name << ": a level lies at " << level << (pressure ? " Pa" : " m")
           << ", and must lie from " << least << " to " << most
           << "; correct its values or its units";
      throw ReadError(text.str());
    }
  }
}
}

void VerticalReader::findDirection(CloudFile& file)
{
  std::vector<double> values = this->nominal();
  bool pressure = this->isPressure();
  std::string name = file.File.dimensions()[static_cast<std::size_t>(file.Grid.z)].name;
  if (values.empty())
  {
    // Fields only: one column in the middle, or the next that is whole.
    const RoleVariable* field = file.find(Role::Pressure);
    pressure = field != nullptr;
    field = field               ? field
      : file.find(Role::Height) ? file.find(Role::Height)
                                : file.find(Role::Geopotential);
    const RoleVariable* base = file.find(pressure ? Role::BasePressure : Role::BaseGeopotential);
    name = field->variable->name;
    for (std::size_t j : { file.Grid.ny / 2, std::size_t(0), file.Grid.ny - 1 })
    {
      Region column{ 0, { file.Grid.nx / 2 }, { j } };
      const FieldReader reader(file);
      const std::vector<float> f = reader.field(*field, column);
      values.assign(f.begin(), f.end());
      const std::vector<float> g =
        base ? reader.field(*base, column) : std::vector<float>(f.size(), 0.0F);
      std::transform(values.begin(), values.end(), g.begin(), values.begin(), std::plus<double>());
      if (std::isfinite(values.front()) && std::isfinite(values.back()))
      {
        break;
      }
    }
    if (!std::isfinite(values.front()) || !std::isfinite(values.back()))
    {
      throw ReadError("variable " + name +
        ": it holds only missing values where it was looked at; name another variable with "
        "SetVariableName");
    }
    file.Grid.flipZ = (values.back() > values.front()) == pressure;
    return;
  }
  if (pressure || this->Form == Coordinate::Height)
  {
    requirePlausible(values, pressure, name);
  }
  const bool rises = values.back() > values.front();
  for (std::size_t k = 1; k < values.size(); ++k)
  {
    if (!((rises ? 1 : -1) * (values[k] - values[k - 1]) > 0))
    {
      throw ReadError("variable " + name + ": its levels are not monotonic at index " +
        std::to_string(k) + "; sort the levels");
    }
  }
  file.Grid.flipZ = rises == pressure;
  for (std::vector<double>* v : { &this->A, &this->B, &this->C })
  {
    if (file.Grid.flipZ)
    {
      std::reverse(v->begin(), v->end());
    }
  }
}
}
