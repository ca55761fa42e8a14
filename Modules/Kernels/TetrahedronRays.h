// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file TetrahedronRays.h
 * @brief Where the rays of a camera enter and leave a tetrahedron, and the optical depth between, in closed form.
 *
 * In ray space the point at depth z on the ray of the pixel offset (u, v) is
 *
 *     (u z, v z, z)   perspective        (u, v, z)   parallel
 *
 * so that a plane n.q = c is met at 1/z = (n_x u + n_y v + n_z) / c, or at z = (c - n_x u - n_y v) / n_z: linear in (u, v).
 * With the order k = -1/z or k = z, which grows along the ray, a ray is in the tetrahedron between the greatest k of the
 * planes that face the eye and the least k of the others. That holds with the eye inside and for tetrahedra that reach
 * behind it. The density is linear in the tetrahedron, hence along the ray, and tau = length (s0 + s1) / 2 is exact.
 *
 * Neighbours share every ray between them: a face's plane is computed from its vertices in one order, the order in which
 * they are given, so both tetrahedra find the same k to the last bit; give vertices in a global order. Rays are
 * displaced by a billionth of a pixel, so that none runs in a face of a grid that is aligned with the image.
 *
 * @sa TetrahedronSum.h, TetrahedralSplit.h, vtkCloudCellVolume, TestTetrahedronRays.cxx
 */
#ifndef TetrahedronRays_h
#define TetrahedronRays_h

