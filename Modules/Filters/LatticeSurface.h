// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file LatticeSurface.h
 * @brief The vertices of a contour surface on a lattice: position, normal and where the other arrays come from.
 */
#ifndef LatticeSurface_h
#define LatticeSurface_h

#include "CurvilinearGradient.h"
#include "LatticeGrid.h"
#include "TetrahedralContour.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace nephoscope
{
/// How far from a to b the value lies, 0 to 1.
inline double crossing(double a, double b, double value)
{
  const double t = (value - a) / (b - a);
  return t >= 0 && t <= 1 ? t : 0.5; // differences beyond a double's range
}

/**
 * The unit normal towards lower values. Along its edge the field falls. A gradient may say otherwise a little, for the field need
 * not be linear; where it is more than 30 degrees off, or zero, its part along the edge is replaced by the edge's slope.
 * @param towardLower the edge, from its higher to its lower end  @param fall by how much the field falls over it, > 0
 */
inline Vector3 outwardNormal(const Vector3& gradient, const Vector3& towardLower, double fall)
{
  const double l = length(gradient);
  const double wrong = dot(gradient, towardLower);
  if (l > 0 && l <= std::numeric_limits<double>::max() &&
    (wrong <= 0 || wrong * wrong <= 0.25 * l * l * dot(towardLower, towardLower)))
  {
    return (-1 / l) * gradient;
  }
  const Vector3 direction = normalized(towardLower);
  const double slope = fall / length(towardLower);
  const Vector3 normal = slope * direction - (gradient - dot(gradient, direction) * direction);
  if (std::isfinite(dot(normal, normal)) && dot(normal, normal) > 0)
  {
    return normalized(normal);
  }
  return dot(direction, direction) > 0 ? direction : Vector3{ 0, 0, 1 };
}

/// A lattice with a field on it: the gradient at a point.
template <class Points, class T>
struct LatticeField
{
  LatticeShape Shape;
  const Points& X;
  const T* Values;
  const LatticeBits* Usable; ///< points that have a value; null for all
  bool Ring;                 ///< the last point of each row is the first again

  T value(int i, int j, int k) const { return this->Values[this->id(i, j, k)]; }
  Index id(int i, int j, int k) const
  {
    return i + this->Shape.n[0] * (j + Index(this->Shape.n[1]) * k);
  }
  bool usable(const std::array<int, 3>& p) const
  {
    return !this->Usable || this->Usable->test(p[1] + Index(p[2]) * this->Shape.n[1], p[0]);
  }

  /// One step along an axis; the same point where there is none.
  std::array<int, 3> neighbour(std::array<int, 3> p, int axis, int step) const
  {
    const std::array<int, 3> here = p;
    p[axis] += step;
    const int last = this->Shape.n[axis] - 1;
    if (axis == 0 && this->Ring)
    {
      p[0] = p[0] < 0 ? last - 1 : p[0] > last ? 1 : p[0];
    }
    return p[axis] < 0 || p[axis] > last || !this->usable(p) ? here : p;
  }

  bool inside(int i, int j, int k) const
  {
    const auto& n = this->Shape.n;
    return i > 0 && i < n[0] - 1 && j > 0 && j < n[1] - 1 && k > 0 && k < n[2] - 1;
  }

  bool areNeighboursUsable(int i, int j, int k) const
  {
    return !this->Usable ||
      (this->usable({ i - 1, j, k }) && this->usable({ i + 1, j, k }) &&
        this->usable({ i, j - 1, k }) && this->usable({ i, j + 1, k }) &&
        this->usable({ i, j, k - 1 }) && this->usable({ i, j, k + 1 }));
  }

  /// Where all six neighbours are: without asking.
  Vector3 gradientInside(int i, int j, int k) const
  {
    const T* f = this->Values + this->id(i, j, k);
    const Index row = this->Shape.n[0];
    const Index layer = row * this->Shape.n[1];
    const auto difference = [f](Index step)
    { return static_cast<double>(f[step]) - static_cast<double>(f[-step]); };
    return this->X.gradientInside(i, j, k, { difference(1), difference(row), difference(layer) });
  }

  Vector3 gradient(int i, int j, int k) const
  {
    if (this->inside(i, j, k) && this->areNeighboursUsable(i, j, k))
    {
      return this->gradientInside(i, j, k);
    }
    std::array<Vector3, 3> step;
    std::array<double, 3> change;
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto a = this->neighbour({ i, j, k }, axis, -1);
      const auto b = this->neighbour({ i, j, k }, axis, 1);
      step[axis] = this->X(b[0], b[1], b[2]) - this->X(a[0], a[1], a[2]);
      change[axis] = static_cast<double>(this->value(b[0], b[1], b[2])) -
        static_cast<double>(this->value(a[0], a[1], a[2]));
    }
    return curvilinearGradient(step, change);
  }
};

/// Gradients of a few rows on two levels, at the ends of crossed edges.
class GradientRows
{
public:
  /// From row j0, `rows` rows of n points.
  void start(int j0, int rows, int n)
  {
    this->J0 = j0;
    this->Rows = rows;
    this->N = n;
    this->Gradients.resize(std::size_t(2) * rows * n);
  }
  Vector3* row(int j, int k)
  {
    return this->Gradients.data() +
      this->N * (std::size_t(j - this->J0) + std::size_t(k & 1) * this->Rows);
  }

