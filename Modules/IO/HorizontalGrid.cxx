// SPDX-License-Identifier: BSD-3-Clause
#include "HorizontalGrid.h"

#include "NumberText.h"
#include "ReadError.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
constexpr double Degree = 3.14159265358979323846 / 180;

/// Adds whole turns so that neighbours differ by less than half a turn.
void unwrap(std::vector<double>& longitude)
{
  for (std::size_t i = 1; i < longitude.size(); ++i)
  {
    longitude[i] -= 360 * std::round((longitude[i] - longitude[i - 1]) / 360);
  }
}

/// 1 ascending, -1 descending; throws where it is neither.
int direction(const std::vector<double>& values, const std::string& name)
{
  const int sign = values.size() < 2 || values[1] > values[0] ? 1 : -1;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    if (!std::isfinite(values[i]) || (i > 0 && !(sign * (values[i] - values[i - 1]) > 0)))
    {
      throw ReadError("variable " + name + ": it is not monotonic at index " + std::to_string(i) +
        "; sort the axis");
    }
  }
  return sign;
}

/// Turns the values so that they ascend; true if they did not.
bool ascend(std::vector<double>& values, const std::string& name)
{
  const bool flip = direction(values, name) < 0;
  if (flip)
  {
    std::reverse(values.begin(), values.end());
  }
  return flip;
}

std::vector<double> converted(
  const CloudFile& file, const FileVariable& variable, const char* units)
{
  std::vector<double> values = file.File.readAll(variable);
  const auto conversion = variable.text("units").empty()
    ? UnitConversion()
    : unitConversion(variable.text("units"), units);
  if (!conversion)
  {
    throw ReadError("variable " + variable.name + ": its units '" +
      variable.text("units").substr(0, 80) + "' do not convert to '" + units + "'; correct them");
  }
  for (double& value : values)
  {
    value = conversion->scale * value + conversion->offset;
  }
  return values;
}

/// Longitudes or latitudes on the grid's two dimensions, whatever their order in the file; the first time step.
std::vector<double> onGrid(const CloudFile& file, const RoleVariable& role)
{
  const FileVariable& variable = *role.variable;
  const GridAxes& grid = file.Grid;
  std::vector<std::size_t> count(variable.dimensions.size(), 1);
  bool transposed = false;
  for (std::size_t axis = 0; axis < count.size(); ++axis)
  {
    const int d = variable.dimensions[axis];
    count[axis] = d == grid.y ? grid.ny : d == grid.x ? grid.nx : 1;
    transposed = transposed ||
      (d == grid.y && axis + 1 < count.size() && variable.dimensions.back() != grid.x) ||
      (d == grid.x && axis + 1 < count.size());
  }
  const std::vector<double> raw =
    file.File.read(variable, std::vector<std::size_t>(count.size(), 0), count);
  std::vector<double> values(grid.nx * grid.ny);
  if (raw.size() != values.size())
  {
    throw ReadError("variable " + variable.name +
      ": it does not cover the grid; name another one with SetVariableName");
  }
  for (std::size_t j = 0; j < grid.ny; ++j)
  {
    for (std::size_t i = 0; i < grid.nx; ++i)
    {
      const double value = raw[transposed ? i * grid.ny + j : j * grid.nx + i];
      values[j * grid.nx + i] = role.conversion.scale * value + role.conversion.offset;
    }
  }
  return values;
}

std::vector<double> alongX(const std::vector<double>& x, std::size_t ny)
{
  std::vector<double> all;
  all.reserve(x.size() * ny);
  for (std::size_t j = 0; j < ny; ++j)
  {
    all.insert(all.end(), x.begin(), x.end());
  }
  return all;
}

std::vector<double> alongY(const std::vector<double>& y, std::size_t nx)
{
  std::vector<double> all;
  all.reserve(y.size() * nx);
  for (double value : y)
  {
    all.insert(all.end(), nx, value);
  }
  return all;
}
}

HorizontalGrid::HorizontalGrid(CloudFile& file)
{
  this->findProjection(file);
  if (!this->layPlane(file) && !this->layPlain(file) && !this->layColumns(file) &&
    !this->layCurvilinear(file))
  {
    throw ReadError("variable " + file.master().name +
      ": neither longitudes and latitudes nor x and y in metres were found for it; name them with "
      "SetVariableName");
  }
  this->check(file);
}

void HorizontalGrid::findProjection(CloudFile& file)
{
  std::string name = file.master().text("grid_mapping");
  name = name.substr(0, name.find_first_of(": "));
  const FileVariable* mapping = name.empty() ? nullptr : file.File.find(name);
  if (!name.empty() && !mapping)
  {
    file.warn("variable " + file.master().name + ": its grid mapping " + name.substr(0, 80) +
      " is not in the file");
  }
  this->Radius = planetRadius(mapping);
  std::string definition = mapping ? projOfGridMapping(*mapping) : std::string();
  if (definition.empty() && file.isWRF())
  {
    definition = projOfWRF(file.File);
  }
  if (!definition.empty())
  {
    this->Plane = std::make_unique<Projection>(definition);
  }
}

