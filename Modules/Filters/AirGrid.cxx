// SPDX-License-Identifier: BSD-3-Clause
#include "AirGrid.h"

#include "CloudArrays.h"
#include "WholeData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
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

}

BlockOfGrid::BlockOfGrid(vtkStructuredGrid* grid, const PointExtent& whole)
{
  int extent[6];
  grid->GetExtent(extent);
  for (int axis = 0; axis < 3; ++axis)
  {
    this->First[axis] = extent[2 * axis] - whole[2 * axis];
    this->Count[axis] = extent[2 * axis + 1] - extent[2 * axis] + 1;
  }
}

bool BlockOfGrid::has(const ColumnRectangle& block, int levels) const
{
  return this->First[0] <= block.firstColumn && this->First[1] <= block.firstRow &&
    block.firstColumn + block.columns <= this->First[0] + this->Count[0] &&
    block.firstRow + block.rows <= this->First[1] + this->Count[1] && this->First[2] == 0 &&
    this->Count[2] == levels;
}

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

}
