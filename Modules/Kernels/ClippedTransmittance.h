// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file ClippedTransmittance.h
 * @brief Cheap stand-ins for the transmittance exp(-x): powers of a clipped line, and clipped polynomials.
 *
 * Max's sexp (1986; 1994, "it is not really an exponential") is the power n = 2 with gain 1 and k = 1:
 *
 *     sexp(-x) = (1 - x/2)_+^2,        in general   gain (1 - k x / n)_+^n,     (u)_+ = max(u, 0)
 *
 * and a polynomial is cut where it would be negative and beyond its range:  (c_0 + c_1 x + ... + c_n x^n)_+ on [0, X], else 0.
 * x is an optical depth, >= 0. The exact counterpart is std::exp(-x); errors are in Data/Calibration/transmittance.json.
 *
 * Templated on the scalar of the constants, so that they can be differentiated while they are fitted.
 * @sa fitTransmittance, Utilities/Doc/fits.md, TestClippedTransmittance.cxx
 */
#ifndef ClippedTransmittance_h
#define ClippedTransmittance_h

namespace nephoscope
{
/// gain (1 - k x / n)_+^n. @pre n >= 1
template <class T>
T clippedPower(int n, const T& gain, const T& k, double x)
{
  const T line = T(1) - k * (x / n);
  if (!(line > T(0)))
  {
    return T(0);
  }
  T power = gain;
  for (int i = 0; i < n; ++i)
  {
    power *= line;
  }
  return power;
}

/// (c[0] + c[1] x + ... + c[degree] x^degree)_+ where x <= end, else 0.
template <class T>
T clippedPolynomial(int degree, const T* c, double x, double end)
{
  if (!(x <= end))
  {
    return T(0);
  }
  T sum = c[degree];
  for (int i = degree - 1; i >= 0; --i)
  {
    sum = sum * x + c[i];
  }
  return sum > T(0) ? sum : T(0);
}
}
#endif
