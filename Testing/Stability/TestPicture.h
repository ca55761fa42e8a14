// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file TestPicture.h
 * @brief Small grids, small pictures of them, and their errors.
 */
#ifndef TestPicture_h
#define TestPicture_h

#include "Camera.h"
#include "RayCells.h"
#include "Segment.h"
#include "Stability.h"
#include "vtkSmartPointer.h"

#include <array>
#include <functional>
#include <vector>

class vtkCloudBody;
class vtkCloudCellVolume;

namespace nephoscope
{
namespace stability
{
/// A camera in both shapes.
struct View
{
  Vector3 eye;
  Vector3 target;
  double angle = 30;     ///< degrees; not used if halfHeight > 0
  double halfHeight = 0; ///< of a parallel camera, else 0
  int width = 24;
  int height = 16;

  Camera camera() const;
};

/// A grid of n[0] x n[1] x n[2] points at place(a, b, c), a, b, c from 0 to 1, with cloud fraction density(i, j, k).
vtkSmartPointer<vtkStructuredGrid> makeGrid(const std::array<int, 3>& n,
  const std::function<Vector3(double, double, double)>& place,
  const std::function<double(int, int, int)>& density, bool floatPoints = false);

/// A body that draws a grid with extinction 1 a unit where the cloud fraction is 1.
vtkSmartPointer<vtkCloudCellVolume> bodyOf(vtkStructuredGrid* grid, const RGB& color = { 1, 1, 1 });

using Bodies = std::vector<vtkSmartPointer<vtkCloudBody>>;

struct Picture
{
  std::vector<RGB> radiance;
  std::vector<RGB> transmittance;
};
Picture draw(const Bodies& bodies, const View& view);
/// Draws and lets go of the picture; says how many segments it took.
long long countSegments(const Bodies& bodies, const View& view);

/// Largest error of transmittance, ours and the naive way's, against the exact sum; NaN counts as 1.
Outcome compareWithExact(
  vtkStructuredGrid* grid, const View& view, Naive way, double tolerance = 1e-5);
}
}
#endif
