// SPDX-License-Identifier: BSD-3-Clause
// How the vertical coordinate becomes fields of pressure and height. VerticalReader.cxx finds it.
#include "ReadError.h"
#include "VerticalCoordinate.h"
#include "VerticalReader.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
constexpr double GravityOfWRF = 9.81; // share/module_model_constants.F

/// Calls work(column) for every column of a layer, in parallel.
template <class Work>
void overColumns(std::size_t layer, const Work& work)
{
  vtkSMPTools::For(0, static_cast<vtkIdType>(layer),
    [&work](vtkIdType first, vtkIdType last)
    {
      for (vtkIdType column = first; column < last; ++column)
      {
        work(static_cast<std::size_t>(column));
      }
    });
}

void addTo(std::vector<float>& sum, const std::vector<float>& other)
{
  std::transform(sum.begin(), sum.end(), other.begin(), sum.begin(), std::plus<float>());
}
}

void VerticalReader::describe(CloudFile& file) const
{
  const auto name = [&](Role role) { return file.find(role)->variable->name; };
  const auto sum = [&](Role role, Role base)
  { return name(role) + (file.find(base) ? " + " + name(base) : std::string()); };
  const bool air = file.find(Role::Temperature) || file.find(Role::PotentialTemperature);
  const bool heightCoordinate = !this->A.empty() && !this->isPressure();
  if (file.find(Role::Pressure))
  {
    const int z = file.Axes.dimensionAlong(*file.find(Role::Pressure)->variable, Axis::Vertical);
    if (file.find(Role::BasePressure) || z != file.Grid.z)
    {
      file.derive("Pressure: " + sum(Role::Pressure, Role::BasePressure) +
        (z != file.Grid.z ? ", mean of the half levels" : ""));
    }
  }
  else if (this->isPressure())
  {
    file.derive("Pressure: from the " + this->Kind + " coordinate");
  }
  else
  {
    file.derive("Pressure: US Standard Atmosphere 1976 at Height");
    file.warn(
      "the file has no pressure: that of the US Standard Atmosphere 1976 at the height is given");
  }
  if (file.find(Role::Height))
  {
    return;
  }
  if (file.find(Role::Geopotential))
  {
    file.derive("Height: (" + sum(Role::Geopotential, Role::BaseGeopotential) +
      (file.isWRF() ? ") / 9.81 m/s2, mean of the faces" : ") / 9.80665 m/s2"));
  }
  else if (heightCoordinate)
  {
    file.derive("Height: from the " + this->Kind + " coordinate");
  }
  else if (air)
  {
    file.derive(std::string("Height: hypsometric, from ") +
      (file.find(Role::SpecificHumidity) ? "temperature and humidity" : "temperature"));
  }
  else
  {
    file.derive("Height: US Standard Atmosphere 1976 at Pressure");
    file.warn("the file has neither height nor temperature: heights are those of the US Standard "
              "Atmosphere 1976");
  }
}

std::vector<float> VerticalReader::pressureOf(const FieldReader& reader, const Region& region) const
{
  if (const RoleVariable* field = this->File.find(Role::Pressure))
  {
    std::vector<float> pressure = reader.field(*field, region);
    if (const RoleVariable* base = this->File.find(Role::BasePressure))
    {
      addTo(pressure, reader.field(*base, region));
    }
    return pressure;
  }
  std::vector<float> pressure;
  if (!this->isPressure())
  {
    return pressure;
  }
  const std::size_t layer = region.layer();
  pressure.resize(layer * this->A.size());
  std::vector<double> surface;
  if (this->Form == Coordinate::HybridPressure)
  {
    surface = reader.surface(this->Surface[0], region);
    if (this->LogSurface)
    {
      std::for_each(surface.begin(), surface.end(), [](double& ps) { ps = std::exp(ps); });
    }
  }
  overColumns(layer,
    [&](std::size_t c)
    {
      for (std::size_t k = 0; k < this->A.size(); ++k)
      {
        const double p =
          surface.empty() ? this->A[k] : hybridPressure(this->A[k], this->B[k], surface[c]);
        pressure[k * layer + c] = static_cast<float>(p);
      }
    });
  return pressure;
}

std::vector<float> VerticalReader::heightOf(const FieldReader& reader, const Region& region) const
{
  if (const RoleVariable* field = this->File.find(Role::Height))
  {
    return reader.field(*field, region);
  }
  if (const RoleVariable* field = this->File.find(Role::Geopotential))
  {
    std::vector<float> height = reader.field(*field, region);
    if (const RoleVariable* base = this->File.find(Role::BaseGeopotential))
    {
      addTo(height, reader.field(*base, region));
    }
    const double g = this->File.isWRF() ? GravityOfWRF : StandardGravity;
    std::for_each(height.begin(), height.end(), [g](float& z) { z = static_cast<float>(z / g); });
    return height;
  }
  std::vector<float> height;
  if (this->A.empty() || this->isPressure())
  {
    return height;
  }
  const std::size_t layer = region.layer();
  height.resize(layer * this->A.size());
  const bool terrain = this->Form != Coordinate::Height;
  const bool sleve = this->Form == Coordinate::Sleve;
  const std::vector<double> first =
    terrain ? reader.surface(this->Surface[0], region) : std::vector<double>();
  const std::vector<double> second =
    sleve ? reader.surface(this->Surface[1], region) : std::vector<double>();
  overColumns(layer,
    [&](std::size_t c)
    {
      for (std::size_t k = 0; k < this->A.size(); ++k)
      {
        const double z = sleve
          ? sleveHeight(this->A[k], 1, this->B[k], first[c], this->C[k], second[c])
          : terrain ? hybridHeight(this->A[k], this->B[k], first[c])
                    : this->A[k];
        height[k * layer + c] = static_cast<float>(z);
      }
    });
  return height;
}

