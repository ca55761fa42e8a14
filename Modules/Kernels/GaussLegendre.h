// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file GaussLegendre.h
 * @brief Gauss and Legendre's quadrature: n places and weights that integrate polynomials of degree 2 n - 1 exactly.
 *
 * Places are the roots of P_n, found by Newton's method from Abramowitz and Stegun 22.16.6; weights are
 * 2 / ((1 - x^2) P_n'(x)^2), ibid. 25.4.29, scaled to the interval. Error of places and weights: some 1e-15 of the interval.
 * Cost O(n^2).
 * @sa TestGaussLegendre.cxx
 */
#ifndef GaussLegendre_h
#define GaussLegendre_h

#include <vector>

namespace nephoscope
{
struct QuadraturePoint
{
  double x;
  double weight;
};

/// Ascending places between a and b. @pre n >= 1
std::vector<QuadraturePoint> gaussLegendre(int n, double a, double b);

/// The same with n places in each of several equal panels: for integrands with kinks.
std::vector<QuadraturePoint> gaussLegendrePanels(int panels, int n, double a, double b);
}
#endif
