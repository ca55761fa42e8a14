// SPDX-License-Identifier: BSD-3-Clause
#include "AirSnapshot.h"

#include "CloudArrays.h"
#include "WholeData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkStringArray.h"
#include "vtkStructuredGrid.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr double MeanRadius = 6371229; // m

std::string geometryOf(vtkStructuredGrid* grid)
{
  auto* const names =
    vtkStringArray::SafeDownCast(grid->GetFieldData()->GetAbstractArray(arrays::Geometry));
  return names && names->GetNumberOfValues() > 0 ? names->GetValue(0) : "Local";
}

double fieldValue(vtkStructuredGrid* grid, const char* name, double otherwise)
{
  vtkDataArray* const array = grid->GetFieldData()->GetArray(name);
  return array && array->GetNumberOfValues() > 0 ? array->GetComponent(0, 0) : otherwise;
}

/// Horizontal coordinates of a point: longitude and latitude [rad], or x and y [m].
struct Reader
{
  vtkStructuredGrid* Grid;
  bool Globe;
  double Scale; // of a map's numbers to radians, 1 in a plane

  std::array<double, 2> at(int i, int j) const
  {
    int dimensions[3];
    this->Grid->GetDimensions(dimensions);
    double p[3];
    this->Grid->GetPoint(i + static_cast<vtkIdType>(dimensions[0]) * j, p);
    return this->Globe
      ? std::array<double, 2>{ std::atan2(p[1], p[0]), std::atan2(p[2], std::hypot(p[0], p[1])) }
      : std::array<double, 2>{ p[0] * this->Scale, p[1] * this->Scale };
  }
};

void requireMonotonic(const std::vector<double>& values, const char* what)
{
  for (std::size_t n = 1; n + 1 < values.size(); ++n)
  {
    if (!((values[n + 1] - values[n]) * (values[n] - values[n - 1]) > 0))
    {
      throw GridError(std::string("the grid's ") + what +
        " do not rise or fall steadily: trajectories need a grid along meridians and parallels, "
        "or along x and y.");
    }
  }
}

/// Every column has to stand where its row and its column say.
void requireAligned(const AirGrid& air, const Reader& reader)
{
  const double allowed = 0.05 * air.columns.smallestSpacing();
  for (int j = 0; j < air.columns.rows(); ++j)
  {
    for (int i = 0; i < air.columns.columns(); ++i)
    {
      const std::array<double, 2> at = reader.at(i, j);
      const Vector3 is = air.sphere ? Vector3{ std::cos(at[1]) * std::cos(at[0]),
        std::cos(at[1]) * std::sin(at[0]), std::sin(at[1]) }
                                    : Vector3{ at[0], at[1], 0 };
      if (!(length(is - air.columns.position(i, j)) <= allowed))
      {
        throw GridError("the grid's lines do not run along " +
          std::string(air.sphere ? "meridians and parallels" : "x and y") +
          ": read the file with its own projection (geometry Local).");
      }
    }
  }
}

Vector3 windAt(const AirGrid& air, const Vector3& position, const double v[3])
{
  if (!air.sphere || air.globe)
  {
    return { v[0], v[1], v[2] };
  }
  const double across = std::hypot(position[0], position[1]);
  const Vector3 east =
    across > 0 ? Vector3{ -position[1] / across, position[0] / across, 0 } : Vector3{ 0, 1, 0 };
  return v[0] * east + v[1] * cross(position, east) + v[2] * position;
}

void measureRows(const AirGrid& air, AirSnapshot& snapshot)
{
  const int ny = air.columns.rows();
  snapshot.rows.resize(static_cast<std::size_t>(ny) * air.levels);
  vtkSMPTools::For(0, static_cast<vtkIdType>(snapshot.rows.size()),
    [&air, &snapshot, ny](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType row = begin; row < end; ++row)
      {
        snapshot.rows[row] = measureRow(air.columns, air.radius, snapshot.velocity.data(),
          static_cast<int>(row % ny), static_cast<int>(row / ny));
      }
    });
}

float finite(double value)
{
  return std::isfinite(value) ? static_cast<float>(value) : 0.0F;
}
}