#include "Camera.h"
#include "Vector3.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephoscope
{
/// The camera's space in which planes are linear in pixels.
class RaySpace
{
public:
  explicit RaySpace(const Camera& camera)
    : Eye(camera.eye())
    , Across((1 / camera.pixel()) * camera.right())
    , Upward((1 / camera.pixel()) * camera.up())
    , Forward(camera.forward())
    , Pixel2(camera.isParallel() ? 0 : camera.pixel() * camera.pixel())
    , HalfWidth(0.5 * camera.width())
    , HalfHeight(0.5 * camera.height())
    , Parallel(camera.isParallel())
  {
  }

  bool isParallel() const { return this->Parallel; }

  Vector3 point(const Vector3& p) const
  {
    const Vector3 d = p - this->Eye;
    return { dot(d, this->Across), dot(d, this->Upward), dot(d, this->Forward) };
  }

  /// Offset of a pixel's ray, and back to image coordinates.
  double u(int x) const { return x + 0.5 + ShiftX - this->HalfWidth; }
  double v(int y) const { return y + 0.5 + ShiftY - this->HalfHeight; }
  double imageX(double u) const { return u + this->HalfWidth; }
  double imageY(double v) const { return v + this->HalfHeight; }

  /// Distance along the ray per unit of depth.
  double stretch(double u, double v) const { return std::sqrt(1 + this->Pixel2 * (u * u + v * v)); }

private:
  static constexpr double ShiftX = 1.1e-9;
  static constexpr double ShiftY = 0.7e-9;
  Vector3 Eye;
  Vector3 Across;
  Vector3 Upward;
  Vector3 Forward;
  double Pixel2;
  double HalfWidth;
  double HalfHeight;
  bool Parallel;
};

/// a u + b v + c
struct PixelLinear
{
  double a;
  double b;
  double c;
  double at(double u, double v) const { return this->a * u + (this->b * v + this->c); }
};

/// A stretch of a ray in a tetrahedron, in depths. Rounding may leave nothing of it: farDepth <= nearDepth.
struct RayPiece
{
  double nearDepth;
  double farDepth;
};

/**
 * The inward or outward normals of a tetrahedron's faces; normals[i] belongs to the face opposite vertex i.
 * @return det, six times the signed volume; a normal's value at its vertex is det times -1, 1, -1, 1
 */
inline double faceNormals(const Vector3* const (&q)[4], Vector3 (&normals)[4])
{
  const Vector3 e1 = *q[1] - *q[0];
  const Vector3 e2 = *q[2] - *q[0];
  const Vector3 e3 = *q[3] - *q[0];
  normals[0] = cross(*q[2] - *q[1], *q[3] - *q[1]);
  normals[1] = cross(e2, e3);
  normals[2] = cross(e1, e3);
  normals[3] = cross(e1, e2);
  return dot(normals[3], e3);
}

/// What is linear in a tetrahedron, along the rays of a camera; never beyond its values at the vertices.
class RayField
{
public:
  /// From the faceNormals of vertices not in a plane, the first vertex and the values s at all; s = s_0 + sum (s_i - s_0) lambda_i along the ray, as Fixed + Varying(u, v) z or Varying(u, v) + Fixed z.
  void set(
    const Vector3 (&normals)[4], double det, const Vector3& q0, const float (&s)[4], bool parallel)
  {
    this->Least = std::min({ s[0], s[1], s[2], s[3] });
    this->Greatest = std::max({ s[0], s[1], s[2], s[3] });
    const double s0 = s[0];
    const Vector3 gradient = ((s[1] - s0) / det) * normals[1] + ((s0 - s[2]) / det) * normals[2] +
      ((s[3] - s0) / det) * normals[3];
    const double atEye = s0 - dot(gradient, q0);
    this->Fixed = parallel ? gradient[2] : atEye;
    this->Varying = { gradient[0], gradient[1], parallel ? atEye : gradient[2] };
  }

  /// The value at a depth on a ray.
  template <bool Parallel>
  double at(double u, double v, double depth) const
  {
    const double varying = this->Varying.at(u, v);
    const double s = Parallel ? varying + this->Fixed * depth : this->Fixed + varying * depth;
    return std::max(this->Least, std::min(s, this->Greatest));
  }

  const PixelLinear& varying() const { return this->Varying; }
  double fixed() const { return this->Fixed; }
  double least() const { return this->Least; }
  double greatest() const { return this->Greatest; }

private:
  PixelLinear Varying;
  double Fixed;
  double Least;
  double Greatest;
};

/**
 * @brief A tetrahedron as the rays of a camera meet it.
 *
 * Densities are >= 0 and finite. What rounding makes of slivers stays bounded: depths lie within those of the vertices,
 * densities too.
 */
class TetrahedronRays
{
public:
  /**
   * Get ready.
   * @param q vertices in ray space, in an order on which neighbours agree
   * @param s densities there
   * @return false if it has no volume (or no finite one), or lies behind the eye
   */
  bool set(const Vector3* const (&q)[4], const float (&s)[4], bool parallel)
  {
    this->Nearest = std::min({ (*q[0])[2], (*q[1])[2], (*q[2])[2], (*q[3])[2] });
    this->Farthest = std::max({ (*q[0])[2], (*q[1])[2], (*q[2])[2], (*q[3])[2] });
    Vector3 normals[4];
    const double det = faceNormals(q, normals);
    if (!(std::abs(det) > 0 && std::abs(det) < std::numeric_limits<double>::infinity()) ||
      !(this->Farthest > 0))
    {
      return false;
    }
    this->Nearest = std::max(this->Nearest, 0.0);
    this->Enters = 0;
    this->Leaves = 0;
    const double side = det > 0 ? 1 : -1;
    this->addPlane(normals[0], *q[1], side, parallel);
    this->addPlane(normals[1], *q[0], -side, parallel);
    this->addPlane(normals[2], *q[0], side, parallel);
    this->addPlane(normals[3], *q[0], -side, parallel);
    this->Density.set(normals, det, *q[0], s, parallel);
    return this->Leaves > 0; // what has no far side is flat to within rounding
  }

  /**
   * The pieces of the rays of a row.
   * @param u offsets of the rays along the row, @param n of them; @param v of the row
   * @param visit called as visit(i, piece) for each ray that meets the tetrahedron
   */
  template <bool Parallel, class Visit>
  void meetRow(const double* u, int n, double v, Visit&& visit) const
  {
    switch (this->Enters)
    {
      case 0:
        return this->row<Parallel, 0>(u, n, v, visit);
      case 1:
        return this->row<Parallel, 1>(u, n, v, visit);
      case 2:
        return this->row<Parallel, 2>(u, n, v, visit);
      default:
        return this->row<Parallel, 3>(u, n, v, visit);
    }
  }

  /// The density at a depth on a ray.
  template <bool Parallel>
  double density(double u, double v, double depth) const
  {
    return this->Density.at<Parallel>(u, v, depth);
  }

  /// The planes as k(u, v): first the enters() that rays enter by, then those that they leave by.
  const PixelLinear& plane(int f) const { return this->Planes[f]; }
  int enters() const { return this->Enters; }
  /// The depths of the vertices are within, and >= 0.
  double nearest() const { return this->Nearest; }
  double farthest() const { return this->Farthest; }
  const RayField& field() const { return this->Density; }

private:
  template <bool Parallel, int NumberEntered, class Visit>
  void row(const double* u, int n, double v, Visit&& visit) const
  {
    double at[4];
    for (int f = 0; f < 4; ++f)
    {
      at[f] = this->Planes[f].b * v + this->Planes[f].c;
    }
    for (int i = 0; i < n; ++i)
    {
      double enter = Parallel ? 0 : -std::numeric_limits<double>::infinity();
      double leave =
        Parallel ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::min();
      for (int f = 0; f < NumberEntered; ++f)
      {
        enter = std::max(enter, this->Planes[f].a * u[i] + at[f]);
      }
      for (int f = NumberEntered; f < 4; ++f)
      {
        leave = std::min(leave, this->Planes[f].a * u[i] + at[f]);
      }
      if (enter < leave)
      {
        visit(i,
          RayPiece{ std::max(Parallel ? enter : -1 / enter, this->Nearest),
            std::min(Parallel ? leave : -1 / leave, this->Farthest) });
      }
    }
  }

  /// The plane through a point; `outward` is the sign that turns the normal out of the tetrahedron.
  void addPlane(const Vector3& n, const Vector3& through, double outward, bool parallel)
  {
    // Seen edge-on, it is moved by next to nothing, to the same side for both tetrahedra at it.
    constexpr double Tiny = 1e-200;
    const double c = dot(n, through);
    double divisor = parallel ? n[2] : c;
    divisor = std::abs(divisor) < Tiny ? Tiny : divisor;
    const double scale = -1 / divisor;
    const PixelLinear k = { n[0] * scale, n[1] * scale, parallel ? -c * scale : n[2] * scale };
    this->Planes[divisor * outward > 0 ? 3 - this->Leaves++ : this->Enters++] = k;
  }

  PixelLinear Planes[4]; ///< those that rays enter by first, then those they leave by
  int Enters = 0;
  int Leaves = 0;
  RayField Density;
  double Nearest;
  double Farthest;
};
}
#endif
