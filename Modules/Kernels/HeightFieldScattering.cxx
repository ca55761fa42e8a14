// SPDX-License-Identifier: BSD-3-Clause
#include "HeightFieldScattering.h"

#include "HeightFieldMethods.h"
#include "HeightFieldRay.h"
#include "Optics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nephoscope
{
namespace
{
constexpr double SteepestSlope = 1e7;

double usable(double density)
{
  return density > 0 ? std::min<double>(density, DensestExtinction) : 0;
}
}

HeightFieldScattering::HeightFieldScattering(const HeightField& field, double planeHeight,
  const ScatteringDensities& densities, const ScatteringSettings& settings)
  : Field(field)
  , PlaneHeight(planeHeight)
  , Densities{ usable(densities.sun), usable(densities.view), usable(densities.behind) }
  , Settings(settings)
{
}

const std::vector<std::string>& HeightFieldScattering::names()
{
  static const std::vector<std::string> all{ "Exact", "March", "Sexp1986", "Moments" };
  return all;
}

std::unique_ptr<HeightFieldScattering> HeightFieldScattering::make(const std::string& name,
  const HeightField& field, double planeHeight, const ScatteringDensities& densities,
  const ScatteringSettings& settings)
{
  if (name == "Exact")
  {
    return std::make_unique<HeightFieldExact>(field, planeHeight, densities, settings);
  }
  if (name == "March")
  {
    return std::make_unique<HeightFieldMarch>(field, planeHeight, densities, settings);
  }
  if (name == "Sexp1986")
  {
    return std::make_unique<HeightFieldSexp>(field, planeHeight, densities, settings);
  }
  if (name == "Moments")
  {
    return std::make_unique<HeightFieldMoments>(field, planeHeight, densities, settings);
  }
  throw std::invalid_argument(
    "no scattering method '" + name + "': use Exact, March, Sexp1986 or Moments");
}

void HeightFieldScattering::shine(const CloudSlice& slice, const std::vector<double>& slopes,
  SliceLight& light, const std::vector<double>& ends)
{
  light.rays.assign(slopes.size(), RayLight());
  light.segments.clear();
  light.largestViewArgument = 0;
  light.largestSunArgument = 0;
  light.pieces = 0;
  const double sum = slice.x + slice.y + slice.z + slice.ux + slice.uy + slice.far;
  if (slopes.empty() || !std::isfinite(sum) || !std::isfinite(this->PlaneHeight) ||
    !(slice.far > 0))
  {
    return;
  }
  this->Slopes.clear();
  for (const double slope : slopes)
  {
    this->Slopes.push_back(
      std::isnan(slope) ? SteepestSlope : std::clamp(slope, -SteepestSlope, SteepestSlope));
  }
  this->Ends = ends;
  this->Light = &light;
  this->run(slice);
}

bool HeightFieldScattering::add(
  std::uint32_t ray, double nearEnd, double farEnd, double light, double error)
{
  const HeightFieldRay at(0, this->Slopes[ray], this->Densities);
  RayLight& all = this->Light->rays[ray];
  const double depth = this->Densities.behind * at.gamma * (farEnd - nearEnd);
  all.light += all.transmittance * light;
  all.error += all.transmittance * error;
  all.transmittance *= std::exp(-depth);
  this->Light->segments.push_back({ ray, nearEnd, farEnd, light, depth });
  this->Light->largestViewArgument =
    std::max(this->Light->largestViewArgument, at.delta() * (farEnd - nearEnd));
  static const double hidden = std::exp(-OpaqueViewDepth);
  return all.transmittance > hidden;
}

double HeightFieldScattering::part(
  const CloudSlice& slice, double slope, double nearEnd, double farEnd) const
{
  const HeightFieldRay ray(slice.z - this->PlaneHeight, slope, this->Densities);
  const double wave = std::min(this->Field.shortestWave(), farEnd - nearEnd);
  const double step = std::min(wave / 16, 2 / std::max(ray.view, 1e-300));
  const auto topAt = [&](double r) { return this->Field.top(this->valueAt(slice, r)); };
  LinearSteps steps(ray, nearEnd);
  steps.start(nearEnd, topAt(nearEnd));
  double light = 0;
  double r = nearEnd;
  while (r < farEnd && ray.view * (r - nearEnd) < OpaqueViewDepth)
  {
    r = r + step < farEnd ? r + step : farEnd;
    light += steps.to(r, topAt(r));
  }
  return light;
}
}
