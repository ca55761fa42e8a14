// SPDX-License-Identifier: BSD-3-Clause
#include "ScreenTriangle.h"

#include <cmath>

namespace nephoscope
{
namespace
{
/// How far out of the picture a point may be snapped, pixels. With pictures of up to 32768 pixels the integers of
/// ScreenTriangle stay below 2^62.
constexpr double Guard = 8192;
/// Smallest depth before a perspective camera, scene units.
constexpr double SmallestDepth = 1e-9;
}

ScreenProjection::ScreenProjection(const Camera& camera)
  : Eye(camera.eye())
  , Right(camera.right())
  , Up(camera.up())
  , Forward(camera.forward())
  , PerPixel(1 / camera.pixel())
  , Nearest(camera.isParallel() ? 0 : SmallestDepth)
  , Picture{ 0, camera.width(), 0, camera.height() }
  , Parallel(camera.isParallel())
{
}

ScreenProjection::Homogeneous ScreenProjection::transform(const Vector3& point) const
{
  const Vector3 d = point - this->Eye;
  const double depth = dot(d, this->Forward);
  const double w = this->Parallel ? 1 : depth;
  return { this->PerPixel * dot(d, this->Right) + 0.5 * this->Picture.x1 * w,
    this->PerPixel * dot(d, this->Up) + 0.5 * this->Picture.y1 * w, w, depth };
}

double ScreenProjection::inside(const Homogeneous& h, int plane) const
{
  switch (plane)
  {
    case 0:
      return h.z - this->Nearest;
    case 1:
      return h.x + Guard * h.w;
    case 2:
      return (this->Picture.x1 + Guard) * h.w - h.x;
    case 3:
      return h.y + Guard * h.w;
    default:
      return (this->Picture.y1 + Guard) * h.w - h.y;
  }
}

ScreenPoint ScreenProjection::rounded(const Homogeneous& h) const
{
  // Rounding in the clipping may have left a point a little outside of the guard.
  const double x = std::clamp(h.x / h.w, -Guard, this->Picture.x1 + Guard);
  const double y = std::clamp(h.y / h.w, -Guard, this->Picture.y1 + Guard);
  return { static_cast<std::int32_t>(std::lround(x * ScreenPoint::Steps)),
    static_cast<std::int32_t>(std::lround(y * ScreenPoint::Steps)) };
}

ScreenPoint ScreenProjection::snap(const Vector3& point) const
{
  const Homogeneous h = this->transform(point);
  if (!std::isfinite(h.x + h.y + h.z))
  {
    return {};
  }
  for (int plane = 0; plane < Planes; ++plane)
  {
    if (this->inside(h, plane) < 0)
    {
      return { ScreenPoint::Far, 0 };
    }
  }
  return this->rounded(h);
}

ScreenProjection::Fan ScreenProjection::clip(
  const Vector3& a, const Vector3& b, const Vector3& c) const
{
  std::array<Homogeneous, 3 + Planes> now{ this->transform(a), this->transform(b),
    this->transform(c) };
  int count = 3;
  for (int plane = 0; plane < Planes; ++plane)
  {
    std::array<Homogeneous, 3 + Planes> kept;
    int number = 0;
    for (int i = 0; i < count; ++i)
    {
      const Homogeneous& p = now[i];
      const Homogeneous& q = now[(i + 1) % count];
      const double dp = this->inside(p, plane);
      const double dq = this->inside(q, plane);
      if (dp >= 0 && number < 3 + Planes)
      {
        kept[number++] = p;
      }
      if ((dp >= 0) != (dq >= 0) && number < 3 + Planes)
      {
        // From the inner to the outer end, whichever way round this triangle has the edge.
        const Homogeneous& in = dp >= 0 ? p : q;
        const Homogeneous& out = dp >= 0 ? q : p;
        const double s = dp >= 0 ? dp / (dp - dq) : dq / (dq - dp);
        kept[number++] = { in.x + s * (out.x - in.x), in.y + s * (out.y - in.y),
          in.w + s * (out.w - in.w), in.z + s * (out.z - in.z) };
      }
    }
    now = kept;
    count = number;
  }
  Fan fan;
  for (int i = 2; i < count; ++i)
  {
    fan.triangle[fan.count++].p = { this->rounded(now[0]), this->rounded(now[i - 1]),
      this->rounded(now[i]) };
  }
  return fan;
}
}
