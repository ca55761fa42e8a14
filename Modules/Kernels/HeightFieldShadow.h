// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file HeightFieldShadow.h
 * @brief What the clouds of a height field let through of the sun, at equally spaced places of a row.
 *
 *     c = exp(-rho (g - h)) where F > 0, else 1
 *
 * by the vertical thickness g - h (Max 1986 section 6, with the exponential in place of his quadratic). F is sampled as
 * HeightFieldSamples.h does, without a sine for each place; shares are within 2e-7 of the formula's, a float's rounding.
 * @sa HeightField.h, CloudShadow.h, vtkCloudHeightFieldShadow
 */
#ifndef HeightFieldShadow_h
#define HeightFieldShadow_h

#include <cstddef>
#include <memory>

namespace nephoscope
{
class HeightField;

/// Keeps scratch memory: one object per thread.
class HeightFieldShadow
{
public:
  /// @param field kept by reference
  /// @param extinction rho, 1/m, >= 0
  HeightFieldShadow(const HeightField& field, double extinction);
  ~HeightFieldShadow();

  /// The shares of places (x + i spacing, y), i from 0 to count - 1; spacing in metres, > 0.
  void row(double x, double y, double spacing, std::size_t count, float* shares);

private:
  struct Scratch;
  const HeightField& Field;
  double Extinction;
  std::unique_ptr<Scratch> Work;
};
}
#endif
