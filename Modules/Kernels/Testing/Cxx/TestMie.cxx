// SPDX-License-Identifier: BSD-3-Clause
#include "GaussLegendre.h"
#include "Mie.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using nephoscope::Droplets;
using nephoscope::gaussLegendre;
using nephoscope::MiePhase;
using nephoscope::miePhase;
using nephoscope::MieSeries;
using nephoscope::MieSphere;

namespace
{
constexpr double Pi = 3.14159265358979323846;
}

// H. Du, Mie-scattering calculation, Applied Optics 43, 1951 (2004), table 1, whose values are those of Wiscombe's MIEV0.
TEST(Mie, HasThePublishedEfficiencies)
{
  struct Row
  {
    double x;
    double n;
    double k;
    double extinction;
    double scattering;
  };
  for (const Row& row :
    { Row{ 0.099, 0.75, 0, 7.417859e-06, 7.417859e-06 },
      Row{ 0.101, 0.75, 0, 8.033538e-06, 8.033538e-06 }, Row{ 10, 0.75, 0, 2.232265, 2.232265 },
      Row{ 1000, 0.75, 0, 1.997908, 1.997908 }, Row{ 100, 1.33, 1e-5, 2.101321, 2.096594 },
      Row{ 10000, 1.33, 1e-5, 2.004089, 1.723857 }, Row{ 0.055, 1.5, 1, 0.10149104, 1.131687e-05 },
      Row{ 0.056, 1.5, 1, 0.1033467, 1.216311e-05 }, Row{ 100, 1.5, 1, 2.097502, 1.283697 },
      Row{ 10000, 1.5, 1, 2.004368, 1.236574 }, Row{ 1, 10, 10, 2.532993, 2.049405 },
      Row{ 100, 10, 10, 2.071124, 1.836785 }, Row{ 10000, 10, 10, 2.005914, 1.795393 } })
  {
    const MieSphere sphere = MieSeries(row.x, { row.n, row.k }).sphere();
    EXPECT_NEAR(sphere.extinction / row.extinction, 1, 5e-7) << row.x << ", " << row.n;
    EXPECT_NEAR(sphere.scattering / row.scattering, 1, 5e-7) << row.x << ", " << row.n;
  }
}

// Bohren and Huffman 1983, appendix A, the sample of BHMIE: a sphere of 0.525 um, index 1.55, at 0.6328 um.
TEST(Mie, IsTheBooksSample)
{
  const MieSphere sphere = MieSeries(2 * Pi * 0.525 / 0.6328, 1.55).sphere();
  EXPECT_NEAR(sphere.extinction, 3.10543, 5e-6);
  EXPECT_NEAR(sphere.scattering, 3.10543, 5e-6);
}

// Wiscombe's MIEV0, test case 10: amplitudes forward of x = 100, index 1.33 - 1e-5 i; he has the other sign of i.
TEST(Mie, HasThePublishedAmplitudes)
{
  const auto s = MieSeries(100, { 1.33, 1e-5 }).amplitudes(1);
  EXPECT_NEAR(s.s1.real(), 5253.302, 1e-3);
  EXPECT_NEAR(std::abs(s.s1.imag()), 124.3188, 1e-4);
  EXPECT_EQ(s.s1, s.s2);
}

// The optical theorem: Q_ext = 4/x^2 Re S(forward), (4.76); and the phase function's integral and mean cosine are Q_sca and g.
TEST(Mie, KeepsTheOpticalTheoremAndItsMoments)
{
  for (const double x : { 0.01, 1.0, 7.5, 60.0 })
  {
    const MieSeries series(x, { 1.4, 0.01 });
    EXPECT_NEAR(4 / (x * x) * series.amplitudes(1).s1.real(), series.sphere().extinction,
      1e-12 * series.sphere().extinction);
    double total = 0;
    double forward = 0;
    for (const auto& mu : gaussLegendre(200, -1, 1))
    {
      const double p = series.differential(mu.x) * 2 * Pi * mu.weight;
      total += p;
      forward += p * mu.x;
    }
    EXPECT_NEAR(total / series.sphere().scattering, 1, 1e-10) << x;
    EXPECT_NEAR(forward / total, series.sphere().asymmetry, 1e-10) << x;
  }
}

