// SPDX-License-Identifier: BSD-3-Clause
#include "CloudRoles.h"

namespace nephoscope
{
namespace
{
// One row a role, in the order of the enumeration. Names: CF and CMIP, CAM and E3SM, ECMWF, WRF, Met Office, COSP, ICON.
const std::vector<RoleRule>& rules() // NOLINT(readability-function-size): a table
{
  static const std::vector<RoleRule> table = {
    { "CloudFraction", "1",
      { "cloud_area_fraction_in_atmosphere_layer", "cloud_volume_fraction_in_atmosphere_layer",
        "cloud_area_fraction" },
      { "cl", "CLOUD", "cc", "fraction_of_cloud_cover", "CLDFRA", "tca", "cloud_fraction",
        "cloud_volume_fraction_in_atmosphere_layer", "clc", "CLC", "CLD", "cld", "cldfra", "clf",
        "cloud", "cloudfrac", "cloud_area_fraction", "cloudiness" } },
    { "LiquidWater", "kg kg-1",
      { "mass_fraction_of_cloud_liquid_water_in_air", "cloud_liquid_water_mixing_ratio",
        "mass_fraction_of_stratiform_cloud_liquid_water_in_air" },
      { "clw", "CLDLIQ", "clwc", "specific_cloud_liquid_water_content", "QCLOUD", "q_liquid",
        "mr_lsliq", "qcl", "QCL", "qc", "QC", "ql", "QL", "cloud_liquid_water",
        "liquid_water_content", "lwc" } },
    { "IceWater", "kg kg-1",
      { "mass_fraction_of_cloud_ice_in_air", "cloud_ice_mixing_ratio",
        "mass_fraction_of_stratiform_cloud_ice_in_air" },
      { "cli", "CLDICE", "ciwc", "specific_cloud_ice_water_content", "QICE", "q_ice", "mr_lsice",
        "qcf", "QCF", "qi", "QI", "cloud_ice_water", "iwc" } },
    { "Temperature", "K", { "air_temperature" },
      { "ta", "T", "t", "temperature", "T_abs", "TK", "tk", "temp", "air_temperature",
        "temperature_hl" } },
    { "PotentialTemperature", "K", { "air_potential_temperature" },
      { "theta", "T", "TH", "THETA", "th", "air_potential_temperature", "potential_temperature" } },
    { "SpecificHumidity", "kg kg-1", { "specific_humidity", "humidity_mixing_ratio" },
      { "hus", "Q", "q", "specific_humidity", "QVAPOR", "qv", "QV", "hum" } },
    { "EastwardWind", "m s-1", { "eastward_wind", "x_wind", "grid_eastward_wind" },
      { "ua", "U", "u", "u_component_of_wind", "eastward_wind", "x_wind", "u_wind" } },
    { "NorthwardWind", "m s-1", { "northward_wind", "y_wind", "grid_northward_wind" },
      { "va", "V", "v", "v_component_of_wind", "northward_wind", "y_wind", "v_wind" } },
    { "UpwardWind", "m s-1", { "upward_air_velocity" },
      { "wa", "W", "w", "vertical_velocity", "upward_air_velocity", "wz", "w_wind" } },
    { "PressureVelocity", "Pa s-1", { "lagrangian_tendency_of_air_pressure" },
      { "wap", "OMEGA", "omega", "w", "W", "vertical_velocity",
        "lagrangian_tendency_of_air_pressure" } },
    { "Pressure", "Pa", { "air_pressure" },
      { "pfull", "P", "p", "pres", "pressure", "air_pressure", "pa", "PMID", "p_full",
        "pressure_fl", "pressure_hl" } },
    { "Height", "m", { "altitude", "height_above_mean_sea_level", "geopotential_height", "height" },
      { "height", "zg", "Z3", "z", "altitude", "zfull", "z_mc", "HGT_full", "geopotential_height",
        "gh" } },
    { "Geopotential", "m2 s-2", { "geopotential" },
      { "z", "geopotential", "PH", "phi", "Phi", "Z" } },
    { "ConvectiveLiquidWater", "kg kg-1", {}, { "mr_ccliq" } },
    { "ConvectiveIceWater", "kg kg-1", {}, { "mr_ccice" } },
    { "BasePressure", "Pa", {}, { "PB" } },
    { "BaseGeopotential", "m2 s-2", {}, { "PHB" } },
    { "SurfacePressure", "Pa", { "surface_air_pressure" },
      { "ps", "PS", "sp", "PSFC", "psfc", "surface_pressure", "aps", "psl_sfc" } },
    { "LogSurfacePressure", "1",
      { "logarithm_of_surface_air_pressure", "logarithm_of_surface_pressure" },
      { "lnsp", "LNSP" } },
    { "SurfaceAltitude", "m", { "surface_altitude" },
      { "orog", "orography", "surface_altitude", "HGT", "HSURF", "topo", "z_sfc", "zs", "oro" } },
    { "SurfaceGeopotential", "m2 s-2", { "surface_geopotential" },
      { "PHIS", "geosp", "z_surface", "surface_geopotential" } },
    { "VerticalCoordinate", "", {}, {} },
    { "HybridA", "", {}, { "hyam", "ap", "a" } },
    { "HybridB", "1", {}, { "hybm", "b" } },
    { "ReferencePressure", "Pa", { "reference_air_pressure_for_atmosphere_vertical_coordinate" },
      { "P0", "p0" } },
    { "Longitude", "degrees_east", { "longitude" },
      { "lon", "longitude", "XLONG", "XLON", "nav_lon", "lons", "xlong", "clon", "TLON", "Lon",
        "long" } },
    { "Latitude", "degrees_north", { "latitude" },
      { "lat", "latitude", "XLAT", "nav_lat", "lats", "xlat", "clat", "TLAT", "Lat" } },
    { "Time", "", { "time" }, { "time", "XTIME", "Time", "valid_time", "t" } },
  };
  return table;
}
}

const RoleRule& ruleOf(Role role)
{
  return rules()[static_cast<std::size_t>(role)];
}

Role roleOfName(const std::string& name)
{
  for (std::size_t i = 0; i < rules().size(); ++i)
  {
    if (name == rules()[i].name)
    {
      return static_cast<Role>(i);
    }
  }
  return Role::Count;
}
}
