// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudGradedBackdrop.h"

#include "vtkMath.h"
#include "vtkObjectFactory.h"

#include <cmath>

vtkStandardNewMacro(vtkCloudGradedBackdrop);

void vtkCloudGradedBackdrop::SetColor(double r, double g, double b)
{
  this->SetZenith(r, g, b);
  this->SetHorizon(r, g, b);
  this->SetNadir(r, g, b);
}

void vtkCloudGradedBackdrop::GetRadiance(const double direction[3], float radiance[3]) const
{
  const double norm = vtkMath::Norm(this->Up);
  const double sine = norm > 0 ? vtkMath::Dot(direction, this->Up) / norm : 0;
  const double* const towards = sine >= 0 ? this->Zenith : this->Nadir;
  for (int c = 0; c < 3; ++c)
  {
    radiance[c] =
      static_cast<float>(this->Horizon[c] + std::abs(sine) * (towards[c] - this->Horizon[c]));
  }
}

void vtkCloudGradedBackdrop::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto print = [&os, indent](const char* name, const double v[3])
  { os << indent << name << ": " << v[0] << ' ' << v[1] << ' ' << v[2] << '\n'; };
  print("Up", this->Up);
  print("Zenith", this->Zenith);
  print("Horizon", this->Horizon);
  print("Nadir", this->Nadir);
}