AirGrid airGridOf(vtkStructuredGrid* grid)
{
  int n[3];
  grid->GetDimensions(n);
  if (n[0] < 1 || n[1] < 1 || n[2] < 1)
  {
    throw GridError("the grid has no points.");
  }
  const std::string missing = whatIsMissing(grid);
  if (!missing.empty())
  {
    throw GridError(missing);
  }
  AirGrid air;
  const std::string geometry = geometryOf(grid);
  air.globe = geometry == "Globe";
  air.sphere = air.globe || geometry == "Map";
  air.levels = n[2];
  air.radius = air.globe ? fieldValue(grid, arrays::PlanetRadius, MeanRadius) : MeanRadius;
  air.heightScale = fieldValue(grid, arrays::HeightScale, 1);
  double bounds[6];
  grid->GetBounds(bounds);
  Reader reader{ grid, air.globe, 1 };
  if (geometry == "Map")
  {
    const bool degrees = std::max(std::abs(bounds[0]), std::abs(bounds[1])) <= 720 &&
      std::max(std::abs(bounds[2]), std::abs(bounds[3])) <= 90;
    reader.Scale = degrees ? Pi / 180 : 1 / air.radius;
    air.heightScale *= degrees ? air.radius * Pi / 180 : 1;
  }

  std::vector<double> x;
  std::vector<double> y;
  for (int i = 0; i < n[0]; ++i)
  {
    x.push_back(reader.at(i, n[1] / 2)[0]);
    while (air.globe && i > 0 && x[i] < x[i - 1])
    {
      x[i] += 2 * Pi;
    }
  }
  for (int j = 0; j < n[1]; ++j)
  {
    y.push_back(reader.at(n[0] / 2, j)[1]);
  }
  requireMonotonic(x, air.sphere ? "longitudes" : "x coordinates");
  requireMonotonic(y, air.sphere ? "latitudes" : "y coordinates");
  air.columns = air.sphere ? ColumnGrid::sphere(x, y) : ColumnGrid::plane(x, y);
  requireAligned(air, reader);
  return air;
}

AirSnapshot airSnapshotOf(const AirGrid& air, vtkStructuredGrid* grid, double time)
{
  vtkDataArray* const wind = grid->GetPointData()->GetArray(arrays::Wind);
  vtkDataArray* const height = grid->GetPointData()->GetArray(arrays::Height);
  if (!wind || wind->GetNumberOfComponents() != 3)
  {
    throw GridError("there is no point array Wind of 3 components: the file needs eastward and "
                    "northward wind, or choose its variables.");
  }
  if (!height || height->GetNumberOfComponents() != 1)
  {
    throw GridError("there is no point array Height.");
  }
  const auto points = static_cast<vtkIdType>(air.points());
  if (grid->GetNumberOfPoints() != points)
  {
    throw GridError("the grid has another number of points than at its first time.");
  }
  const std::string missing = whatIsMissing(grid);
  if (!missing.empty())
  {
    throw GridError(missing);
  }
  AirSnapshot snapshot;
  snapshot.time = time;
  snapshot.velocity.resize(3 * air.points());
  snapshot.upward.resize(air.points());
  snapshot.height.resize(air.points());
  const int nx = air.columns.columns();
  const int ny = air.columns.rows();
  vtkSMPTools::For(0, points,
    [&air, &snapshot, wind, height, nx, ny](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType p = begin; p < end; ++p)
      {
        const Vector3 position =
          air.columns.position(static_cast<int>(p % nx), static_cast<int>(p / nx % ny));
        double v[3];
        wind->GetTuple(p, v);
        const Vector3 full = windAt(air, position, v);
        const Vector3 vertical = air.sphere ? position : Vector3{ 0, 0, 1 };
        const double up = dot(full, vertical);
        const Vector3 along = full - up * vertical;
        for (int c = 0; c < 3; ++c)
        {
          snapshot.velocity[3 * p + c] = finite(along[c]);
        }
        snapshot.upward[p] = finite(up);
        snapshot.height[p] = finite(height->GetComponent(p, 0));
      }
    });
  measureRows(air, snapshot);
  return snapshot;
}

int RowSchemes::mostSubsteps() const
{
  return this->Substeps.empty() ? 1
                                : *std::max_element(this->Substeps.begin(), this->Substeps.end());
}

