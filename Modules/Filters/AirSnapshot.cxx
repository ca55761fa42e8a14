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
#include <limits>

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

/// Where the block of a process is found in its grid.
class BlockOfGrid
{
public:
  BlockOfGrid() = default;
  /// @param whole extent, whose first point is point 0
  BlockOfGrid(vtkStructuredGrid* grid, const PointExtent& whole)
  {
    int extent[6];
    grid->GetExtent(extent);
    for (int axis = 0; axis < 3; ++axis)
    {
      this->First[axis] = extent[2 * axis] - whole[2 * axis];
      this->Count[axis] = extent[2 * axis + 1] - extent[2 * axis] + 1;
    }
  }
  vtkIdType id(int i, int j, int k) const
  {
    return i - this->First[0] +
      this->Count[0] *
      (j - this->First[1] + static_cast<vtkIdType>(this->Count[1]) * (k - this->First[2]));
  }
  bool has(const ColumnRectangle& block, int levels) const
  {
    return this->First[0] <= block.firstColumn && this->First[1] <= block.firstRow &&
      block.firstColumn + block.columns <= this->First[0] + this->Count[0] &&
      block.firstRow + block.rows <= this->First[1] + this->Count[1] && this->First[2] == 0 &&
      this->Count[2] == levels;
  }

private:
  int First[3] = { 0, 0, 0 };
  int Count[3] = { 0, 0, 0 };
};

/// Horizontal coordinates of a point: longitude and latitude [rad], or x and y [m].
struct Reader
{
  vtkStructuredGrid* Grid;
  BlockOfGrid Block;
  bool Globe;
  double Scale; // of a map's numbers to radians, 1 in a plane

