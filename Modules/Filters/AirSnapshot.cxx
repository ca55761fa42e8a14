// SPDX-License-Identifier: BSD-3-Clause
#include "AirSnapshot.h"

#include "CloudArrays.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkStructuredGrid.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
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

float finite(double value)
{
  return std::isfinite(value) ? static_cast<float>(value) : 0.0F;
}

/// Wind and heights of a rectangle of columns.
AirSnapshot snapshotOf(const AirGrid& air, vtkStructuredGrid* grid, const BlockOfGrid& block,
  const ColumnRectangle& part)
{
  vtkDataArray* const wind = grid->GetPointData()->GetArray(arrays::Wind);
  vtkDataArray* const height = grid->GetPointData()->GetArray(arrays::Height);
  const auto points = static_cast<vtkIdType>(part.size()) * air.levels;
  AirSnapshot snapshot;
  snapshot.velocity.resize(static_cast<std::size_t>(3 * points));
  snapshot.upward.resize(static_cast<std::size_t>(points));
  snapshot.height.resize(static_cast<std::size_t>(points));
  vtkSMPTools::For(0, points,
    [&air, &snapshot, &block, &part, wind, height](vtkIdType begin, vtkIdType end)
    {
      const auto columns = static_cast<vtkIdType>(part.size());
      for (vtkIdType p = begin; p < end; ++p)
      {
        const auto n = static_cast<std::size_t>(p % columns);
        const Vector3 position = air.columns.position(part.column(n), part.row(n));
        const vtkIdType id = block.id(part.column(n), part.row(n), static_cast<int>(p / columns));
        double v[3];
        wind->GetTuple(id, v);
        const Vector3 full = windAt(air, position, v);
        const Vector3 vertical = air.sphere ? position : Vector3{ 0, 0, 1 };
        const double up = dot(full, vertical);
        const Vector3 along = full - up * vertical;
        for (int c = 0; c < 3; ++c)
        {
          snapshot.velocity[3 * p + c] = finite(along[c]);
        }
        snapshot.upward[p] = finite(up);
        snapshot.height[p] = finite(height->GetComponent(id, 0));
      }
    });
  return snapshot;
}

std::vector<double> partOf(const std::vector<double>& values, int first, int count)
{
  return { values.begin() + first, values.begin() + first + count };
}

/// Of a rectangle's parts of rows, with differences inside of it, in an array of all rows.
std::vector<WindMeasure> measureRows(
  const AirGrid& air, const std::vector<float>& velocity, const ColumnRectangle& part)
{
  const int ny = air.columns.rows();
  std::vector<WindMeasure> rows(static_cast<std::size_t>(ny) * air.levels);
  if (part.size() == 0)
  {
    return rows;
  }
  const std::vector<double> x =
    partOf(air.columns.columnCoordinates(), part.firstColumn, part.columns);
  const std::vector<double> y = partOf(air.columns.rowCoordinates(), part.firstRow, part.rows);
  const ColumnGrid grid = air.sphere ? ColumnGrid::sphere(x, y) : ColumnGrid::plane(x, y);
  vtkSMPTools::For(0, static_cast<vtkIdType>(part.rows) * air.levels,
    [&air, &rows, &velocity, &grid, &part, ny](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType row = begin; row < end; ++row)
      {
        const int j = static_cast<int>(row % part.rows);
        const int k = static_cast<int>(row / part.rows);
        rows[part.firstRow + j + static_cast<std::size_t>(ny) * k] =
          measureRow(grid, air.radius, velocity.data(), j, k);
      }
    });
  return rows;
}

/// Neighbours of different blocks stand together in one of them with its borders, so that no difference is left out.
void measureTogether(const ColumnShare& share, std::vector<WindMeasure>& rows)
{
  std::vector<double> values;
  for (const WindMeasure& row : rows)
  {
    values.insert(values.end(), { row.speed, row.strain });
  }
  share.largest(values.data(), values.size());
  for (std::size_t n = 0; n < rows.size(); ++n)
  {
    rows[n] = { values[2 * n], values[2 * n + 1] };
  }
}

