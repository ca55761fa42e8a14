// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudHaze.h"

#include "Camera.h"
#include "DeepTile.h"
#include "HazeShafts.h"
#include "ImageGrid.h"
#include "PhaseFunction.h"
#include "vtkInformation.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkCloudHaze);

namespace
{
/// Nothing is seen through this.
constexpr double Thickest = 100;
}

struct vtkCloudHaze::Air
{
  nephoscope::CloudShadow Clouds;
  std::unique_ptr<nephoscope::HazeShafts> Shafts;
  nephoscope::Vector3 TowardSun;
  double Reach = 0; ///< the farthest end of a segment, 0 for clear air
};

vtkCloudHaze::vtkCloudHaze()
  : Ready(std::make_unique<Air>())
{
}

vtkCloudHaze::~vtkCloudHaze() = default;

int vtkCloudHaze::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

bool vtkCloudHaze::Validate(const nephoscope::Camera& camera)
{
  for (const double extinction : this->Extinction)
  {
    if (!(extinction >= 0) || !std::isfinite(extinction))
    {
      vtkErrorMacro("Extinction " << extinction << " is not a number from 0 up.");
      return false;
    }
  }
  if (!(this->TowardSun[2] > 0))
  {
    vtkErrorMacro("TowardSun " << this->TowardSun[0] << ' ' << this->TowardSun[1] << ' '
                               << this->TowardSun[2]
                               << " is not above the horizon; give it a z above 0.");
    return false;
  }
  if (!(this->Step > 0))
  {
    vtkErrorMacro("Step " << this->Step << " is not above 0.");
    return false;
  }
  if (camera.isParallel() && this->Method == Moments)
  {
    vtkErrorMacro("The method Moments is for rays from one eye, which a parallel camera has not; "
                  "choose Exact or March.");
    return false;
  }
  return true;
}

bool vtkCloudHaze::Prepare(const nephoscope::Camera& camera)
{
  if (!this->Validate(camera))
  {
    return false;
  }
  Air& air = *this->Ready;
  const std::string wrong = readShadow(this->GetUsedInput(0), air.Clouds);
  if (!wrong.empty())
  {
    vtkErrorMacro(<< wrong);
    return false;
  }
  if (air.Clouds.transmittance.empty())
  {
    air.Clouds.height = this->Height;
  }
  double thinnest = VTK_DOUBLE_MAX;
  for (const double extinction : this->Extinction)
  {
    thinnest = extinction > 0 ? std::min(thinnest, extinction) : thinnest;
  }
  air.Reach = thinnest < VTK_DOUBLE_MAX ? std::min(this->Range, Thickest / thinnest) : 0;
  air.TowardSun = nephoscope::normalized(
    nephoscope::Vector3{ this->TowardSun[0], this->TowardSun[1], this->TowardSun[2] });
  air.Shafts = std::make_unique<nephoscope::HazeShafts>(air.Clouds, air.TowardSun, camera.eye(),
    nephoscope::Channels{ this->Extinction[0], this->Extinction[1], this->Extinction[2] });
  if (this->Method == Moments && air.Shafts->beginTables(this->Radials))
  {
    vtkSMPTools::For(0, this->Radials,
      [&air](vtkIdType first, vtkIdType last)
      { air.Shafts->tabulateRadials(static_cast<int>(first), static_cast<int>(last)); });
  }
  return true;
}

void vtkCloudHaze::Emit(const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const
{
  const Air& air = *this->Ready;
  const auto method = static_cast<nephoscope::HazeMethod>(this->Method);
  const nephoscope::TileExtent& e = tile.extent();
  for (int y = e.y0; y < e.y0 + e.height; ++y)
  {
    for (int x = e.x0; x < e.x0 + e.width; ++x)
    {
      const nephoscope::Ray ray = camera.ray(x + 0.5, y + 0.5);
      const auto stretch =
        air.Shafts->below(ray, 0, std::min<double>(air.Reach, tile.opaqueAt(x, y)));
      const double length = stretch.far - stretch.near;
      if (!(length > 0))
      {
        continue;
      }
      const nephoscope::Channels glow = air.Shafts->glow(method, ray, stretch, this->Step);
      const double phase = vtkMath::Pi() *
        nephoscope::henyeyGreenstein(this->Anisotropy, dot(ray.direction, air.TowardSun));
      nephoscope::Segment haze;
      haze.nearEnd = stretch.near;
      haze.farEnd = stretch.far;
      for (int c = 0; c < 3; ++c)
      {
        const double depth = this->Extinction[c] * length;
        haze.opticalDepth[c] = static_cast<float>(depth);
        haze.radiance[c] =
          static_cast<float>(this->SunColor[c] * this->Albedo[c] * phase * glow[c] -
            this->SkyColor[c] * std::expm1(-depth));
      }
      tile.add(x, y, haze);
    }
  }
}

void vtkCloudHaze::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto print = [&os, indent](const char* name, const double v[3])
  { os << indent << name << ": " << v[0] << ' ' << v[1] << ' ' << v[2] << '\n'; };
  os << indent << "Method: " << this->Method << '\n';
  os << indent << "Radials: " << this->Radials << '\n';
  os << indent << "Step: " << this->Step << '\n';
  print("Extinction", this->Extinction);
  print("Albedo", this->Albedo);
  os << indent << "Anisotropy: " << this->Anisotropy << '\n';
  print("TowardSun", this->TowardSun);
  print("SunColor", this->SunColor);
  print("SkyColor", this->SkyColor);
  os << indent << "Height: " << this->Height << '\n';
  os << indent << "Range: " << this->Range << '\n';
}
