// SPDX-License-Identifier: BSD-3-Clause
#include "Projection.h"

#include "ReadError.h"

#include <proj.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace nephoscope
{
namespace
{
constexpr double Degree = 3.14159265358979323846 / 180;
constexpr double WRFRadius = 6370000; // m

std::string option(const char* name, double value)
{
  char text[64];
  std::snprintf(text, sizeof(text), " +%s=%.12g", name, value);
  return text;
}

bool number(const FileVariable& mapping, const char* name, double& value, std::size_t index = 0)
{
  const auto found = mapping.attributes.find(name);
  if (found == mapping.attributes.end() || found->second.numbers.size() <= index ||
    !std::isfinite(found->second.numbers[index]))
  {
    return false;
  }
  value = found->second.numbers[index];
  return true;
}

/// " +lat_0=.." for each attribute that is there.
std::string options(
  const FileVariable& mapping, const std::vector<std::pair<const char*, const char*>>& names)
{
  std::string text;
  for (const auto& [attribute, name] : names)
  {
    double value = 0;
    if (number(mapping, attribute, value))
    {
      text += option(name, value);
    }
  }
  return text;
}

std::string figure(const FileVariable& mapping)
{
  double major = 0;
  double other = 0;
  if (number(mapping, "semi_major_axis", major) && major > 0)
  {
    if (number(mapping, "inverse_flattening", other) && other > 0)
    {
      return option("a", major) + option("rf", other);
    }
    if (number(mapping, "semi_minor_axis", other) && other > 0)
    {
      return option("a", major) + option("b", other);
    }
  }
  return option("R", planetRadius(&mapping));
}

std::string polarStereographic(const FileVariable& mapping)
{
  double origin = 90;
  double parallel = 0;
  number(mapping, "latitude_of_projection_origin", origin);
  const bool atParallel = number(mapping, "standard_parallel", parallel);
  return "+proj=stere" + option("lat_0", origin < 0 ? -90 : 90) +
    (atParallel ? option("lat_ts", parallel)
                : options(mapping, { { "scale_factor_at_projection_origin", "k_0" } })) +
    options(mapping,
      { { "straight_vertical_longitude_from_pole", "lon_0" },
        { "longitude_of_projection_origin", "lon_0" } });
}

std::string conic(const FileVariable& mapping, const char* proj)
{
  double first = 0;
  double second = 0;
  if (!number(mapping, "standard_parallel", first))
  {
    throw ReadError("variable " + mapping.name + ": it has no standard_parallel; add it");
  }
  if (!number(mapping, "standard_parallel", second, 1))
  {
    second = first;
  }
  return std::string("+proj=") + proj + option("lat_1", first) + option("lat_2", second) +
    options(mapping,
      { { "latitude_of_projection_origin", "lat_0" },
        { "longitude_of_central_meridian", "lon_0" } });
}

std::string rotated(const FileVariable& mapping)
{
  double latitude = 90;
  double longitude = 0;
  double origin = 0;
  number(mapping, "grid_north_pole_latitude", latitude);
  number(mapping, "grid_north_pole_longitude", longitude);
  number(mapping, "north_pole_grid_longitude", origin);
  return "+proj=ob_tran +o_proj=eqc" + option("o_lat_p", latitude) + option("o_lon_p", origin) +
    option("lon_0", 180 + longitude);
}
}

struct Projection::Handle
{
  PJ_CONTEXT* context = nullptr;
  PJ* proj = nullptr;
  ~Handle()
  {
    proj_destroy(this->proj);
    proj_context_destroy(this->context);
  }
};

Projection::Projection(const std::string& definition)
  : Definition(definition)
  , Proj(new Handle)
{
  this->Proj->context = proj_context_create();
  proj_log_level(this->Proj->context, PJ_LOG_NONE);
  this->Proj->proj = proj_create(this->Proj->context, definition.c_str());
  if (!this->Proj->proj)
  {
    throw ReadError("PROJ does not know the projection '" + definition +
      "'; correct the attributes of the grid mapping");
  }
}

Projection::~Projection() = default;

bool Projection::forward(double longitude, double latitude, double& x, double& y) const
{
  const PJ_COORD to =
    proj_trans(this->Proj->proj, PJ_FWD, proj_coord(longitude * Degree, latitude * Degree, 0, 0));
  proj_errno_reset(this->Proj->proj);
  x = to.xy.x;
  y = to.xy.y;
  return std::isfinite(x) && std::isfinite(y);
}

bool Projection::inverse(double x, double y, double& longitude, double& latitude) const
{
  const PJ_COORD to = proj_trans(this->Proj->proj, PJ_INV, proj_coord(x, y, 0, 0));
  proj_errno_reset(this->Proj->proj);
  longitude = to.lp.lam / Degree;
  latitude = to.lp.phi / Degree;
  return std::isfinite(longitude) && std::isfinite(latitude);
}

bool Projection::north(double longitude, double latitude, double& x, double& y) const
{
  const double step = 1e-4; // degrees; about 11 m
  double below[2];
  double above[2];
  if (!this->forward(longitude, std::max(latitude - step, -90.0), below[0], below[1]) ||
    !this->forward(longitude, std::min(latitude + step, 90.0), above[0], above[1]))
  {
    return false;
  }
  const double length = std::hypot(above[0] - below[0], above[1] - below[1]);
  x = (above[0] - below[0]) / length;
  y = (above[1] - below[1]) / length;
  return std::isfinite(x) && std::isfinite(y);
}

double planetRadius(const FileVariable* mapping)
{
  double radius = 0;
  const bool named = mapping &&
    (number(*mapping, "earth_radius", radius) || number(*mapping, "semi_major_axis", radius));
  return named && radius > 0 && radius < 1e12 ? radius : MeanEarthRadius;
}

std::string projOfGridMapping(const FileVariable& mapping)
{
  const std::string name = mapping.text("grid_mapping_name");
  std::string proj;
  if (name == "latitude_longitude" || name.empty())
  {
    return proj;
  }
  if (name == "rotated_latitude_longitude")
  {
    return rotated(mapping) + option("R", planetRadius(&mapping));
  }
  if (name == "polar_stereographic")
  {
    proj = polarStereographic(mapping);
  }
  else if (name == "lambert_conformal_conic" || name == "albers_conical_equal_area")
  {
    proj = conic(mapping, name[0] == 'l' ? "lcc" : "aea");
  }
  else if (name == "mercator")
  {
    proj = "+proj=merc" +
      options(mapping,
        { { "standard_parallel", "lat_ts" }, { "scale_factor_at_projection_origin", "k_0" },
          { "longitude_of_projection_origin", "lon_0" } });
  }
  else if (name == "transverse_mercator")
  {
    proj = "+proj=tmerc" +
      options(mapping,
        { { "latitude_of_projection_origin", "lat_0" },
          { "longitude_of_central_meridian", "lon_0" },
          { "scale_factor_at_central_meridian", "k_0" } });
  }
  else if (name == "lambert_azimuthal_equal_area" || name == "stereographic" ||
    name == "azimuthal_equidistant")
  {
    proj = std::string("+proj=") +
      (name[0] == 'l'      ? "laea"
          : name[0] == 's' ? "stere"
                           : "aeqd") +
      options(mapping,
        { { "latitude_of_projection_origin", "lat_0" },
          { "longitude_of_projection_origin", "lon_0" },
          { "scale_factor_at_projection_origin", "k_0" } });
  }
  else
  {
    throw ReadError("variable " + mapping.name + ": the grid mapping '" + name.substr(0, 80) +
      "' is not known; give the file longitudes and latitudes of two dimensions instead");
  }
  return proj + options(mapping, { { "false_easting", "x_0" }, { "false_northing", "y_0" } }) +
    figure(mapping);
}

std::string projOfWRF(const NetCDFFile& file)
{
  double kind = 0;
  double first = 0;
  double second = 0;
  double longitude = 0;
  double latitude = 0;
  if (!file.globalNumber("MAP_PROJ", kind) || !file.globalNumber("TRUELAT1", first) ||
    !file.globalNumber("STAND_LON", longitude))
  {
    return {};
  }
  if (!file.globalNumber("TRUELAT2", second))
  {
    second = first;
  }
  file.globalNumber("MOAD_CEN_LAT", latitude);
  const std::string tail = option("lon_0", longitude) + option("R", WRFRadius);
  switch (static_cast<int>(std::clamp(kind, 0.0, 99.0)))
  {
    case 1:
      return "+proj=lcc" + option("lat_1", first) + option("lat_2", second) +
        option("lat_0", latitude) + tail;
    case 2:
      return "+proj=stere" + option("lat_0", first < 0 ? -90 : 90) + option("lat_ts", first) + tail;
    case 3:
      return "+proj=merc" + option("lat_ts", first) + tail;
    default:
      return {};
  }
}

std::string projAbout(double longitude, double latitude, double radius)
{
  return "+proj=stere" + option("lat_0", latitude) + option("lon_0", longitude) +
    option("R", radius);
}
}
