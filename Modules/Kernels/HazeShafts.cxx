// SPDX-License-Identifier: BSD-3-Clause
#include "HazeShafts.h"

#include "ArcTangent.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
constexpr double Pi = 3.14159265358979323846;
/// What lies behind this much haze does not count.
constexpr double Thickest = 40;
/// Sines of the sun's elevation up to this are those of the horizon: its light would come 1e9 times the depth far.
constexpr double Horizon = 1e-9;
/// Samples, below which pieces' moments about their middles would be lost in the rounding of their sums' differences.
constexpr double Shortest = 0.1;

/// int_0^d (a + b x) (r + x)^k dx for k = 0, 1, 2.
void addLinear(double a, double b, double r, double d, double m[3])
{
  const double i0 = d * (a + b * d / 2);
  const double i1 = d * d * (a / 2 + b * d / 3);
  const double i2 = d * d * d * (a / 3 + b * d / 4);
  m[0] += i0;
  m[1] += r * i0 + i1;
  m[2] += r * r * i0 + 2 * r * i1 + i2;
}

/// Where in [near, far] `o + t d` is a whole number from 0 to `last`.
void crossings(double o, double d, int last, double near, double far, std::vector<double>& found)
{
  if (d == 0 || !(far > near))
  {
    return;
  }
  const double a = o + near * d;
  const double b = o + far * d;
  const double from = std::clamp(std::ceil(std::min(a, b)), 0.0, last + 1.0);
  const double to = std::clamp(std::floor(std::max(a, b)), -1.0, static_cast<double>(last));
  for (double line = from; line <= to; ++line)
  {
    found.push_back(std::clamp((line - o) / d, near, far));
  }
}
}

/// A stretch of a ray in one channel, seen from the cloud plane.
struct HazeShafts::Track
{
  double x0; ///< R(0)
  double y0;
  double dx; ///< D
  double dy;
  double near;
  double far;
  double before; ///< tau A / S_z, the haze between the plane and the near end
  double decay;  ///< eps

  /// What is left of the light on its way by a point.
  double left(double t) const { return std::exp(-this->before - this->decay * (t - this->near)); }
};

HazeShafts::HazeShafts(const CloudShadow& clouds, const Vector3& towardSun, const Vector3& eye,
  const Channels& extinction)
  : Clouds(clouds)
  , TowardSun(normalized(towardSun))
  , Extinction(extinction)
{
  for (double& tau : this->Extinction)
  {
    tau = tau > 0 && std::isfinite(tau) ? tau : 0;
  }
  if (!(this->TowardSun[2] > Horizon))
  {
    this->TowardSun[2] = std::min(this->TowardSun[2], 0.0);
  }
  const double way = this->TowardSun[2] > 0 ? (clouds.height - eye[2]) / this->TowardSun[2] : 0;
  this->R0[0] = eye[0] + way * this->TowardSun[0];
  this->R0[1] = eye[1] + way * this->TowardSun[1];
}

void HazeShafts::tabulate(int radials)
{
  if (this->beginTables(radials))
  {
    this->tabulateRadials(0, radials);
  }
}

bool HazeShafts::beginTables(int radials)
{
  const GridFrame& frame = this->Clouds.transmittance.frame();
  if (this->Clouds.transmittance.empty() || radials < 4)
  {
    return false;
  }
  // Beyond its farthest corner the map has no value.
  const double x1 = frame.x0 + (frame.nx - 1) * frame.dx;
  const double y1 = frame.y0 + (frame.ny - 1) * frame.dy;
  const double reach =
    std::hypot(std::max(std::abs(frame.x0 - this->R0[0]), std::abs(x1 - this->R0[0])),
      std::max(std::abs(frame.y0 - this->R0[1]), std::abs(y1 - this->R0[1])));
  this->Radials = radials;
  this->Sample = reach / (radials - 1);
  this->Covers.resize(static_cast<std::size_t>(radials) * radials);
  this->Sums.resize(this->Covers.size());
  return true;
}

