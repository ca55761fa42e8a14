// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudGlobe.h"

#include "Camera.h"
#include "DeepTile.h"
#include "SurfaceShade.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkCloudGlobe);

vtkCloudGlobe::vtkCloudGlobe()
{
  this->Land = true;
}

bool vtkCloudGlobe::Prepare(const nephoscope::Camera&)
{
  if (!(this->Radius > 0) || !std::isfinite(this->Radius))
  {
    vtkErrorMacro("Radius " << this->Radius << " is not a number above 0.");
    return false;
  }
  return true;
}

void vtkCloudGlobe::Emit(const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const
{
  const nephoscope::Vector3 center{ this->Center[0], this->Center[1], this->Center[2] };
  const double degreesPerUnit = vtkMath::DegreesFromRadians(1 / this->Radius);
  nephoscope::SurfaceShade shade = this->MakeShade();
  const nephoscope::TileExtent& e = tile.extent();
  for (int y = e.y0; y < e.y0 + e.height; ++y)
  {
    for (int x = e.x0; x < e.x0 + e.width; ++x)
    {
      const nephoscope::Ray ray = camera.ray(x + 0.5, y + 0.5);
      const nephoscope::Vector3 toCenter = center - ray.origin;
      const double middle = dot(toCenter, ray.direction); // where the ray is nearest to the centre
      const double miss = length(toCenter - middle * ray.direction);
      const double half = std::sqrt(std::max(0.0, (this->Radius - miss) * (this->Radius + miss)));
      const double distance = middle - half;
      const double pixel = camera.footprint(middle);
      const double cover = this->SmoothLimb ? std::min(1.0, 0.5 + (this->Radius - miss) / pixel)
                                            : (miss <= this->Radius ? 1 : 0);
      if (!(distance >= 0) || !(cover > 0))
      {
        continue;
      }
      const nephoscope::Vector3 up =
        nephoscope::normalized(ray.origin + distance * ray.direction - center);
      const double pixelNorth = camera.footprint(distance) * degreesPerUnit;
      shade.color = this->ColorAt(vtkMath::DegreesFromRadians(std::atan2(up[1], up[0])),
        vtkMath::DegreesFromRadians(std::asin(std::clamp(up[2], -1.0, 1.0))),
        pixelNorth / std::max(std::hypot(up[0], up[1]), 1e-6), pixelNorth);
      nephoscope::RGB light = shade(up, -1.0 * ray.direction);
      for (float& channel : light)
      {
        channel *= static_cast<float>(cover);
      }
      const float depth = cover < 1 ? static_cast<float>(-std::log1p(-cover)) : nephoscope::Opaque;
      tile.add(x, y, { distance, distance, { depth, depth, depth }, light });
    }
  }
}

void vtkCloudGlobe::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Radius: " << this->Radius << '\n';
  os << indent << "Center: " << this->Center[0] << ' ' << this->Center[1] << ' ' << this->Center[2]
     << '\n';
  os << indent << "SmoothLimb: " << this->SmoothLimb << '\n';
}
