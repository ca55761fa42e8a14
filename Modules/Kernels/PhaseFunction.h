// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file PhaseFunction.h
 * @brief Phase functions in closed form, 1 over all directions, 1/sr. mu is the cosine between the directions of propagation before and
 *        after: 1 is forward.
 *
 *     Henyey and Greenstein 1941    p = (1 - g^2) / (4 pi (1 + g^2 - 2 g mu)^(3/2))
 *     Draine 2003 (eq. 4)           p = p_HG (1 + alpha mu^2) / (1 + alpha (1 + 2 g^2)/3)
 *
 * Draine's is Henyey and Greenstein's for alpha = 0, Rayleigh's for alpha = 1 and g = 0. g is the mean cosine of the former only.
 *
 * Templated on the scalar of the constants, so that they can be differentiated while they are fitted.
 * Domain: -1 < g < 1, alpha >= 0, -1 <= mu <= 1. At g = +-1 all light goes one way; there and beyond the result is 0.
 * @sa fitPhase, TestPhaseFunction.cxx
 */
#ifndef PhaseFunction_h
#define PhaseFunction_h

#include <cmath>

namespace nephoscope
{
template <class T>
T henyeyGreenstein(const T& g, double mu)
{
  using std::sqrt;
  constexpr double Sphere = 12.566370614359172954;
  const T spread = T(1) - g * g;
  const T distance = T(1) + g * g - 2.0 * g * mu;
  if (!(spread > T(0)) || !(distance > T(0)))
  {
    return T(0);
  }
  return spread / (Sphere * distance * sqrt(distance));
}

template <class T>
T draine(const T& g, const T& alpha, double mu)
{
  return henyeyGreenstein(g, mu) * (T(1) + alpha * (mu * mu)) /
    (T(1) + alpha * (T(1) + 2.0 * g * g) / 3.0);
}
}
#endif