// Small spheres are Rayleigh's: Q = 8/3 x^4 |(m^2 - 1)/(m^2 + 2)|^2 up to order x^2, and p = 3/(16 pi) (1 + mu^2).
TEST(Mie, IsRayleighsWhenSmall)
{
  const double x = 0.01;
  const double m2 = 1.33 * 1.33;
  const double rayleigh = 8.0 / 3 * std::pow(x, 4) * std::pow((m2 - 1) / (m2 + 2), 2);
  const MieSeries series(x, 1.33);
  EXPECT_NEAR(series.sphere().scattering / rayleigh, 1, x * x);
  for (const double mu : { -1.0, 0.2, 1.0 })
  {
    EXPECT_NEAR(
      series.differential(mu) / series.sphere().scattering, 3 / (16 * Pi) * (1 + mu * mu), 1e-4);
  }
}

// Whatever comes in, what comes out is finite; NaN scatters nothing.
TEST(Mie, IsFiniteForAnyInput)
{
  const double huge = std::numeric_limits<double>::infinity();
  for (const double x : { -1.0, 0.0, 1e-300, huge, std::nan("") })
  {
    const MieSeries series(x, { 1.33, -1 });
    EXPECT_TRUE(std::isfinite(series.sphere().extinction)) << x;
    EXPECT_TRUE(std::isfinite(series.differential(0.3))) << x;
  }
  EXPECT_EQ(MieSeries(std::nan(""), 1.33).sphere().scattering, 0);
  EXPECT_EQ(MieSeries(1, std::nan("")).differential(1), 0);
}

// Of many sizes: 1 over all directions, g that of the phase function, and twice the sizes change g and Q by no more than the narrow
// resonances of single sizes do, 1e-3. At 0.5 um the curve is smooth, and 100 sizes suffice.
TEST(Mie, AveragesOverDroplets)
{
  std::vector<double> cosines;
  const auto places = gaussLegendre(400, -1, 1);
  for (const auto& mu : places)
  {
    cosines.push_back(mu.x);
  }
  const MiePhase mean = miePhase({ 5e-6, 0.1 }, 550e-9, cosines, 400);
  double total = 0;
  double forward = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    total += 2 * Pi * mean.phase[i] * places[i].weight;
    forward += 2 * Pi * mean.phase[i] * places[i].weight * places[i].x;
  }
  EXPECT_NEAR(total, 1, 1e-6);
  EXPECT_NEAR(forward, mean.asymmetry, 1e-6);
  EXPECT_NEAR(mean.albedo, 1, 1e-5);
  EXPECT_NEAR(
    mean.extinction, 2.17, 0.05); // Hansen and Travis 1974, figure 11: towards 2 as droplets grow
  EXPECT_NEAR(mean.asymmetry, 0.848, 0.005);
  const MiePhase finer = miePhase({ 5e-6, 0.1 }, 550e-9, { 0.0 }, 800);
  EXPECT_NEAR(finer.asymmetry, mean.asymmetry, 1e-3);
  EXPECT_NEAR(finer.extinction, mean.extinction, 2e-3);
  const MiePhase few = miePhase({ 0.5e-6, 0.1 }, 550e-9, { -1.0 }, 100);
  const MiePhase many = miePhase({ 0.5e-6, 0.1 }, 550e-9, { -1.0 }, 400);
  EXPECT_NEAR(few.phase[0] / many.phase[0], 1, 1e-3);
  EXPECT_NEAR(few.asymmetry, many.asymmetry, 1e-5);
}
