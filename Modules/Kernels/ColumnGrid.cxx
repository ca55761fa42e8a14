// SPDX-License-Identifier: BSD-3-Clause
#include "ColumnGrid.h"

#include "ArcTangent.h"

#include <algorithm>
#include <limits>

namespace nephoscope
{
namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr double PoleTolerance = 1e-6; // radians; a row this near is the pole itself

/// Lagrange's weights of `count` nodes for a place.
template <class Nodes>
void setWeights(Nodes& nodes, const std::array<double, 4>& at, double place)
{
  if (nodes.count == 2)
  {
    nodes.weight[1] = (place - at[0]) / (at[1] - at[0]);
    nodes.weight[0] = 1 - nodes.weight[1];
    return;
  }
  for (int a = 0; a < nodes.count; ++a)
  {
    double weight = 1;
    for (int b = 0; b < nodes.count; ++b)
    {
      weight *= b == a ? 1 : (place - at[b]) / (at[a] - at[b]);
    }
    nodes.weight[a] = weight;
  }
}

std::vector<std::array<double, 2>> directionsOf(const std::vector<double>& angles)
{
  std::vector<std::array<double, 2>> directions;
  for (const double angle : angles)
  {
    directions.push_back({ std::cos(angle), std::sin(angle) });
  }
  return directions;
}
}

void ColumnGrid::Axis::set(std::vector<double> values)
{
  this->Values = std::move(values);
  const int n = static_cast<int>(this->Values.size());
  this->Descending = n > 1 && this->Values.back() < this->Values.front();
  this->Rising = this->Values;
  if (this->Descending)
  {
    std::reverse(this->Rising.begin(), this->Rising.end());
  }
  this->Guess.clear();
  if (n < 2)
  {
    return;
  }
  for (int k = 0; k + 1 < n; ++k)
  {
    this->Inverse.push_back(1 / (this->rising(k + 1) - this->rising(k)));
  }
  // As many equal bins as intervals; each knows the interval of its lower end.
  this->First = this->rising(0);
  this->Scale = (n - 1) / (this->rising(n - 1) - this->First);
  this->Guess.resize(n);
  for (int bin = 0, k = 0; bin < n; ++bin)
  {
    while (k < n - 2 && this->rising(k + 1) <= this->First + bin / this->Scale)
    {
      ++k;
    }
    this->Guess[bin] = k;
  }
}

ColumnGrid ColumnGrid::sphere(std::vector<double> longitudes, std::vector<double> latitudes)
{
  ColumnGrid grid;
  grid.Sphere = true;
  grid.X.set(std::move(longitudes));
  grid.Y.set(std::move(latitudes));
  grid.ColumnDirections = directionsOf(grid.X.Values);
  grid.RowDirections = directionsOf(grid.Y.Values);

  const int nx = grid.columns();
  if (nx > 2)
  {
    const double span = grid.X.rising(nx - 1) - grid.X.rising(0);
    const double spacing = span / (nx - 1);
    const bool closed = std::abs(span - 2 * Pi) < 1e-6;
    grid.Periodic = closed || std::abs(span + spacing - 2 * Pi) < 0.5 * spacing;
    grid.Period = closed ? nx - 1 : nx;
    if (grid.Periodic && !closed)
    {
      grid.X.Inverse.push_back(1 / (2 * Pi - span));
    }
  }
  const int ny = grid.rows();
  if (grid.Periodic && ny >= 4)
  {
    const double south = grid.Y.rising(0) + Pi / 2;
    const double north = Pi / 2 - grid.Y.rising(ny - 1);
    grid.Poles = { south < 1.5 * (grid.Y.rising(1) - grid.Y.rising(0)),
      north < 1.5 * (grid.Y.rising(ny - 1) - grid.Y.rising(ny - 2)) };
    grid.PoleRows = { south < PoleTolerance, north < PoleTolerance };
  }
  return grid;
}

ColumnGrid ColumnGrid::plane(std::vector<double> x, std::vector<double> y)
{
  ColumnGrid grid;
  grid.X.set(std::move(x));
  grid.Y.set(std::move(y));
  return grid;
}

int ColumnGrid::columnInterval(double& x) const
{
  const double first = this->X.rising(0);
  if (!this->Periodic)
  {
    if (this->Sphere && (x < first || x > this->X.Rising.back()))
    {
      // Beyond the nearer edge; a region may go over the meridian at which longitudes begin again.
      x -= 2 * Pi * std::round((x - 0.5 * (first + this->X.Rising.back())) / (2 * Pi));
    }
    x = std::min(std::max(x, first), this->X.Rising.back());
    return this->X.interval(x);
  }
  if (x < first || x >= first + 2 * Pi)
  {
    x -= 2 * Pi * std::floor((x - first) / (2 * Pi));
  }
  return x >= this->X.rising(this->Period - 1) ? this->Period - 1 : this->X.interval(x);
}

ColumnGrid::Between ColumnGrid::betweenColumns(double x) const
{
  const int k = this->columnInterval(x);
  const int next = this->Periodic && k + 1 == this->Period ? 0 : k + 1;
  const int last = this->columns() - 1;
  return { this->X.Descending ? last - k : k, this->X.Descending ? last - next : next,
    (x - this->X.rising(k)) * this->X.Inverse[k] };
}

ColumnGrid::Between ColumnGrid::betweenRows(double y) const
{
  y = std::min(std::max(y, this->Y.Rising.front()), this->Y.Rising.back());
  const int k = this->Y.interval(y);
  const int last = this->rows() - 1;
  return { this->Y.Descending ? last - k : k, this->Y.Descending ? last - k - 1 : k + 1,
    (y - this->Y.rising(k)) * this->Y.Inverse[k] };
}

