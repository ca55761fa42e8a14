// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudWater.h"

#include "Camera.h"
#include "CloudPanorama.h"
#include "DeepTile.h"
#include "Fresnel.h"
#include "HeightGrid.h"
#include "ImageGrid.h"
#include "SurfaceShade.h"
#include "WaterWaves.h"
#include "vtkCloudBackdrop.h"
#include "vtkCloudHeightField.h"
#include "vtkInformation.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

vtkStandardNewMacro(vtkCloudWater);

namespace
{
using nephoscope::Vector3;
using nephoscope::WaterSlopes;

constexpr double RefractiveIndex = 1.34;
/// Slopes of what is finer than the waves, and of the sun's disc, in each direction.
constexpr double LeastVariance = 2e-5;
/// Farther along a ray than this is the horizon.
constexpr double Farthest = 1e12;

Vector3 vectorOf(const double v[3])
{
  return { v[0], v[1], v[2] };
}

/// A number in [0, 1) for each pixel.
double lotOf(int x, int y)
{
  std::uint32_t h =
    static_cast<std::uint32_t>(x) * 73856093U ^ static_cast<std::uint32_t>(y) * 19349663U;
  h = (h ^ h >> 15) * 0x2c1b3c6dU;
  return (h >> 8) / 16777216.0;
}

Vector3 normalOf(double slopeX, double slopeY)
{
  return normalized(Vector3{ -slopeX, -slopeY, 1 });
}
}

/// The water with all that is seen in it.
class vtkCloudWater::Sea
{
public:
  /// Where a ray meets the water.
  struct Hit
  {
    Vector3 At;
    Vector3 Ray; ///< unit, from the eye
    WaterSlopes Slopes;
    double Lot; ///< 0 to 1, drawn for each pixel
  };

  Vector3 Radiance(const Hit& hit) const
  {
    const double sunlight = this->Clouds.at(hit.At, this->Shade.towardSun);
    return this->Mirrored(hit, this->Upwelling(sunlight)) + sunlight * this->Glitter(hit);
  }

  nephoscope::WaterWaves Waves;
  nephoscope::CloudShadow Clouds;
  nephoscope::HeightGrid Hills;
  nephoscope::SurfaceShade Shade; ///< of the water's depth
  const vtkCloudBackdrop* Sky = nullptr;
  nephoscope::CloudPanorama Panorama;
  const vtkCloudHeightField* Lit = nullptr; ///< the clouds of the panorama
  Vector3 CloudEdge, CloudCore, Land;
  vtkMTimeType Read = 0;

private:
  /// Light that comes back out of the water.
  Vector3 Upwelling(double sunlight) const
  {
    nephoscope::SurfaceShade shade = this->Shade;
    shade.sun = sunlight * shade.sun;
    const nephoscope::RGB light = shade({ 0, 0, 1 }, { 0, 0, 1 });
    return { light[0], light[1], light[2] };
  }

  /// The mean over the rough slopes of what they mirror and let out.
  Vector3 Mirrored(const Hit& hit, const Vector3& upwelling) const
  {
    // Gauss and Hermite's nodes: slopes along the line of sight matter most.
    static constexpr double Along[5] = { -2.856970013872806, -1.355626179974266, 0,
      1.355626179974266, 2.856970013872806 };
    static constexpr double Weights[5] = { 0.0112574113277207, 0.2220759220056126,
      0.5333333333333333, 0.2220759220056126, 0.0112574113277207 };
    const WaterSlopes& s = hit.Slopes;
    const Vector3 a = normalized(Vector3{ hit.Ray[0], hit.Ray[1], 1e-12 });
    // Cholesky's factors of the covariance in axes along and across the line of sight.
    const double aa = s.xx * a[0] * a[0] + 2 * s.xy * a[0] * a[1] + s.yy * a[1] * a[1];
    const double ab = (s.yy - s.xx) * a[0] * a[1] + s.xy * (a[0] * a[0] - a[1] * a[1]);
    const double along = std::sqrt(std::max(aa, LeastVariance));
    const double skewed = ab / along;
    const double across = std::sqrt(std::max(0.0, s.xx + s.yy - aa - skewed * skewed));
    // Across, a pair of nodes at a place drawn by lot, so that no second image of a hill shows; its mean square is 1.
    const double aside = 1.7320508075688772 * hit.Lot * across;
    Vector3 sum{ 0, 0, 0 };
    double seen = 0;
    for (int i = 0; i < 5; ++i)
    {
      for (const double side : { -1.0, 1.0 })
      {
        const double sa = along * Along[i];
        const double sb = skewed * Along[i] + side * aside;
        const Vector3 normal = normalOf(s.x + sa * a[0] - sb * a[1], s.y + sa * a[1] + sb * a[0]);
        const double cosine = -dot(normal, hit.Ray);
        if (cosine > 0)
        {
          const double weight = Weights[i] * cosine / normal[2];
          const double f = nephoscope::fresnel(std::min(cosine, 1.0), RefractiveIndex);
          sum = sum + weight * (f * this->Above(hit, normal) + (1 - f) * upwelling);
          seen += weight;
        }
      }
    }
    return seen > 0 ? 1 / seen * sum : upwelling;
  }

