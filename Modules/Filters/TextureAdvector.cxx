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

/// Textures of odd number are read so far away from those of even number, that their patterns have nothing in common.
Vector3 displacementOf(const AirGrid& air)
{
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
      // At one and a half periods, where a texture has faded to half its weight, its share has been stretched twofold.
      constexpr double Share = 0.95;
      const double strain =
        strainOfShare(this->Air, airSnapshotOf(this->Air, grid, this->Times[0]), Share);
      this->Period =
        std::min(std::max(std::log(2.0) / (1.5 * strain), ShortestPeriod), LongestPeriod);
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

/// What the textures have before them in the interval that begins with a step; those that are not there yet and do not begin in it
/// have nothing.
std::vector<TextureAdvector::Leg> TextureAdvector::legs(int step) const
{
  std::vector<Leg> legs;
  const double begin = this->Times[step];
  const bool last = step + 1 == static_cast<int>(this->Times.size());
  const double length = last ? 1 : this->Times[step + 1] - begin;
  for (const long texture : this->Textures)
  {
    const auto state = this->States.find({ texture, step });
    if (state != this->States.end())
    {
      legs.push_back({ texture, 0, &state->second, {} });
    }
    else if (this->stepBefore(this->start(texture)) == step)
    {
      legs.push_back({ texture, (this->start(texture) - begin) / length, nullptr, {} });
    }
  }
  return legs;
}

/// A snapshot completes the interval that ends with it: carry the textures on to there.
void TextureAdvector::cross(int step)
{
  const auto begin = this->Snapshots.find(step - 1);
  if (begin == this->Snapshots.end() || this->Times[step] > this->Target)
  {
    return;
  }
  std::vector<Leg> legs = this->legs(step - 1);
  legs.erase(std::remove_if(legs.begin(), legs.end(),
               [this, step](const Leg& leg) {
                 return this->States.count({ leg.texture, step }) > 0;
               }),
    legs.end());
  if (!legs.empty())
  {
    const AirInterval interval(this->Air, begin->second, this->Snapshots[step]);
    this->advance(interval, legs, 1, true);
    for (Leg& leg : legs)
    {
      this->States[{ leg.texture, step }] = std::move(leg.result);
    }
  }
  if (step - 1 < this->stepBefore(this->Target))
  {
    this->Snapshots.erase(step - 1);
  }
}

/// Textures that set off together have the same trajectories.
void TextureAdvector::advance(
  const AirInterval& interval, std::vector<Leg>& legs, double to, bool asDisplacement)
{
  const RowSchemes schemes = interval.schemes(
    this->Setting.integrator, this->Setting.interpolation, this->Setting.tolerance);
  this->Substeps = schemes.mostSubsteps();
  for (Leg& leg : legs)
  {
    leg.result.resize(3 * this->Air.points());
  }
  const AirMotion& motion = interval.motion();
  const int nx = this->Air.columns.columns();
  const int ny = this->Air.columns.rows();
  const auto advanceRow = [&motion, &schemes, &legs, nx, to, asDisplacement](int j, int k)
  {
    const TrajectoryScheme scheme = schemes.at(j, k);
    Departure departure;
    for (int i = 0; i < nx; ++i)
    {
      const Vector3 home = asDisplacement ? placeOfPoint(motion, i, j, k, to) : Vector3{ 0, 0, 0 };
      const std::size_t point = i + static_cast<std::size_t>(nx) * j + motion.columns() * k;
      for (std::size_t n = 0; n < legs.size(); ++n)
      {
        if (n == 0 || legs[n].from != legs[n - 1].from)
        {
          depart(motion, scheme, i, j, k, legs[n].from, to, departure);
        }
        const float* const known = legs[n].state ? legs[n].state->data() : nullptr;
        store(carriedCoordinates(departure, known) - home, legs[n].result.data() + 3 * point);
      }
    }
  };
  vtkSMPTools::For(0, static_cast<vtkIdType>(ny) * this->Air.levels,
    [&advanceRow, ny](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType row = begin; row < end; ++row)
      {
        advanceRow(static_cast<int>(row % ny), static_cast<int>(row / ny));
      }
    });
}