ColumnGrid::Nodes ColumnGrid::nodesOfLongitude(double x, Interpolation interpolation) const
{
  const int n = this->columns();
  Nodes nodes;
  if (n < 2)
  {
    return { 1, { 0 }, { 1 } };
  }
  const double whole = 2 * Pi; // added to the values of columns that lie a circle further on
  const int k = this->columnInterval(x);
  nodes.count = interpolation == Interpolation::Cubic && n >= 4 ? 4 : 2;
  int start = nodes.count == 4 ? k - 1 : k;
  if (!this->Periodic)
  {
    start = std::min(std::max(start, 0), n - nodes.count);
  }
  std::array<double, 4> at{};
  for (int a = 0; a < nodes.count; ++a)
  {
    int column = start + a;
    double turn = 0;
    if (this->Periodic && column < 0)
    {
      column += this->Period;
      turn = -whole;
    }
    else if (this->Periodic && column >= this->Period)
    {
      column -= this->Period;
      turn = whole;
    }
    at[a] = this->X.rising(column) + turn;
    nodes.index[a] = this->X.Descending ? n - 1 - column : column;
  }
  setWeights(nodes, at, x);
  return nodes;
}

double ColumnGrid::rowValue(int row) const
{
  const int n = this->rows();
  if (row < 0)
  {
    return -Pi - this->Y.rising(-row - (this->PoleRows[0] ? 0 : 1));
  }
  if (row >= n)
  {
    return Pi - this->Y.rising(2 * n - 1 - row - (this->PoleRows[1] ? 1 : 0));
  }
  return this->Y.rising(row);
}

ColumnGrid::Nodes ColumnGrid::nodesOfRow(double y, Interpolation interpolation) const
{
  const int n = this->rows();
  Nodes nodes;
  if (n < 2)
  {
    return { 1, { 0 }, { 1 } };
  }
  int k;
  if (this->isBeyondRows(y))
  {
    k = y < this->Y.rising(0) ? -1 : n - 1;
  }
  else
  {
    y = std::min(std::max(y, this->Y.rising(0)), this->Y.rising(n - 1));
    k = this->Y.interval(y);
  }
  nodes.count = interpolation == Interpolation::Cubic && n >= 4 ? 4 : 2;
  int start = nodes.count == 4 ? k - 1 : k;
  if (!this->overSouth())
  {
    start = std::max(start, 0);
  }
  if (!this->overNorth())
  {
    start = std::min(start, n - nodes.count);
  }
  std::array<double, 4> at{};
  for (int a = 0; a < nodes.count; ++a)
  {
    nodes.index[a] = start + a;
    at[a] = this->rowValue(start + a);
  }
  setWeights(nodes, at, y);
  return nodes;
}

void ColumnGrid::locate(
  const Vector3& position, Interpolation interpolation, ColumnStencil& stencil) const
{
  double x = position[0];
  double y = position[1];
  if (this->Sphere)
  {
    x = arcTangent(position[1], position[0]);
    y = arcTangent(position[2], std::sqrt(position[0] * position[0] + position[1] * position[1]));
  }
  const int nx = this->columns();
  const int ny = this->rows();
  if (interpolation == Interpolation::Linear && nx > 1 && ny > 1 && !this->isBeyondRows(y))
  {
    const Between across = this->betweenColumns(x);
    const Between along = this->betweenRows(y);
    const int row[2] = { nx * along.before, nx * along.after };
    stencil.count = 4;
    stencil.column = { row[0] + across.before, row[0] + across.after, row[1] + across.before,
      row[1] + across.after };
    stencil.weight = { (1 - along.share) * (1 - across.share), (1 - along.share) * across.share,
      along.share * (1 - across.share), along.share * across.share };
    return;
  }
  const Nodes rows = this->nodesOfRow(y, interpolation);
  const Nodes along = this->nodesOfLongitude(x, interpolation);
  Nodes opposite{};
  bool haveOpposite = false;
  stencil.count = 0;
  for (int a = 0; a < rows.count; ++a)
  {
    int row = rows.index[a];
    const Nodes* across = &along;
    if (row < 0 || row >= ny)
    {
      row = row < 0 ? -row - (this->PoleRows[0] ? 0 : 1)
                    : 2 * ny - 1 - row - (this->PoleRows[1] ? 1 : 0);
      if (!haveOpposite)
      {
        opposite = this->nodesOfLongitude(x + Pi, interpolation);
        haveOpposite = true;
      }
      across = &opposite;
    }
    const int j = this->Y.Descending ? ny - 1 - row : row;
    for (int b = 0; b < across->count; ++b, ++stencil.count)
    {
      stencil.column[stencil.count] = across->index[b] + nx * j;
      stencil.weight[stencil.count] = rows.weight[a] * across->weight[b];
    }
  }
}

double ColumnGrid::smallestSpacing() const
{
  double spacing = std::numeric_limits<double>::infinity();
  for (int j = 0; j + 1 < this->rows(); ++j)
  {
    spacing = std::min(spacing, this->Y.rising(j + 1) - this->Y.rising(j));
  }
  double narrowest = 1;
  if (this->Sphere)
  {
    constexpr double Highest = 80 * Pi / 180;
    for (const double latitude : this->Y.Values)
    {
      narrowest =
        std::abs(latitude) < Highest ? std::min(narrowest, std::cos(latitude)) : narrowest;
    }
  }
  for (int i = 0; i + 1 < this->columns(); ++i)
  {
    spacing = std::min(spacing, (this->X.rising(i + 1) - this->X.rising(i)) * narrowest);
  }
  return spacing;
}
}
