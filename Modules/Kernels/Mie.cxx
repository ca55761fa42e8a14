// SPDX-License-Identifier: BSD-3-Clause
#include "Mie.h"

#include "GaussLegendre.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
using Complex = std::complex<double>;
constexpr double Pi = 3.14159265358979323846;

/// D_n(z) for n = 0 to terms, downward: (4.89).
std::vector<Complex> logarithmicDerivatives(Complex z, int terms)
{
  const double size = std::abs(z);
  const int start = std::max(terms, static_cast<int>(size + 6 * std::cbrt(size))) + 16;
  std::vector<Complex> d(start + 1);
  for (int n = start; n > 0; --n)
  {
    const Complex ratio = static_cast<double>(n) / z;
    d[n - 1] = ratio - 1.0 / (d[n] + ratio);
  }
  d.resize(terms + 1);
  return d;
}

double within(double value, double least, double most)
{
  return std::isnan(value) ? 0 : std::clamp(value, least, most);
}
}

MieSeries::MieSeries(double sizeParameter, Complex index)
  : X(within(sizeParameter, 1e-3, 1e5))
{
  const double n = within(index.real(), 1e-3, 20);
  const double k = within(index.imag(), 0, 20);
  if (this->X == 0 || n == 0 || std::isnan(index.imag()))
  {
    this->X = 1e-3; // nothing scatters
    return;
  }
  const Complex m(n, k);
  const double x = this->X;
  const int terms = static_cast<int>(x + 4 * std::cbrt(x) + 2);
  const std::vector<Complex> d = logarithmicDerivatives(m * x, terms);
  double psiBefore = std::cos(x);
  double psi = std::sin(x);
  double chiBefore = -std::sin(x);
  double chi = std::cos(x);
  for (int i = 1; i <= terms; ++i)
  {
    const double psiNext = (2 * i - 1) * psi / x - psiBefore;
    const double chiNext = (2 * i - 1) * chi / x - chiBefore;
    const Complex xi(psiNext, -chiNext);
    const Complex xiBefore(psi, -chi);
    const Complex electric = d[i] / m + i / x;
    const Complex magnetic = m * d[i] + i / x;
    this->A.push_back((electric * psiNext - psi) / (electric * xi - xiBefore));
    this->B.push_back((magnetic * psiNext - psi) / (magnetic * xi - xiBefore));
    psiBefore = psi;
    psi = psiNext;
    chiBefore = chi;
    chi = chiNext;
  }
  double sumG = 0;
  for (int i = 1; i <= terms; ++i)
  {
    const Complex a = this->A[i - 1];
    const Complex b = this->B[i - 1];
    this->Sphere.extinction += (2 * i + 1) * (a + b).real();
    this->Sphere.scattering += (2 * i + 1) * (std::norm(a) + std::norm(b));
    sumG += (2 * i + 1.0) / (i * (i + 1.0)) * (a * std::conj(b)).real();
    if (i < terms)
    {
      const Complex next = a * std::conj(this->A[i]) + b * std::conj(this->B[i]);
      sumG += i * (i + 2.0) / (i + 1.0) * next.real();
    }
  }
  this->Sphere.asymmetry = 2 * sumG / this->Sphere.scattering;
  this->Sphere.extinction *= 2 / (x * x);
  this->Sphere.scattering *= 2 / (x * x);
}

MieSeries::Amplitudes MieSeries::amplitudes(double cosine) const
{
  Amplitudes sum{};
  double piBefore = 0;
  double pi = 1;
  for (std::size_t i = 0; i < this->A.size(); ++i)
  {
    const double n = static_cast<double>(i + 1);
    const double tau = n * cosine * pi - (n + 1) * piBefore;
    const double weight = (2 * n + 1) / (n * (n + 1));
    sum.s1 += weight * (this->A[i] * pi + this->B[i] * tau);
    sum.s2 += weight * (this->A[i] * tau + this->B[i] * pi);
    const double next = ((2 * n + 1) * cosine * pi - (n + 1) * piBefore) / n;
    piBefore = pi;
    pi = next;
  }
  return sum;
}

double MieSeries::differential(double cosine) const
{
  const Amplitudes s = this->amplitudes(cosine);
  return (std::norm(s.s1) + std::norm(s.s2)) / (2 * Pi * this->X * this->X);
}

Complex waterIndex(double wavelength)
{
  struct Row
  {
    double wavelength;
    double n;
    double k;
  };
  constexpr Row Table[] = { { 450e-9, 1.337, 1.02e-9 }, { 550e-9, 1.333, 1.96e-9 },
    { 650e-9, 1.331, 1.64e-8 } };
  const double at = std::isnan(wavelength) ? 550e-9 : std::clamp(wavelength, 450e-9, 650e-9);
  const Row& low = Table[at < 550e-9 ? 0 : 1];
  const Row& high = Table[at < 550e-9 ? 1 : 2];
  const double share = (at - low.wavelength) / (high.wavelength - low.wavelength);
  return { low.n + share * (high.n - low.n), low.k + share * (high.k - low.k) };
}

MiePhase miePhase(
  const Droplets& droplets, double wavelength, const std::vector<double>& cosines, int sizes)
{
  const double a = within(droplets.effectiveRadius, 1e-9, 1e-3);
  const double b = within(droplets.effectiveVariance, 0.01, 0.4);
  const Complex index = waterIndex(wavelength);
  MiePhase mean;
  mean.phase.assign(cosines.size(), 0.0);
  double area = 0;
  double scattering = 0;
  double forward = 0;
  // r = a t, weighted with the area, whose mean is t = 1 and variance b. Beyond 7 standard deviations 1e-6 of it is left.
  for (const QuadraturePoint& t : gaussLegendre(sizes, 1e-3, 1 + 7 * std::sqrt(b)))
  {
    const double weight =
      t.weight * std::exp(((1 - 3 * b) / b + 2) * std::log(t.x) - (t.x - 1) / b);
    const MieSeries series(2 * Pi * a * t.x / wavelength, index);
    const MieSphere& sphere = series.sphere();
    area += weight;
    mean.extinction += weight * sphere.extinction;
    scattering += weight * sphere.scattering;
    forward += weight * sphere.scattering * sphere.asymmetry;
    for (std::size_t i = 0; i < cosines.size(); ++i)
    {
      mean.phase[i] += weight * series.differential(cosines[i]);
    }
  }
  if (!(scattering > 0) || !(mean.extinction > 0))
  {
    return mean;
  }
  for (double& p : mean.phase)
  {
    p /= scattering;
  }
  mean.albedo = std::min(1.0, scattering / mean.extinction);
  mean.asymmetry = forward / scattering;
  mean.extinction /= area;
  return mean;
}
}
