// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudPlane.h"

#include "Camera.h"
#include "DeepTile.h"
#include "SurfaceShade.h"
#include "vtkObjectFactory.h"

#include <cmath>

vtkStandardNewMacro(vtkCloudPlane);

namespace
{
/// Farther along a ray than this is the horizon.
constexpr double Farthest = 1e15;
}

bool vtkCloudPlane::Prepare(const nephoscope::Camera&)
{
  if (!(this->DegreesPerUnit > 0) || !std::isfinite(this->DegreesPerUnit))
  {
    vtkErrorMacro("DegreesPerUnit " << this->DegreesPerUnit << " is not a number above 0.");
    return false;
  }
  if (!(this->Bounds[0] <= this->Bounds[1] && this->Bounds[2] <= this->Bounds[3]))
  {
    vtkErrorMacro("Bounds " << this->Bounds[0] << ' ' << this->Bounds[1] << ' ' << this->Bounds[2]
                            << ' ' << this->Bounds[3] << " are not in ascending pairs.");
    return false;
  }
  return true;
}

void vtkCloudPlane::Emit(const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const
{
  nephoscope::SurfaceShade shade = this->MakeShade();
  const nephoscope::TileExtent& e = tile.extent();
  for (int y = e.y0; y < e.y0 + e.height; ++y)
  {
    for (int x = e.x0; x < e.x0 + e.width; ++x)
    {
      const nephoscope::Ray ray = camera.ray(x + 0.5, y + 0.5);
      const double distance = (this->Height - ray.origin[2]) / ray.direction[2];
      if (!(distance >= 0 && distance < Farthest))
      {
        continue;
      }
      const nephoscope::Vector3 at = ray.origin + distance * ray.direction;
      if (at[0] < this->Bounds[0] || at[0] > this->Bounds[1] || at[1] < this->Bounds[2] ||
        at[1] > this->Bounds[3])
      {
        continue;
      }
      const double pixel = camera.footprint(distance) * this->DegreesPerUnit;
      shade.color =
        this->ColorAt(at[0] * this->DegreesPerUnit, at[1] * this->DegreesPerUnit, pixel, pixel);
      const nephoscope::Vector3 side{ 0, 0, ray.direction[2] < 0 ? 1.0 : -1.0 };
      tile.add(x, y,
        { distance, distance, { nephoscope::Opaque, nephoscope::Opaque, nephoscope::Opaque },
          shade(side, -1.0 * ray.direction) });
    }
  }
}

void vtkCloudPlane::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Height: " << this->Height << '\n';
  os << indent << "Bounds: " << this->Bounds[0] << ' ' << this->Bounds[1] << ' ' << this->Bounds[2]
     << ' ' << this->Bounds[3] << '\n';
  os << indent << "DegreesPerUnit: " << this->DegreesPerUnit << '\n';
}
