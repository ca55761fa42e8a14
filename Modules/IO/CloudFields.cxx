// SPDX-License-Identifier: BSD-3-Clause
#include "CloudFields.h"

#include "NumberText.h"
#include "ReadError.h"
#include "VerticalCoordinate.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
constexpr float LargestFraction = 1.01F; // what rounding and packing may add to 1
constexpr float UnitlessPerCent = 1.5F;  // above it, a fraction without units is in per cent

template <class Work>
void overPoints(std::size_t n, const Work& work)
{
  vtkSMPTools::For(0, static_cast<vtkIdType>(n),
    [&work](vtkIdType first, vtkIdType last)
    {
      for (vtkIdType i = first; i < last; ++i)
      {
        work(static_cast<std::size_t>(i));
      }
    });
}

float largest(const std::vector<float>& values)
{
  float most = -1;
  for (float value : values)
  {
    most = value > most ? value : most; // NaN compares false
  }
  return most;
}

/// A fraction without units may be in per cent: the whole first step decides, so that every piece and step agrees.
float unitlessScale(CloudFile& file, const RoleVariable& role, const FieldReader& reader)
{
  if (!role.unitless)
  {
    return 1;
  }
  Region whole;
  for (std::size_t i = 0; i < file.Grid.nx; ++i)
  {
    whole.columns.push_back(i);
  }
  for (std::size_t j = 0; j < file.Grid.ny; ++j)
  {
    whole.rows.push_back(j);
  }
  const float most = largest(reader.field(role, whole));
  if (most <= UnitlessPerCent)
  {
    return 1;
  }
  file.warn("variable " + role.variable->name + ": it has no units; its values up to " +
    numberText(most) + " are taken for per cent");
  return 0.01F;
}

std::vector<float> readFraction(CloudFile& file, const FieldReader& reader, const Region& region)
{
  const RoleVariable* role = file.find(Role::CloudFraction);
  if (!role)
  {
    return {};
  }
  std::vector<float> fraction = reader.field(*role, region);
  const float scale = unitlessScale(file, *role, reader);
  const float most = largest(fraction) * scale;
  if (most > LargestFraction)
  {
    throw ReadError("variable " + role->variable->name + ": its largest value is " +
      numberText(most) + ", but a cloud fraction ends at 1; correct its units ('" +
      role->variable->text("units").substr(0, 80) + "'), to '%' if it is in per cent");
  }
  overPoints(fraction.size(),
    [&fraction, scale](std::size_t i)
    {
      fraction[i] =
        std::isnan(fraction[i]) ? fraction[i] : std::clamp(fraction[i] * scale, 0.0F, 1.0F);
    });
  return fraction;
}

std::vector<float> readWater(const CloudFile& file, const FieldReader& reader, const Region& region,
  Role role, Role convective)
{
  const RoleVariable* own = file.find(role);
  if (!own)
  {
    return {};
  }
  std::vector<float> water = reader.field(*own, region);
  if (const RoleVariable* other = file.find(convective))
  {
    const std::vector<float> more = reader.field(*other, region);
    overPoints(water.size(), [&](std::size_t i) { water[i] += more[i]; });
  }
  // Packing and advection leave tiny negative values.
  overPoints(water.size(), [&water](std::size_t i) { water[i] = water[i] < 0 ? 0 : water[i]; });
  return water;
}

void readWind(
  const CloudFile& file, const FieldReader& reader, const Region& region, CloudFields& fields)
{
  const RoleVariable* u = file.find(Role::EastwardWind);
  const RoleVariable* v = file.find(Role::NorthwardWind);
  if (!u || !v)
  {
    return;
  }
  fields.east = reader.field(*u, region);
  fields.north = reader.field(*v, region);
  if (const RoleVariable* w = file.find(Role::UpwardWind))
  {
    fields.up = reader.field(*w, region);
  }
  else if (const RoleVariable* omega = file.find(Role::PressureVelocity))
  {
    // w = -omega / (rho g), rho = p / (Rd Tv)
    fields.up = reader.field(*omega, region);
    const VerticalReader::Fields& air = fields.air;
    overPoints(fields.up.size(),
      [&](std::size_t i)
      {
        const double t =
          air.temperature.empty() ? standardTemperature(air.height[i]) : air.temperature[i];
        const double q = air.humidity.empty() || std::isnan(air.humidity[i]) ? 0 : air.humidity[i];
        const double density =
          std::max(air.pressure[i], 1.0F) / (DryAirGasConstant * virtualTemperature(t, q));
        fields.up[i] = static_cast<float>(-fields.up[i] / (density * StandardGravity));
      });
  }
  else
  {
    fields.up.assign(fields.east.size(), 0.0F);
  }
}