  /// Works out those of level k.
  template <class Points, class T>
  void find(const LatticeField<Points, T>& field, const ContourLevel& level, int k)
  {
    for (int j = this->J0; j < this->J0 + this->Rows; ++j)
    {
      Vector3* out = this->row(j, k);
      for (Index w = 0; w < field.Shape.words(); ++w)
      {
        Bits left = level.endsOfCrossedEdges(j + Index(field.Shape.n[1]) * k, w);
        for (; left != 0; left &= left - 1)
        {
          const int i = static_cast<int>(64 * w) + __builtin_ctzll(left);
          out[i] = field.gradient(i, j, k);
        }
      }
    }
  }

private:
  int J0 = 0;
  int Rows = 0;
  int N = 0;
  std::vector<Vector3> Gradients;
};

/// Where a level's vertices go.
template <class Real>
struct SurfaceVertices
{
  Real* Points;
  float* Normals; ///< null for none
};

/// What the vertices of one row of edges are made from: the four rows of points (j, k), (j + 1, k), (j, k + 1), (j + 1, k + 1).
template <class Points, class T>
struct EdgeRows
{
  Index Start[4]; ///< the first point's id
  typename Points::Row X[4];
  const T* Values[4];
  const Vector3* Gradients[4];

  EdgeRows(const LatticeField<Points, T>& field, GradientRows* gradients, int j, int k)
  {
    for (int r = 0; r < 4; ++r)
    {
      const int jr = std::min(j + (r & 1), field.Shape.n[1] - 1);
      const int kr = std::min(k + (r >> 1), field.Shape.n[2] - 1);
      this->Start[r] = field.id(0, jr, kr);
      this->X[r] = field.X.row(jr, kr);
      this->Values[r] = field.Values + this->Start[r];
      this->Gradients[r] = gradients ? gradients->row(jr, kr) : nullptr;
    }
  }

  /// The vertex on the edge of this slot that point i owns.
  template <class Real, class Attach>
  void write(Index id, int i, std::array<std::uint8_t, 2> ends, double value,
    const SurfaceVertices<Real>& out, Attach&& attach) const
  {
    const Index ia = i + (ends[0] & 1);
    const Index ib = i + (ends[1] & 1);
    const int a = ends[0] >> 1;
    const int b = ends[1] >> 1;
    const double fa = static_cast<double>(this->Values[a][ia]);
    const double fb = static_cast<double>(this->Values[b][ib]);
    const double t = crossing(fa, fb, value);
    const Vector3 xa = this->X[a](ia);
    const Vector3 edge = this->X[b](ib) - xa;
    const Vector3 x = xa + t * edge;
    for (int c = 0; c < 3; ++c)
    {
      out.Points[3 * id + c] = static_cast<Real>(x[c]);
    }
    if (out.Normals)
    {
      const Vector3 gradient = (1 - t) * this->Gradients[a][ia] + t * this->Gradients[b][ib];
      const Vector3 normal =
        outwardNormal(gradient, (fa > fb ? 1.0 : -1.0) * edge, std::abs(fa - fb));
      for (int c = 0; c < 3; ++c)
      {
        out.Normals[3 * id + c] = static_cast<float>(normal[c]);
      }
    }
    attach(id, this->Start[a] + ia, this->Start[b] + ib, t);
  }
};

/**
 * Writes the vertices that the rows j0 to j1 - 1 of all levels own.
 * @param attach called with (id, from, to, t): the two points of the lattice that a vertex lies between
 */
template <class Points, class T, class Attach>
void writeVertices(const LatticeField<Points, T>& field, const ContourLevel& level, double value,
  int j0, int j1, GradientRows& gradients, const SurfaceVertices<typename Points::Real>& out,
  Attach&& attach)
{
  const auto& n = field.Shape.n;
  if (out.Normals)
  {
    gradients.start(j0, std::min(j1 + 1, n[1]) - j0, n[0]);
    gradients.find(field, level, 0);
  }
  for (int k = 0; k < n[2]; ++k)
  {
    if (out.Normals && k + 1 < n[2])
    {
      gradients.find(field, level, k + 1);
    }
    for (int j = j0; j < j1; ++j)
    {
      const int parity = field.Shape.rowParity(j, k);
      const EdgeRows<Points, T> rows(field, out.Normals ? &gradients : nullptr, j, k);
      level.forEachEdge(j + Index(n[1]) * k,
        [&](Index id, int i, int slot)
        { rows.write(id, i, edgeEnds(slot, (parity + i) & 1), value, out, attach); });
    }
  }
}

/// Whether most cells (of up to 4096, evenly taken) have their i, j, k left-handed in space.
template <class Points>
bool leftHanded(const LatticeShape& shape, const Points& x)
{
  const Index cells = Index(shape.n[0] - 1) * (shape.n[1] - 1) * (shape.n[2] - 1);
  const Index stride = std::max<Index>(cells / 4096, 1);
  Index balance = 0;
  for (Index cell = 0; cell < cells; cell += stride)
  {
    const int i = static_cast<int>(cell % (shape.n[0] - 1));
    const int j = static_cast<int>(cell / (shape.n[0] - 1) % (shape.n[1] - 1));
    const int k = static_cast<int>(cell / (shape.n[0] - 1) / (shape.n[1] - 1));
    // From the middle tetrahedron, which has volume in a cell that is collapsed at one corner or edge.
    const TetrahedronVertices& t = TetrahedralSplit[splitParity(i, j, k)][0];
    Vector3 p[4];
    for (int c = 0; c < 4; ++c)
    {
      p[c] = x(i + (t[c] & 1), j + (t[c] >> 1 & 1), k + (t[c] >> 2));
    }
    const double volume = dot(p[1] - p[0], cross(p[2] - p[0], p[3] - p[0]));
    balance += volume < 0 ? -1 : volume > 0 ? 1 : 0;
  }
  return balance < 0;
}
}
#endif
