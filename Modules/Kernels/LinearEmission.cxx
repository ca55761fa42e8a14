// SPDX-License-Identifier: BSD-3-Clause
#include "LinearEmission.h"

#include <cmath>
#include <cstddef>

namespace nephoscope
{
namespace
{
/// Gauss-Legendre on [0, 1], abscissae from the middle.
template <std::size_t N>
struct Rule
{
  double at[N];
  double weight[N];
};
constexpr Rule<3> Thin = { { -0.38729833462074169, 0, 0.38729833462074169 },
  { 5.0 / 18, 8.0 / 18, 5.0 / 18 } };
constexpr Rule<6> Thick = { { -0.46623475710157600, -0.33060469323313226, -0.11930959304159845,
                              0.11930959304159845, 0.33060469323313226, 0.46623475710157600 },
  { 0.085662246189585173, 0.18038078652406930, 0.23395696728634552, 0.23395696728634552,
    0.18038078652406930, 0.085662246189585173 } };

/// int x tau'(x) exp(-tau(x)) dx over [0, end] in equal parts, over tau.
template <std::size_t N>
double farIntegral(const Rule<N>& rule, double tau, double skew, double end, int parts)
{
  double sum = 0;
  for (int part = 0; part < parts; ++part)
  {
    for (std::size_t n = 0; n < N; ++n)
    {
      const double x = (part + 0.5 + rule.at[n]) * end / parts;
      sum +=
        rule.weight[n] * x * (1 + skew * (2 * x - 1)) * std::exp(-tau * x * (1 + skew * (x - 1)));
    }
  }
  return sum * end / parts;
}
}

EmissionWeights linearEmission(double tau, double skew)
{
  constexpr double Enough = 20; // optical depth behind which nothing counts
  constexpr double InAPart = 2; // optical depth that six points do well
  constexpr double Little = 0.05;
  constexpr double Solid = 1e30;
  if (!(tau < Solid))
  {
    return { 1, 0 };
  }
  const double steepest = tau * (1 + std::abs(skew));
  if (steepest < Little)
  {
    const double far = tau * farIntegral(Thin, tau, skew, 1, 1);
    return { -std::expm1(-tau) - far, far };
  }
  double end = 1;
  if (tau > Enough)
  {
    // x (1 + skew (x - 1)) = share
    const double share = Enough / tau;
    const double b = 1 - skew;
    end = 2 * share / (b + std::sqrt(b * b + 4 * skew * share));
  }
  const int parts = 1 + static_cast<int>(steepest * end / InAPart);
  const double far = tau * farIntegral(Thick, tau, skew, end, parts);
  return { -std::expm1(-tau) - far, far };
}
}
