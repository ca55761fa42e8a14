// SPDX-License-Identifier: BSD-3-Clause
#include "RayCells.h"

#include "CloudArrays.h"
#include "TetrahedralSplit.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkStructuredGrid.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nephoscope
{
namespace stability
{
namespace
{
struct GridPoint
{
  Vector3 at;
  double density;
  double color[3];
};
using Tetrahedron = std::array<GridPoint, 4>;
using Hexahedron = std::array<GridPoint, 8>; // corners by bit pattern

template <class F>
void forEachCell(vtkStructuredGrid* grid, F&& f)
{
  int n[3];
  grid->GetDimensions(n);
  vtkDataArray* const density = grid->GetPointData()->GetArray(arrays::CloudFraction);
  vtkDataArray* const color = grid->GetPointData()->GetArray(arrays::SourceColor);
  for (int k = 0; k + 1 < n[2]; ++k)
  {
    for (int j = 0; j + 1 < n[1]; ++j)
    {
      for (int i = 0; i + 1 < n[0]; ++i)
      {
        Hexahedron cell;
        for (int v = 0; v < 8; ++v)
        {
          const vtkIdType p =
            i + (v & 1) + static_cast<vtkIdType>(n[0]) * (j + (v >> 1 & 1) + n[1] * (k + (v >> 2)));
          grid->GetPoint(p, cell[v].at.v);
          cell[v].density = density->GetComponent(p, 0);
          for (int c = 0; c < 3; ++c)
          {
            cell[v].color[c] = color ? color->GetComponent(p, c) : 1;
          }
        }
        if (grid->IsCellVisible(i + (n[0] - 1) * (j + (n[1] - 1) * static_cast<vtkIdType>(k))))
        {
          f(cell, splitParity(i, j, k));
        }
      }
    }
  }
}

template <class F>
void forEachTetrahedron(vtkStructuredGrid* grid, F&& f)
{
  forEachCell(grid,
    [&f](const Hexahedron& cell, int parity)
    {
      for (const TetrahedronVertices& t : TetrahedralSplit[parity])
      {
        f(Tetrahedron{ cell[t[0]], cell[t[1]], cell[t[2]], cell[t[3]] });
      }
    });
}

template <class Real>
using Triple = std::array<Real, 3>;

template <class Real>
Triple<Real> triple(const Vector3& a)
{
  return { static_cast<Real>(a[0]), static_cast<Real>(a[1]), static_cast<Real>(a[2]) };
}
template <class Real>
Triple<Real> minus(const Triple<Real>& a, const Triple<Real>& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}
template <class Real>
Real inner(const Triple<Real>& a, const Triple<Real>& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class Real>
Triple<Real> outer(const Triple<Real>& a, const Triple<Real>& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

/// Part of a ray in one tetrahedron, and the barycentric coordinates along the ray.
template <class Real>
struct RayPart
{
  Real from = 0;
  Real to = 1e30F;
  Real at0[4];
  Real rate[4];

  /// The part is empty where the ray misses. Nothing is guarded unless `guarded`.
  RayPart(const Tetrahedron& t, const Ray& ray, bool guarded)
  {
    const Triple<Real> origin = triple<Real>(ray.origin);
    const Triple<Real> direction = triple<Real>(ray.direction);
    for (int n = 0; n < 4; ++n)
    {
      const Triple<Real> a = triple<Real>(t[(n + 1) % 4].at);
      const Triple<Real> normal =
        outer(minus(triple<Real>(t[(n + 2) % 4].at), a), minus(triple<Real>(t[(n + 3) % 4].at), a));
      const Real height = inner(normal, minus(triple<Real>(t[n].at), a));
      this->at0[n] = inner(normal, minus(origin, a)) / height;
      this->rate[n] = inner(normal, direction) / height;
      if ((guarded && height == 0) || (this->rate[n] == 0 && this->at0[n] < 0))
      {
        this->to = -1;
      }
      else if (this->rate[n] > 0)
      {
        this->from = std::max(this->from, -this->at0[n] / this->rate[n]);
      }
      else if (this->rate[n] < 0)
      {
        this->to = std::min(this->to, -this->at0[n] / this->rate[n]);
      }
    }
  }

  /// What is linear in the tetrahedron, given at its corners, at a distance.
  template <class ValueOf>
  Real value(const Tetrahedron& t, Real distance, const ValueOf& valueOf) const
  {
    Real sum = 0;
    for (int n = 0; n < 4; ++n)
    {
      sum += static_cast<Real>(valueOf(t[n])) * (this->at0[n] + this->rate[n] * distance);
    }
    return sum;
  }
};

/// Optical depth of a ray in one tetrahedron. Nothing is guarded unless `guarded`.
template <class Real>
Real depthInTetrahedron(const Tetrahedron& t, const Ray& ray, bool guarded)
{
  const RayPart<Real> part(t, ray, guarded);
  // Written so that what is not a number is not hidden.
  return part.to <= part.from ? 0
                              : (part.to - part.from) *
      part.value(t, (part.from + part.to) / 2, [](const GridPoint& p) { return p.density; });
}

/// Mean density times the part of a ray on the inner side of six planes, each through three corners of a face.
double depthBetweenPlanes(const Hexahedron& cell, const Ray& ray)
{
  constexpr int Faces[6][3] = { { 0, 1, 2 }, { 4, 5, 6 }, { 0, 1, 4 }, { 2, 3, 6 }, { 0, 2, 4 },
    { 1, 3, 5 } };
  Vector3 middle{ 0, 0, 0 };
  double density = 0;
  for (const GridPoint& p : cell)
  {
    middle = middle + 0.125 * p.at;
    density += p.density / 8;
  }
  double from = 0;
  double to = 1e30;
  for (const auto& face : Faces)
  {
    const Vector3& a = cell[face[0]].at;
    Vector3 normal = cross(cell[face[1]].at - a, cell[face[2]].at - a);
    normal = dot(normal, middle - a) < 0 ? -1 * normal : normal;
    const double at0 = dot(normal, ray.origin - a);
    const double rate = dot(normal, ray.direction);
    (rate > 0 ? from : to) = rate > 0 ? std::max(from, -at0 / rate) : std::min(to, -at0 / rate);
  }
  return to > from ? density * (to - from) : 0;
}

/// Whether a pixel's middle is in the box of the projected corners, taking the projection's word for it.
bool inProjectedBox(const Tetrahedron& t, const Camera& camera, double x, double y)
{
  double low[2] = { 1e300, 1e300 };
  double high[2] = { -1e300, -1e300 };
  for (const GridPoint& p : t)
  {
    const Projected seen = camera.project(p.at);
    low[0] = std::min(low[0], seen.x);
    high[0] = std::max(high[0], seen.x);
    low[1] = std::min(low[1], seen.y);
    high[1] = std::max(high[1], seen.y);
  }
  return low[0] <= x && x <= high[0] && low[1] <= y && y <= high[1];
}
}

double naiveOpticalDepth(vtkStructuredGrid* grid, const Camera& camera, int x, int y, Naive way)
{
  const Ray ray = camera.ray(x + 0.5, y + 0.5);
  double sum = 0;
  if (way == Naive::PlanarFaces)
  {
    forEachCell(grid, [&](const Hexahedron& cell, int) { sum += depthBetweenPlanes(cell, ray); });
    return sum;
  }
  forEachTetrahedron(grid,
    [&](const Tetrahedron& t)
    {
      if (way == Naive::Float)
      {
        sum += static_cast<double>(depthInTetrahedron<float>(t, ray, false));
      }
      else if (way == Naive::Inclusive || inProjectedBox(t, camera, x + 0.5, y + 0.5))
      {
        sum += depthInTetrahedron<double>(t, ray, true);
      }
    });
  return sum;
}

ExactLight exactLight(vtkStructuredGrid* grid, const Camera& camera, int x, int y, double shift)
{
  struct Met
  {
    RayPart<long double> part;
    Tetrahedron tetrahedron;
    int cell;
  };
  const Ray ray = camera.ray(x + 0.5 + shift, y + 0.5 + 0.7 * shift);
  std::vector<Met> met;
  int cells = 0;
  forEachCell(grid,
    [&](const Hexahedron& cell, int parity)
    {
      for (const TetrahedronVertices& v : TetrahedralSplit[parity])
      {
        const Tetrahedron t = { cell[v[0]], cell[v[1]], cell[v[2]], cell[v[3]] };
        const RayPart<long double> part(t, ray, true);
        if (part.to > part.from)
        {
          met.push_back({ part, t, cells });
        }
      }
      ++cells;
    });
  std::sort(
    met.begin(), met.end(), [](const Met& a, const Met& b) { return a.part.from < b.part.from; });
  ExactLight light;
  std::vector<int> left;
  long double through = 1;
  for (std::size_t m = 0; m < met.size(); ++m)
  {
    const Met& here = met[m];
    if (m > 0 && met[m - 1].cell != here.cell)
    {
      left.push_back(met[m - 1].cell);
    }
    light.comesBack =
      light.comesBack || std::find(left.begin(), left.end(), here.cell) != left.end();
    // The midpoint rule, exact for the transmittance; its error falls with the square of the steps.
    constexpr int Steps = 2000;
    const long double step = (here.part.to - here.part.from) / Steps;
    for (int n = 0; n < Steps; ++n)
    {
      const long double at = here.part.from + (n + 0.5L) * step;
      const long double next = through *
        std::exp(-step *
          here.part.value(here.tetrahedron, at, [](const GridPoint& p) { return p.density; }));
      for (int c = 0; c < 3; ++c)
      {
        light.radiance[c] += static_cast<double>((through - next) *
          here.part.value(here.tetrahedron, at, [c](const GridPoint& p) { return p.color[c]; }));
      }
      through = next;
    }
  }
  return light;
}

double exactOpticalDepth(vtkStructuredGrid* grid, const Camera& camera, int x, int y, double shift)
{
  const Ray ray = camera.ray(x + 0.5 + shift, y + 0.5 + 0.7 * shift);
  long double sum = 0;
  forEachTetrahedron(
    grid, [&](const Tetrahedron& t) { sum += depthInTetrahedron<long double>(t, ray, true); });
  return static_cast<double>(sum);
}
}
}
