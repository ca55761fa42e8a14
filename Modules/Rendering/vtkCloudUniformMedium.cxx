// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudUniformMedium.h"

#include "DeepTile.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkCloudUniformMedium);

namespace
{
/// Nothing is seen through this.
constexpr double Thickest = 100;
}

vtkCloudUniformMedium::vtkCloudUniformMedium()
{
  this->SetNumberOfInputPorts(0);
}

bool vtkCloudUniformMedium::Prepare(const nephoscope::Camera&)
{
  for (const double extinction : this->Extinction)
  {
    if (!(extinction >= 0) || !std::isfinite(extinction))
    {
      vtkErrorMacro("Extinction " << extinction << " is not a number from 0 up.");
      return false;
    }
  }
  return true;
}

void vtkCloudUniformMedium::Emit(const nephoscope::Camera&, nephoscope::DeepTile& tile) const
{
  double thinnest = VTK_DOUBLE_MAX;
  for (const double extinction : this->Extinction)
  {
    thinnest = extinction > 0 ? std::min(thinnest, extinction) : thinnest;
  }
  if (thinnest == VTK_DOUBLE_MAX)
  {
    return;
  }
  const double reach = std::min(this->Range, Thickest / thinnest);
  const nephoscope::TileExtent& e = tile.extent();
  for (int y = e.y0; y < e.y0 + e.height; ++y)
  {
    for (int x = e.x0; x < e.x0 + e.width; ++x)
    {
      nephoscope::Segment haze;
      haze.farEnd = std::min<double>(reach, tile.opaqueAt(x, y));
      for (int c = 0; c < 3; ++c)
      {
        const double depth = this->Extinction[c] * haze.farEnd;
        haze.opticalDepth[c] = static_cast<float>(depth);
        haze.radiance[c] = static_cast<float>(-this->Color[c] * std::expm1(-depth));
      }
      tile.add(x, y, haze);
    }
  }
}

void vtkCloudUniformMedium::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Extinction: " << this->Extinction[0] << ' ' << this->Extinction[1] << ' '
     << this->Extinction[2] << '\n';
  os << indent << "Color: " << this->Color[0] << ' ' << this->Color[1] << ' ' << this->Color[2]
     << '\n';
  os << indent << "Range: " << this->Range << '\n';
}
