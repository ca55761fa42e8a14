// SPDX-License-Identifier: BSD-3-Clause
#include "SceneLayout.h"

#include "NumberText.h"
#include "ReadError.h"

#include <cmath>

namespace nephoscope
{
namespace
{
constexpr double Degree = 3.14159265358979323846 / 180;
using Vector = std::array<double, 3>;

Vector sum(double a, const Vector& u, double b, const Vector& v)
{
  return { a * u[0] + b * v[0], a * u[1] + b * v[1], a * u[2] + b * v[2] };
}
}

SceneLayout::SceneLayout(
  const HorizontalGrid& grid, const GridAxes& axes, const SceneOptions& options, bool gridWind)
  : Grid(grid)
  , Axes(axes)
  , Options(options)
  , GridWind(gridWind)
{
  if (!grid.hasPlaces() && options.geometry != SceneGeometry::Local)
  {
    throw ReadError(
      "the grid is a plane in metres without longitudes and latitudes; use SetGeometryToLocal");
  }
  if (options.geometry == SceneGeometry::Local && grid.hasPlaces())
  {
    if (!grid.Plane)
    {
      const std::size_t middle = (axes.ny / 2) * axes.nx + axes.nx / 2;
      this->Own = std::make_unique<Projection>(
        projAbout(grid.Longitude[middle], grid.Latitude[middle], grid.Radius));
    }
    this->Definition = (this->Own ? this->Own : grid.Plane)->definition();
  }
}

double SceneLayout::heightScale() const
{
  const bool degrees = this->Options.geometry == SceneGeometry::Map && this->Options.degrees;
  return this->Options.exaggeration / (degrees ? this->Grid.Radius * Degree : 1);
}

void SceneLayout::globe(double longitude, double latitude, SceneColumn& column) const
{
  const double sinLon = std::sin(longitude * Degree);
  const double cosLon = std::cos(longitude * Degree);
  const bool atPole = std::abs(latitude) >= 90;
  const double sinLat = atPole ? std::copysign(1.0, latitude) : std::sin(latitude * Degree);
  const double cosLat = atPole ? 0 : std::cos(latitude * Degree);
  column.up = { cosLat * cosLon, cosLat * sinLon, sinLat };
  column.along = { -sinLon, cosLon, 0 };
  column.across = { -sinLat * cosLon, -sinLat * sinLon, cosLat };
  column.base = sum(this->Grid.Radius, column.up, 0, column.up);
  column.rise = sum(this->heightScale(), column.up, 0, column.up);
}

void SceneLayout::map(double longitude, double latitude, SceneColumn& column) const
{
  const double scale = this->Options.degrees ? 1 : this->Grid.Radius * Degree;
  column.base = { scale * longitude, scale * latitude, 0 };
  column.rise = { 0, 0, this->heightScale() };
}

void SceneLayout::local(std::size_t at, SceneColumn& column) const
{
  column.rise = { 0, 0, this->heightScale() };
  const Projection* plane = this->Own ? this->Own.get() : this->Grid.Plane.get();
  if (!this->Grid.X.empty())
  {
    column.base = { this->Grid.X[at], this->Grid.Y[at], 0 };
  }
  else if (!plane->forward(
             this->Grid.Longitude[at], this->Grid.Latitude[at], column.base[0], column.base[1]))
  {
    throw ReadError("longitude " + numberText(this->Grid.Longitude[at], 10) + ", latitude " +
      numberText(this->Grid.Latitude[at], 10) + " lie outside the projection '" +
      plane->definition() + "'; use SetGeometryToMap or SetGeometryToGlobe");
  }
  double x = 0;
  double y = 1;
  if (plane && plane->north(this->Grid.Longitude[at], this->Grid.Latitude[at], x, y))
  {
    column.across = { x, y, 0 };
    column.along = { y, -x, 0 };
  }
}

void SceneLayout::turnGridWind(std::size_t i, std::size_t j, SceneColumn& column) const
{
  // The grid's x in true east and north: from the projection, else from the step to the next column.
  const std::size_t nx = this->Axes.nx;
  const std::size_t at = j * nx + i;
  double east = 1;
  double north = 0;
  double x = 0;
  double y = 1;
  if (this->Grid.Plane &&
    this->Grid.Plane->north(this->Grid.Longitude[at], this->Grid.Latitude[at], x, y))
  {
    east = y;
    north = x;
  }
  else if (this->Grid.hasPlaces() && !this->Grid.Plain && nx > 1)
  {
    const std::size_t a = j * nx + (i + 1 < nx ? i : i - 1);
    const double dx = (this->Grid.Longitude[a + 1] - this->Grid.Longitude[a]) *
      std::cos(this->Grid.Latitude[at] * Degree);
    const double dy = this->Grid.Latitude[a + 1] - this->Grid.Latitude[a];
    const double length = std::hypot(dx, dy);
    east = length > 0 ? dx / length : 1;
    north = length > 0 ? dy / length : 0;
  }
  const Vector trueEast = column.along;
  const Vector trueNorth = column.across;
  column.along = sum(east, trueEast, north, trueNorth);
  column.across = sum(-north, trueEast, east, trueNorth);
}

SceneColumn SceneLayout::column(std::size_t i, std::size_t j, int turn) const
{
  SceneColumn column;
  const std::size_t at = j * this->Axes.nx + i;
  if (this->Options.geometry == SceneGeometry::Local)
  {
    this->local(at, column);
  }
  else if (this->Options.geometry == SceneGeometry::Globe)
  {
    this->globe(this->Grid.Longitude[at], this->Grid.Latitude[at], column);
  }
  else
  {
    this->map(this->Grid.Longitude[at] + 360 * turn, this->Grid.Latitude[at], column);
  }
  if (this->GridWind)
  {
    this->turnGridWind(i, j, column);
  }
  return column;
}

SceneColumn SceneLayout::pole(std::size_t i, int sign, int turn) const
{
  SceneColumn column;
  const double longitude = this->Grid.Longitude[i];
  if (this->Options.geometry == SceneGeometry::Globe)
  {
    this->globe(longitude, 90 * sign, column);
  }
  else
  {
    this->map(longitude + 360 * turn, 90 * sign, column);
  }
  return column;
}
}