  /// What a ray sees that a facet of the water has mirrored.
  Vector3 Above(const Hit& hit, const Vector3& normal) const
  {
    Vector3 up = hit.Ray - 2 * dot(hit.Ray, normal) * normal;
    up[2] = std::max(up[2], 1e-4);
    up = normalized(up);
    const double hills = this->Hills.intersect({ hit.At, up }, Farthest);
    if (hills < Farthest)
    {
      const Vector3 at = hit.At + hills * up;
      nephoscope::SurfaceShade shade = this->Shade;
      shade.color = this->Land;
      shade.sun = this->Clouds.at(at, shade.towardSun) * shade.sun;
      const nephoscope::RGB light = shade(this->Hills.normal(at[0], at[1], 0), -1 * up);
      return { light[0], light[1], light[2] };
    }
    float radiance[3];
    Vector3 sky = this->Shade.sky;
    if (this->Sky)
    {
      this->Sky->GetRadiance(up.v, radiance);
      sky = { radiance[0], radiance[1], radiance[2] };
    }
    // The clouds are blurred by the slopes between two nodes.
    const double blur = std::sqrt(hit.Slopes.xx + hit.Slopes.yy);
    if (this->Lit)
    {
      const auto clouds = this->Panorama.at(hit.At, up, blur);
      return clouds.transmittance * sky +
        this->Lit->RadianceOf(clouds.light, clouds.transmittance, up);
    }
    const double way = (this->Clouds.height - hit.At[2]) / up[2];
    const double clear = this->Clouds.at(hit.At, up, way * blur);
    return clear * sky + (1 - clear) * (clear * this->CloudEdge + (1 - clear) * this->CloudCore);
  }

  Vector3 Glitter(const Hit& hit) const
  {
    const Vector3& sun = this->Shade.towardSun;
    const Vector3 facet = normalized(sun - hit.Ray);
    if (!(sun[2] > 0) || !(facet[2] > 0.1))
    {
      return { 0, 0, 0 };
    }
    const double density = hit.Slopes.density(-facet[0] / facet[2], -facet[1] / facet[2]);
    const double f = nephoscope::fresnel(std::clamp(dot(facet, sun), 0.0, 1.0), RefractiveIndex);
    const double steep = facet[2] * facet[2];
    return vtkMath::Pi() * f * density / (4 * std::max(-hit.Ray[2], 0.02) * steep * steep) *
      this->Shade.sun;
  }
};

vtkCloudWater::vtkCloudWater()
  : Ready(std::make_unique<Sea>())
{
  this->SetNumberOfInputPorts(2);
}

vtkCloudWater::~vtkCloudWater() = default;

int vtkCloudWater::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

void vtkCloudWater::SetBackdrop(vtkCloudBackdrop* backdrop)
{
  if (this->Backdrop != backdrop)
  {
    this->Backdrop = backdrop;
    this->Modified();
  }
}

vtkCloudBackdrop* vtkCloudWater::GetBackdrop() const
{
  return this->Backdrop;
}

void vtkCloudWater::SetClouds(vtkCloudHeightField* clouds)
{
  if (this->Clouds != clouds)
  {
    this->Clouds = clouds;
    this->Modified();
  }
}

vtkCloudHeightField* vtkCloudWater::GetClouds() const
{
  return this->Clouds;
}