AirInterval::AirInterval(const AirGrid& air, const AirSnapshot& begin, const AirSnapshot& end)
  : Ends{ &begin, &end }
{
  this->Motion.wind.grid = &air.columns;
  this->Motion.wind.levels = air.levels;
  this->Motion.wind.radius = air.radius;
  this->Motion.wind.seconds = end.time - begin.time;
  this->Motion.heightScale = air.heightScale;
  for (int time = 0; time < 2; ++time)
  {
    this->Motion.wind.velocity[time] = this->Ends[time]->velocity.data();
    this->Motion.height[time] = this->Ends[time]->height.data();
    this->LevelVelocity[time].resize(air.points());
  }
  vtkSMPTools::For(0, air.columns.rows(),
    [this](vtkIdType first, vtkIdType last)
    {
      for (vtkIdType j = first; j < last; ++j)
      {
        this->setLevelVelocity(static_cast<int>(j));
      }
    });
  for (int time = 0; time < 2; ++time)
  {
    this->Motion.wind.levelVelocity[time] = this->LevelVelocity[time].data();
  }
}

/// Of the columns of a row.
void AirInterval::setLevelVelocity(int j)
{
  const int nx = this->Motion.wind.grid->columns();
  const int levels = this->Motion.wind.levels;
  std::vector<double> height(levels);
  std::vector<double> through(levels);
  std::vector<double> velocity(levels);
  for (int i = 0; i < nx; ++i)
  {
    const ColumnSlope slope(this->Motion, i, j);
    for (int time = 0; time < 2; ++time)
    {
      const auto point = [this, nx, i, j](int k)
      { return i + static_cast<std::size_t>(nx) * j + this->Motion.columns() * k; };
      for (int k = 0; k < levels; ++k)
      {
        height[k] = this->Ends[time]->height[point(k)];
        through[k] =
          slope.motionThroughLevels(this->Motion, time, k, this->Ends[time]->upward[point(k)]);
      }
      levelVelocity(levels, height.data(), through.data(), velocity.data());
      for (int k = 0; k < levels; ++k)
      {
        this->LevelVelocity[time][point(k)] = static_cast<float>(velocity[k]);
      }
    }
  }
}

RowSchemes AirInterval::schemes(
  Integrator integrator, Interpolation interpolation, double tolerance) const
{
  const WindPair& wind = this->Motion.wind;
  std::vector<WindMeasure> rows = this->Ends[0]->rows;
  for (std::size_t row = 0; row < rows.size(); ++row)
  {
    rows[row].include(this->Ends[1]->rows[row]);
  }
  return { { integrator, interpolation, 1 }, wind.grid->rows(),
    substepsOfRows(
      *wind.grid, wind.levels, wind.radius, rows, integrator, wind.seconds, tolerance) };
}

double strainOfShare(const AirGrid& air, const AirSnapshot& snapshot, double share)
{
  // The map of a short time: its largest singular value is 1 + strain rate * time.
  constexpr double Short = 600; // s
  AirMotion still;
  still.wind.grid = &air.columns;
  still.wind.levels = air.levels;
  still.wind.radius = air.radius;
  const int nx = air.columns.columns();
  const int ny = air.columns.rows();
  const auto points = static_cast<vtkIdType>(air.points());
  std::vector<float> moved(3 * air.points());
  vtkSMPTools::For(0, points,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType p = begin; p < end; ++p)
      {
        const Vector3 at = placeOf(
          still, air.columns.position(static_cast<int>(p % nx), static_cast<int>(p / nx % ny)), 0);
        for (int c = 0; c < 3; ++c)
        {
          moved[3 * p + c] = static_cast<float>(at[c] + Short * snapshot.velocity[3 * p + c]);
        }
      }
    });
  std::vector<float> strain(air.points());
  vtkSMPTools::For(0, points,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType p = begin; p < end; ++p)
      {
        const Stretch stretch = stretchAt(still, moved.data(), static_cast<int>(p % nx),
          static_cast<int>(p / nx % ny), static_cast<int>(p / nx / ny));
        strain[p] = static_cast<float>(
          std::max(stretch.largest - 1, 1 - std::min(stretch.smallest, 1.0)) / Short);
      }
    });
  const auto at = strain.begin() + static_cast<std::ptrdiff_t>(share * (strain.size() - 1));
  std::nth_element(strain.begin(), at, strain.end());
  return *at;
}
}
