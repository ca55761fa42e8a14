// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file ShellCase.h
 * @brief The case that the methods are measured on: cloud in a curvilinear shell over terrain, known in closed form.
 *
 * A globe of radius 1. Grid point (i, j, k) of nx x ny x nz lies at
 *
 *     longitude 2 pi i / nx      latitude -pi/2 + pi (j + 1/2) / ny      level eta = k / (nz - 1)
 *     radius    1 + h + (top - h) eta   top = 0.05, h the terrain's height, 0 to 0.0125
 *
 * so that levels follow the terrain and cells are slender towards the poles, as in a model's grid; open at the seam.
 * Cloud fraction is c = t^2 (3 - 2 t), t = clamp((g - 0.026) / 1.3, 0, 1), g a sum of travelling waves less a parabola in eta:
 * smooth, exactly zero where it is clear, 28 % of the points above 15 %.
 *
 * For volumes, extinction is Extinction times cloud fraction per unit length and the source radiance is 1: a ray's light is
 * then 1 - T, T its transmittance, in whatever order cells are drawn. For orders it is sourceOf(cloud fraction), linear in
 * each tetrahedron too, and a ray's light depends on the order.
 */
#ifndef ShellCase_h
#define ShellCase_h

#include "Benchmark.h"
#include "Camera.h"
#include "vtkSmartPointer.h"

class vtkCamera;
class vtkImageData;
class vtkStructuredGrid;
class vtkUnstructuredGrid;

namespace nephoscope
{
namespace performance
{
namespace shell
{
constexpr double ContourValue =
  0.15F;                          // a float, as the values are: some filters round it, some do not
constexpr double Extinction = 40; ///< per radius of the globe where cloud fraction is 1
constexpr double Top = 0.05;

/// Longitude, latitude, level.
struct Place
{
  double longitude;
  double latitude;
  double eta;
};

double cloudFraction(const Place& place);
/// The source radiance, grey, of cloud whose order is to be seen: dark where it is dense.
inline double sourceOf(double fraction)
{
  return 1 - fraction;
}
Vector3 position(const Place& place);
Place place(const Vector3& position); ///< the inverse; eta < 0 or > 1 outside the shell

/// Grid coordinates (i, j, k), not only whole, to a place.
Place placeOnGrid(const Situation& situation, double i, double j, double k);

/// The grid with its cloud fraction, float.
vtkSmartPointer<vtkStructuredGrid> structuredGrid(const Situation& situation);
/// The same with SourceColor, sourceOf the cloud fraction at each point.
vtkSmartPointer<vtkStructuredGrid> paintedGrid(const Situation& situation);
/// Each cell as five tetrahedra, alternating so that neighbours agree; the same points and values.
vtkSmartPointer<vtkUnstructuredGrid> tetrahedra(const Situation& situation);
/// The values on an image of spacing 1: (i, j, k) are the coordinates.
vtkSmartPointer<vtkImageData> indexImage(const Situation& situation);
/// The grid's values, trilinear in (i, j, k), on a cube of samples^3 points about the globe; zero outside the grid.
vtkSmartPointer<vtkImageData> resampledImage(const Situation& situation, int samples);

/// Where pictures are taken from: the whole globe fills the picture's height.
vtkSmartPointer<vtkCamera> vtkView();
Camera view(const Situation& situation); ///< the same
}
}
}
#endif
