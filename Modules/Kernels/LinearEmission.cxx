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

/// Coefficients of the weights' series.
struct ThinSeries
{
  static constexpr int Most = 12;
  double near[Most][Most + 1] = {}; ///< of tau^m (-skew)^k in w0, [m - 1][k]
  double both[Most] = {};           ///< of tau^m in w0 + w1, [m - 1]

  constexpr ThinSeries()
  {
    double factor = -1; // (-1)^(m-1) / m!
    for (int m = 1; m <= Most; ++m)
    {
      factor /= -m;
      this->both[m - 1] = factor;
      double term = factor / (m + 1);
      for (int k = 0; k <= m; ++k)
      {
        this->near[m - 1][k] = term;
        term *= static_cast<double>(m - k) / (m + k + 2);
      }
    }
  }
};
constexpr ThinSeries Series;

/// The weights to so many powers of tau, their sum to more.
template <int Powers, int PowersOfSum>
EmissionWeights ofThin(double tau, double skew)
{
  double near = 0;
  for (int m = Powers; m >= 1; --m)
  {
    double inSkew = 0;
    for (int k = m; k >= 0; --k)
    {
      inSkew = Series.near[m - 1][k] - skew * inSkew;
    }
    near = (inSkew + near) * tau;
  }
  double both = 0;
  for (int m = PowersOfSum; m >= 1; --m)
  {
    both = (Series.both[m - 1] + both) * tau;
  }
  return { near, both - near };
}
}

EmissionWeights linearEmission(double tau, double skew)
{
  constexpr double Enough = 20; // optical depth behind which nothing counts
  constexpr double InAPart = 2; // optical depth that six points do well
  constexpr double Thinnest = 0.01;
  constexpr double Thin = 0.2;
  constexpr double Solid = 1e30;
  if (!(tau < Solid))
  {
    return { 1, 0 };
  }
  if (tau < Thin)
  {
    return tau < Thinnest ? ofThin<3, 6>(tau, skew) : ofThin<6, 12>(tau, skew);
  }
  const double steepest = tau * (1 + std::abs(skew));
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
