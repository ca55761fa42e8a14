// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudTerrainSource.h"

#include "CloudArrays.h"
#include "FractalNoise.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <cmath>

vtkStandardNewMacro(vtkCloudTerrainSource);

namespace
{
constexpr double MostPoints = 1 << 28;
constexpr double MostWavelengths = 1 << 19; // what FractalHills::row takes, with room

bool isPositive(double number)
{
  return number > 0 && std::isfinite(number);
}
}

vtkCloudTerrainSource::vtkCloudTerrainSource()
{
  this->SetNumberOfInputPorts(0);
}

bool vtkCloudTerrainSource::Validate()
{
  const int* const n = this->Dimensions;
  if (n[0] < 2 || n[1] < 2 || static_cast<double>(n[0]) * n[1] > MostPoints)
  {
    vtkErrorMacro(
      "Dimensions " << n[0] << " x " << n[1]
                    << " are not 2 x 2 to 2^28 points; give others, or a larger Spacing.");
    return false;
  }
  if (!isPositive(this->Spacing) || !isPositive(this->Wavelength))
  {
    vtkErrorMacro("Spacing " << this->Spacing << " and Wavelength " << this->Wavelength
                             << " have to be numbers above 0, metres.");
    return false;
  }
  double origin[3];
  this->GetOrigin(origin);
  for (int axis = 0; axis < 2; ++axis)
  {
    const double end = origin[axis] + (n[axis] - 1) * this->Spacing;
    if (!(std::fmax(std::fabs(origin[axis]), std::fabs(end)) <= MostWavelengths * this->Wavelength))
    {
      vtkErrorMacro("Points lie farther than 2^19 Wavelengths of "
        << this->Wavelength << " m from (0, 0); give another Center, or a longer Wavelength.");
      return false;
    }
  }
  return true;
}

void vtkCloudTerrainSource::GetOrigin(double origin[3]) const
{
  for (int axis = 0; axis < 2; ++axis)
  {
    origin[axis] = this->Center[axis] - 0.5 * (this->Dimensions[axis] - 1) * this->Spacing;
  }
  origin[2] = 0;
}

int vtkCloudTerrainSource::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkInformation* const out = outputs->GetInformationObject(0);
  const int extent[6] = { 0, this->Dimensions[0] - 1, 0, this->Dimensions[1] - 1, 0, 0 };
  const double spacing[3] = { this->Spacing, this->Spacing, 1 };
  double origin[3];
  this->GetOrigin(origin);
  out->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  out->Set(vtkDataObject::SPACING(), spacing, 3);
  out->Set(vtkDataObject::ORIGIN(), origin, 3);
  vtkDataObject::SetPointDataActiveScalarInfo(out, VTK_FLOAT, 1);
  return 1;
}

int vtkCloudTerrainSource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  if (!this->Validate())
  {
    return 0;
  }
  nephoscope::FractalHills hills;
  hills.wavelength = this->Wavelength;
  hills.relief = this->Relief;
  hills.mean = this->Mean;
  hills.gain = this->Gain;
  hills.seed = static_cast<std::uint32_t>(this->Seed);
  double origin[3];
  this->GetOrigin(origin);
  vtkImageData* const image = vtkImageData::GetData(outputs);
  image->SetDimensions(this->Dimensions[0], this->Dimensions[1], 1);
  image->SetSpacing(this->Spacing, this->Spacing, 1);
  image->SetOrigin(origin);
  vtkNew<vtkFloatArray> heights;
  heights->SetName(nephoscope::arrays::Height);
  heights->SetNumberOfTuples(image->GetNumberOfPoints());
  float* const height = heights->GetPointer(0);
  const int across = this->Dimensions[0];
  const double spacing = this->Spacing;
  vtkSMPTools::For(0, this->Dimensions[1],
    [&hills, &origin, height, across, spacing](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType j = begin; j < end; ++j)
      {
        hills.row(origin[0], origin[1] + static_cast<double>(j) * spacing, spacing,
          static_cast<std::size_t>(across), height + j * across);
      }
    });
  image->GetPointData()->SetScalars(heights);
  return 1;
}

void vtkCloudTerrainSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Dimensions: " << this->Dimensions[0] << ' ' << this->Dimensions[1] << '\n';
  os << indent << "Center: " << this->Center[0] << ' ' << this->Center[1] << '\n';
  os << indent << "Spacing: " << this->Spacing << '\n';
  os << indent << "Wavelength: " << this->Wavelength << '\n';
  os << indent << "Relief: " << this->Relief << '\n';
  os << indent << "Mean: " << this->Mean << '\n';
  os << indent << "Gain: " << this->Gain << '\n';
  os << indent << "Seed: " << this->Seed << '\n';
}
