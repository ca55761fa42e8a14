// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Mie.h
 * @brief Scattering of light by a sphere, exactly: the series of Mie, after Bohren and Huffman 1983, chapter 4.
 *
 * For size parameter x = 2 pi r / wavelength and relative refractive index m = n + i k, k >= 0 for absorption, with Riccati and
 * Bessel's psi and xi, D_n the logarithmic derivative of psi_n(m x):
 *
 *     a_n = ((D_n/m + n/x) psi_n - psi_{n-1}) / ((D_n/m + n/x) xi_n - xi_{n-1})                               (4.88)
 *     b_n = ((m D_n + n/x) psi_n - psi_{n-1}) / ((m D_n + n/x) xi_n - xi_{n-1})
 *     Q_ext = 2/x^2 sum (2n+1) Re(a_n + b_n)                                                                 (4.62)
 *     Q_sca = 2/x^2 sum (2n+1) (|a_n|^2 + |b_n|^2)                                                           (4.61)
 *     S1 = sum (2n+1)/(n(n+1)) (a_n pi_n + b_n tau_n),   S2 with pi and tau exchanged                        (4.74)
 *     phase function, 1 over 4 pi:  p = (|S1|^2 + |S2|^2) / (2 pi x^2 Q_sca)  for unpolarised light
 *
 * The series ends at x + 4 x^(1/3) + 2 terms (Wiscombe 1980). D_n by downward recurrence from 6 |m x|^(1/3) + 16 beyond |m x|; psi_n upward, whose
 * rounding errors grow slowly up to n = x. Errors, against published values: below 1e-6 of Q for x to 10,000 (TestMie.cxx).
 *
 * Domain: 1e-3 <= x <= 1e5, |m| <= 20. Outside, arguments are brought there; NaN gives a sphere that scatters nothing.
 * Cost: O(x) and O(x) for each direction.
 */
#ifndef Mie_h
#define Mie_h

#include <complex>
#include <vector>

namespace nephoscope
{
struct MieSphere
{
  double extinction = 0; ///< Q_ext, cross-section over pi r^2
  double scattering = 0; ///< Q_sca
  double asymmetry = 0;  ///< g, the mean cosine of the scattering angle (4.65 and after)
};

/// One sphere's series, ready for any number of directions.
class MieSeries
{
public:
  MieSeries(double sizeParameter, std::complex<double> refractiveIndex);

  const MieSphere& sphere() const { return this->Sphere; }
  double sizeParameter() const { return this->X; }

  struct Amplitudes
  {
    std::complex<double> s1;
    std::complex<double> s2;
  };
  /// S1 and S2. @param cosine of the scattering angle, -1 to 1; 1 is forward
  Amplitudes amplitudes(double cosine) const;

  /// pi r^2 Q_sca p over pi r^2: the differential cross-section per steradian, over the geometric one.
  double differential(double cosine) const;

private:
  double X;
  std::vector<std::complex<double>> A; ///< a_n, from n = 1
  std::vector<std::complex<double>> B;
  MieSphere Sphere;
};

/// Water's index at a wavelength: Hale and Querry 1973, table 1, linear between 450, 550 and 650 nm and constant beyond.
std::complex<double> waterIndex(double wavelength);

/**
 * Droplets of many sizes: the gamma distribution of Hansen and Travis 1974 (eq. 2.56),
 * n(r) ~ r^((1 - 3 b)/b) exp(-r / (a b)), whose effective radius is a and effective variance b.
 */
struct Droplets
{
  double effectiveRadius = 10e-6; ///< a, m, > 0
  double effectiveVariance = 0.1; ///< b, 0.01 to 0.4
};

struct MiePhase
{
  std::vector<double> phase; ///< of each direction, 1/sr, 1 over all directions
  double extinction = 0;     ///< mean Q_ext, weighted with pi r^2
  double albedo = 0;         ///< scattering over extinction
  double asymmetry = 0;      ///< g
};

/**
 * The droplets' phase function.
 * @param wavelength m, in air
 * @param cosines directions
 * @param sizes places of the quadrature over radii; resonances of single sizes are narrow: g is good to 1e-3 with 150 at 5 um
 */
MiePhase miePhase(
  const Droplets& droplets, double wavelength, const std::vector<double>& cosines, int sizes = 400);
}
#endif