bool HorizontalGrid::layPlane(CloudFile& file)
{
  GridAxes& grid = file.Grid;
  const FileVariable* vx = grid.x < 0 ? nullptr : coordinateVariable(file.File, grid.x);
  const FileVariable* vy = grid.y < 0 ? nullptr : coordinateVariable(file.File, grid.y);
  if (!vx || !vy)
  {
    return false;
  }
  const bool rotated = vx->text("standard_name") == "grid_longitude" ||
    (this->Plane && this->Plane->definition().find("ob_tran") != std::string::npos);
  const bool metric = vx->has("units") && vy->has("units") &&
    unitConversion(vx->text("units"), "m") && unitConversion(vy->text("units"), "m");
  if ((!rotated && !metric) || (rotated && !this->Plane))
  {
    return false;
  }
  Values x = rotated ? file.File.readAll(*vx) : converted(file, *vx, "m");
  Values y = rotated ? file.File.readAll(*vy) : converted(file, *vy, "m");
  if (rotated)
  {
    unwrap(x);
    const double turn = 360 * std::round((x.front() + x.back()) / 720);
    const auto metres = [this](double& v) { v *= Degree * this->Radius; };
    std::for_each(x.begin(), x.end(), [turn](double& v) { v -= turn; });
    std::for_each(x.begin(), x.end(), metres);
    std::for_each(y.begin(), y.end(), metres);
  }
  grid.flipX = ascend(x, vx->name);
  grid.flipY = ascend(y, vy->name);
  this->X = alongX(x, grid.ny);
  this->Y = alongY(y, grid.nx);
  if (this->Plane)
  {
    this->Longitude.resize(this->X.size());
    this->Latitude.resize(this->X.size());
    for (std::size_t c = 0; c < this->X.size(); ++c)
    {
      if (!this->Plane->inverse(this->X[c], this->Y[c], this->Longitude[c], this->Latitude[c]))
      {
        throw ReadError("variable " + vx->name + ": x " + numberText(this->X[c], 10) + " m, y " +
          numberText(this->Y[c], 10) + " m lie outside the projection '" +
          this->Plane->definition() + "'; check units and grid mapping");
      }
      const double before = c % grid.nx ? this->Longitude[c - 1]
        : c                             ? this->Longitude[c - grid.nx]
                                        : this->Longitude[c];
      this->Longitude[c] -= 360 * std::round((this->Longitude[c] - before) / 360);
    }
  }
  return true;
}

bool HorizontalGrid::layPlain(CloudFile& file)
{
  GridAxes& grid = file.Grid;
  const RoleVariable* lon = file.find(Role::Longitude);
  const RoleVariable* lat = file.find(Role::Latitude);
  const bool hasLat = lat && lat->variable->dimensions == std::vector<int>{ grid.y } &&
    file.Axes.of(grid.y) != Axis::Column;
  const bool hasLon = lon && lon->variable->dimensions == std::vector<int>{ grid.x };
  const bool section = hasLat && grid.x < 0; // a zonal mean or one meridian
  const bool parallel = hasLon && grid.y < 0 && file.Axes.of(grid.x) != Axis::Column;
  if (!(hasLat && hasLon) && !section && !parallel)
  {
    return false;
  }
  Values x(1, 0.0);
  Values y(1, 0.0);
  if (hasLon)
  {
    x = converted(file, *lon->variable, "degrees_east");
    unwrap(x);
    grid.flipX = ascend(x, lon->variable->name);
  }
  if (hasLat)
  {
    y = converted(file, *lat->variable, "degrees_north");
    grid.flipY = ascend(y, lat->variable->name);
  }
  if (section || parallel)
  {
    file.warn("variable " + file.master().name + ": it has no " +
      (section ? "longitude" : "latitude") + " and is laid along " +
      (section ? "longitude" : "latitude") + " 0");
  }
  else
  {
    this->findSeamAndPoles(file, x, y);
  }
  if (x.back() - x.front() > 360 + 1e-3)
  {
    throw ReadError("variable " + lon->variable->name + ": it goes round more than once, from " +
      numberText(x.front(), 10) + " to " + numberText(x.back(), 10) + "; cut it to 360 degrees");
  }
  this->Longitude = alongX(x, grid.ny);
  this->Latitude = alongY(y, grid.nx);
  this->Plain = true;
  return true;
}

void HorizontalGrid::findSeamAndPoles(
  CloudFile& file, const Values& longitude, const Values& latitude)
{
  const std::size_t nx = longitude.size();
  const std::size_t ny = latitude.size();
  if (nx < 3 || ny < 2)
  {
    return;
  }
  const double span = longitude.back() - longitude.front();
  const double step = span / static_cast<double>(nx - 1);
  const double seam = 360 - span; // the gap from the last column to the first
  const bool even = std::abs(seam - (longitude[1] - longitude[0])) < 0.05 * step;
  const bool closed = std::abs(seam) < 1e-3 * step;
  file.Grid.periodic = even && !closed;
  if (!file.Grid.periodic && !closed)
  {
    return;
  }
  this->Global = latitude.back() - latitude.front() > 120;
  const double south = latitude.front() + 90;
  const double north = 90 - latitude.back();
  this->SouthPole = south > 1e-6 && south < 1.5 * (latitude[1] - latitude[0]);
  this->NorthPole = north > 1e-6 && north < 1.5 * (latitude[ny - 1] - latitude[ny - 2]);
}

