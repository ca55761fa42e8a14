// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudTerrain.h"

#include "Camera.h"
#include "DeepTile.h"
#include "FractalNoise.h"
#include "HeightGrid.h"
#include "ImageGrid.h"
#include "SurfaceShade.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkCloudTerrain);

namespace
{
using nephoscope::Vector3;

/// 0 below `from`, 1 above `to`, smooth between.
double step(double from, double to, double x)
{
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

Vector3 mixed(const Vector3& a, const Vector3& b, double share)
{
  return a + share * (b - a);
}
}

/// The hills with all that a hit needs.
class vtkCloudTerrain::Landscape
{
public:
  /// Where a ray meets the ground.
  struct Hit
  {
    Vector3 At;
    double Footprint;
  };

  nephoscope::RGB Radiance(const Hit& hit, const Vector3& towardEye) const
  {
    const Vector3 normal = this->RoughNormal(hit);
    nephoscope::SurfaceShade shade = this->Shade;
    shade.color = this->ColorAt(hit, normal);
    shade.sun = this->Sunlight(hit) * shade.sun;
    return shade(normal, towardEye);
  }

  nephoscope::HeightGrid Ground;
  nephoscope::CloudShadow Clouds;
  nephoscope::SurfaceShade Shade;
  Vector3 Sand, Grass, Wood, Rock;
  double Roughness = 0;
  double WaterLevel = 0;
  double Scale = 1; ///< scene units of height a metre
  vtkMTimeType Read = 0;

private:
  double Spacing() const { return this->Ground.heights().frame().dx; }

  Vector3 RoughNormal(const Hit& hit) const
  {
    const Vector3 smooth = this->Ground.normal(hit.At[0], hit.At[1], hit.Footprint);
    // Each octave has the same slope; noise of wavelength w has slopes of about 3 / w.
    const double wavelength = 4 * this->Spacing();
    const nephoscope::Noise noise =
      nephoscope::NoiseOctaves{ wavelength, 6, 0.5, 77 }(hit.At[0], hit.At[1], hit.Footprint);
    const double slope = this->Roughness * wavelength / 6;
    return normalized(smooth - Vector3{ slope * noise.dx, slope * noise.dy, 0 });
  }

  Vector3 ColorAt(const Hit& hit, const Vector3& normal) const
  {
    const double patches = nephoscope::NoiseOctaves{ 40 * this->Spacing(), 7, 0.7, 5 }.value(
      hit.At[0], hit.At[1], hit.Footprint);
    const double specks = nephoscope::NoiseOctaves{ 2 * this->Spacing(), 5, 0.8, 9 }.value(
      hit.At[0], hit.At[1], hit.Footprint);
    const double slope = std::hypot(normal[0], normal[1]) / std::max(normal[2], 1e-3);
    const double high = (hit.At[2] - this->WaterLevel) / this->Scale;
    // Woods keep to hollows and to the north, where it is damp.
    Vector3 color =
      mixed(this->Grass, this->Wood, step(-0.15, 0.3, patches + 0.8 * normal[1] + 0.25 * specks));
    color = mixed(color, this->Rock, step(0.6, 1.1, slope + 0.25 * specks));
    color = mixed(this->Sand, color, step(2, 9, high + 2 * specks));
    return (1 + 0.25 * std::clamp(specks, -1.0, 1.0)) * color;
  }

  /// The share of the sun's light that arrives.
  double Sunlight(const Hit& hit) const
  {
    const Vector3& toward = this->Shade.towardSun;
    const double lift = 0.02 * this->Spacing() + 0.5 * hit.Footprint;
    const nephoscope::Ray up{ hit.At + Vector3{ 0, 0, lift }, toward };
    if (std::isfinite(this->Ground.intersect(up, VTK_DOUBLE_MAX)))
    {
      return 0;
    }
    return this->Clouds.at(hit.At, toward, hit.Footprint);
  }
};

vtkCloudTerrain::vtkCloudTerrain()
  : Ready(std::make_unique<Landscape>())
{
  this->SetNumberOfInputPorts(2);
}

vtkCloudTerrain::~vtkCloudTerrain() = default;

int vtkCloudTerrain::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

bool vtkCloudTerrain::Prepare(const nephoscope::Camera&)
{
  if (!(this->HeightScale > 0) || !std::isfinite(this->HeightScale))
  {
    vtkErrorMacro("HeightScale " << this->HeightScale << " is not a number above 0.");
    return false;
  }
  Landscape& land = *this->Ready;
  if (land.Read < this->GetInputsMTime())
  {
    nephoscope::GridPyramid heights;
    double z = 0;
    std::string wrong = readGrid(
      this->GetInputDataObject(0, 0), nephoscope::arrays::Height, heights, z, this->HeightScale);
    wrong += readShadow(this->GetUsedInput(1), land.Clouds);
    if (!wrong.empty())
    {
      vtkErrorMacro(<< wrong);
      return false;
    }
    land.Ground = nephoscope::HeightGrid(std::move(heights));
    land.Read = this->GetInputsMTime();
  }
  const auto vector = [](const double* v) { return Vector3{ v[0], v[1], v[2] }; };
  land.Shade = this->MakeShade();
  land.Sand = vector(this->SandColor);
  land.Grass = vector(this->GrassColor);
  land.Wood = vector(this->WoodColor);
  land.Rock = vector(this->RockColor);
  land.Roughness = this->Roughness;
  land.WaterLevel = this->WaterLevel;
  land.Scale = this->HeightScale;
  return true;
}

void vtkCloudTerrain::Emit(const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const
{
  const Landscape& land = *this->Ready;
  const nephoscope::TileExtent& e = tile.extent();
  for (int y = e.y0; y < e.y0 + e.height; ++y)
  {
    for (int x = e.x0; x < e.x0 + e.width; ++x)
    {
      const nephoscope::Ray ray = camera.ray(x + 0.5, y + 0.5);
      const double distance = land.Ground.intersect(ray, tile.opaqueAt(x, y));
      if (std::isfinite(distance))
      {
        const Landscape::Hit hit{ ray.origin + distance * ray.direction,
          camera.footprint(distance) };
        tile.add(x, y,
          { distance, distance, { nephoscope::Opaque, nephoscope::Opaque, nephoscope::Opaque },
            land.Radiance(hit, -1.0 * ray.direction) });
      }
    }
  }
}

void vtkCloudTerrain::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto print = [&os, indent](const char* name, const double v[3])
  { os << indent << name << ": " << v[0] << ' ' << v[1] << ' ' << v[2] << '\n'; };
  os << indent << "HeightScale: " << this->HeightScale << '\n';
  os << indent << "WaterLevel: " << this->WaterLevel << '\n';
  print("SandColor", this->SandColor);
  print("GrassColor", this->GrassColor);
  print("WoodColor", this->WoodColor);
  print("RockColor", this->RockColor);
  os << indent << "Roughness: " << this->Roughness << '\n';
}
