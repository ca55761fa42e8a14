// SPDX-License-Identifier: BSD-3-Clause
#include "Optics.h"

#include "VerticalCoordinate.h"

#include <cmath>

namespace nephoscope
{
double airDensity(double pressure, double temperature)
{
  return pressure / (DryAirGasConstant * temperature);
}

double standardAirDensity(double z)
{
  return airDensity(standardPressure(z), standardTemperature(z));
}

float usableExtinction(double extinction)
{
  if (std::isnan(extinction))
  {
    return static_cast<float>(extinction);
  }
  if (extinction >= DensestExtinction)
  {
    return DensestExtinction;
  }
  return extinction > 0 ? static_cast<float>(extinction) : 0.0F;
}
}
