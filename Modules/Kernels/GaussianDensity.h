// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file GaussianDensity.h
 * @brief Density that is a sum of Gaussians, and its integral along any stretch of a ray in closed form (Perlin).
 *
 *     rho(x) = a exp(-|M (x - c)|^2 / 2)        M upper triangular, so that M^T M is any positive matrix: balls, pills, pancakes
 *
 * Along the ray x = o + t d it is a Gaussian of t again (Perlin, "the density function along any line through them is also a Gaussian"):
 * with p = M (o - c), q = M d, t0 = -p.q / |q|^2 and the foot f = p + t0 q,
 *
 *     int_from^to rho dt = a exp(-|f|^2 / 2) sqrt(pi / 2) / |q| (erf(s (to - t0)) - erf(s (from - t0))),   s = |q| / sqrt(2)
 *
 * by erfc where both ends lie on one side, so that tails keep their digits. Where |q| (to - from) is below 1e-3, which |q| = 0 is (a
 * ray within a layer), the integral is that of the second-order series about the stretch's middle, good to 1e-12.
 *
 * A term is ten numbers, the GaussianPart in this order. Rows of M that are 0 leave the term the same along axes: a layer has m22 alone.
 * Templated on the numbers' scalar, so that they can be differentiated while they are fitted; places are double.
 * @sa DensityGrid.h, fitDensity, TestGaussianDensity.cxx
 */
#ifndef GaussianDensity_h
#define GaussianDensity_h

#include <cmath>
#include <limits>

namespace nephoscope
{
/// The numbers of a term: a in 1/m, c in m, M in 1/m.
enum GaussianPart
{
  GaussianAmplitude,
  GaussianX,
  GaussianY,
  GaussianZ,
  GaussianM00,
  GaussianM01,
  GaussianM02,
  GaussianM11,
  GaussianM12,
  GaussianM22,
  GaussianParts
};

/// x = origin + t direction, from <= t <= to; either may be infinite.
struct DensityRay
{
  double origin[3];    ///< m
  double direction[3]; ///< of length 1
  double from;         ///< m
  double to;           ///< m
};

/// u = M v
template <class T, class U>
void gaussianShape(const T* term, const U v[3], T u[3])
{
  u[0] = term[GaussianM00] * v[0] + term[GaussianM01] * v[1] + term[GaussianM02] * v[2];
  u[1] = term[GaussianM11] * v[1] + term[GaussianM12] * v[2];
  u[2] = term[GaussianM22] * v[2];
}

template <class T>
T gaussianDot(const T a[3], const T b[3])
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// rho at a place, 1/m.
template <class T>
T gaussianDensity(const T* term, const double place[3])
{
  using std::exp;
  const T from[3] = { place[0] - term[GaussianX], place[1] - term[GaussianY],
    place[2] - term[GaussianZ] };
  T u[3];
  gaussianShape(term, from, u);
  return term[GaussianAmplitude] * exp(-0.5 * gaussianDot(u, u));
}

/// erf(b) - erf(a); an end may be infinite, and then counts as a constant.
template <class T>
T erfBetween(const T& a, const T& b)
{
  using std::erf;
  using std::erfc;
  // beyond 30 erf is 1 to the last digit
  const auto limited = [](const T& x) { return x > 30.0 ? T(30) : x < -30.0 ? T(-30) : x; };
  const T low = limited(a);
  const T high = limited(b);
  if (low > 0.0)
  {
    return erfc(low) - erfc(high);
  }
  return high < 0.0 ? erfc(-high) - erfc(-low) : erf(high) - erf(low);
}

/// Optical depth of one term along a ray, >= 0 if its amplitude is. Infinite only for an endless ray within a layer.
template <class T>
T gaussianLineIntegral(const T* term, const DensityRay& ray)
{
  using std::exp;
  using std::sqrt;
  const T from[3] = { ray.origin[0] - term[GaussianX], ray.origin[1] - term[GaussianY],
    ray.origin[2] - term[GaussianZ] };
  T p[3];
  T q[3];
  gaussianShape(term, from, p);
  gaussianShape(term, ray.direction, q);
  const T square = gaussianDot(q, q);
  const double length = ray.to - ray.from;
  if (!(length > 0))
  {
    return T(0);
  }
  if (!(square > 0.0) && std::isinf(length))
  {
    const T here = term[GaussianAmplitude] * exp(-0.5 * gaussianDot(p, p));
    return here > 0.0 ? T(std::numeric_limits<double>::infinity()) : T(0);
  }
  if (!(square * length * length > 1e-6))
  {
    const double middle = 0.5 * (ray.from + ray.to);
    const T u[3] = { p[0] + middle * q[0], p[1] + middle * q[1], p[2] + middle * q[2] };
    const T slope = gaussianDot(u, q);
    return term[GaussianAmplitude] * exp(-0.5 * gaussianDot(u, u)) * length *
      (1.0 + (length * length / 24) * (slope * slope - square));
  }
  const T middle = -gaussianDot(p, q) / square;
  const T foot[3] = { p[0] + middle * q[0], p[1] + middle * q[1], p[2] + middle * q[2] };
  const T norm = sqrt(square);
  const T scale = norm * 0.70710678118654752;
  constexpr double RootHalfPi = 1.2533141373155003;
  return term[GaussianAmplitude] * exp(-0.5 * gaussianDot(foot, foot)) * (RootHalfPi / norm) *
    erfBetween(T(scale * (ray.from - middle)), T(scale * (ray.to - middle)));
}

/**
 * Integral of a term over all space; of a layer or a column over the axes where it is not the same everywhere.
 * @return 1/m times m for each such axis
 */
double gaussianMass(const double* term);
}
#endif
