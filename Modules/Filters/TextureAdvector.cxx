// SPDX-License-Identifier: BSD-3-Clause
#include "TextureAdvector.h"

#include "vtkSMPTools.h"
#include "vtkStructuredGrid.h"

#include <algorithm>
#include <atomic>
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

void TextureAdvector::divide(vtkMultiProcessController* controller, const PointExtent& whole)
{
  this->Controller = controller;
  this->Whole = whole;
}

double TextureAdvector::progress() const
{
  return static_cast<double>(this->Next - this->First) / (this->Last - this->First + 2);
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
  this->Air = this->Controller ? airGridOf(grid, this->Controller, this->Whole) : airGridOf(grid);
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
  this->Known = true;
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
  this->First = this->Next;
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
    this->advance(begin->second, this->Snapshots[step], legs, 1, true);
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

void TextureAdvector::advance(const AirSnapshot& begin, const AirSnapshot& end,
  std::vector<Leg>& legs, double to, bool asDisplacement)
{
  bool known = false;
  for (double reach = 1; !known; reach *= 2)
  {
    const AirInterval interval(this->Air, begin, end, reach);
    known = this->advanceWithin(interval, legs, to, asDisplacement);
    this->FarthestReach = std::max(this->FarthestReach, reach);
  }
}

/// Textures that set off together have the same trajectories. Returns false if air came from beyond the columns that a process has.
bool TextureAdvector::advanceWithin(
  const AirInterval& interval, std::vector<Leg>& legs, double to, bool asDisplacement)
{
  const RowSchemes schemes = interval.schemes(
    this->Setting.integrator, this->Setting.interpolation, this->Setting.tolerance);
  this->Substeps = schemes.mostSubsteps();
  std::vector<NearbyValues> states;
  for (Leg& leg : legs)
  {
    leg.result.resize(3 * this->Air.points());
    states.push_back(
      leg.state ? interval.about().gather(*leg.state, this->Air.levels, 3) : NearbyValues());
  }
  const AirMotion& motion = interval.motion();
  const auto advancePoint = [&](vtkIdType p, Departure& departure)
  {
    const auto [i, j, k] = this->Air.point(static_cast<std::size_t>(p));
    const TrajectoryScheme scheme = schemes.at(j, k);
    const Vector3 home = asDisplacement ? placeOfPoint(motion, i, j, k, to) : Vector3{ 0, 0, 0 };
    bool known = true;
    for (std::size_t n = 0; n < legs.size(); ++n)
    {
      if (n == 0 || legs[n].from != legs[n - 1].from)
      {
        depart(motion, scheme, i, j, k, legs[n].from, to, departure);
        known = known && departure.known;
      }
      const float* const state = legs[n].state ? states[n].data() : nullptr;
      store(carriedCoordinates(departure, state) - home, legs[n].result.data() + 3 * p);
    }
    return known;
  };
  std::atomic<bool> known{ true };
  vtkSMPTools::For(0, static_cast<vtkIdType>(this->Air.points()),
    [&advancePoint, &known](vtkIdType begin, vtkIdType end)
    {
      Departure departure;
      for (vtkIdType p = begin; p < end; ++p)
      {
        if (!advancePoint(p, departure))
        {
          known = false;
        }
      }
    });
  return this->Air.share.everywhere(known);
}

/// On a file time there is no way to go: coordinates are the places and the displacements there.
void TextureAdvector::stand(const AirSnapshot& now, std::vector<Leg>& legs) const
{
  const AirMotion still = this->Air.still();
  for (Leg& leg : legs)
  {
    leg.result = leg.state ? *leg.state : Displacement(3 * this->Air.points(), 0.0F);
    float* const out = leg.result.data();
    vtkSMPTools::For(0, static_cast<vtkIdType>(this->Air.points()),
      [this, &still, &now, out](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType p = begin; p < end; ++p)
        {
          const AirGrid::Point point = this->Air.point(static_cast<std::size_t>(p));
          float* const moved = out + 3 * p;
          store(Vector3{ moved[0], moved[1], moved[2] } +
              placeOf(still, this->Air.columns.position(point.i, point.j), now.height[p]),
            moved);
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
    this->advance(begin, end, legs, (this->Target - begin.time) / (end.time - begin.time), false);
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
  const Neighborhood beside(this->Air.share, this->Air.columns, this->Air.radius, 0);
  const AirSnapshot& now = this->Snapshots.at(this->stepBefore(this->Target));
  const NearbyValues height = beside.gather(now.height, this->Air.levels, 1);
  const NearbyValues coordinates = beside.gather(
    result.coordinates[result.weight[1] > result.weight[0] ? 1 : 0], this->Air.levels, 3);
  AirMotion motion = this->Air.still();
  motion.wind.held = beside.held();
  motion.height[0] = motion.height[1] = height.data();
  result.stretch.resize(this->Air.points());
  vtkSMPTools::For(0, static_cast<vtkIdType>(this->Air.points()),
    [this, &motion, &coordinates, &result](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType p = begin; p < end; ++p)
      {
        const AirGrid::Point point = this->Air.point(static_cast<std::size_t>(p));
        result.stretch[p] = static_cast<float>(
          stretchAt(motion, coordinates.data(), point.i, point.j, point.k).largest);
      }
    });
  const auto half = static_cast<long long>(this->Air.allPoints() / 2);
  result.medianStretch = this->Air.share.ranked(result.stretch, half);
  result.maximumStretch = this->Air.share.largest(result.stretch, 0);
}

/// From the own points to all of a process's grid, which has columns of others on its borders and as ghosts.
void TextureAdvector::spread(vtkStructuredGrid* grid, Result& result) const
{
  if (!this->Air.share.isDivided())
  {
    return;
  }
  std::vector<int> columns;
  if (grid->GetNumberOfPoints() > 0)
  {
    int extent[6];
    grid->GetExtent(extent);
    for (int j = extent[2]; j <= extent[3]; ++j)
    {
      for (int i = extent[0]; i <= extent[1]; ++i)
      {
        columns.push_back(
          ringColumn(this->Whole, i, 0) + this->Air.share.columns() * (j - this->Whole[2]));
      }
    }
  }
  const ColumnRequest request(this->Air.share, columns);
  for (std::size_t n = 0; n < this->Textures.size(); ++n)
  {
    result.coordinates[n] = request.fetch(result.coordinates[n], this->Air.levels, 3);
  }
  result.stretch = request.fetch(result.stretch, this->Air.levels, 1);
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
    this->spread(grid, result);
    return result;
  }
  this->locateTextures(result);
  this->measureStretch(result);
  this->displaceOther(result);
  this->spread(grid, result);
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