  std::array<double, 2> at(int i, int j) const
  {
    double p[3];
    this->Grid->GetPoint(this->Block.id(i, j, 0), p);
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

/// Every own column has to stand where its row and its column say.
std::string whatIsMisaligned(const AirGrid& air, const Reader& reader)
{
  const double allowed = 0.05 * air.columns.smallestSpacing();
  const ColumnRectangle& own = air.share.own();
  for (std::size_t n = 0; n < own.size(); ++n)
  {
    const std::array<double, 2> at = reader.at(own.column(n), own.row(n));
    const Vector3 is = air.sphere ? Vector3{ std::cos(at[1]) * std::cos(at[0]),
      std::cos(at[1]) * std::sin(at[0]), std::sin(at[1]) }
                                  : Vector3{ at[0], at[1], 0 };
    if (!(length(is - air.columns.position(own.column(n), own.row(n))) <= allowed))
    {
      return "the grid's lines do not run along " +
        std::string(air.sphere ? "meridians and parallels" : "x and y") +
        ": read the file with its own projection (geometry Local).";
    }
  }
  return "";
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

/// What makes a grid useless as this process's part; empty if nothing does.
std::string whatIsWrong(
  vtkStructuredGrid* grid, const BlockOfGrid& block, const ColumnShare& share, int levels)
{
  if (share.own().size() == 0 && share.isDivided())
  {
    return "";
  }
  if (grid->GetNumberOfPoints() == 0 || share.own().size() == 0)
  {
    return "the grid has no points.";
  }
  if (!block.has(share.block(), levels))
  {
    return share.isDivided()
      ? "the input does not give the block of whole columns that it was asked for: run this filter "
        "in one process."
      : "the grid has another number of points than at its first time.";
  }
  return whatIsMissing(grid);
}

/// What is the same in all processes that have points is so afterwards in the others too.
void describeScene(vtkStructuredGrid* grid, const ColumnShare& share, AirGrid& air, double& scale)
{
  constexpr double Nothing = -std::numeric_limits<double>::max();
  const bool nothing = share.own().size() == 0;
  double bounds[6];
  grid->GetBounds(bounds);
  const std::string geometry = geometryOf(grid);
  std::array<double, 6> facts{ geometry == "Globe" ? 1.0 : 0.0, geometry == "Map" ? 1.0 : 0.0,
    fieldValue(grid, arrays::PlanetRadius, MeanRadius), fieldValue(grid, arrays::HeightScale, 1),
    std::max(std::abs(bounds[0]), std::abs(bounds[1])),
    std::max(std::abs(bounds[2]), std::abs(bounds[3])) };
  if (nothing)
  {
    facts.fill(Nothing);
  }
  share.largest(facts.data(), facts.size());
  air.globe = facts[0] == 1;
  const bool map = facts[1] == 1;
  air.sphere = air.globe || map;
  air.radius = air.globe ? facts[2] : MeanRadius;
  air.heightScale = facts[3];
  scale = 1;
  if (map)
  {
    const bool degrees = facts[4] <= 720 && facts[5] <= 90;
    scale = degrees ? Pi / 180 : 1 / air.radius;
    air.heightScale *= degrees ? air.radius * Pi / 180 : 1;
  }
}

/// Coordinates of the columns along the middle row and of the rows along the middle column, each from who has it.
void gatherAxes(
  const ColumnShare& share, const Reader& reader, std::vector<double>& x, std::vector<double>& y)
{
  constexpr double Nothing = -std::numeric_limits<double>::max();
  x.assign(share.columns(), Nothing);
  y.assign(share.rows(), Nothing);
  const ColumnRectangle& own = share.own();
  for (std::size_t n = 0; n < own.size(); ++n)
  {
    const int i = own.column(n);
    const int j = own.row(n);
    if (j == share.rows() / 2)
    {
      x[i] = std::fmax(reader.at(i, j)[0], Nothing); // not NaN, which has no maximum
    }
    if (i == share.columns() / 2)
    {
      y[j] = std::fmax(reader.at(i, j)[1], Nothing);
    }
  }
  for (std::vector<double>* const values : { &x, &y })
  {
    share.largest(values->data(), values->size());
    std::replace(values->begin(), values->end(), Nothing, std::nan(""));
  }
}

AirGrid airGridOf(vtkStructuredGrid* grid, const ColumnShare& share, const PointExtent& whole)
{
  const BlockOfGrid block(grid, whole);
  AirGrid air;
  air.share = share;
  air.whole = whole;
  air.levels = whole[5] - whole[4] + 1;
  share.require(whatIsWrong(grid, block, share, air.levels));
  Reader reader{ grid, block, false, 1 };
  describeScene(grid, share, air, reader.Scale);
  reader.Globe = air.globe;
  std::vector<double> x;
  std::vector<double> y;
  gatherAxes(share, reader, x, y);
  for (std::size_t i = 1; i < x.size(); ++i)
  {
    while (air.globe && x[i] < x[i - 1])
    {
      x[i] += 2 * Pi;
    }
  }
  requireMonotonic(x, air.sphere ? "longitudes" : "x coordinates");
  requireMonotonic(y, air.sphere ? "latitudes" : "y coordinates");
  air.columns = air.sphere ? ColumnGrid::sphere(x, y) : ColumnGrid::plane(x, y);
  share.require(whatIsMisaligned(air, reader));
  return air;
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

AirMotion AirGrid::still() const
{
  AirMotion motion;
  motion.wind.grid = &this->columns;
  motion.wind.levels = this->levels;
  motion.wind.radius = this->radius;
  motion.heightScale = this->heightScale;
  return motion;
}

AirGrid airGridOf(vtkStructuredGrid* grid)
{
  PointExtent whole;
  grid->GetExtent(whole.data());
  return airGridOf(grid, ColumnShare(whole[1] - whole[0] + 1, whole[3] - whole[2] + 1), whole);
}

AirGrid airGridOf(
  vtkStructuredGrid* grid, vtkMultiProcessController* controller, const PointExtent& whole)
{
  return airGridOf(grid, ColumnShare(controller, whole), whole);
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
double strongestWind(const AirSnapshot& snapshot)
{
  double speed = 0;
  for (const WindMeasure& row : snapshot.rows)
  {
    speed = std::max(speed, row.speed);
  }
  return speed;
}

/// m. Stages of a step may lie off the sphere, where the wind is stronger by some percent (Trajectory.cxx).
double wayOfAir(const AirSnapshot& begin, const AirSnapshot& end)
{
  constexpr double OffTheSphere = 1.05;
  return OffTheSphere * std::max(strongestWind(begin), strongestWind(end)) *
    std::abs(end.time - begin.time);
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
  , About(air.share, air.columns, air.radius, reach * wayOfAir(begin, end))
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