void VerticalReader::compute(const FieldReader& reader, const Region& region, Fields& fields) const
{
  fields.pressure = this->pressureOf(reader, region);
  fields.height = this->heightOf(reader, region);
  const std::size_t n = region.layer() * this->File.Grid.nz;
  if (fields.pressure.empty())
  {
    fields.pressure.resize(n);
    std::transform(fields.height.begin(), fields.height.end(), fields.pressure.begin(),
      [](float z) { return static_cast<float>(standardPressure(z)); });
  }
  const RoleVariable* theta = this->File.find(Role::PotentialTemperature);
  if (const RoleVariable* t = this->File.find(Role::Temperature))
  {
    fields.temperature = reader.field(*t, region);
  }
  else if (theta)
  {
    const double offset = this->File.isWRF() && theta->variable->name == "T" ? 300 : 0;
    fields.temperature = reader.field(*theta, region);
    std::transform(fields.temperature.begin(), fields.temperature.end(), fields.pressure.begin(),
      fields.temperature.begin(),
      [offset](float value, float p)
      { return static_cast<float>(temperatureOfPotential(value + offset, std::max(p, 0.0F))); });
  }
  if (const RoleVariable* q = this->File.find(Role::SpecificHumidity))
  {
    fields.humidity = reader.field(*q, region);
  }
  if (fields.height.empty())
  {
    fields.height.resize(n);
    this->hypsometric(reader, region, fields);
  }
  this->fillHeights(region, fields);
}

void VerticalReader::hypsometric(
  const FieldReader& reader, const Region& region, Fields& fields) const
{
  const std::size_t layer = region.layer();
  const std::size_t nz = this->File.Grid.nz;
  if (fields.temperature.empty())
  {
    std::transform(fields.pressure.begin(), fields.pressure.end(), fields.height.begin(),
      [](float p) { return static_cast<float>(std::isfinite(p) ? standardHeight(p) : NAN); });
    return;
  }
  // From the ground if the file has it, else from the standard height of the lowest level.
  const RoleVariable* ps = this->Surface[0].variable && this->isPressure()
    ? &this->Surface[0]
    : this->File.find(Role::SurfacePressure);
  const RoleVariable* zs = this->File.find(Role::SurfaceAltitude);
  const RoleVariable* phi = this->File.find(Role::SurfaceGeopotential);
  std::vector<double> surface = ps ? reader.surface(*ps, region) : std::vector<double>();
  std::vector<double> ground = zs ? reader.surface(*zs, region)
    : phi                         ? reader.surface(*phi, region)
                                  : std::vector<double>();
  const double toHeight = zs ? 1 : 1 / StandardGravity;
  if (!ps)
  {
    this->File.warn("the file has no surface pressure: heights start from the standard atmosphere "
                    "at the lowest level");
  }
  else if (ground.empty())
  {
    this->File.warn("the file has no orography: the ground's height is that of the standard "
                    "atmosphere at the surface pressure");
  }
  const bool logarithm = ps == &this->Surface[0] && this->LogSurface;
  overColumns(layer,
    [&](std::size_t c)
    {
      thread_local std::vector<double> p;
      thread_local std::vector<double> tv;
      thread_local std::vector<double> z;
      p.resize(nz);
      tv.resize(nz);
      z.resize(nz);
      for (std::size_t k = 0; k < nz; ++k)
      {
        const std::size_t at = k * layer + c;
        p[k] = std::max(fields.pressure[at], 1e-3F);
        const double q = fields.humidity.empty() ? 0 : fields.humidity[at];
        tv[k] = virtualTemperature(fields.temperature[at], std::isfinite(q) ? q : 0);
      }
      double bottom = surface.empty() ? p[0] : logarithm ? std::exp(surface[c]) : surface[c];
      bottom = std::isfinite(bottom) && bottom > 0 ? bottom : p[0];
      const double base =
        surface.empty() || ground.empty() ? standardHeight(bottom) : ground[c] * toHeight;
      hypsometricHeights(nz, p.data(), tv.data(), bottom, base, z.data());
      for (std::size_t k = 0; k < nz; ++k)
      {
        fields.height[k * layer + c] = static_cast<float>(z[k]);
      }
    });
}

void VerticalReader::fillHeights(const Region& region, Fields& fields) const
{
  // A masked height still needs a place: that of its pressure in the standard atmosphere, else in line with its column.
  const std::size_t layer = region.layer();
  const std::size_t nz = this->File.Grid.nz;
  fields.groundless.assign(fields.height.size(), 0);
  overColumns(layer,
    [&](std::size_t c)
    {
      double last = 0;
      for (std::size_t k = 0; k < nz; ++k)
      {
        const std::size_t at = k * layer + c;
        if (!(std::abs(fields.height[at]) < 1e7F))
        {
          const float p = fields.pressure[at];
          const double nominal = this->isPressure() && this->A[k] > 0 ? this->A[k] : 0;
          fields.height[at] = static_cast<float>(p > 0 ? standardHeight(p)
              : nominal > 0                            ? standardHeight(nominal)
                                                       : last + 100);
          fields.groundless[at] = 1;
        }
        last = fields.height[at];
      }
    });
}
}
