// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudGround.h"

#include "LandMask.h"
#include "Vector3.h"

#include <algorithm>
#include <cmath>

namespace
{
using nephoscope::Vector3;

Vector3 mixed(const Vector3& a, const double b[3], double share)
{
  return { a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]),
    a[2] + share * (b[2] - a[2]) };
}

/// How much of a pixel a line covers that is as wide as the pixel.
double lineCover(double distance, double pixel)
{
  return pixel > 0 ? std::max(0.0, 1 - std::abs(distance) / pixel) : 0;
}

double graticuleCover(
  double longitude, double latitude, double spacing, double pixelEast, double pixelNorth)
{
  const double meridian = longitude - spacing * std::round(longitude / spacing);
  const double parallel = latitude - spacing * std::round(latitude / spacing);
  return std::max(lineCover(meridian, pixelEast), lineCover(parallel, pixelNorth));
}
}

vtkCloudGround::vtkCloudGround()
{
  this->SetNumberOfInputPorts(0);
}

Vector3 vtkCloudGround::ColorAt(
  double longitude, double latitude, double pixelEast, double pixelNorth) const
{
  Vector3 color{ this->SeaColor[0], this->SeaColor[1], this->SeaColor[2] };
  if (this->Land)
  {
    const double land = nephoscope::LandMask::earth().landAt(longitude, latitude, pixelNorth);
    color = mixed(color, this->LandColor, land);
    color = mixed(color, this->LineColor, this->CoastLines ? 4 * land * (1 - land) : 0);
  }
  if (this->Graticule > 0)
  {
    color = mixed(color, this->LineColor,
      graticuleCover(longitude, latitude, this->Graticule, pixelEast, pixelNorth));
  }
  return color;
}

void vtkCloudGround::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto print = [&os, indent](const char* name, const double v[3])
  { os << indent << name << ": " << v[0] << ' ' << v[1] << ' ' << v[2] << '\n'; };
  print("SeaColor", this->SeaColor);
  print("LandColor", this->LandColor);
  print("LineColor", this->LineColor);
  os << indent << "Land: " << this->Land << '\n';
  os << indent << "CoastLines: " << this->CoastLines << '\n';
  os << indent << "Graticule: " << this->Graticule << '\n';
}
