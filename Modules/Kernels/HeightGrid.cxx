// SPDX-License-Identifier: BSD-3-Clause
#include "HeightGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephoscope
{
namespace
{
constexpr double Never = std::numeric_limits<double>::infinity();

/// The least root of a t^2 + b t + c in [0, far], c > 0; infinity if there is none.
double leastRoot(double a, double b, double c, double far)
{
  const double discriminant = b * b - 4 * a * c;
  if (discriminant < 0)
  {
    return Never;
  }
  const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  double least = Never;
  for (const double root : { a != 0 ? q / a : Never, q != 0 ? c / q : Never })
  {
    least = root >= 0 && root <= far ? std::min(least, root) : least;
  }
  return least;
}

/// Cut [near, far] to where `from <= origin + t direction <= to`.
void clip(double origin, double direction, double from, double to, double& near, double& far)
{
  if (direction == 0)
  {
    far = origin >= from && origin <= to ? far : -Never;
    return;
  }
  const double a = (from - origin) / direction;
  const double b = (to - origin) / direction;
  near = std::max(near, std::min(a, b));
  far = std::min(far, std::max(a, b));
}
}

/// A ray whose horizontal places are counted in spacings from the grid's first point.
struct HeightGrid::Cast
{
  double origin[3];
  double direction[3];
};

HeightGrid::HeightGrid(GridPyramid heights)
  : Heights(std::move(heights))
{
  const GridFrame& frame = this->Heights.frame();
  if (this->Heights.empty() || frame.nx < 2 || frame.ny < 2)
  {
    return;
  }
  Level cells{ frame.nx - 1, frame.ny - 1, {} };
  for (int j = 0; j < cells.ny; ++j)
  {
    for (int i = 0; i < cells.nx; ++i)
    {
      cells.highest.push_back(std::max({ this->Heights.at(i, j), this->Heights.at(i + 1, j),
        this->Heights.at(i, j + 1), this->Heights.at(i + 1, j + 1) }));
    }
  }
  this->Levels.push_back(std::move(cells));
  while (this->Levels.back().nx > 1 || this->Levels.back().ny > 1)
  {
    const Level& fine = this->Levels.back();
    Level coarse{ (fine.nx + 1) / 2, (fine.ny + 1) / 2, {} };
    coarse.highest.assign(
      static_cast<std::size_t>(coarse.nx) * coarse.ny, -std::numeric_limits<float>::infinity());
    for (int j = 0; j < fine.ny; ++j)
    {
      for (int i = 0; i < fine.nx; ++i)
      {
        float& highest = coarse.highest[static_cast<std::size_t>(j / 2) * coarse.nx + i / 2];
        highest = std::max(highest, fine.highest[static_cast<std::size_t>(j) * fine.nx + i]);
      }
    }
    this->Levels.push_back(std::move(coarse));
  }
}

double HeightGrid::top() const
{
  return this->Levels.empty() ? -Never : this->Levels.back().highest[0];
}

double HeightGrid::intersect(const Ray& ray, double far) const
{
  if (this->Levels.empty())
  {
    return Never;
  }
  const GridFrame& frame = this->Heights.frame();
  const Cast cast{ { (ray.origin[0] - frame.x0) / frame.dx, (ray.origin[1] - frame.y0) / frame.dy,
                     ray.origin[2] },
    { ray.direction[0] / frame.dx, ray.direction[1] / frame.dy, ray.direction[2] } };
  return this->visit(cast, static_cast<int>(this->Levels.size()) - 1, 0, 0, 0, far);
}

// NOLINTNEXTLINE(misc-no-recursion): as deep as there are levels
double HeightGrid::visit(const Cast& cast, int level, int i, int j, double near, double far) const
{
  const Level& blocks = this->Levels[level];
  if (i >= blocks.nx || j >= blocks.ny)
  {
    return Never;
  }
  const double width = std::ldexp(1.0, level);
  const Level& cells = this->Levels[0];
  clip(cast.origin[0], cast.direction[0], i * width, std::min<double>((i + 1) * width, cells.nx),
    near, far);
  clip(cast.origin[1], cast.direction[1], j * width, std::min<double>((j + 1) * width, cells.ny),
    near, far);
  if (!(near <= far))
  {
    return Never;
  }
  const double lowest = cast.origin[2] +
    (cast.direction[2] == 0 ? 0 : cast.direction[2] * (cast.direction[2] < 0 ? far : near));
  if (lowest > blocks.highest[static_cast<std::size_t>(j) * blocks.nx + i])
  {
    return Never;
  }
  if (level == 0)
  {
    return this->patch(cast, i, j, near, far);
  }
  // The near block first, the far one last; of the two others a ray crosses one.
  const int x = cast.direction[0] < 0 ? 1 : 0;
  const int y = cast.direction[1] < 0 ? 1 : 0;
  double first = Never;
  for (const auto& child :
    { std::pair(x, y), std::pair(1 - x, y), std::pair(x, 1 - y), std::pair(1 - x, 1 - y) })
  {
    first = std::min(first,
      this->visit(
        cast, level - 1, 2 * i + child.first, 2 * j + child.second, near, std::min(far, first)));
  }
  return first;
}

double HeightGrid::patch(const Cast& cast, int i, int j, double near, double far) const
{
  const double a = this->Heights.at(i, j);
  const double b = this->Heights.at(i + 1, j) - a;
  const double c = this->Heights.at(i, j + 1) - a;
  const double d = this->Heights.at(i + 1, j + 1) - a - b - c;
  const double u = cast.origin[0] + near * cast.direction[0] - i;
  const double v = cast.origin[1] + near * cast.direction[1] - j;
  const double du = cast.direction[0];
  const double dv = cast.direction[1];
  const double above = cast.origin[2] + near * cast.direction[2] - a - b * u - c * v - d * u * v;
  if (above <= 0)
  {
    return near;
  }
  return near +
    leastRoot(
      -d * du * dv, cast.direction[2] - b * du - c * dv - d * (u * dv + v * du), above, far - near);
}

Vector3 HeightGrid::normal(double x, double y, double footprint) const
{
  const GridPyramid::Slopes slopes = this->Heights.slopes(x, y, footprint);
  return normalized(Vector3{ -slopes.x, -slopes.y, 1 });
}
}
