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
/// The part of one dimension that the taps need.
struct Span
{
  std::size_t start = 0;
  std::size_t count = 1;
  std::size_t stride = 0; ///< in the values read
};
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

template <class T>
std::vector<T> FieldReader::read(
  const RoleVariable& role, const Region& region, const std::vector<std::size_t>& levels) const
{
  const FileVariable& variable = *role.variable;
  const GridAxes& grid = this->File.Grid;
  const std::size_t rank = variable.dimensions.size();
  std::vector<std::size_t> start(rank, 0);
  std::vector<std::size_t> count(rank, 1);
  // 0 x, 1 y, 2 z
  Taps taps[3] = { Taps(region.columns.size(), Tap{ 0, 0, 0 }),
    Taps(region.rows.size(), Tap{ 0, 0, 0 }), Taps(levels.size(), Tap{ 0, 0, 0 }) };
  std::size_t place[3] = { rank, rank, rank };
  for (std::size_t axis = 0; axis < rank; ++axis)
  {
    const int d = variable.dimensions[axis];
    const std::size_t size = this->File.File.sizeOf(variable, axis);
    const Axis kind = this->File.Axes.of(d);
    const auto lay =
      [&](int which, int own, std::size_t places, bool flip, const std::vector<std::size_t>& wanted)
    {
      taps[which] = this->tapsAlong(d, own, places, flip, wanted, which < 2);
      place[which] = axis;
    };
    if (d == grid.time || kind == Axis::Time)
    {
      start[axis] = std::min(region.time, size - 1);
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
  for (int which = 0; which < 3; ++which)
  {
    if (place[which] == rank || taps[which].empty())
    {
      continue;
    }
    std::size_t low = taps[which][0].low;
    std::size_t high = low;
    for (const Tap& tap : taps[which])
    {
      low = std::min({ low, tap.low, tap.high });
      high = std::max({ high, tap.low, tap.high });
    }
    if (high >= this->File.File.sizeOf(variable, place[which]))
    {
      throw ReadError("variable " + variable.name + ": it is shorter than the grid of " +
        this->File.master().name + "; name another one with SetVariableName");
    }
    start[place[which]] = low;
    count[place[which]] = high - low + 1;
    for (Tap& tap : taps[which])
    {
      tap.low -= low;
      tap.high -= low;
    }
  }
  const std::vector<double> raw = this->File.File.read(variable, start, count);
  std::size_t stride[3] = { 0, 0, 0 };
  std::size_t step = 1;
  for (std::size_t axis = rank; axis-- > 0;)
  {
    for (int which = 0; which < 3; ++which)
    {
      stride[which] = place[which] == axis ? step : stride[which];
    }
    step *= count[axis];
  }
  const std::size_t nx = region.columns.size();
  const std::size_t ny = region.rows.size();
  std::vector<T> values(nx * ny * levels.size());
  const UnitConversion& unit = role.conversion;
  vtkSMPTools::For(0, static_cast<vtkIdType>(ny * levels.size()),
    [&values, &taps, &stride, &raw, unit, nx, ny](vtkIdType first, vtkIdType last)
    {
      for (vtkIdType line = first; line < last; ++line)
      {
        const Tap& ty = taps[1][static_cast<std::size_t>(line) % ny];
        const Tap& tz = taps[2][static_cast<std::size_t>(line) / ny];
        T* out = values.data() + static_cast<std::size_t>(line) * nx;
        for (std::size_t i = 0; i < nx; ++i)
        {
          const Tap& tx = taps[0][i];
          const auto alongX = [&](std::size_t base)
          {
            const double a = raw[base + tx.low * stride[0]];
            return tx.weight == 0 ? a : a + tx.weight * (raw[base + tx.high * stride[0]] - a);
          };
          const auto alongY = [&](std::size_t base)
          {
            const double a = alongX(base + ty.low * stride[1]);
            return ty.weight == 0 ? a : a + ty.weight * (alongX(base + ty.high * stride[1]) - a);
          };
          const double a = alongY(tz.low * stride[2]);
          const double value =
            tz.weight == 0 ? a : a + tz.weight * (alongY(tz.high * stride[2]) - a);
          out[i] = static_cast<T>(unit.scale * value + unit.offset);
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