void HazeShafts::tabulateRadials(int first, int last)
{
  const int radials = this->Radials;
  for (int radial = first; radial < last; ++radial)
  {
    const double angle = 2 * Pi * radial / radials;
    float* const covers = &this->Covers[static_cast<std::size_t>(radial) * radials];
    Moments* const sums = &this->Sums[static_cast<std::size_t>(radial) * radials];
    Moments sum{};
    for (int k = 0; k < radials; ++k)
    {
      const double r = k * this->Sample;
      covers[k] = static_cast<float>(this->Clouds.at(this->R0[0] + r * std::cos(angle),
        this->R0[1] + r * std::sin(angle), std::max(this->Sample, r * 2 * Pi / radials)));
      if (k > 0)
      {
        addLinear(covers[k - 1], static_cast<double>(covers[k]) - covers[k - 1], k - 1, 1, sum.m);
      }
      sums[k] = sum;
    }
  }
}

HazeShafts::Stretch HazeShafts::below(const Ray& ray, double t0, double t1) const
{
  const double depth = this->Clouds.height - ray.origin[2];
  const double rise = ray.direction[2];
  Stretch stretch{ std::max(t0, 0.0), t1 };
  if (rise > 0)
  {
    stretch.far = std::min(stretch.far, depth / rise);
  }
  else if (rise < 0)
  {
    stretch.near = std::max(stretch.near, depth / rise);
  }
  else if (!(depth > 0))
  {
    stretch.far = -1;
  }
  return stretch;
}

HazeShafts::Track HazeShafts::trackOf(const Ray& ray, const Stretch& stretch, double tau) const
{
  const Vector3& s = this->TowardSun;
  const double steep = ray.direction[2] / s[2];
  const double way = (this->Clouds.height - ray.origin[2]) / s[2];
  const double depth =
    std::max(0.0, this->Clouds.height - ray.origin[2] - stretch.near * ray.direction[2]);
  const double decay = tau * (1 - steep);
  Track track{ ray.origin[0] + way * s[0], ray.origin[1] + way * s[1],
    ray.direction[0] - steep * s[0], ray.direction[1] - steep * s[1], stretch.near, stretch.far,
    tau * depth / s[2], decay };
  if (decay > 0)
  {
    track.far = std::min(track.far, track.near + Thickest / decay);
  }
  else if (decay < 0 && track.near < track.far + Thickest / decay)
  {
    // The light grows along a steep ray: before its last part there is nearly none.
    track.before += decay * (track.far + Thickest / decay - track.near);
    track.near = track.far + Thickest / decay;
  }
  return track;
}

double HazeShafts::cover(const Track& track, double t) const
{
  return this->Clouds.at(track.x0 + t * track.dx, track.y0 + t * track.dy);
}

Channels HazeShafts::glow(
  HazeMethod method, const Ray& ray, const Stretch& stretch, double step) const
{
  Channels light{};
  if (!(stretch.far > stretch.near) || !(this->TowardSun[2] > 0))
  {
    return light;
  }
  const Heading heading = method == HazeMethod::Moments ? this->headingOf(ray) : Heading{};
  for (int c = 0; c < 3; ++c)
  {
    const Track track = this->trackOf(ray, stretch, this->Extinction[c]);
    if (this->Extinction[c] > 0 && std::isfinite(track.far))
    {
      light[c] = this->Extinction[c] *
        (method == HazeMethod::March      ? this->march(track, step)
            : method == HazeMethod::Exact ? this->exact(track)
            : this->Radials > 0           ? this->moments(track, heading)
                                          : this->exact(track));
    }
  }
  return light;
}

