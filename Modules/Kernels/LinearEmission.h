// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file LinearEmission.h
 * @brief The light of a stretch of a ray in which extinction and colour are both linear.
 *
 * With x from 0 to 1 along the stretch, extinction tau (1 + skew (2 x - 1)) and tau(x) = tau x (1 + skew (x - 1)),
 *
 *     L = int c(x) tau'(x) exp(-tau(x)) dx = w0 c(0) + w1 c(1)
 *     w1 = int x tau'(x) exp(-tau(x)) dx          w0 + w1 = 1 - exp(-tau)
 *
 * the volume rendering equation of Max 1995 eq. 5 with g = kappa sigma. w1 has a closed form in the error function where the
 * extinction grows and in Dawson's integral where it falls, both of which cancel for small skew; Gauss-Legendre
 * quadrature has neither fault. It stops where exp(-tau) < 3e-9. For tau below 0.2 the series of the exponential is integrated
 * term by term, with int (x (1 + skew (x - 1)))^m dx:
 *
 *     w0 = sum_m sum_(k <= m) (-1)^(m-1) m! / ((m-k)! (m+k+1)!) tau^m (-skew)^k        to m = 6
 *
 * @sa TetrahedronScan.h, TestLinearEmission.cxx
 */
#ifndef LinearEmission_h
#define LinearEmission_h

namespace nephoscope
{
/// What the colours at the ends of a stretch count for.
struct EmissionWeights
{
  double nearEnd;
  double farEnd;
};

/**
 * The weights, within 1e-8, and within a millionth of themselves for small tau.
 * @param tau optical depth, >= 0
 * @param skew -1 to 1: the extinction is 1 - skew times the mean at the near end, 1 + skew times at the far one
 * Cost: no exponential for tau below 0.2, 6 up to 1, at most 126.
 */
EmissionWeights linearEmission(double tau, double skew);
}
#endif