/// On a file time there is no way to go: coordinates are the places and the displacements there.
void TextureAdvector::stand(const AirSnapshot& now, std::vector<Leg>& legs) const
{
  AirMotion motion;
  motion.wind.grid = &this->Air.columns;
  motion.wind.radius = this->Air.radius;
  motion.height[0] = motion.height[1] = now.height.data();
  motion.heightScale = this->Air.heightScale;
  const int nx = this->Air.columns.columns();
  const int ny = this->Air.columns.rows();
  for (Leg& leg : legs)
  {
    leg.result = leg.state ? *leg.state : Displacement(3 * this->Air.points(), 0.0F);
    float* const out = leg.result.data();
    vtkSMPTools::For(0, static_cast<vtkIdType>(ny) * this->Air.levels,
      [&motion, out, nx, ny](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType row = begin; row < end; ++row)
        {
          for (int i = 0; i < nx; ++i)
          {
            float* const moved = out + 3 * (i + nx * row);
            store(Vector3{ moved[0], moved[1], moved[2] } +
                placeOfPoint(motion, i, static_cast<int>(row % ny), static_cast<int>(row / ny), 0),
              moved);
          }
        }
      });
  }
}

/// The coordinates at the target, with even numbers first, so that an array keeps its texture until that has faded.
void TextureAdvector::locateTextures(Result& result)
{
  const int before = this->stepBefore(this->Target);
  const AirSnapshot& begin = this->Snapshots.at(before);
  const AirSnapshot& end = this->Snapshots.at(this->Last);
  std::vector<Leg> legs = this->legs(before);
  if (this->Last == before)
  {
    this->stand(begin, legs);
  }
  else
  {
    this->advance(AirInterval(this->Air, begin, end), legs,
      (this->Target - begin.time) / (end.time - begin.time), false);
  }
  for (Leg& leg : legs)
  {
    const int place = this->Textures.size() == 2 && leg.texture % 2 != 0 ? 1 : 0;
    result.weight[place] = this->weightOf(leg.texture);
    result.coordinates[place] = std::move(leg.result);
  }
}

void TextureAdvector::displaceOther(Result& result) const
{
  std::vector<float>& other = result.coordinates[1];
  const Vector3 away = displacementOf(this->Air);
  vtkSMPTools::For(0, static_cast<vtkIdType>(other.size() / 3),
    [&other, away](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType v = 3 * begin; v < 3 * end; ++v)
      {
        other[v] += static_cast<float>(away[static_cast<int>(v % 3)]);
      }
    });
}

/// Of the heavier texture.
void TextureAdvector::measureStretch(Result& result) const
{
  const AirSnapshot& now = this->Snapshots.at(this->stepBefore(this->Target));
  AirMotion motion;
  motion.wind.grid = &this->Air.columns;
  motion.wind.levels = this->Air.levels;
  motion.wind.radius = this->Air.radius;
  motion.height[0] = motion.height[1] = now.height.data();
  motion.heightScale = this->Air.heightScale;
  const int nx = this->Air.columns.columns();
  const int ny = this->Air.columns.rows();
  result.stretch.resize(this->Air.points());
  const float* const c = result.coordinates[result.weight[1] > result.weight[0] ? 1 : 0].data();
  float* const out = result.stretch.data();
  vtkSMPTools::For(0, static_cast<vtkIdType>(ny) * this->Air.levels,
    [&motion, c, out, nx, ny](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType row = begin; row < end; ++row)
      {
        for (int i = 0; i < nx; ++i)
        {
          out[i + nx * row] = static_cast<float>(
            stretchAt(motion, c, i, static_cast<int>(row % ny), static_cast<int>(row / ny))
              .largest);
        }
      }
    });
}

TextureAdvector::Result TextureAdvector::finish(vtkStructuredGrid* grid)
{
  Result result;
  if (this->Times.empty())
  {
    const AirSnapshot now = airSnapshotOf(this->Air, grid, 0);
    std::vector<Leg> still{ { 0, 0, nullptr, {} } };
    this->stand(now, still);
    result.coordinates[0] = std::move(still[0].result);
    result.stretch.assign(this->Air.points(), 1.0F);
    return result;
  }
  this->locateTextures(result);
  this->measureStretch(result);
  this->displaceOther(result);
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
