// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file SceneRays.h
 * @brief The rays of a picture in figures: how many there are, and how long they stay between two heights.
 */
#ifndef SceneRays_h
#define SceneRays_h

#include "Camera.h"
#include "RadianceError.h"
#include "vtkCloudscape.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace nephoscope
{
/// The rays of a picture, by some of them.
struct View
{
  Camera camera;
  double rays;

  explicit View(vtkCloudscape* scape)
    : camera(scape->GetRays())
    , rays(static_cast<double>(this->camera.width()) * this->camera.height())
  {
  }

  /// Mean length of the rays between two heights, up to a horizontal distance and a length.
  double lengthBetween(double low, double high, double far, double longest) const
  {
    double sum = 0;
    this->forSome(
      [&](const Ray& ray)
      {
        const Stretch stretch = between(ray, low, high, far);
        sum += std::clamp(stretch.to - stretch.from, 0.0, longest);
      });
    return sum / (Across * Up);
  }

  /// Middle distance of where rays come between two heights; 0 if none does.
  double distanceOf(double low, double high, double far) const
  {
    std::vector<double> distances;
    this->forSome(
      [&](const Ray& ray)
      {
        const Stretch stretch = between(ray, low, high, far);
        if (stretch.to > stretch.from)
        {
          distances.push_back(stretch.from);
        }
      });
    return quantile(distances, 0.5);
  }

private:
  static constexpr int Across = 24;
  static constexpr int Up = 18;
  struct Stretch
  {
    double from;
    double to;
  };

  template <class Visitor>
  void forSome(Visitor&& visit) const
  {
    for (int j = 0; j < Up; ++j)
    {
      for (int i = 0; i < Across; ++i)
      {
        visit(this->camera.ray(
          (i + 0.5) * this->camera.width() / Across, (j + 0.5) * this->camera.height() / Up));
      }
    }
  }

  static Stretch between(const Ray& ray, double low, double high, double far)
  {
    const double flat = std::hypot(ray.direction[0], ray.direction[1]);
    double from = 0;
    double to = far / std::max(flat, 1e-9);
    const double rise = ray.direction[2];
    if (std::abs(rise) > 1e-12)
    {
      const double a = (low - ray.origin[2]) / rise;
      const double b = (high - ray.origin[2]) / rise;
      from = std::max(from, std::min(a, b));
      to = std::min(to, std::max(a, b));
    }
    else if (ray.origin[2] < low || ray.origin[2] > high)
    {
      return { 0, 0 };
    }
    return { from, to };
  }
};
}
#endif
