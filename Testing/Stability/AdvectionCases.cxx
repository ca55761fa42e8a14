// SPDX-License-Identifier: BSD-3-Clause
// Where carrying coordinates along the wind is known to fail. The naive way counts in longitude and latitude, interpolates what it
// carries, or steps explicitly.
#include "Stability.h"

#include "Atmosphere.h"
#include "ErrorText.h"
#include "Trajectory.h"
#include "Vector3.h"
#include "vtkCloudTextureAdvection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephoscope
{
namespace stability
{
namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr double Hour = Atmosphere::Hour;
constexpr double Radius = Atmosphere::Radius;

/// A globe that turns about an axis at a speed of its fastest places, m/s.
struct Turn
{
  Vector3 axis;
  double speed;

  Vector3 wind(const Vector3& place) const
  {
    return this->speed * cross(this->axis, normalized(place));
  }
  Vector3 before(const Vector3& place, double seconds) const
  {
    const double angle = -this->speed * seconds / Radius;
    return std::cos(angle) * place + std::sin(angle) * cross(this->axis, place) +
      (1 - std::cos(angle)) * dot(this->axis, place) * this->axis;
  }
};

vtkSmartPointer<Atmosphere> atmosphere(const Turn& turn)
{
  auto air = vtkSmartPointer<Atmosphere>::New();
  air->Size[0] = 65;
  air->Size[1] = 32;
  air->Wind = [turn](const double p[3], double, double wind[3])
  {
    const Vector3 v = turn.wind({ p[0], p[1], p[2] });
    std::copy(v.v, v.v + 3, wind);
  };
  return air;
}

vtkSmartPointer<vtkCloudTextureAdvection> advection(Atmosphere* air)
{
  auto filter = vtkSmartPointer<vtkCloudTextureAdvection>::New();
  filter->SetInputConnection(air->GetOutputPort());
  filter->CrossFadeOff();
  filter->SetIntegratorToRungeKutta4();
  filter->SetInterpolationToCubic();
  filter->SetTolerance(1000);
  return filter;
}

/// Calls f(place, coordinates) for each point at a time.
template <class F>
void forEachPoint(Atmosphere* air, double time, F&& f)
{
  const auto filter = advection(air);
  filter->UpdateTimeStep(time);
  const std::vector<double> c = pointValues(filter, arrays::TextureCoordinates);
  for (std::size_t p = 0; p < c.size() / 3; ++p)
  {
    Vector3 place{};
    filter->GetOutput()->GetPoint(static_cast<vtkIdType>(p), place.v);
    f(place, Vector3{ c[3 * p], c[3 * p + 1], c[3 * p + 2] });
  }
}

/// Largest distance, km, between what is carried and the truth; NaN counts as the globe's radius.
double errorOf(const Turn& turn, double time)
{
  double largest = 0;
  forEachPoint(atmosphere(turn), time,
    [&](const Vector3& place, const Vector3& was)
    {
      const double miss = length(was - turn.before(place, time));
      largest = std::max(largest, std::isfinite(miss) ? miss : Radius);
    });
  return largest / 1000;
}

int notFinite(Atmosphere* air, double time)
{
  int count = 0;
  forEachPoint(air, time,
    [&count](const Vector3&, const Vector3& was)
    { count += std::isfinite(dot(was, was)) ? 0 : 1; });
  return count;
}

Vector3 direction(double longitude, double latitude)
{
  return { std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
    std::sin(latitude) };
}

/// The same, km, of Runge-Kutta steps in longitude and latitude: 12 of the second order.
double errorInAngles(const Turn& turn, double time)
{
  const auto rate = [&turn](double longitude, double latitude)
  {
    const Vector3 v = turn.wind(direction(longitude, latitude));
    const Vector3 east{ -std::sin(longitude), std::cos(longitude), 0 };
    const Vector3 north = cross(direction(longitude, latitude), east);
    return std::array<double, 2>{ dot(v, east) / (Radius * std::cos(latitude)),
      dot(v, north) / Radius };
  };
  double largest = 0;
  for (int n = 0; n < 64 * 32; ++n)
  {
    const int row = n / 64;
    double longitude = 2 * Pi * (n % 64) / 64;
    double latitude = -Pi / 2 + Pi * (row + 0.5) / 32;
    const Vector3 exact = turn.before(direction(longitude, latitude), time);
    for (int step = 0; step < 12; ++step)
    {
      const double dt = -time / 12;
      const auto first = rate(longitude, latitude);
      const auto middle = rate(longitude + dt / 2 * first[0], latitude + dt / 2 * first[1]);
      longitude += dt * middle[0];
      latitude += dt * middle[1];
    }
    largest = std::max(largest, Radius * length(direction(longitude, latitude) - exact) / 1000);
  }
  return largest;
}

Outcome kilometres(double naive, double ours, double most)
{
  return { figure("error", naive) + " km", figure("error", ours) + " km", ours <= most };
}

constexpr double Tenth = 2 * Pi * Radius / 64 / 10 / 1000; // of a grid step, km

const StabilityRegistration poles(
  { "advection", "wind across both poles, 12 h", "error below a tenth of a grid step, 63 km",
    []
    {
      const Turn turn{ { 0, 1, 0 }, 40 };
      return kilometres(errorInAngles(turn, 12 * Hour), errorOf(turn, 12 * Hour), Tenth);
    } });

const StabilityRegistration dateLine({ "advection", "wind across the date line, 18 h",
  "error below a tenth of a grid step, 63 km",
  []
  {
    const Turn turn{ { 0, 0, 1 }, 40 };
    // Longitude carried as a number, interpolated between columns 0 and 63 of 64.
    const double moved = 40 * 18 * Hour / (2 * Pi * Radius / 64);
    double naive = 0;
    for (int i = 0; i < 64; ++i)
    {
      const double at = i - moved;
      const double below = std::floor(at);
      const auto column = [](double n) { return 2 * Pi / 64 * std::fmod(n + 64, 64.0); };
      const double got = column(below) + (at - below) * (column(below + 1) - column(below));
      naive = std::max(naive, Radius * length(direction(got, 0) - direction(2 * Pi / 64 * at, 0)));
    }
    return kilometres(naive / 1000, errorOf(turn, 18 * Hour), Tenth);
  } });

const StabilityRegistration calm({ "advection", "no wind at all, 18 h",
  "every point its own place, to a metre",
  []
  {
    // The longest float is 6.4e6 m; summed a thousand times with a weight of 1/1000.
    float sum = 0;
    for (int n = 0; n < 1000; ++n)
    {
      sum += static_cast<float>(Radius) / 1000;
    }
    return kilometres(std::abs(sum - Radius) / 1000, errorOf({ { 0, 0, 1 }, 0 }, 18 * Hour), 0.001);
  } });

const StabilityRegistration storm({ "advection", "wind of 300 m/s: 10 grid steps in one of time",
  "error below a tenth of a grid step, 63 km",
  []
  {
    const Turn turn{ normalized({ 1, 2, 2 }), 300 };
    // Upwind differences on a row of 64 columns: ten steps of 6 h.
    const double courant = 300 * 6 * Hour / (2 * Pi * Radius / 64);
    std::vector<double> row(64, 0.0);
    row[20] = 1;
    for (int step = 0; step < 10; ++step)
    {
      std::vector<double> next(64);
      for (int i = 0; i < 64; ++i)
      {
        next[i] = row[i] - courant * (row[i] - row[(i + 63) % 64]);
      }
      row = next;
    }
    Outcome outcome = kilometres(0, errorOf(turn, 6 * Hour), Tenth);
    outcome.naive = figure("values of up to", *std::max_element(row.begin(), row.end()));
    return outcome;
  } });

const StabilityRegistration strange({ "advection", "winds NaN and infinite in a patch",
  "no coordinate that is not finite; the patch is calm",
  []
  {
    const Turn turn{ { 0, 0, 1 }, 40 };
    const auto air = atmosphere(turn);
    int bad = 0;
    air->Wind = [turn, &bad](const double p[3], double time, double wind[3])
    {
      const Vector3 v = turn.wind({ p[0], p[1], p[2] });
      std::copy(v.v, v.v + 3, wind);
      if (p[0] > 0 && std::abs(p[1]) < 1e6 && std::abs(p[2]) < 2e6)
      {
        wind[1] = p[2] > 0 ? std::numeric_limits<double>::quiet_NaN()
                           : std::numeric_limits<double>::infinity();
        bad += time == 0 ? 1 : 0;
      }
    };
    const int count = notFinite(air, 12 * Hour);
    return Outcome{ "at least " + std::to_string(bad) + " points not finite",
      std::to_string(count) + " points not finite", count == 0 && bad > 0 };
  } });

/// Velocities across levels by ds/dt = w / (dz/ds), w 0.1 m/s: naively and ours.
std::array<double, 2> largestLevelVelocity(const std::vector<double>& height)
{
  const int n = static_cast<int>(height.size());
  const std::vector<double> rise(n, 0.1);
  std::vector<double> ours(n);
  levelVelocity(n, height.data(), rise.data(), ours.data());
  std::array<double, 2> largest{ 0, 0 };
  for (int k = 0; k < n; ++k)
  {
    const double apart = height[std::min(k + 1, n - 1)] - height[std::max(k - 1, 0)];
    largest[0] = std::max(largest[0], std::abs(2 * rise[k] / apart));
    largest[1] = std::max(largest[1], std::isfinite(ours[k]) ? std::abs(ours[k]) : 1);
  }
  return largest;
}

const StabilityRegistration single({ "advection", "a single level, in rising air",
  "air stays on its level; error below a tenth of a grid step",
  []
  {
    const Turn turn{ { 0, 1, 0 }, 40 };
    const auto air = atmosphere(turn);
    air->Size[2] = 1;
    air->Wind = [turn](const double p[3], double, double wind[3])
    {
      const Vector3 place{ p[0], p[1], p[2] };
      const Vector3 v = turn.wind(place) + 0.5 * normalized(place);
      std::copy(v.v, v.v + 3, wind);
    };
    double largest = 0;
    forEachPoint(air, 6 * Hour,
      [&](const Vector3& place, const Vector3& was)
      {
        const double miss = length(was - turn.before(place, 6 * Hour)) / 1000;
        largest = std::max(largest, std::isfinite(miss) ? miss : Radius);
      });
    return Outcome{ figure("levels/s", largestLevelVelocity({ 1000 })[0]),
      figure("error", largest) + " km", largest < Tenth };
  } });

const StabilityRegistration folded({ "advection", "levels that fold and coincide, in rising air",
  "air stays on its level there; no coordinate that is not finite",
  []
  {
    const std::vector<double> heights{ 100, 300, 300, 300, 250, 1000 };
    const auto air = atmosphere({ { 0, 1, 0 }, 40 });
    air->Size[2] = static_cast<int>(heights.size());
    air->Height = [heights](int level, double) { return heights[level]; };
    const auto [naive, ours] = largestLevelVelocity(heights);
    const int count = notFinite(air, 12 * Hour);
    return Outcome{ figure("levels/s", naive),
      figure("levels/s", ours) + ", " + std::to_string(count) + " points not finite",
      ours < 0.01 && count == 0 };
  } });

Outcome timesOutcome(const std::vector<double>& times, const std::string& naive)
{
  const auto air = atmosphere({ { 0, 0, 1 }, 40 });
  air->Times = times;
  const std::string text = errorTextOf(advection(air));
  const std::string wanted = "time step 2 is not later than the one before";
  const std::size_t at = text.find(wanted);
  const bool holds = at != std::string::npos;
  return { naive, holds ? "error: " + wanted : "no error", holds };
}

const StabilityRegistration equal(
  { "advection", "two time steps that are equal", "an error that names the step", [] {
     return timesOutcome({ 0, 5, 5, 7 }, figure("dz/dt", 1 / (5.0 - 5.0)) + " m/s");
   } });

const StabilityRegistration decreasing(
  { "advection", "time steps that decrease", "an error that names the step",
    []
    {
      // Where between its neighbours is 4.5 s?
      return timesOutcome({ 0, 5, 4, 7 }, figure("weight", (4.5 - 5.0) / (5.0 - 4.0)));
    } });
}
}
}
