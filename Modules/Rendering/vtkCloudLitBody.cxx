// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudLitBody.h"

#include "SurfaceShade.h"

nephoscope::SurfaceShade vtkCloudLitBody::MakeShade() const
{
  nephoscope::SurfaceShade shade;
  shade.towardSun = nephoscope::normalized(
    nephoscope::Vector3{ this->TowardSun[0], this->TowardSun[1], this->TowardSun[2] });
  for (int i = 0; i < 3; ++i)
  {
    shade.sun[i] = this->SunColor[i];
    shade.sky[i] = this->SkyColor[i];
  }
  shade.ambient = this->Ambient;
  return shade;
}

void vtkCloudLitBody::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto print = [&os, indent](const char* name, const double v[3])
  { os << indent << name << ": " << v[0] << ' ' << v[1] << ' ' << v[2] << '\n'; };
  print("TowardSun", this->TowardSun);
  print("SunColor", this->SunColor);
  print("SkyColor", this->SkyColor);
  os << indent << "Ambient: " << this->Ambient << '\n';
}
