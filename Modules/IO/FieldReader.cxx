// SPDX-License-Identifier: BSD-3-Clause
#include "FieldReader.h"

#include "ReadError.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nephoscope
{
namespace
{
/// The tap's weighted mean of what `value` gives `stride` a place apart, from `base` on.
template <class Tap, class Value>
double mean(const Tap& tap, std::size_t stride, std::size_t base, const Value& value)
{
  const double a = value(base + tap.low * stride);
  return tap.weight == 0 ? a : a + tap.weight * (value(base + tap.high * stride) - a);
}
}

bool FieldReader::tapByCoordinate(int dimension, int own, bool periodic, Taps& taps) const
{
  const FileVariable* from = coordinateVariable(this->File.File, dimension);
  const FileVariable* to = own < 0 ? nullptr : coordinateVariable(this->File.File, own);
  if (!from || !to || from->text("units") != to->text("units"))
  {
    return false;
  }
  const std::vector<double> source = this->File.File.readAll(*from);
  const std::vector<double> target = this->File.File.readAll(*to);
  const std::size_t n = source.size();
  if (n < 2)
  {
    return false;
  }
  const double sign = source[1] > source[0] ? 1 : -1;
  for (std::size_t i = 0; i < n; ++i)
  {
    if (!std::isfinite(source[i]) || (i > 0 && !(sign * (source[i] - source[i - 1]) > 0)))
    {
      return false;
    }
  }
  for (Tap& tap : taps)
  {
    const double x = target[tap.low];
    const auto after = std::upper_bound(
      source.begin(), source.end(), x, [sign](double a, double b) { return sign * a < sign * b; });
    const std::size_t high = static_cast<std::size_t>(after - source.begin());
    if (high > 0 && high < n)
    {
      tap = { high - 1, high, (x - source[high - 1]) / (source[high] - source[high - 1]) };
    }
    else if (periodic) // between the last place and the first, a turn on
    {
      const double gap = 360 - sign * (source[n - 1] - source[0]);
      const double past = high == 0 ? gap - sign * (source[0] - x) : sign * (x - source[n - 1]);
      tap = { n - 1, 0, gap > 0 ? std::clamp(past / gap, 0.0, 1.0) : 0.0 };
    }
    else
    {
      tap = { high == 0 ? 0 : n - 1, high == 0 ? 0 : n - 1, 0 };
    }
  }
  return true;
}

FieldReader::Taps FieldReader::tapsAlong(int dimension, int own, std::size_t places, bool flip,
  const std::vector<std::size_t>& wanted, bool horizontal) const
{
  const std::size_t n = this->File.File.dimensions()[static_cast<std::size_t>(dimension)].size;
  Taps taps;
  taps.reserve(wanted.size());
  for (std::size_t index : wanted)
  {
    const std::size_t place = flip ? places - 1 - index : index;
    taps.push_back({ place, place, 0 });
  }
  const bool round = horizontal && this->File.Grid.periodic && own == this->File.Grid.x;
  if (dimension == own || (horizontal && this->tapByCoordinate(dimension, own, round, taps)))
  {
    return taps;
  }
  for (Tap& tap : taps)
  {
    if (n == places + 1)
    {
      tap = { tap.low, tap.low + 1, 0.5 };
    }
    else if (n + 1 == places)
    {
      tap = { tap.low > 0 ? tap.low - 1 : 0, std::min(tap.low, n - 1), 0.5 };
    }
  }
  return taps;
}

FieldReader::Block FieldReader::blockOf(
  const FileVariable& variable, const Region& region, const std::vector<std::size_t>& levels) const
{
  const GridAxes& grid = this->File.Grid;
  const std::size_t rank = variable.dimensions.size();
  Block block{ std::vector<std::size_t>(rank, 0), std::vector<std::size_t>(rank, 1),
    { { rank, 0, Taps(region.columns.size(), Tap{ 0, 0, 0 }) },
      { rank, 0, Taps(region.rows.size(), Tap{ 0, 0, 0 }) },
      { rank, 0, Taps(levels.size(), Tap{ 0, 0, 0 }) } } };
  for (std::size_t axis = 0; axis < rank; ++axis)
  {
    const int d = variable.dimensions[axis];
    const Axis kind = this->File.Axes.of(d);
    const auto lay = [&](int which, int own, std::size_t places, bool flip,
                       const std::vector<std::size_t>& wanted) {
      block.lines[which] = { axis, 0, this->tapsAlong(d, own, places, flip, wanted, which < 2) };
    };
    if (d == grid.time || kind == Axis::Time)
    {
      block.start[axis] = std::min(region.time, this->File.File.sizeOf(variable, axis) - 1);
    }
    else if (d == grid.z || kind == Axis::Vertical)
    {
      lay(2, grid.z, grid.nz, grid.flipZ, levels);
    }
    else if (d == grid.y || (kind == Axis::Y && grid.y >= 0))
    {
      lay(1, grid.y, grid.ny, grid.flipY, region.rows);
    }
    else if (d == grid.x || (kind == Axis::X && grid.x >= 0))
    {
      lay(0, grid.x, grid.nx, grid.flipX, region.columns);
    }
  }
  return block;
}

void FieldReader::fit(const FileVariable& variable, Block& block) const
{
  const std::size_t rank = variable.dimensions.size();
  for (Line& line : block.lines)
  {
    if (line.axis == rank || line.taps.empty())
    {
      continue;
    }
    std::size_t low = line.taps[0].low;
    std::size_t high = low;
    for (const Tap& tap : line.taps)
    {
      low = std::min({ low, tap.low, tap.high });
      high = std::max({ high, tap.low, tap.high });
    }
    if (high >= this->File.File.sizeOf(variable, line.axis))
    {
      throw ReadError("variable " + variable.name + ": it is shorter than the grid of " +
        this->File.master().name + "; name another one with SetVariableName");
    }
    block.start[line.axis] = low;
    block.count[line.axis] = high - low + 1;
    for (Tap& tap : line.taps)
    {
      tap.low -= low;
      tap.high -= low;
    }
  }
  std::size_t step = 1;
  for (std::size_t axis = rank; axis-- > 0; step *= block.count[axis])
  {
    for (Line& line : block.lines)
    {
      line.stride = line.axis == axis ? step : line.stride;
    }
  }
}

template <class T>
std::vector<T> FieldReader::read(
  const RoleVariable& role, const Region& region, const std::vector<std::size_t>& levels) const
{
  Block block = this->blockOf(*role.variable, region, levels);
  this->fit(*role.variable, block);
  const std::vector<double> raw = this->File.File.read(*role.variable, block.start, block.count);
  const std::size_t nx = region.columns.size();
  const std::size_t ny = region.rows.size();
  std::vector<T> values(nx * ny * levels.size());
  const UnitConversion& unit = role.conversion;
  const Line& x = block.lines[0];
  const Line& y = block.lines[1];
  const Line& z = block.lines[2];
  vtkSMPTools::For(0, static_cast<vtkIdType>(ny * levels.size()),
    [&](vtkIdType first, vtkIdType last)
    {
      for (vtkIdType line = first; line < last; ++line)
      {
        const Tap& ty = y.taps[static_cast<std::size_t>(line) % ny];
        const Tap& tz = z.taps[static_cast<std::size_t>(line) / ny];
        T* out = values.data() + static_cast<std::size_t>(line) * nx;
        for (std::size_t i = 0; i < nx; ++i)
        {
          const auto alongX = [&](std::size_t base)
          { return mean(x.taps[i], x.stride, base, [&](std::size_t at) { return raw[at]; }); };
          const auto alongY = [&](std::size_t base) { return mean(ty, y.stride, base, alongX); };
          out[i] = static_cast<T>(unit.scale * mean(tz, z.stride, 0, alongY) + unit.offset);
        }
      }
    });
  return values;
}

std::vector<float> FieldReader::field(const RoleVariable& role, const Region& region) const
{
  std::vector<std::size_t> levels(this->File.Grid.nz);
  std::iota(levels.begin(), levels.end(), std::size_t(0));
  return this->read<float>(role, region, levels);
}

std::vector<double> FieldReader::surface(const RoleVariable& role, const Region& region) const
{
  return this->read<double>(role, region, { 0 });
}
}
