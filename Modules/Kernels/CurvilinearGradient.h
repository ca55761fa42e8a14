// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file CurvilinearGradient.h
 * @brief The gradient of a field from its differences, and the positions', along the three directions of a grid.
 *
 * With X_c the difference of position along direction c and f_c that of the field, grad f . X_c = f_c, so
 *
 *     grad f = (f_i X_j x X_k + f_j X_k x X_i + f_k X_i x X_j) / (X_i . X_j x X_k)
 *
 * Unit: field per length. With central differences the error is of second order where the grid is smooth.
 *
 * Where the three directions span no volume (at the poles of a globe, at zero-volume cells) the answer is the shortest
 * vector that fits the differences best: least squares of unit directions with a ridge of 1e-6. A direction shorter than 1e-9 of the
 * longest is not used.
 *
 * @sa TestCurvilinearGradient.cxx
 */
#ifndef CurvilinearGradient_h
#define CurvilinearGradient_h

#include "Vector3.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nephoscope
{
/// Solves the symmetric system with diagonal d and off-diagonal elements o = (12, 02, 01) by Cramer's rule.
inline std::array<double, 3> solveSymmetric(
  double d, const std::array<double, 3>& o, const std::array<double, 3>& b)
{
  const double c0 = d * d - o[0] * o[0];
  const double c1 = o[1] * o[0] - o[2] * d;
  const double c2 = o[2] * o[0] - o[1] * d;
  const double determinant = d * c0 + o[2] * c1 + o[1] * c2;
  const double c11 = d * d - o[1] * o[1];
  const double c12 = o[1] * o[2] - d * o[0];
  const double c22 = d * d - o[2] * o[2];
  return { (c0 * b[0] + c1 * b[1] + c2 * b[2]) / determinant,
    (c1 * b[0] + c11 * b[1] + c12 * b[2]) / determinant,
    (c2 * b[0] + c12 * b[1] + c22 * b[2]) / determinant };
}

/// The answer where the directions span no volume. Rare: kept out of the loops that call curvilinearGradient.
[[gnu::noinline]] inline Vector3 degenerateGradient(
  const std::array<Vector3, 3>& positions, const std::array<double, 3>& field)
{
  std::array<Vector3, 3> unit{};
  std::array<double, 3> slope{ 0, 0, 0 };
  const double longest = std::sqrt(std::max({ dot(positions[0], positions[0]),
    dot(positions[1], positions[1]), dot(positions[2], positions[2]) }));
  for (int c = 0; c < 3; ++c)
  {
    const double l = length(positions[c]);
    if (l > 1e-9 * longest)
    {
      unit[c] = (1 / l) * positions[c];
      slope[c] = field[c] / l;
    }
  }
  const std::array<double, 3> a = solveSymmetric(
    1 + 1e-6, { dot(unit[1], unit[2]), dot(unit[0], unit[2]), dot(unit[0], unit[1]) }, slope);
  return a[0] * unit[0] + a[1] * unit[1] + a[2] * unit[2];
}

/// @param positions differences of position along i, j, k  @param field differences of the field over the same steps
inline Vector3 curvilinearGradient(
  const std::array<Vector3, 3>& positions, const std::array<double, 3>& field)
{
  const Vector3 jk = cross(positions[1], positions[2]);
  const Vector3 ki = cross(positions[2], positions[0]);
  const Vector3 ij = cross(positions[0], positions[1]);
  const double volume = dot(positions[0], jk);
  const double ii = dot(positions[0], positions[0]);
  const double jj = dot(positions[1], positions[1]);
  const double kk = dot(positions[2], positions[2]);
  const double shortest = std::min({ ii, jj, kk });
  if (volume * volume > 1e-16 * ii * jj * kk && shortest > 1e-18 * std::max({ ii, jj, kk }))
  {
    return (1 / volume) * (field[0] * jk + field[1] * ki + field[2] * ij);
  }
  return degenerateGradient(positions, field);
}
}
#endif
