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
/// Where rays begin: blocks of 16 x 16 cells. Larger ones hold a hill nearly always.
constexpr int FirstLevel = 4;

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

/// Cut [near, far] to where `0 <= origin + t direction <= to`.
void clip(double origin, double direction, double to, double& near, double& far)
{
  if (direction == 0)
  {
    far = origin >= 0 && origin <= to ? far : -Never;
    return;
  }
  const double a = -origin / direction;
  const double b = (to - origin) / direction;
  near = std::max(near, std::min(a, b));
  far = std::min(far, std::max(a, b));
}

/// Where a ray leaves the block of a cell along one axis; of the last block beyond the grid's edge, where the ray's own end is.
double leaves(double origin, double inverse, int level, int cell)
{
  const int block = (cell >> level) + (inverse > 0 ? 1 : 0);
  return inverse == 0 ? Never : (static_cast<double>(block << level) - origin) * inverse;
}

/// The cell from `first` to before `last` that is nearest to a place.
int cellAt(double place, int first, int last)
{
  return place > first ? static_cast<int>(std::min(place, last - 1.0)) : first;
}
}

/// A ray whose horizontal places are counted in spacings from the grid's first point, and the part of it that is left.
struct HeightGrid::Cast
{
  double origin[3];
  double direction[3];
  double inverse[2]; ///< of the horizontal directions; 0 of 0
  double near;
  double far;
};

/// A cell, and the level of the block about it that is being looked at.
struct HeightGrid::Place
{
  int level;
  int i;
  int j;
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
  const Level& cells = this->Levels[0];
  const double dx = ray.direction[0] / frame.dx;
  const double dy = ray.direction[1] / frame.dy;
  Cast cast{ { (ray.origin[0] - frame.x0) / frame.dx, (ray.origin[1] - frame.y0) / frame.dy,
               ray.origin[2] },
    { dx, dy, ray.direction[2] }, { dx != 0 ? 1 / dx : 0, dy != 0 ? 1 / dy : 0 }, 0, far };
  clip(cast.origin[0], cast.direction[0], cells.nx, cast.near, cast.far);
  clip(cast.origin[1], cast.direction[1], cells.ny, cast.near, cast.far);
  if (ray.direction[2] > 0)
  {
    cast.far = std::min(cast.far, (this->top() - ray.origin[2]) / ray.direction[2]);
  }
  return cast.near <= cast.far ? this->descend(cast) : Never;
}

/// From block to block, finer where the ground may reach the ray, coarser where a coarser block begins.
double HeightGrid::descend(Cast& cast) const
{
  const Level& cells = this->Levels[0];
  Place at{ std::min(FirstLevel, static_cast<int>(this->Levels.size()) - 1),
    cellAt(cast.origin[0] + cast.near * cast.direction[0], 0, cells.nx),
    cellAt(cast.origin[1] + cast.near * cast.direction[1], 0, cells.ny) };
  while (at.i >= 0 && at.i < cells.nx && at.j >= 0 && at.j < cells.ny)
  {
    const Level& blocks = this->Levels[static_cast<std::size_t>(at.level)];
    const double alongX = leaves(cast.origin[0], cast.inverse[0], at.level, at.i);
    const double alongY = leaves(cast.origin[1], cast.inverse[1], at.level, at.j);
    const double end = std::min({ alongX, alongY, cast.far });
    const double lowest = cast.origin[2] +
      (cast.direction[2] == 0 ? 0 : cast.direction[2] * (cast.direction[2] < 0 ? end : cast.near));
    const bool isReached = !(lowest > blocks.at(at.i >> at.level, at.j >> at.level));
    if (isReached && at.level > 0)
    {
      --at.level;
      continue;
    }
    const double hit = isReached ? this->patch(cast, at.i, at.j, end) : Never;
    if (hit < Never || end >= cast.far)
    {
      return hit;
    }
    cast.near = std::max(cast.near, end);
    this->advance(cast, alongX <= alongY ? 0 : 1, at);
  }
  return Never;
}

/// To the next block along an axis.
void HeightGrid::advance(const Cast& cast, int axis, Place& at) const
{
  int& along = axis == 0 ? at.i : at.j;
  int& aside = axis == 0 ? at.j : at.i;
  const int points = axis == 0 ? this->Levels[0].ny : this->Levels[0].nx;
  const int width = 1 << at.level;
  const int block = along >> at.level;
  const int first = (aside >> at.level) << at.level;
  along =
    (cast.direction[axis] > 0 ? block + 1 : block) * width - (cast.direction[axis] > 0 ? 0 : 1);
  aside = cellAt(cast.origin[1 - axis] + cast.near * cast.direction[1 - axis], first,
    std::min(first + width, points));
  if (at.level + 1 < static_cast<int>(this->Levels.size()) && along >> (at.level + 1) != block >> 1)
  {
    ++at.level;
  }
}

double HeightGrid::patch(const Cast& cast, int i, int j, double far) const
{
  const double near = cast.near;
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