/// The values of a block's own columns.
std::vector<float> ownOf(
  const std::vector<float>& values, const ColumnShare& share, int levels, int components)
{
  const ColumnRectangle& own = share.own();
  const ColumnRectangle& block = share.block();
  std::vector<float> result;
  result.reserve(own.size() * levels * components);
  for (int row = 0; row < own.rows * levels; ++row)
  {
    const auto begin = values.begin() +
      static_cast<std::ptrdiff_t>(block.columns) * components *
        (row % own.rows + block.rows * (row / own.rows));
    result.insert(
      result.end(), begin, begin + static_cast<std::ptrdiff_t>(own.columns) * components);
  }
  return result;
}

std::string whatWindLacks(vtkStructuredGrid* grid)
{
  vtkDataArray* const wind = grid->GetPointData()->GetArray(arrays::Wind);
  if (!wind || wind->GetNumberOfComponents() != 3)
  {
    return "there is no point array Wind of 3 components: the file needs eastward and northward "
           "wind, or choose its variables.";
  }
  vtkDataArray* const height = grid->GetPointData()->GetArray(arrays::Height);
  if (!height || height->GetNumberOfComponents() != 1)
  {
    return "there is no point array Height.";
  }
  return "";
}
}

AirSnapshot airSnapshotOf(const AirGrid& air, vtkStructuredGrid* grid, double time)
{
  const ColumnShare& share = air.share;
  const BlockOfGrid block(grid, air.whole);
  std::string wrong = whatIsWrong(grid, block, share, air.levels);
  if (wrong.empty() && share.own().size() > 0)
  {
    wrong = whatWindLacks(grid);
  }
  share.require(wrong);
  AirSnapshot snapshot = snapshotOf(air, grid, block, share.block());
  snapshot.rows = measureRows(air, snapshot.velocity, share.block());
  if (share.isDivided())
  {
    measureTogether(share, snapshot.rows);
    snapshot.velocity = ownOf(snapshot.velocity, share, air.levels, 3);
    snapshot.upward = ownOf(snapshot.upward, share, air.levels, 1);
    snapshot.height = ownOf(snapshot.height, share, air.levels, 1);
  }
  snapshot.time = time;
  return snapshot;
}

int RowSchemes::mostSubsteps() const
{
  return this->Substeps.empty() ? 1
                                : *std::max_element(this->Substeps.begin(), this->Substeps.end());
}

namespace
{
/// Of all levels and both times, in some rows.
double strongestWind(
  const AirSnapshot* const ends[2], const AirGrid& air, const std::array<int, 2>& rows)
{
  double speed = 0;
  for (int k = 0; k < air.levels; ++k)
  {
    for (int j = rows[0]; j <= rows[1]; ++j)
    {
      const std::size_t row = j + static_cast<std::size_t>(air.columns.rows()) * k;
      speed = std::max({ speed, ends[0]->rows[row].speed, ends[1]->rows[row].speed });
    }
  }
  return speed;
}

/// How far air may have come that ends at the own columns, m: with the strongest wind of those rows that the strongest of all leads to.
double wayOfAir(const AirSnapshot* const ends[2], const AirGrid& air)
{
  constexpr double OffTheSphere =
    1.05; // where stages of a step may lie, with as much more wind (Trajectory.cxx)
  const double seconds = OffTheSphere * std::abs(ends[1]->time - ends[0]->time);
  const double farthest = seconds * strongestWind(ends, air, { 0, air.columns.rows() - 1 });
  return seconds *
    strongestWind(ends, air, rowsWithin(air.columns, air.share.own(), farthest, air.radius));
}
}

/// Of one column, to be used again for the next.
struct AirInterval::ColumnProfile
{
  std::vector<double> height;
  std::vector<double> through;
  std::vector<double> velocity;

