// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file ScreenTriangle.h
 * @brief Which pixels' rays a triangle meets, so that a mesh has no crack and no ray meets a shared edge twice.
 *
 *  1. A point is projected and snapped to 1/16384 of a pixel.
 *  2. A triangle that reaches behind the eye, or far out of the picture, is first clipped in homogeneous coordinates.
 *     A new point depends on the two ends of its edge only, inside one first, so that neighbours agree on it.
 *  3. Coverage is decided in integers: a pixel centre is inside if it is left of all three edges; on an edge, if it is
 *     after a shift by (e, e^2), e > 0 infinitesimal. This shift is the same for all triangles.
 *
 * So in a mesh whose snapped triangles do not overlap each pixel centre belongs to exactly one triangle.
 * Snapping decides coverage only; distance and attributes come from the unsnapped triangle (RayTriangle.h).
 *
 * @sa Camera.h, RayTriangle.h, TestScreenTriangle.cxx
 */
#ifndef ScreenTriangle_h
#define ScreenTriangle_h

#include "Camera.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace nephoscope
{
/// A half-open rectangle of pixels, [x0, x1) x [y0, y1).
struct PixelRectangle
{
  int x0 = 0;
  int x1 = 0;
  int y0 = 0;
  int y1 = 0;
};

/// A snapped point, 1/16384 pixel; or a mark that it has no place.
struct ScreenPoint
{
  static constexpr int Steps = 16384; ///< per pixel
  static constexpr std::int32_t Far =
    INT32_MIN; ///< in x: behind the eye or far off; its triangles want clipping
  static constexpr std::int32_t None =
    INT32_MIN + 1; ///< in x: not finite; its triangles are skipped

  std::int32_t x = None;
  std::int32_t y = 0;
};

/// Three snapped points, counter-clockwise (row 0 is the lowest).
struct ScreenTriangle
{
  std::array<ScreenPoint, 3> p;

  /// Twice the signed area, > 0 if counter-clockwise. Exact.
  std::int64_t area() const { return edge(this->p[0], this->p[1], this->p[2].x, this->p[2].y); }

  /// The pixels whose centres may be inside, within the limits.
  PixelRectangle box(const PixelRectangle& limits) const
  {
    const auto [left, right] = std::minmax({ this->p[0].x, this->p[1].x, this->p[2].x });
    const auto [low, high] = std::minmax({ this->p[0].y, this->p[1].y, this->p[2].y });
    return { std::max(limits.x0, firstCentre(left)), std::min(limits.x1, lastCentre(right) + 1),
      std::max(limits.y0, firstCentre(low)), std::min(limits.y1, lastCentre(high) + 1) };
  }

  /// Call visit(x, y) for each pixel within the limits whose centre is inside, row by row. Precondition: area() > 0.
  template <class Visitor>
  void forEachPixel(const PixelRectangle& limits, const Visitor& visit) const
  {
    const PixelRectangle b = this->box(limits);
    if (b.x0 >= b.x1)
    {
      return;
    }
    const std::int64_t cx = std::int64_t{ b.x0 } * ScreenPoint::Steps + ScreenPoint::Steps / 2;
    for (int y = b.y0; y < b.y1; ++y)
    {
      const std::int64_t cy = std::int64_t{ y } * ScreenPoint::Steps + ScreenPoint::Steps / 2;
      std::int64_t e[3];
      std::int64_t step[3];
      for (int i = 0; i < 3; ++i)
      {
        const ScreenPoint& a = this->p[i];
        const ScreenPoint& c = this->p[(i + 1) % 3];
        e[i] = edge(a, c, cx, cy) - (ownsItsPixels(a, c) ? 0 : 1);
        step[i] = -(std::int64_t{ c.y } - a.y) * ScreenPoint::Steps;
      }
      for (int x = b.x0; x < b.x1; ++x)
      {
        if ((e[0] | e[1] | e[2]) >= 0)
        {
          visit(x, y);
        }
        e[0] += step[0];
        e[1] += step[1];
        e[2] += step[2];
      }
    }
  }

private:
  /// > 0 where (x, y) is left of the edge from a to b.
  static std::int64_t edge(
    const ScreenPoint& a, const ScreenPoint& b, std::int64_t x, std::int64_t y)
  {
    return (std::int64_t{ b.x } - a.x) * (y - a.y) - (std::int64_t{ b.y } - a.y) * (x - a.x);
  }
  /// Whether a point on the edge is inside once it is shifted by (e, e^2).
  static bool ownsItsPixels(const ScreenPoint& a, const ScreenPoint& b)
  {
    return b.y < a.y || (b.y == a.y && b.x > a.x);
  }
  static int floorDivide(std::int32_t a) { return a >> 14; }
  static int firstCentre(std::int32_t a) { return floorDivide(a + ScreenPoint::Steps / 2 - 1); }
  static int lastCentre(std::int32_t a) { return floorDivide(a - ScreenPoint::Steps / 2); }
};

/// Projects points and triangles to a camera's image.
class ScreenProjection
{
public:
  explicit ScreenProjection(const Camera& camera);

  /// The snapped place of a point; marked Far or None where it has none.
  ScreenPoint snap(const Vector3& point) const;

  /// Up to 8 corners of a clipped triangle as a fan: at most 6 triangles.
  struct Fan
  {
    std::array<ScreenTriangle, 6> triangle;
    int count = 0;
  };
  /// What is left of a triangle in front of the eye and not far out of the picture; in the order of its corners.
  Fan clip(const Vector3& a, const Vector3& b, const Vector3& c) const;

  /// The whole picture.
  const PixelRectangle& picture() const { return this->Picture; }

private:
  /// x / w and y / w are pixels, z is the depth.
  struct Homogeneous
  {
    double x, y, w, z;
  };
  static constexpr int Planes = 5;

  Homogeneous transform(const Vector3& point) const;
  double inside(const Homogeneous& h, int plane) const;
  ScreenPoint rounded(const Homogeneous& h) const;

  Vector3 Eye;
  Vector3 Right;
  Vector3 Up;
  Vector3 Forward;
  double PerPixel;
  double Nearest;
  PixelRectangle Picture;
  bool Parallel;
};
}
#endif
