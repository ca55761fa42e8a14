// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file FogBall.h
 * @brief A body whose light is known in closed form.
 */
#ifndef FogBall_h
#define FogBall_h

#include "Camera.h"
#include "DeepTile.h"
#include "vtkCloudBody.h"
#include "vtkObjectFactory.h"

#include <cmath>

/// A uniform ball of glowing fog about the origin.
class FogBall : public vtkCloudBody
{
public:
  static FogBall* New();
  vtkTypeMacro(FogBall, vtkCloudBody);
  double Radius = 1;
  double Extinction = 1;
  double Glow[3] = { 1, 1, 1 };
  bool Drawable = true;

  bool Prepare(const nephoscope::Camera&) override { return this->Drawable; }
  void Emit(const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const override
  {
    const nephoscope::TileExtent& e = tile.extent();
    for (int y = e.y0; y < e.y0 + e.height; ++y)
    {
      for (int x = e.x0; x < e.x0 + e.width; ++x)
      {
        const nephoscope::Ray ray = camera.ray(x + 0.5, y + 0.5);
        const double middle = -dot(ray.origin, ray.direction);
        const double miss2 = dot(ray.origin, ray.origin) - middle * middle;
        const double half2 = this->Radius * this->Radius - miss2;
        if (half2 > 0)
        {
          const double half = std::sqrt(half2);
          const auto tau = static_cast<float>(2 * half * this->Extinction);
          const double light = -std::expm1(-tau);
          tile.add(x, y,
            { middle - half, middle + half, { tau, tau, tau },
              { static_cast<float>(this->Glow[0] * light),
                static_cast<float>(this->Glow[1] * light),
                static_cast<float>(this->Glow[2] * light) } });
        }
      }
    }
  }

protected:
  FogBall() { this->SetNumberOfInputPorts(0); }
};
vtkStandardNewMacro(FogBall);
#endif
