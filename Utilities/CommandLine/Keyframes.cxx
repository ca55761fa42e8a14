// SPDX-License-Identifier: BSD-3-Clause
#include "Keyframes.h"

#include <cmath>

namespace nephoscope::program
{
namespace
{
/// The values of one key: moments in rising order and what it is then.
template <std::size_t N>
struct Track
{
  std::vector<double> moments;
  std::vector<std::array<double, N>> values;

  double slope(std::size_t n, std::size_t c) const
  {
    return n == 0 || n + 1 == this->moments.size()
      ? 0
      : (this->values[n + 1][c] - this->values[n - 1][c]) /
        (this->moments[n + 1] - this->moments[n - 1]);
  }

  std::array<double, N> at(double moment, bool smooth) const
  {
    if (moment <= this->moments.front())
    {
      return this->values.front();
    }
    std::size_t n = 0;
    while (n + 1 < this->moments.size() && this->moments[n + 1] < moment)
    {
      ++n;
    }
    if (n + 1 == this->moments.size())
    {
      return this->values.back();
    }
    const double length = this->moments[n + 1] - this->moments[n];
    const double t = (moment - this->moments[n]) / length;
    std::array<double, N> result{};
    for (std::size_t c = 0; c < N; ++c)
    {
      const double step = this->values[n + 1][c] - this->values[n][c];
      const double begin = smooth ? length * this->slope(n, c) : step;
      const double end = smooth ? length * this->slope(n + 1, c) : step;
      // Hermite's cubic; with both slopes equal to the step it is the line.
      result[c] = this->values[n][c] + t * begin +
        t * t * ((3 - 2 * t) * step - (2 - t) * begin - (1 - t) * end);
    }
    return result;
  }
};

std::array<double, 1> valuesOf(double value)
{
  return { value };
}
Triple valuesOf(const Triple& value)
{
  return value;
}
void store(const std::array<double, 1>& from, std::optional<double>& to)
{
  to = from[0];
}
void store(const std::array<double, 1>& from, double& to)
{
  to = from[0];
}
void store(const Triple& from, std::optional<Triple>& to)
{
  to = from;
}

/// Bring one key of the scene to the moment; it stays as it is if no keyframe gives it.
template <class Value, class Target>
void move(const Scene& scene, std::optional<Value> Keyframe::*key, double moment, Target& target)
{
  Track<std::tuple_size_v<decltype(valuesOf(Value()))>> track;
  for (const Keyframe& frame : scene.keyframes)
  {
    if (frame.*key)
    {
      track.moments.push_back(frame.at);
      track.values.push_back(valuesOf(*(frame.*key)));
    }
  }
  if (!track.moments.empty())
  {
    store(track.at(moment, scene.animation.motion == "smooth"), target);
  }
}
}

Scene sceneAt(const Scene& scene, double moment)
{
  Scene now = scene;
  now.moment = moment;
  move(scene, &Keyframe::longitude, moment, now.camera.longitude);
  move(scene, &Keyframe::latitude, moment, now.camera.latitude);
  move(scene, &Keyframe::bearing, moment, now.camera.bearing);
  move(scene, &Keyframe::elevation, moment, now.camera.elevation);
  move(scene, &Keyframe::distance, moment, now.camera.distance);
  move(scene, &Keyframe::viewAngle, moment, now.camera.viewAngle);
  move(scene, &Keyframe::position, moment, now.camera.position);
  move(scene, &Keyframe::target, moment, now.camera.target);
  move(scene, &Keyframe::towardSun, moment, now.light.towardSun);
  if (now.light.towardSun)
  {
    Triple& sun = *now.light.towardSun;
    const double length = std::hypot(sun[0], sun[1], sun[2]);
    for (double& component : sun)
    {
      component /= length > 0 ? length : 1;
    }
  }
  return now;
}
}
