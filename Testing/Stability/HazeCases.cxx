// SPDX-License-Identifier: BSD-3-Clause
// Where light shafts in haze are known to fail (Max 1986, section 5). Ours is the method Moments.
#include "HazeShafts.h"
#include "Stability.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephoscope
{
namespace stability
{
namespace
{
constexpr double Plane = 1000;
constexpr double Nan = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();
const Vector3 Slant{ -0.5, 0.8, 0.6 };

/// The same transmittance over 12.8 km x 9.6 km, and beyond.
CloudShadow evenClouds(float transmittance)
{
  const GridFrame frame{ -6400, -4800, 50, 50, 257, 193 };
  return { GridPyramid(frame, std::vector<float>(257 * 193, transmittance)), Plane,
    std::isfinite(transmittance) ? transmittance : 0 };
}

double shine(const CloudShadow& clouds, const Vector3& sun, const Ray& ray, double far, double tau)
{
  HazeShafts haze(clouds, sun, ray.origin, { tau, 0, 0 });
  haze.tabulate(128);
  return haze.glow(HazeMethod::Moments, ray, haze.below(ray, 0, far))[0];
}

/// The light of haze without clouds along a stretch whose near end is `depth` below the plane.
double clearLight(double tau, double sine, double rise, double depth, double length)
{
  const double eps = tau * (1 - rise / sine);
  const double sum = eps == 0 ? length : -std::expm1(-eps * length) / eps;
  return tau * std::exp(-tau * depth / sine) * sum;
}

Ray rayOf(double height, const Vector3& direction)
{
  return { { 150, -220, height }, normalized(direction) };
}

double relative(double light, double truth)
{
  const double error = std::abs(light - truth) / truth;
  return std::isfinite(error) ? error : Infinity;
}

/// Keeps the larger; a NaN stays.
void worsen(double& worst, double error)
{
  worst = std::isnan(worst) || error <= worst ? worst : error;
}

Outcome outcome(const std::string& what, double naive, double ours, double limit)
{
  return { figure(what, naive), figure(what, ours), ours <= limit };
}

const StabilityRegistration neverThere({ "haze",
  "rays level and downward, which never reach the cloud plane", "the closed form to 1e-3 of it",
  []
  {
    const CloudShadow clear = evenClouds(1);
    const double tau = 2e-4;
    const double far = 3000;
    const double sine = normalized(Slant)[2];
    double naive = 0;
    double ours = 0;
    for (const double rise : { 0.0, -0.0, 1e-300, -1e-12, -0.02, -0.3 })
    {
      const Ray ray = rayOf(930, { 0.3, 1, rise });
      const double v = ray.direction[2];
      const double truth = clearLight(tau, sine, v, 70, far);
      worsen(ours, relative(shine(clear, Slant, ray, far, tau), truth));
      // The way to the plane, whatever its sign.
      worsen(naive, std::abs(clearLight(tau, sine, v, 70, 70 / v) / truth - 1));
    }
    return outcome("relative error", naive, ours, 1e-3);
  } });

const StabilityRegistration eyeAbove({ "haze", "the eye at and above the cloud plane",
  "nothing upward and level; downward the closed form below the plane to 1e-3 of it",
  []
  {
    const CloudShadow clear = evenClouds(1);
    const double tau = 2e-4;
    const double sine = normalized(Slant)[2];
    double naive = 0;
    double ours = 0;
    bool dark = true;
    for (const double height : { 1000.0, 1000.0 + 1e-9, 1500.0, 3000.0 })
    {
      for (const double rise : { 0.0, 1e-9, 1.0 })
      {
        dark = dark && shine(clear, Slant, rayOf(height, { 0.3, 1, rise }), 9000, tau) == 0;
      }
      const Ray down = rayOf(height, { 0.3, 1, -1 });
      const double v = down.direction[2];
      const double above = (Plane - height) / v;
      const double truth = clearLight(tau, sine, v, 0, 9000 - above);
      worsen(ours, relative(shine(clear, Slant, down, 9000, tau), truth));
      // A negative depth and the whole ray.
      worsen(naive, relative(clearLight(tau, sine, v, Plane - height, 9000), truth));
    }
    Outcome result = outcome("relative error", naive, ours, 1e-3);
    result.holds = result.holds && dark;
    return result;
  } });

const StabilityRegistration noCloud(
  { "haze", "no cloud at all, without a map and with a clear one", "the closed form to 1e-3 of it",
    []
    {
      const double tau = 2e-4;
      const double sine = normalized(Slant)[2];
      double naive = 0;
      double ours = 0;
      for (const double rise : { 0.0, 0.1, 0.6, 2.0 })
      {
        const Ray ray = rayOf(30, { 0.3, 1, rise });
        const double v = ray.direction[2];
        const double length = std::min(9000.0, 970 / v);
        const double truth = clearLight(tau, sine, v, 970, length);
        for (const CloudShadow& clouds : { CloudShadow{ {}, Plane }, evenClouds(1) })
        {
          worsen(ours, relative(shine(clouds, Slant, ray, length, tau), truth));
        }
        // One quadratic for the whole exponential.
        const double x = tau * (1 - v / sine) * length;
        const double sum = length * (1 - x / 2 + x * x / 6);
        worsen(naive, relative(tau * std::exp(-tau * 970 / sine) * sum, truth));
      }
      return outcome("relative error", naive, ours, 1e-3);
    } });

const StabilityRegistration closed(
  { "haze", "a closed cover, and one of values that are not numbers", "dark",
    []
    {
      double naive = 0;
      double ours = 0;
      for (const float value : { 0.0F, static_cast<float>(Nan), static_cast<float>(Infinity) })
      {
        const CloudShadow clouds = evenClouds(value);
        worsen(naive, std::abs(value * clearLight(2e-4, 0.6, 0, 970, 3000)));
        for (const double rise : { -0.1, 0.0, 0.1, 2.0 })
        {
          worsen(ours, shine(clouds, Slant, rayOf(30, { 0.3, 1, rise }), 3000, 2e-4));
        }
      }
      return outcome("light", naive, ours, 0);
    } });

const StabilityRegistration extinctions({ "haze",
  "extinctions of 0 and 1e-12/m to 1e3/m, from just below the plane and from 5 km above it",
  "nothing; the closed form to 1e-3 of it",
  []
  {
    const CloudShadow clear = evenClouds(1);
    const double sine = normalized(Slant)[2];
    bool dark = shine(clear, Slant, rayOf(30, { 0, 1, 0.1 }), 3000, 0) == 0;
    dark = dark && shine(clear, Slant, rayOf(30, { 0, 1, 0.1 }), 3000, 1e3) == 0;
    double naive = 0;
    double ours = 0;
    for (const double tau : { 1e-12, 1e-3, 1.0, 30.0, 1e3 })
    {
      const Ray level = rayOf(Plane - 1e-3, { 0.3, 1, 0 });
      const double below = clearLight(tau, sine, 0, 1e-3, 3000);
      worsen(ours, relative(shine(clear, Slant, level, 3000, tau), below));
      const Ray down = rayOf(Plane + 5000, { 0.1, 1, -2 });
      const double v = down.direction[2];
      const double above = clearLight(tau, sine, v, 0, 6500 + 5000 / v);
      worsen(ours, relative(shine(clear, Slant, down, 6500, tau), above));
      // Max's quadratic for the whole ray.
      const double x = tau * 3000;
      worsen(naive, relative(x * std::exp(-tau * 1e-3 / sine) * (1 - x / 2 + x * x / 6), below));
    }
    Outcome result = outcome("relative error", naive, ours, 1e-3);
    result.holds = result.holds && dark;
    return result;
  } });

/// clearLight of a low sun, from the light left at both ends.
double lowLight(double tau, double sine, const Ray& ray, const HazeShafts::Stretch& stretch)
{
  if (!(sine > 0) || !(stretch.far > stretch.near))
  {
    return 0;
  }
  const auto left = [&](double t)
  {
    const double depth = std::max(0.0, Plane - ray.origin[2] - t * ray.direction[2]);
    return std::exp(-tau * (depth / sine + t - stretch.near));
  };
  return (left(stretch.near) - left(stretch.far)) / (1 - ray.direction[2] / sine);
}

const StabilityRegistration horizon(
  { "haze", "the sun at the horizon and below it: its way through the haze grows beyond all bounds",
    "the closed form within 1e-4; dark from the horizon down",
    []
    {
      const CloudShadow clear = evenClouds(1);
      const double tau = 2e-4;
      double naive = 0;
      double ours = 0;
      for (const double sine : { 0.1, 1e-3, 1e-12, 1e-300, 5e-324, 0.0, -0.0, -0.1 })
      {
        const Vector3 sun{ std::sqrt(1 - sine * sine), 0, sine };
        for (const double height : { 30.0, Plane - 1, Plane, Plane + 200 })
        {
          for (const double rise : { -0.3, 0.0, 0.04, 1.0 })
          {
            const Ray ray = rayOf(height, { 0.3, 1, rise });
            const HazeShafts::Stretch lit =
              HazeShafts(clear, sun, ray.origin, { tau, 0, 0 }).below(ray, 0, 3000);
            const double error = shine(clear, sun, ray, 3000, tau) - lowLight(tau, sine, ray, lit);
            worsen(ours, std::isfinite(error) ? std::abs(error) : Infinity);
            worsen(naive, std::abs(clearLight(tau, sine, ray.direction[2], Plane - height, 3000)));
          }
        }
      }
      return outcome("error of light", naive, ours, 1e-4);
    } });

const StabilityRegistration sunAhead({ "haze", "the sun exactly before the eye, and behind it",
  "the closed forms tau L exp(-tau A / S_z) and (1 - exp(-2 tau L)) / 2 to 1e-3 of them",
  []
  {
    const CloudShadow clear = evenClouds(1);
    const double tau = 2e-4;
    double naive = 0;
    double ours = 0;
    for (const Vector3& sun : { Slant, Vector3{ 0, 0, 1 }, Vector3{ 0.9, 0.1, 0.2 } })
    {
      const Vector3 s = normalized(sun);
      const double length = 970 / s[2];
      for (const double turn : { 0.0, 1e-16, -1e-12, 1e-7, 1e-4 })
      {
        const Ray ray{ { 150, -220, 30 }, normalized(Vector3{ s[0] + turn, s[1], s[2] }) };
        const double truth = clearLight(tau, s[2], ray.direction[2], 970, 970 / ray.direction[2]);
        worsen(ours, relative(shine(clear, sun, ray, 1e6, tau), truth));
        const double eps = tau * (1 - ray.direction[2] / s[2]);
        const double sum = (1 - std::exp(-eps * length)) / eps;
        worsen(naive, std::abs(tau * std::exp(-tau * length) * sum / truth - 1));
      }
      const Ray back{ { 150, -220, 1200 }, { -s[0], -s[1], -s[2] } };
      const double behind = -std::expm1(-2 * tau * 2000) / 2;
      worsen(ours, relative(shine(clear, sun, back, 2000 + 200 / s[2], tau), behind));
    }
    return outcome("relative error", naive, ours, 1e-3);
  } });
}
}
}