  explicit ColumnProfile(int levels)
    : height(levels)
    , through(levels)
    , velocity(levels)
  {
  }
};

AirInterval::AirInterval(
  const AirGrid& air, const AirSnapshot& begin, const AirSnapshot& end, double reach)
  : Ends{ &begin, &end }
  , About(air.share, air.columns, air.radius, reach * wayOfAir(this->Ends, air))
  , Motion(air.still())
{
  this->Motion.wind.held = this->About.held();
  this->Motion.wind.seconds = end.time - begin.time;
  for (int time = 0; time < 2; ++time)
  {
    this->Velocity[time] = this->About.gather(this->Ends[time]->velocity, air.levels, 3);
    this->Height[time] = this->About.gather(this->Ends[time]->height, air.levels, 1);
    this->Motion.wind.velocity[time] = this->Velocity[time].data();
    this->Motion.height[time] = this->Height[time].data();
    this->OwnLevelVelocity[time].resize(air.points());
  }
  vtkSMPTools::For(0, static_cast<vtkIdType>(air.share.own().size()),
    [this, &air](vtkIdType first, vtkIdType last)
    {
      ColumnProfile profile(air.levels);
      for (vtkIdType column = first; column < last; ++column)
      {
        this->setLevelVelocity(air, static_cast<std::size_t>(column), profile);
      }
    });
  for (int time = 0; time < 2; ++time)
  {
    this->LevelVelocity[time] = this->About.gather(this->OwnLevelVelocity[time], air.levels, 1);
    this->Motion.wind.levelVelocity[time] = this->LevelVelocity[time].data();
  }
}

/// Of an own column.
void AirInterval::setLevelVelocity(const AirGrid& air, std::size_t column, ColumnProfile& profile)
{
  const int levels = air.levels;
  auto& [height, through, velocity] = profile;
  const ColumnSlope slope(
    this->Motion, air.share.own().column(column), air.share.own().row(column));
  for (int time = 0; time < 2; ++time)
  {
    const auto point = [&air, column](int k) { return column + air.share.own().size() * k; };
    for (int k = 0; k < levels; ++k)
    {
      height[k] = this->Ends[time]->height[point(k)];
      through[k] =
        slope.motionThroughLevels(this->Motion, time, k, this->Ends[time]->upward[point(k)]);
    }
    levelVelocity(levels, height.data(), through.data(), velocity.data());
    for (int k = 0; k < levels; ++k)
    {
      this->OwnLevelVelocity[time][point(k)] = static_cast<float>(velocity[k]);
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
  AirMotion still = air.still();
  std::vector<float> ownMoved(3 * air.points());
  const auto points = static_cast<vtkIdType>(air.points());
  vtkSMPTools::For(0, points,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType p = begin; p < end; ++p)
      {
        const AirGrid::Point point = air.point(p);
        const Vector3 at = placeOf(still, air.columns.position(point.i, point.j), 0);
        for (int c = 0; c < 3; ++c)
        {
          ownMoved[3 * p + c] = static_cast<float>(at[c] + Short * snapshot.velocity[3 * p + c]);
        }
      }
    });
  const Neighborhood beside(air.share, air.columns, air.radius, 0);
  const NearbyValues moved = beside.gather(ownMoved, air.levels, 3);
  still.wind.held = beside.held();
  std::vector<float> strain(air.points());
  vtkSMPTools::For(0, points,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType p = begin; p < end; ++p)
      {
        const AirGrid::Point point = air.point(p);
        const Stretch stretch = stretchAt(still, moved.data(), point.i, point.j, point.k);
        strain[p] = static_cast<float>(
          std::max(stretch.largest - 1, 1 - std::min(stretch.smallest, 1.0)) / Short);
      }
    });
  return air.share.ranked(std::move(strain), static_cast<long long>(share * (air.allPoints() - 1)));
}
}
