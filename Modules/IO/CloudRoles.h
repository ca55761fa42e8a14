// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file CloudRoles.h
 * @brief What a variable can be to the reader, and the names by which models call it.
 */
#ifndef CloudRoles_h
#define CloudRoles_h

#include <string>
#include <vector>

namespace nephoscope
{
enum class Role
{
  // fields, in the order in which they may define the grid
  CloudFraction,
  LiquidWater,
  IceWater,
  Temperature,
  PotentialTemperature,
  SpecificHumidity,
  EastwardWind,
  NorthwardWind,
  UpwardWind,
  PressureVelocity,
  Pressure,
  Height,
  Geopotential,
  // addends: WRF's base state, convective water beside the large-scale one
  ConvectiveLiquidWater,
  ConvectiveIceWater,
  BasePressure,
  BaseGeopotential,
  // at the ground
  SurfacePressure,
  LogSurfacePressure,
  SurfaceAltitude,
  SurfaceGeopotential,
  // along the vertical
  VerticalCoordinate,
  HybridA,
  HybridB,
  ReferencePressure,
  // along the other axes
  Longitude,
  Latitude,
  Time,
  Count
};

/// How a role is found.
struct RoleRule
{
  const char* name;                       ///< of the role
  const char* units;                      ///< that its values are converted to
  std::vector<std::string> standardNames; ///< best first
  std::vector<std::string> names;         ///< best first
};

const RoleRule& ruleOf(Role role);
inline bool isField(Role role)
{
  return role <= Role::BaseGeopotential;
}
inline bool isSurface(Role role)
{
  return role >= Role::SurfacePressure && role <= Role::SurfaceGeopotential;
}
/// Role::Count if there is no such role.
Role roleOfName(const std::string& name);
}
#endif
