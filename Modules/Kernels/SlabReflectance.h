// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file SlabReflectance.h
 * @brief Sunlight that a plane-parallel slab sends back after one scattering, as a share of what falls on it.
 *
 *     R = albedo int_0^1 P(mu, mu0)/2  mu/(mu + mu0)  (1 - exp(-tau (1/mu + 1/mu0)))  dmu
 *
 * mu cosine of the outgoing direction to the normal, mu0 of the sun's; P the mean over azimuth of 4 pi times Henyey and Greenstein's
 * phase function, whose cosine is -mu mu0 + sqrt((1 - mu^2)(1 - mu0^2)) cos phi; tau optical depth along the normal.
 * Chandrasekhar 1960, section 47, integrated over the hemisphere. Isotropic and tau infinite: albedo (1 - mu0 ln(1 + 1/mu0)) / 2.
 *
 * Quadrature by 64 points over mu and over phi: errors below 1e-9 for |g| <= 0.9, mu0 >= 0.1. Templated on the scalar of albedo and
 * depth. Domain: |g| < 1, 0 < mu0 <= 1, depth >= 0; the albedo may be beyond 1, as an effective one.
 * @sa fitSlab, TestSlabReflectance.cxx
 */
#ifndef SlabReflectance_h
#define SlabReflectance_h

#include <cmath>
#include <vector>

namespace nephoscope
{
class SlabReflectance
{
public:
  SlabReflectance(double g, double mu0);

  template <class T>
  T operator()(const T& albedo, const T& depth) const
  {
    using std::exp;
    T sum(0);
    for (const Part& part : this->Parts)
    {
      sum += part.weight * (T(1) - exp(-(depth * part.rate)));
    }
    return albedo * sum;
  }

private:
  struct Part
  {
    double weight; ///< P/2 mu/(mu + mu0) dmu
    double rate;   ///< 1/mu + 1/mu0
  };
  std::vector<Part> Parts;
};
}
#endif