bool HorizontalGrid::layColumns(CloudFile& file)
{
  GridAxes& grid = file.Grid;
  const RoleVariable* lon = file.find(Role::Longitude);
  const RoleVariable* lat = file.find(Role::Latitude);
  const int column = file.Axes.dimensionAlong(file.master(), Axis::Column);
  if (column < 0)
  {
    return false;
  }
  const std::string refusal = "variable " + file.master().name +
    ": unstructured columns (dimension " +
    file.File.dimensions()[static_cast<std::size_t>(column)].name +
    ") are not supported yet; put the field on a regular grid first, with cdo remapcon for example";
  const std::vector<int> own{ column };
  if (!lon || !lat || lon->variable->dimensions != own || lat->variable->dimensions != own ||
    (grid.x >= 0 && grid.y >= 0))
  {
    throw ReadError(refusal);
  }
  Values x = converted(file, *lon->variable, "degrees_east");
  Values y = converted(file, *lat->variable, "degrees_north");
  unwrap(x);
  const auto monotonic = [](const Values& v)
  {
    const auto notAbove = [](double a, double b) { return !(a < b); };
    const auto notBelow = [](double a, double b) { return !(a > b); };
    return std::adjacent_find(v.begin(), v.end(), notAbove) == v.end() ||
      std::adjacent_find(v.begin(), v.end(), notBelow) == v.end();
  };
  const bool alongLatitude = monotonic(y);
  if (!alongLatitude && !monotonic(x))
  {
    throw ReadError(refusal);
  }
  const bool flip = alongLatitude ? y.front() > y.back() : x.front() > x.back();
  if (flip)
  {
    std::reverse(x.begin(), x.end());
    std::reverse(y.begin(), y.end());
  }
  grid.x = alongLatitude ? -1 : column;
  grid.y = alongLatitude ? column : -1;
  grid.nx = alongLatitude ? 1 : x.size();
  grid.ny = alongLatitude ? x.size() : 1;
  (alongLatitude ? grid.flipY : grid.flipX) = flip;
  this->Longitude = x;
  this->Latitude = y;
  this->Plain = true;
  return true;
}

bool HorizontalGrid::layCurvilinear(CloudFile& file)
{
  GridAxes& grid = file.Grid;
  const RoleVariable* lon = file.find(Role::Longitude);
  const RoleVariable* lat = file.find(Role::Latitude);
  const auto flat = [](const RoleVariable* role)
  { return role && role->variable->dimensions.size() >= 2; };
  if (!flat(lon) || !flat(lat) || grid.nx < 2 || grid.ny < 2)
  {
    return false;
  }
  Values x = onGrid(file, *lon);
  Values y = onGrid(file, *lat);
  for (std::size_t c = 1; c < x.size(); ++c)
  {
    const double before = c % grid.nx ? x[c - 1] : x[c - grid.nx];
    x[c] -= 360 * std::round((x[c] - before) / 360);
  }
  // Left-handed (j runs south): turn j round, so that i, j, k are right-handed with k up.
  const std::size_t c = (grid.ny / 2 - 1) * grid.nx + grid.nx / 2 - 1;
  const double cross =
    (x[c + 1] - x[c]) * (y[c + grid.nx] - y[c]) - (x[c + grid.nx] - x[c]) * (y[c + 1] - y[c]);
  grid.flipY = cross < 0;
  for (std::size_t j = 0; grid.flipY && j < grid.ny / 2; ++j)
  {
    const auto row = static_cast<std::ptrdiff_t>(j * grid.nx);
    const auto mirror = static_cast<std::ptrdiff_t>((grid.ny - 1 - j) * grid.nx);
    const auto n = static_cast<std::ptrdiff_t>(grid.nx);
    std::swap_ranges(x.begin() + row, x.begin() + row + n, x.begin() + mirror);
    std::swap_ranges(y.begin() + row, y.begin() + row + n, y.begin() + mirror);
  }
  this->Longitude = x;
  this->Latitude = y;
  return true;
}

void HorizontalGrid::check(const CloudFile& file) const
{
  const RoleVariable* lat = file.find(Role::Latitude);
  const RoleVariable* lon = file.find(Role::Longitude);
  for (std::size_t c = 0; c < this->Longitude.size(); ++c)
  {
    if (!(std::abs(this->Latitude[c]) <= 90 + 1e-6))
    {
      throw ReadError("variable " + (lat ? lat->variable->name : std::string("latitude")) +
        ": latitude " + numberText(this->Latitude[c], 10) + " at column " + std::to_string(c) +
        " is not within -90 to 90; correct it");
    }
    if (!(std::abs(this->Longitude[c]) < 1e5))
    {
      throw ReadError("variable " + (lon ? lon->variable->name : std::string("longitude")) +
        ": longitude " + numberText(this->Longitude[c], 10) + " at column " + std::to_string(c) +
        " is not an angle; correct it");
    }
  }
}
}