void diagnoseFraction(CloudFields& fields)
{
  const std::size_t n = fields.air.temperature.size();
  fields.fraction.resize(n);
  overPoints(n,
    [&fields](std::size_t i)
    {
      const VerticalReader::Fields& air = fields.air;
      const double liquid = fields.liquid.empty() ? 0 : fields.liquid[i];
      const double ice = fields.ice.empty() ? 0 : fields.ice[i];
      const double sum = liquid + ice + air.humidity[i] + air.temperature[i] + air.pressure[i];
      fields.fraction[i] = static_cast<float>(std::isfinite(sum) && air.pressure[i] > 0
          ? cloudFractionXuRandall(
              liquid, ice, air.humidity[i], air.temperature[i], air.pressure[i])
          : NAN);
    });
}

std::string nameOf(const CloudFile& file, Role role)
{
  return file.find(role)->variable->name;
}
}

bool isGridWind(const CloudFile& file)
{
  const RoleVariable* u = file.find(Role::EastwardWind);
  if (!u)
  {
    return false;
  }
  const std::string standard = u->variable->text("standard_name");
  return standard == "x_wind" || standard == "grid_eastward_wind" ||
    (file.isWRF() && standard != "eastward_wind");
}

bool canDiagnose(const CloudFile& file)
{
  return !file.find(Role::CloudFraction) &&
    (file.find(Role::LiquidWater) || file.find(Role::IceWater)) &&
    file.find(Role::SpecificHumidity) &&
    (file.find(Role::Temperature) || file.find(Role::PotentialTemperature));
}

void describeFields(CloudFile& file, bool diagnose)
{
  if (!file.find(Role::CloudFraction))
  {
    const bool can = canDiagnose(file);
    file.derive(std::string("CloudFraction: ") +
      (can && diagnose
          ? "diagnosed from condensate, humidity and temperature after Xu and Randall 1996"
          : can ? "not in the file and not read; it can be diagnosed from condensate (Xu and "
                  "Randall 1996)"
                : "not in the file and not read"));
  }
  for (const auto& [role, convective] : { std::pair(Role::LiquidWater, Role::ConvectiveLiquidWater),
         std::pair(Role::IceWater, Role::ConvectiveIceWater) })
  {
    if (file.find(role) && file.find(convective))
    {
      file.derive(std::string(ruleOf(role).name) + ": " + nameOf(file, role) + " + " +
        nameOf(file, convective));
    }
  }
  if (!file.find(Role::Temperature) && file.find(Role::PotentialTemperature))
  {
    const std::string theta = nameOf(file, Role::PotentialTemperature);
    file.derive("Temperature: from potential temperature " + theta +
      (file.isWRF() && theta == "T" ? " + 300 K" : "") + " and Pressure");
  }
  if (file.find(Role::EastwardWind) && file.find(Role::NorthwardWind))
  {
    const bool w = file.find(Role::UpwardWind) != nullptr;
    const bool omega = !w && file.find(Role::PressureVelocity);
    file.derive("Wind: " + nameOf(file, Role::EastwardWind) + ", " +
      nameOf(file, Role::NorthwardWind) + ", " +
      (w          ? nameOf(file, Role::UpwardWind)
          : omega ? "upward from " + nameOf(file, Role::PressureVelocity) + ", hydrostatic"
                  : std::string("upward 0")) +
      (isGridWind(file) ? ", turned from the grid's directions" : "") + ", along the scene's axes");
  }
}

CloudFields readFields(
  CloudFile& file, const VerticalReader& vertical, const Region& region, bool diagnose)
{
  const FieldReader reader(file);
  CloudFields fields;
  fields.fraction = readFraction(file, reader, region);
  fields.liquid = readWater(file, reader, region, Role::LiquidWater, Role::ConvectiveLiquidWater);
  fields.ice = readWater(file, reader, region, Role::IceWater, Role::ConvectiveIceWater);
  vertical.compute(reader, region, fields.air);
  readWind(file, reader, region, fields);
  const RoleVariable* theta = file.find(Role::PotentialTemperature);
  if (theta && theta->chosen)
  {
    fields.potential = reader.field(*theta, region);
  }
  if (diagnose && canDiagnose(file))
  {
    diagnoseFraction(fields);
  }
  return fields;
}
}
