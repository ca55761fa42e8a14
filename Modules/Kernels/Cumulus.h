// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Cumulus.h
 * @brief Made-up height fields that look like fair-weather clouds, and a height field as a row of numbers.
 *
 * Waves of falling length and amplitude in all directions; the long ones are sines and make the ranks of clouds, the short ones
 * absolute values of sines and make billows. The constant is chosen so that the clouds cover the wanted share of the sky, as if
 * the sum were normally distributed.
 *
 * @sa HeightField.h, vtkCloudHeightFieldSource, TestHeightField.cxx
 */
#ifndef Cumulus_h
#define Cumulus_h

#include "HeightField.h"

#include <cstddef>
#include <cstdint>

namespace nephoscope
{
struct Cumulus
{
  int waves = 12;           ///< how many, 1 to 64
  double wavelength = 1500; ///< of the longest, m, > 0
  double shortening = 0.72; ///< each wave's length over that of the one before, 0 to 1
  double relief = 160;      ///< amplitude of the longest, m
  double smoothness = 1;    ///< amplitudes are lengths to this power
  int billows = 7;          ///< how many of the shortest are absolute values
  double cover = 0.4;       ///< share of the sky, 0 to 1
  double roundness = 30;    ///< c, m
  double depth = 80;        ///< D, m
  std::uint32_t seed = 1;
};

/// The shape; what is out of range is brought to range.
HeightFieldShape cumulusShape(const Cumulus& cumulus);

/// A shape and its cloud plane's height as a row of numbers: height, c, D, 6 coefficients, then 5 a wave (amplitude, p, q, r and
/// the number of the WaveShape).
std::vector<double> numbersOf(const HeightFieldShape& shape, double planeHeight);

/// The reverse; false if there are too few numbers, or one of a shape is none.
bool shapeOf(
  const double* numbers, std::size_t count, HeightFieldShape& shape, double& planeHeight);
}
#endif
