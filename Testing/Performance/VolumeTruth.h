// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file VolumeTruth.h
 * @brief What the volume methods should have drawn: each ray's tetrahedra, sorted along it, in double precision.
 *
 * For a lattice of pixels, the ray through the pixel's middle is met with every tetrahedron of the shell's grid (five a cell,
 * the float points and values that the methods get), the intervals are sorted and integrated in closed form: density is
 * linear along each, so its optical depth is Extinction * length * (c0 + c1) / 2; the light of a source that is linear too is
 * integrated by ten points of Gauss and Legendre. Nothing is shared with the renderer but
 * the camera and the table of tetrahedra.
 */
#ifndef VolumeTruth_h
#define VolumeTruth_h

#include "Benchmark.h"

#include <array>
#include <functional>
#include <vector>

namespace nephoscope
{
namespace performance
{
/// A pixel and what is let through there.
struct TruePixel
{
  int x;
  int y;
  double transmittance;
  double radiance; ///< of shell::sourceOf
};

/// @param stride every so many pixels along x and y
std::vector<TruePixel> volumeTruth(const Situation& situation, int stride);

/**
 * @brief Compare a picture with the truth on about 12,000 pixels.
 * @param quantity the transmittance or the radiance, @param drawnAt of a pixel of the picture
 * @return error (root mean square of the quantity's error over pixels that the cloud covers or that were drawn as
 *         covered), largestError, pixelsCompared, shown (all the cloud's effect in the picture over that in truth)
 * Throws std::runtime_error if the picture shows less than half the cloud, or twice as much: it is of something else, and its
 * time is not that of the task.
 */
Figures volumeFigures(const Situation& situation, double TruePixel::*quantity,
  const std::function<double(int x, int y)>& drawnAt);
}
}
#endif
