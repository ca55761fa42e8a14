// SPDX-License-Identifier: BSD-3-Clause
#include "TextureAdvector.h"

#include "vtkSMPTools.h"
#include "vtkStructuredGrid.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
constexpr double ShortestPeriod = 3600;
constexpr double LongestPeriod = 10 * 86400;

/// Textures of odd number are read far away from those of even number, so that their patterns have nothing in common.
Vector3 displacementOf(long texture, const AirGrid& air)
{
  if (texture % 2 == 0)
  {
    return { 0, 0, 0 };
  }
  const ColumnGrid& grid = air.columns;
  const double size = air.sphere
    ? 2 * air.radius
    : length(grid.position(grid.columns() - 1, grid.rows() - 1) - grid.position(0, 0));
  return size * Vector3{ 1.37, -1.91, 2.23 };
}

void store(const Vector3& v, float* out)
{
  for (int c = 0; c < 3; ++c)
  {
    out[c] = static_cast<float>(v[c]);
  }
}
}

TextureAdvector::TextureAdvector(const Settings& settings, std::vector<double> times)
  : Setting(settings)
  , Times(std::move(times))
{
  for (std::size_t n = 1; n < this->Times.size(); ++n)
  {
    if (!(this->Times[n] > this->Times[n - 1]))
    {
      throw GridError("time step " + std::to_string(n) +
        " is not later than the one before: trajectories need times that rise.");
    }
  }
}

int TextureAdvector::stepBefore(double time) const
{
  const auto after = std::upper_bound(this->Times.begin(), this->Times.end(), time);
  return std::max(static_cast<int>(after - this->Times.begin()) - 1, 0);
}

double TextureAdvector::start(long texture) const
{
  return this->Times.front() + std::max(texture, 0L) * this->Period;
}

double TextureAdvector::weightOf(long texture) const
{
  if (this->Period == 0)
  {
    return 1;
  }
  const double age =
    (this->Target - this->Times.front()) / this->Period - static_cast<double>(texture);
  return std::max(1 - std::abs(age - 1), 0.0);
}

int TextureAdvector::firstStep(long texture) const
{
  for (int step = this->stepBefore(this->Target); step > this->stepBefore(this->start(texture));
       --step)
  {
    if (this->States.count({ texture, step }) > 0)
    {
      return step;
    }
  }
  return this->stepBefore(this->start(texture));
}

void TextureAdvector::begin(double target)
{
  this->Target = target;
  if (this->Known)
  {
    this->plan();
    return;
  }
  this->Next = 0;
  this->Last = 0;
}

void TextureAdvector::learn(vtkStructuredGrid* grid)
{
  this->Air = airGridOf(grid);
  this->Known = true;
  if (this->Setting.crossFade && !this->Times.empty())
  {
    this->Period = this->Setting.restartPeriod;
    if (this->Period == 0)
    {
      const double strain =
        rootMeanSquareStrain(this->Air, airSnapshotOf(this->Air, grid, this->Times[0]));
      this->Period = std::min(std::max(std::log(2.0) / strain, ShortestPeriod), LongestPeriod);
    }
  }
}

void TextureAdvector::plan()
{
  this->Textures = { 0 };
  if (this->Times.empty())
  {
    this->Next = 1;
    this->Last = 0;
    return;
  }
  if (this->Period > 0)
  {
    const auto newest =
      static_cast<long>(std::floor((this->Target - this->Times.front()) / this->Period));
    this->Textures = { newest - 1, newest };
  }
  const int before = this->stepBefore(this->Target);
  this->Last = this->Times[before] < this->Target ? before + 1 : before;
  this->Next = before;
  for (const long texture : this->Textures)
  {
    this->Next = std::min(this->Next, this->firstStep(texture));
  }
  this->skipKnown();
}

void TextureAdvector::skipKnown()
{
  while (this->Next <= this->Last && this->Snapshots.count(this->Next) > 0)
  {
    this->cross(this->Next++);
  }
}

void TextureAdvector::take(vtkStructuredGrid* grid)
{
  if (!this->Known)
  {
    this->learn(grid);
    if (!this->Times.empty())
    {
      this->Snapshots[0] = airSnapshotOf(this->Air, grid, this->Times[0]);
    }
    this->plan();
    return;
  }
  this->Snapshots[this->Next] = airSnapshotOf(this->Air, grid, this->Times[this->Next]);
  this->skipKnown();
}

/// A snapshot completes the interval that ends with it: carry the textures on to there.
void TextureAdvector::cross(int step)
{
  const auto begin = this->Snapshots.find(step - 1);
  if (begin == this->Snapshots.end() || this->Times[step] > this->Target)
  {
    return;
  }
  const AirSnapshot& end = this->Snapshots[step];
  const AirInterval interval(this->Air, begin->second, end);
  const TrajectoryScheme scheme =
    interval.scheme(this->Setting.integrator, this->Setting.interpolation, this->Setting.tolerance);
  this->Substeps = scheme.substeps;
  for (const long texture : this->Textures)
  {
    const auto state = this->States.find({ texture, step - 1 });
    const bool has = state != this->States.end();
    const double since =
      (this->start(texture) - begin->second.time) / (end.time - begin->second.time);
    if (this->States.count({ texture, step }) > 0 || (!has && (since < 0 || since >= 1)))
    {
      continue; // is there already, or does not begin here
    }
    this->States[{ texture, step }] =
      this->advance(interval, scheme, has ? &state->second : nullptr, has ? 0 : since, 1, true);
  }
  if (step - 1 < this->stepBefore(this->Target))
  {
    this->Snapshots.erase(step - 1);
  }
}

