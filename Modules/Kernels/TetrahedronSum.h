// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file TetrahedronSum.h
 * @brief The optical depths of a tetrahedron along the rays of a rectangle of pixels, added to sums.
 *
 * The light of a medium of one source is source (1 - exp(-tau)), tau the sum of its parts' optical depths in any order: where
 * nothing else is translucent, no part has to be kept. Several rays of a row are worked on at once without a branch, with AVX2
 * where the processor has it. The bits are the same without, and for any grouping of a ray with others.
 *
 * Between the keys k0 and k1 of TetrahedronRays.h, with density s = F + V z along the ray,
 *
 *     tau / stretch = (z1 - z0) (2 F + V (z0 + z1)) / 2
 *     z1 - z0 = (k1 - k0) / (k0 k1)      z0 + z1 = -(k0 + k1) / (k0 k1)        in perspective, k = -1/z
 *
 * @sa DeepTile.h, TetrahedronScan.h, TestTetrahedronSum.cxx
 */
#ifndef TetrahedronSum_h
#define TetrahedronSum_h

#include "TetrahedronRays.h"

#include <cstddef>

namespace nephoscope
{
/// Rays of a row of pixels, one's numbers next to another's.
struct RayRow
{
  const double* u;          ///< their offsets
  const double* stretch;    ///< distance along the ray per depth
  const double* limitDepth; ///< depth of what is opaque
  const double* limitKey;   ///< the same as k of TetrahedronRays.h
};

/// A rectangle of pixels and their sums. Of each row, groups of 4 rays are read and written until all of it has been.
struct SumRows
{
  double* opticalDepth;     ///< of the lowest row's first pixel
  std::ptrdiff_t rowLength; ///< to the next row, in the sums and the rays' stretch and limits
  int width;
  int height;
  double v; ///< offset of the lowest row
};

/**
 * Add a tetrahedron.
 * @param rays of the lowest row, from its first pixel on
 * @return the rays that meet it
 */
std::size_t sumOpticalDepths(
  const TetrahedronRays& tetrahedron, bool parallel, const RayRow& rays, const SumRows& rows);

/// The same on any processor, slower.
std::size_t sumOpticalDepthsPlainly(
  const TetrahedronRays& tetrahedron, bool parallel, const RayRow& rays, const SumRows& rows);
}
#endif
