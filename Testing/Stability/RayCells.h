// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file RayCells.h
 * @brief A ray's optical depth in a structured grid, cell by cell: the textbook's way and the exact one.
 */
#ifndef RayCells_h
#define RayCells_h

#include "Camera.h"

#include <vector>

class vtkStructuredGrid;

namespace nephoscope
{
namespace stability
{
/// How the textbook goes about it; each has its way of failing.
enum class Naive
{
  Float,     ///< single precision throughout, division by whatever the volume is
  Inclusive, ///< double, but a ray in a common face or edge belongs to all cells that share it
  PlanarFaces, ///< a hexahedron cut by six planes, each through three corners of a face; constant density in it
  NoNearPlane ///< tetrahedra found by the box of their projected corners, also those behind the eye
};

/// Density is the grid's CloudFraction, linear in five tetrahedra a cell; the ray starts at its origin.
double naiveOpticalDepth(vtkStructuredGrid* grid, const Camera& camera, int x, int y, Naive way);

/**
 * The same by intervals of barycentric coordinates in long double. Cells without volume add nothing, inverted ones the
 * length that they take, overlapping ones all of theirs. The ray is moved by `shift` of a pixel across, so that it lies
 * in no common face; 1e-9 changes no optical depth by more.
 */
double exactOpticalDepth(vtkStructuredGrid* grid, const Camera& camera, int x, int y, double shift);

/// What a ray sees of a grid with SourceColor.
struct ExactLight
{
  double radiance[3] = { 0, 0, 0 };
  bool comesBack = false; ///< whether it enters a hexahedral cell that it has left
};

/// The same ray's light, its tetrahedra in the order in which it enters them, in 2000 steps each: within 1e-6 where no step's
/// optical depth is over 1e-3.
ExactLight exactLight(vtkStructuredGrid* grid, const Camera& camera, int x, int y, double shift);
}
}
#endif
