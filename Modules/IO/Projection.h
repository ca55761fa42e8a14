// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Projection.h
 * @brief Map projections by PROJ, and the PROJ definitions of CF grid mappings and of WRF's global attributes.
 */
#ifndef Projection_h
#define Projection_h

#include "NetCDFFile.h"

#include <memory>
#include <string>

namespace nephoscope
{
/// Between longitude and latitude, degrees, and a plane in metres. One thread at a time.
class Projection
{
public:
  /// @throws ReadError if PROJ does not know the definition
  explicit Projection(const std::string& definition);
  ~Projection();
  Projection(const Projection&) = delete;
  Projection& operator=(const Projection&) = delete;

  const std::string& definition() const { return this->Definition; }
  bool forward(double longitude, double latitude, double& x, double& y) const;
  bool inverse(double x, double y, double& longitude, double& latitude) const;
  /// Unit vector of true north in the plane's axes, by a central difference along the meridian; false at a singular place.
  bool north(double longitude, double latitude, double& x, double& y) const;

private:
  struct Handle;
  std::string Definition;
  std::unique_ptr<Handle> Proj;
};

constexpr double MeanEarthRadius = 6371229; ///< m, of ECMWF, the Met Office and NCEP

/// Radius that a CF grid mapping names, else MeanEarthRadius.
double planetRadius(const FileVariable* mapping);

/**
 * PROJ definition of a CF grid mapping; empty for latitude_longitude. Rotated longitudes and latitudes become metres along
 * the rotated equator: x = R rlon, y = R rlat.
 * @throws ReadError if the mapping is not known
 */
std::string projOfGridMapping(const FileVariable& mapping);

/// PROJ definition from WRF's MAP_PROJ, TRUELAT1 ...; empty if there is none.
std::string projOfWRF(const NetCDFFile& file);

/// A conformal plane about a place: stereographic.
std::string projAbout(double longitude, double latitude, double radius);
}
#endif
