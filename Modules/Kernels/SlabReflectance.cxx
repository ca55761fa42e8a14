// SPDX-License-Identifier: BSD-3-Clause
#include "SlabReflectance.h"

#include "GaussLegendre.h"
#include "PhaseFunction.h"

namespace nephoscope
{
SlabReflectance::SlabReflectance(double g, double mu0)
{
  constexpr double Pi = 3.14159265358979323846;
  constexpr int Points = 64;
  const std::vector<QuadraturePoint> azimuths = gaussLegendre(Points, 0, Pi);
  for (const QuadraturePoint& mu : gaussLegendre(Points, 0, 1))
  {
    const double across = std::sqrt((1 - mu.x * mu.x) * (1 - mu0 * mu0));
    double mean = 0;
    for (const QuadraturePoint& phi : azimuths)
    {
      const double cosine = -mu.x * mu0 + across * std::cos(phi.x);
      mean += phi.weight / Pi * 4 * Pi * henyeyGreenstein(g, cosine);
    }
    this->Parts.push_back({ mu.weight * mean / 2 * mu.x / (mu.x + mu0), 1 / mu.x + 1 / mu0 });
  }
}
}