bool vtkCloudWater::Prepare(const nephoscope::Camera& camera)
{
  Sea& sea = *this->Ready;
  if (sea.Read < this->GetInputsMTime())
  {
    std::string wrong = readShadow(this->GetUsedInput(0), sea.Clouds);
    sea.Hills = {};
    if (vtkDataObject* const heights = this->GetInputDataObject(1, 0))
    {
      nephoscope::GridPyramid grid;
      double z = 0;
      wrong += readGrid(heights, nephoscope::arrays::Height, grid, z, this->HeightScale);
      sea.Hills = nephoscope::HeightGrid(std::move(grid));
    }
    if (!wrong.empty())
    {
      vtkErrorMacro(<< wrong);
      return false;
    }
    sea.Read = this->GetInputsMTime();
  }
  nephoscope::WaterWavesParameters waves;
  waves.windSpeed = this->WindSpeed;
  waves.wind = vectorOf(this->Wind);
  waves.longest = this->Wavelength;
  waves.shortest = this->Wavelength / 200;
  waves.time = this->Time;
  waves.period = this->Period;
  sea.Waves = nephoscope::WaterWaves(waves);
  sea.Shade = this->MakeShade();
  sea.Shade.color = vectorOf(this->WaterColor);
  sea.Sky = this->Backdrop;
  sea.CloudEdge = vectorOf(this->CloudEdgeColor);
  sea.CloudCore = vectorOf(this->CloudCoreColor);
  sea.Land = vectorOf(this->LandColor);
  const bool isLit = this->Clouds && this->Clouds->GetVisibility() && !camera.isParallel();
  sea.Lit = isLit ? this->Clouds.Get() : nullptr;
  const Vector3& eye = camera.eye();
  if (sea.Lit && !this->Clouds->Survey({ eye[0], eye[1], 2 * this->Level - eye[2] }, sea.Panorama))
  {
    return false;
  }
  if (!(length(sea.Shade.towardSun) > 0))
  {
    vtkErrorMacro("TowardSun (0, 0, 0) is no direction; give another.");
    return false;
  }
  return true;
}

/// Where a ray meets the water; infinite if it does not.
double vtkCloudWater::DistanceOf(const nephoscope::Ray& ray) const
{
  const double distance = (this->Level - ray.origin[2]) / ray.direction[2];
  return ray.direction[2] < 0 && distance >= 0 && distance < Farthest
    ? distance
    : std::numeric_limits<double>::infinity();
}

void vtkCloudWater::Hide(const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const
{
  const nephoscope::TileExtent& e = tile.extent();
  for (int y = e.y0; y < e.y0 + e.height; ++y)
  {
    for (int x = e.x0; x < e.x0 + e.width; ++x)
    {
      tile.hideBeyond(x, y, this->DistanceOf(camera.ray(x + 0.5, y + 0.5)));
    }
  }
}

void vtkCloudWater::Emit(const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const
{
  const Sea& sea = *this->Ready;
  const nephoscope::TileExtent& e = tile.extent();
  for (int y = e.y0; y < e.y0 + e.height; ++y)
  {
    for (int x = e.x0; x < e.x0 + e.width; ++x)
    {
      const nephoscope::Ray ray = camera.ray(x + 0.5, y + 0.5);
      const double distance = this->DistanceOf(ray);
      if (!std::isfinite(distance) || distance > tile.opaqueAt(x, y))
      {
        continue;
      }
      const double pixel = camera.footprint(distance);
      const Vector3 level = normalized(Vector3{ ray.direction[0], ray.direction[1], 0 });
      const Vector3 across{ -level[1], level[0], 0 };
      Sea::Hit hit{ ray.origin + distance * ray.direction, ray.direction, {}, lotOf(x, y) };
      hit.Slopes =
        sea.Waves.slopes(hit.At[0], hit.At[1], pixel / -ray.direction[2] * level, pixel * across);
      hit.Slopes.xx += LeastVariance;
      hit.Slopes.yy += LeastVariance;
      const Vector3 light = sea.Radiance(hit);
      tile.add(x, y,
        { distance, distance, { nephoscope::Opaque, nephoscope::Opaque, nephoscope::Opaque },
          { static_cast<float>(light[0]), static_cast<float>(light[1]),
            static_cast<float>(light[2]) } });
    }
  }
}

void vtkCloudWater::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto print = [&os, indent](const char* name, const double v[3])
  { os << indent << name << ": " << v[0] << ' ' << v[1] << ' ' << v[2] << '\n'; };
  os << indent << "Level: " << this->Level << '\n';
  os << indent << "WindSpeed: " << this->WindSpeed << '\n';
  print("Wind", this->Wind);
  os << indent << "Wavelength: " << this->Wavelength << '\n';
  os << indent << "Time: " << this->Time << '\n';
  os << indent << "Period: " << this->Period << '\n';
  print("WaterColor", this->WaterColor);
  print("CloudEdgeColor", this->CloudEdgeColor);
  print("CloudCoreColor", this->CloudCoreColor);
  print("LandColor", this->LandColor);
  os << indent << "HeightScale: " << this->HeightScale << '\n';
  os << indent << "Clouds: " << this->Clouds.Get() << '\n';
  os << indent << "Backdrop: " << this->Backdrop.Get() << '\n';
}
