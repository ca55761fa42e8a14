// SPDX-License-Identifier: BSD-3-Clause
#include "VerticalCoordinate.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
// US Standard Atmosphere 1976, tables 4 and 2: base of each layer, m, and its lapse rate, K/m.
struct Layer
{
  double base;
  double lapse;
  double temperature; // at the base, K
  double pressure;    // at the base, Pa: filled in from the layer below
};
constexpr double StandardGasConstant = 8314.32 / 28.9644; // R*/M0 of the 1976 standard, J/(kg K)
constexpr int Layers = 7;
constexpr double StandardFloor = 150.0; // the mesosphere's law ends before this temperature

double pressureInLayer(const Layer& layer, double z)
{
  const double g = StandardGravity / StandardGasConstant;
  if (layer.lapse == 0)
  {
    return layer.pressure * std::exp(-g * (z - layer.base) / layer.temperature);
  }
  const double t = layer.temperature + layer.lapse * (z - layer.base);
  return layer.pressure * std::pow(t / layer.temperature, -g / layer.lapse);
}

double heightInLayer(const Layer& layer, double p)
{
  const double g = StandardGravity / StandardGasConstant;
  if (layer.lapse == 0)
  {
    return layer.base - layer.temperature / g * std::log(p / layer.pressure);
  }
  const double t = layer.temperature * std::pow(p / layer.pressure, -layer.lapse / g);
  return layer.base + (t - layer.temperature) / layer.lapse;
}

struct Table
{
  Layer layers[Layers + 1] = { { 0, -0.0065, 288.15, 101325 }, { 11000, 0, 0, 0 },
    { 20000, 0.001, 0, 0 }, { 32000, 0.0028, 0, 0 }, { 47000, 0, 0, 0 }, { 51000, -0.0028, 0, 0 },
    { 71000, -0.002, 0, 0 }, { 84852, 0, 0, 0 } }; // the last goes on, isothermal

  Table()
  {
    for (int i = 1; i <= Layers; ++i)
    {
      const Layer& below = layers[i - 1];
      layers[i].temperature = below.temperature + below.lapse * (layers[i].base - below.base);
      layers[i].pressure = pressureInLayer(below, layers[i].base);
    }
  }
};

const Table& table()
{
  static const Table instance;
  return instance;
}

const Layer& layerOfHeight(double z)
{
  int i = 0;
  while (i < Layers && z >= table().layers[i + 1].base)
  {
    ++i;
  }
  return table().layers[i];
}
}

double lnPressure(double p0, double lev)
{
  return p0 * std::exp(-lev);
}

double temperatureOfPotential(double theta, double p)
{
  return theta * std::pow(p / 1e5, DryAirKappa);
}

void hypsometricHeights(
  std::size_t n, const double* p, const double* tv, double ps, double zs, double* z)
{
  const double scale = DryAirGasConstant / StandardGravity;
  for (std::size_t k = 0; k < n; ++k)
  {
    z[k] = k == 0 ? zs + scale * tv[0] * std::log(ps / p[0])
                  : z[k - 1] + scale * 0.5 * (tv[k - 1] + tv[k]) * std::log(p[k - 1] / p[k]);
  }
}

double standardPressure(double z)
{
  // The troposphere's law, carried down, stays finite for any z <= 0; carried up, exp underflows to 0.
  return pressureInLayer(layerOfHeight(z), z);
}

double standardTemperature(double z)
{
  const Layer& layer = layerOfHeight(z);
  return std::max(StandardFloor, layer.temperature + layer.lapse * (z - layer.base));
}

double standardHeight(double p)
{
  p = std::max(p, 1e-6);
  int i = 0;
  while (i < Layers && p <= table().layers[i + 1].pressure)
  {
    ++i;
  }
  return heightInLayer(table().layers[i], p);
}

double saturationPressureWater(double temperature)
{
  const double t = std::clamp(temperature, 123.0, 332.0);
  const double lnT = std::log(t);
  return std::exp(54.842763 - 6763.22 / t - 4.210 * lnT + 0.000367 * t +
    std::tanh(0.0415 * (t - 218.8)) * (53.878 - 1331.22 / t - 9.44523 * lnT + 0.014025 * t));
}

double saturationPressureIce(double temperature)
{
  const double t = std::clamp(temperature, 110.0, 273.16);
  return std::exp(9.550426 - 5723.265 / t + 3.53068 * std::log(t) - 0.00728332 * t);
}

double saturationHumidity(double e, double p)
{
  const double eps = DryAirGasConstant / WaterVapourGasConstant;
  return e >= p ? 1.0 : eps * e / (p - (1 - eps) * e);
}

double cloudFractionXuRandall(double liquid, double ice, double q, double temperature, double p)
{
  liquid = std::max(liquid, 0.0);
  ice = std::max(ice, 0.0);
  const double condensate = liquid + ice;
  if (condensate <= 0)
  {
    return 0;
  }
  const double qsWater = saturationHumidity(saturationPressureWater(temperature), p);
  const double qsIce = saturationHumidity(saturationPressureIce(temperature), p);
  const double qs = (liquid * qsWater + ice * qsIce) / condensate;
  const double rh = std::max(q, 0.0) / qs;
  if (rh >= 1)
  {
    return 1;
  }
  return std::pow(rh, 0.25) * -std::expm1(-100 * condensate / std::pow((1 - rh) * qs, 0.49));
}
}
