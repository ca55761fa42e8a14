// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file CellVolumeReference.h
 * @brief Test grids, and the optical depth of a ray in them as a long double sum over all tetrahedra.
 */
#ifndef CellVolumeReference_h
#define CellVolumeReference_h

#include "Camera.h"
#include "CloudArrays.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkStructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <vector>

namespace reference
{
using nephoscope::Camera;
using nephoscope::Ray;
using nephoscope::Vector3;

using Real = long double;
using Place = std::function<Vector3(double, double, double)>;
using Density = std::function<double(int, int, int)>;

/// A grid of points place(a, b, c), a, b, c from 0 to 1, with the cloud fraction density(i, j, k).
inline vtkNew<vtkStructuredGrid> makeGrid(
  int nx, int ny, int nz, const Place& place, const Density& density)
{
  vtkNew<vtkStructuredGrid> grid;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> fraction;
  fraction->SetName(nephoscope::arrays::CloudFraction);
  for (int k = 0; k < nz; ++k)
  {
    for (int j = 0; j < ny; ++j)
    {
      for (int i = 0; i < nx; ++i)
      {
        points->InsertNextPoint(
          place(double(i) / (nx - 1), double(j) / (ny - 1), double(k) / (nz - 1)).v);
        fraction->InsertNextValue(density(i, j, k));
      }
    }
  }
  grid->SetDimensions(nx, ny, nz);
  grid->SetPoints(points);
  grid->GetPointData()->AddArray(fraction);
  return grid;
}

/// The optical depth of a ray up to a distance in one tetrahedron, from barycentric coordinates along the ray.
inline Real opticalDepth(const Ray& ray, const Vector3 (&p)[4], const double (&s)[4], Real limit)
{
  Real e[3][3];
  Real o[3];
  Real d[3];
  for (int x = 0; x < 3; ++x)
  {
    for (int i = 0; i < 3; ++i)
    {
      e[i][x] = static_cast<Real>(p[i + 1][x]) - p[0][x];
    }
    o[x] = static_cast<Real>(ray.origin[x]) - p[0][x];
    d[x] = ray.direction[x];
  }
  const auto det3 = [](const Real* a, const Real* b, const Real* c)
  {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
      a[2] * (b[0] * c[1] - b[1] * c[0]);
  };
  const Real det = det3(e[0], e[1], e[2]);
  if (det == 0)
  {
    return 0;
  }
  // lambda_i = at[i] + t per[i]
  Real at[4] = { 1, det3(o, e[1], e[2]) / det, det3(e[0], o, e[2]) / det,
    det3(e[0], e[1], o) / det };
  Real per[4] = { 0, det3(d, e[1], e[2]) / det, det3(e[0], d, e[2]) / det,
    det3(e[0], e[1], d) / det };
  Real near = 0;
  Real far = limit;
  for (int i = 1; i < 4; ++i)
  {
    at[0] -= at[i];
    per[0] -= per[i];
  }
  for (int i = 0; i < 4; ++i)
  {
    if (per[i] > 0)
    {
      near = std::max(near, -at[i] / per[i]);
    }
    else if (per[i] < 0)
    {
      far = std::min(far, -at[i] / per[i]);
    }
    else if (at[i] < 0)
    {
      return 0;
    }
  }
  if (!(near < far) || std::isinf(far))
  {
    return 0;
  }
  Real density = 0;
  for (int i = 0; i < 4; ++i)
  {
    density += s[i] * (at[i] + per[i] * (near + far) / 2);
  }
  return density * (far - near);
}

/// The sum over all tetrahedra: of each cell the middle one joins the corners of even i+j+k, and each odd corner makes one
/// with its three neighbours.
inline Real opticalDepth(
  const Ray& ray, vtkStructuredGrid* grid, double limit = std::numeric_limits<double>::infinity())
{
  int n[3];
  grid->GetDimensions(n);
  vtkDataArray* const fraction = grid->GetPointData()->GetArray(nephoscope::arrays::CloudFraction);
  Real sum = 0;
  for (int cell = 0; cell < (n[0] - 1) * (n[1] - 1) * (n[2] - 1); ++cell)
  {
    const int at[3] = { cell % (n[0] - 1), cell / (n[0] - 1) % (n[1] - 1),
      cell / (n[0] - 1) / (n[1] - 1) };
    const int parity = (at[0] + at[1] + at[2]) & 1;
    const auto isEven = [parity](int v)
    { return ((parity + (v & 1) + (v >> 1 & 1) + (v >> 2 & 1)) & 1) == 0; };
    for (int apex = -1; apex < 8; ++apex)
    {
      if (apex >= 0 && isEven(apex))
      {
        continue;
      }
      std::vector<int> corners;
      for (int v = 0; v < 8 && apex < 0; ++v)
      {
        if (isEven(v))
        {
          corners.push_back(v);
        }
      }
      if (apex >= 0)
      {
        corners = { apex, apex ^ 1, apex ^ 2, apex ^ 4 };
      }
      Vector3 p[4];
      double s[4];
      for (int c = 0; c < 4; ++c)
      {
        const int v = corners[c];
        const vtkIdType id =
          (vtkIdType(at[2] + (v >> 2 & 1)) * n[1] + at[1] + (v >> 1 & 1)) * n[0] + at[0] + (v & 1);
        grid->GetPoint(id, p[c].v);
        s[c] = fraction->GetComponent(id, 0);
      }
      sum += opticalDepth(ray, p, s, limit);
    }
  }
  return sum;
}

/// A warped block about the origin; the warp keeps cells from folding.
inline Vector3 warped(double a, double b, double c)
{
  return { 3 * a - 1.5 + 0.15 * std::sin(5 * b + 3 * c), 2 * b - 1 + 0.12 * std::sin(4 * a + c),
    c - 0.5 + 0.08 * std::sin(6 * a + 5 * b) };
}

/// A whole shell on an Earth in metres with hills; the seam closes and the poles are single points.
inline Vector3 globe(double a, double b, double c)
{
  const double longitude = 2 * M_PI * (a < 1 ? a : 0);
  const double latitude = M_PI * (b - 0.5);
  const double across = b == 0 || b == 1 ? 0 : std::cos(latitude);
  const double r =
    6.37e6 + 9e5 * c + 2e5 * (1 - c) * across * std::sin(3 * longitude) * std::sin(2 * latitude);
  return { r * across * std::cos(longitude), r * across * std::sin(longitude),
    r * std::sin(latitude) };
}

inline Density randomDensity(double low, double high, unsigned seed)
{
  auto random = std::make_shared<std::mt19937>(seed);
  return [random, low, high](int, int, int)
  {
    std::uniform_real_distribution<double> power(std::log(low), std::log(high));
    return (*random)() % 4 == 0 ? 0.0 : std::exp(power(*random));
  };
}
}
#endif