TextureAdvector::Displacement TextureAdvector::advance(const AirInterval& interval,
  const TrajectoryScheme& scheme, const Displacement* state, double from, double to,
  bool asDisplacement) const
{
  const AirMotion& motion = interval.motion();
  const int nx = this->Air.columns.columns();
  const int ny = this->Air.columns.rows();
  Displacement result(3 * this->Air.points());
  const float* const known = state ? state->data() : nullptr;
  float* const out = result.data();
  vtkSMPTools::For(0, static_cast<vtkIdType>(this->Air.points()),
    [&motion, &scheme, known, out, nx, ny, from, to, asDisplacement](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType p = begin; p < end; ++p)
      {
        const int i = static_cast<int>(p % nx);
        const int j = static_cast<int>(p / nx % ny);
        const int k = static_cast<int>(p / nx / ny);
        const Vector3 c = carriedCoordinates(motion, scheme, known, i, j, k, from, to);
        store(asDisplacement ? c - placeOfPoint(motion, i, j, k, to) : c, out + 3 * p);
      }
    });
  return result;
}

std::vector<float> TextureAdvector::coordinatesOf(long texture) const
{
  const int before = this->stepBefore(this->Target);
  const AirSnapshot& begin = this->Snapshots.at(before);
  const AirSnapshot& end = this->Snapshots.at(this->Last);
  const AirInterval interval(this->Air, begin, end);
  const auto found = this->States.find({ texture, before });
  const Displacement* const state = found != this->States.end() ? &found->second : nullptr;
  if (this->Last == before)
  {
    // On a file time: no way to go. One that starts just here has its places.
    return this->advance(
      interval, { this->Setting.integrator, this->Setting.interpolation, 1 }, state, 0, 0, false);
  }
  const double length = end.time - begin.time;
  const double from = state ? 0 : (this->start(texture) - begin.time) / length;
  const TrajectoryScheme scheme =
    interval.scheme(this->Setting.integrator, this->Setting.interpolation, this->Setting.tolerance);
  return this->advance(interval, scheme, state, from, (this->Target - begin.time) / length, false);
}

TextureAdvector::Result TextureAdvector::finish(vtkStructuredGrid* grid)
{
  Result result;
  if (this->Times.empty())
  {
    const AirSnapshot now = airSnapshotOf(this->Air, grid, 0);
    const AirInterval still(this->Air, now, now);
    result.coordinates[0] = this->advance(still, {}, nullptr, 0, 0, false);
    result.stretch.assign(this->Air.points(), 1.0F);
    return result;
  }
  for (std::size_t n = 0; n < this->Textures.size(); ++n)
  {
    // Even numbers first, so that an array keeps its texture until that has faded.
    const long texture = this->Textures[n];
    const int place = this->Textures.size() == 2 && texture % 2 != 0 ? 1 : 0;
    result.weight[place] = this->weightOf(texture);
    result.coordinates[place] = this->coordinatesOf(texture);
  }
  const int heavier = result.weight[1] > result.weight[0] ? 1 : 0;
  const AirSnapshot& now = this->Snapshots.at(this->stepBefore(this->Target));
  const AirInterval still(this->Air, now, now);
  const int nx = this->Air.columns.columns();
  const int ny = this->Air.columns.rows();
  result.stretch.resize(this->Air.points());
  const float* const c = result.coordinates[heavier].data();
  float* const out = result.stretch.data();
  const AirMotion& motion = still.motion();
  vtkSMPTools::For(0, static_cast<vtkIdType>(this->Air.points()),
    [&motion, c, out, nx, ny](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType p = begin; p < end; ++p)
      {
        out[p] = static_cast<float>(stretchAt(motion, c, static_cast<int>(p % nx),
          static_cast<int>(p / nx % ny), static_cast<int>(p / nx / ny))
                                      .largest);
      }
    });
  for (std::size_t n = 0; n < this->Textures.size(); ++n)
  {
    const Vector3 away = displacementOf(this->Textures[n], this->Air);
    std::vector<float>& all = result.coordinates[this->Textures[n] % 2 != 0 ? 1 : 0];
    for (std::size_t v = 0; v < all.size(); ++v)
    {
      all[v] += static_cast<float>(away[static_cast<int>(v % 3)]);
    }
  }
  this->forget();
  return result;
}

/// What another time near by can use stays: the states at the last file time and the snapshots about the target.
void TextureAdvector::forget()
{
  const int before = this->stepBefore(this->Target);
  for (auto state = this->States.begin(); state != this->States.end();)
  {
    const bool used = state->first.second >= before &&
      std::count(this->Textures.begin(), this->Textures.end(), state->first.first) > 0;
    state = used ? std::next(state) : this->States.erase(state);
  }
  for (auto snapshot = this->Snapshots.begin(); snapshot != this->Snapshots.end();)
  {
    const bool used = snapshot->first >= before && snapshot->first <= before + 1;
    snapshot = used ? std::next(snapshot) : this->Snapshots.erase(snapshot);
  }
}
}
