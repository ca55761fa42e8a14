// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file TetrahedraSurface.h
 * @brief Contour triangles of a list of tetrahedra: the edges that they cross, merged by sorting.
 *
 *  1. count       triangles of each tetrahedron; prefix sum
 *  2. generate    each triangle's three edges, as pairs of point ids with the lower first
 *  3. merge       the edges sorted; equal ones get one id, in that order
 */
#ifndef TetrahedraSurface_h
#define TetrahedraSurface_h

#include "Vector3.h"

#include "vtkSMPTools.h"
#include "vtkType.h"

#include <array>
#include <cstdint>
#include <vector>

namespace nephoscope
{
struct CrossedEdge
{
  vtkIdType from;
  vtkIdType to;
  vtkIdType corner; ///< 3 triangle + corner that asked for it
  bool operator<(const CrossedEdge& e) const
  {
    return this->from != e.from ? this->from < e.from
      : this->to != e.to        ? this->to < e.to
                                : this->corner < e.corner;
  }
};

/// The surface for one value: vertices as edges, triangles as vertices.
struct TetrahedraSurface
{
  std::vector<CrossedEdge> Vertices;
  std::vector<vtkIdType> Triangles; ///< three vertices each
};

/// Four points, oriented so that their signed volume is not negative; usable ones only.
using OrientedTetrahedron = std::array<vtkIdType, 4>;

/// Calls f(a0, b0, a1, b1, a2, b2) for each triangle, its corners on the edges (a, b).
template <class F>
void forEachTriangleOf(const OrientedTetrahedron& p, unsigned inside, F&& f)
{
  static constexpr std::uint8_t One[4][4] = { { 0, 1, 2, 3 }, { 1, 0, 3, 2 }, { 2, 3, 0, 1 },
    { 3, 2, 1, 0 } };
  static constexpr std::uint8_t Two[16][4] = { {}, {}, {}, { 0, 1, 2, 3 }, {}, { 0, 2, 3, 1 },
    { 1, 2, 0, 3 }, {}, {}, { 0, 3, 1, 2 }, { 1, 3, 2, 0 }, {}, { 2, 3, 0, 1 }, {}, {}, {} };
  const std::uint8_t* q = Two[inside];
  if (q[0] != q[1])
  {
    f(p[q[0]], p[q[2]], p[q[0]], p[q[3]], p[q[1]], p[q[3]]);
    f(p[q[0]], p[q[2]], p[q[1]], p[q[3]], p[q[1]], p[q[2]]);
    return;
  }
  for (int c = 0; c < 4; ++c)
  {
    const std::uint8_t* o = One[c];
    if (inside == 1U << c)
    {
      f(p[o[0]], p[o[1]], p[o[0]], p[o[2]], p[o[0]], p[o[3]]);
    }
    else if (inside == (15U ^ 1U << c))
    {
      f(p[o[0]], p[o[1]], p[o[0]], p[o[3]], p[o[0]], p[o[2]]);
    }
  }
}

template <class T>
unsigned insideMask(const OrientedTetrahedron& p, const T* values, double value)
{
  unsigned mask = 0;
  for (int c = 0; c < 4; ++c)
  {
    mask |= static_cast<unsigned>(static_cast<double>(values[p[c]]) >= value) << c;
  }
  return mask;
}

template <class T>
TetrahedraSurface contourTetrahedra(
  const std::vector<OrientedTetrahedron>& tetrahedra, const T* values, double value)
{
  const vtkIdType count = static_cast<vtkIdType>(tetrahedra.size());
  std::vector<vtkIdType> first(count + 1, 0);
  vtkSMPTools::For(0, count,
    [&first, &tetrahedra, values, value](vtkIdType begin, vtkIdType end)
    {
      static constexpr std::uint8_t Triangles[16] = { 0, 1, 1, 2, 1, 2, 2, 1, 1, 2, 2, 1, 2, 1, 1,
        0 };
      for (vtkIdType t = begin; t < end; ++t)
      {
        first[t + 1] = Triangles[insideMask(tetrahedra[t], values, value)];
      }
    });
  for (vtkIdType t = 0; t < count; ++t)
  {
    first[t + 1] += first[t];
  }

  std::vector<CrossedEdge> edges(3 * first[count]);
  vtkSMPTools::For(0, count,
    [&first, &tetrahedra, &edges, values, value](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType t = begin; t < end; ++t)
      {
        vtkIdType corner = 3 * first[t];
        const auto add = [&edges, &corner](vtkIdType a, vtkIdType b)
        {
          edges[corner] = a < b ? CrossedEdge{ a, b, corner } : CrossedEdge{ b, a, corner };
          ++corner;
        };
        forEachTriangleOf(tetrahedra[t], insideMask(tetrahedra[t], values, value),
          [&add](vtkIdType a0, vtkIdType b0, vtkIdType a1, vtkIdType b1, vtkIdType a2, vtkIdType b2)
          {
            add(a0, b0);
            add(a1, b1);
            add(a2, b2);
          });
      }
    });
  vtkSMPTools::Sort(edges.begin(), edges.end());

  TetrahedraSurface surface;
  surface.Triangles.resize(edges.size());
  for (const CrossedEdge& e : edges)
  {
    if (surface.Vertices.empty() || surface.Vertices.back().from != e.from ||
      surface.Vertices.back().to != e.to)
    {
      surface.Vertices.push_back(e);
    }
    surface.Triangles[e.corner] = static_cast<vtkIdType>(surface.Vertices.size()) - 1;
  }
  return surface;
}

/**
 * The field's gradient at each point: the mean of the linear gradients of the tetrahedra that meet there, weighted by volume.
 * By one thread, so that the sums have one order.
 */
template <class T, class Position>
std::vector<Vector3> tetrahedraGradients(const std::vector<OrientedTetrahedron>& tetrahedra,
  vtkIdType points, const T* values, Position&& position)
{
  // Only the direction is used later, so the common factor 1/6 and the sum of weights may stay out.
  std::vector<Vector3> sums(points, Vector3{ 0, 0, 0 });
  for (const OrientedTetrahedron& t : tetrahedra)
  {
    const Vector3 origin = position(t[0]);
    const Vector3 a = position(t[1]) - origin;
    const Vector3 b = position(t[2]) - origin;
    const Vector3 c = position(t[3]) - origin;
    const double f0 = static_cast<double>(values[t[0]]);
    const Vector3 gradient = (static_cast<double>(values[t[1]]) - f0) * cross(b, c) +
      (static_cast<double>(values[t[2]]) - f0) * cross(c, a) +
      (static_cast<double>(values[t[3]]) - f0) * cross(a, b);
    for (vtkIdType p : t)
    {
      sums[p] = sums[p] + gradient;
    }
  }
  return sums;
}
}
#endif