double HazeShafts::exact(const Track& track) const
{
  static constexpr double Nodes[5] = { -0.906179845938664, -0.538469310105683, 0, 0.538469310105683,
    0.906179845938664 };
  static constexpr double Weights[5] = { 0.236926885056189, 0.478628670499366, 0.568888888888889,
    0.478628670499366, 0.236926885056189 };
  const GridFrame& frame = this->Clouds.transmittance.frame();
  std::vector<double> ends{ track.near, track.far };
  crossings((track.x0 - frame.x0) / frame.dx, track.dx / frame.dx, frame.nx - 1, track.near,
    track.far, ends);
  crossings((track.y0 - frame.y0) / frame.dy, track.dy / frame.dy, frame.ny - 1, track.near,
    track.far, ends);
  std::sort(ends.begin(), ends.end());
  double light = 0;
  for (std::size_t n = 1; n < ends.size(); ++n)
  {
    // The exponential too is smooth in a part.
    const int parts = 1 + static_cast<int>(std::abs(track.decay) * (ends[n] - ends[n - 1]));
    const double half = (ends[n] - ends[n - 1]) / (2 * parts);
    for (int part = 0; part < parts; ++part)
    {
      const double middle = ends[n - 1] + (2 * part + 1) * half;
      for (int k = 0; k < 5; ++k)
      {
        const double t = middle + Nodes[k] * half;
        light += Weights[k] * half * this->cover(track, t) * track.left(t);
      }
    }
  }
  return light;
}

double HazeShafts::march(const Track& track, double step) const
{
  const double length = track.far - track.near;
  const int steps = static_cast<int>(std::min(1e7, std::max(1.0, std::ceil(length / step))));
  double light = 0;
  for (int n = 0; n < steps; ++n)
  {
    const double t = track.near + (n + 0.5) * length / steps;
    light += this->cover(track, t) * track.left(t) * length / steps;
  }
  return light;
}

HazeShafts::Moments HazeShafts::momentsTo(int radial, double r) const
{
  const int last = this->Radials - 1;
  const int k = static_cast<int>(std::min<double>(r, last));
  const std::size_t at = static_cast<std::size_t>(radial) * this->Radials + k;
  Moments sum = this->Sums[at];
  const double here = k < last ? this->Covers[at] : this->Clouds.beyond;
  addLinear(here, k < last ? this->Covers[at + 1] - here : 0, k, r - k, sum.m);
  return sum;
}

HazeShafts::Heading HazeShafts::headingOf(const Ray& ray) const
{
  const double steep = ray.direction[2] / this->TowardSun[2];
  const double dx = ray.direction[0] - steep * this->TowardSun[0];
  const double dy = ray.direction[1] - steep * this->TowardSun[1];
  return { std::sqrt(dx * dx + dy * dy) / this->Sample,
    (arcTangent(dy, dx) / (2 * Pi) + 1) * this->Radials };
}

double HazeShafts::moments(const Track& track, const Heading& heading) const
{
  const double near = track.near;
  const double e = track.decay;
  const int pieces = 1 + static_cast<int>(2 * std::abs(e) * (track.far - near));
  const double half = (track.far - near) / (2 * pieces);
  const double speed = heading.speed;
  if (!(2 * half * speed > Shortest))
  {
    return this->exact(track); // a look at the sun or a thick fog, which cross few grid lines
  }
  // int (t - middle)^k exp(-e (t - middle)) by the quadratic that is nearest to the exponential.
  const double x2 = half * e * half * e;
  const double q[3] = { 1, -e * (1 + x2 / 8) / speed, e * e / (2 * speed * speed) };
  const double turn = heading.turn;
  const double share = turn - std::floor(turn);
  double light = 0;
  for (int side = 0; side < 2; ++side)
  {
    const int radial = (static_cast<int>(turn) + side) % this->Radials;
    Moments before = this->momentsTo(radial, near * speed);
    for (int piece = 0; piece < pieces; ++piece)
    {
      const double middle = near + (2 * piece + 1) * half;
      const Moments after = this->momentsTo(radial, (middle + half) * speed);
      const double r = middle * speed;
      const double c0 = after.m[0] - before.m[0];
      const double c1 = after.m[1] - before.m[1];
      const double c2 = after.m[2] - before.m[2];
      before = after;
      light += (side ? share : 1 - share) * track.left(middle) *
        (q[0] * c0 + q[1] * (c1 - r * c0) + q[2] * (c2 - 2 * r * c1 + r * r * c0)) / speed;
    }
  }
  return light;
}
}
