// SPDX-License-Identifier: BSD-3-Clause
#include "GaussianDensity.h"

namespace nephoscope
{
double gaussianMass(const double* term)
{
  constexpr double RootTwoPi = 2.5066282746310002;
  double mass = term[GaussianAmplitude];
  constexpr GaussianPart Diagonal[] = { GaussianM00, GaussianM11, GaussianM22 };
  for (const int part : Diagonal)
  {
    mass *= term[part] == 0 ? 1 : RootTwoPi / std::abs(term[part]);
  }
  return mass;
}
}
