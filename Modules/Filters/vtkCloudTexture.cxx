// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudTexture.h"

#include "CloudArrays.h"
#include "CloudTexture.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"

vtkStandardNewMacro(vtkCloudTexture);

vtkCloudTexture::vtkCloudTexture()
{
  // The kernel's defaults are the filter's.
  const nephoscope::CloudTextureParameters standard;
  this->Wavelength = standard.wavelength;
  this->Octaves = standard.octaves;
  this->AmplitudeRatio = standard.amplitudeRatio;
  this->Offset = standard.offset;
  this->Threshold = standard.threshold;
  this->Range = standard.range;
  this->Turned = standard.turned;
  this->Seed = standard.seed;
}

vtkCloudTexture::~vtkCloudTexture() = default;

int vtkCloudTexture::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataSet* input = vtkDataSet::GetData(inputVector[0]);
  vtkDataSet* output = vtkDataSet::GetData(outputVector);
  if (!input || !output)
  {
    return 1;
  }
  vtkDataArray* coordinates =
    input->GetPointData()->GetArray(nephoscope::arrays::TextureCoordinates);
  if (coordinates && coordinates->GetNumberOfComponents() != 3)
  {
    vtkErrorMacro("Point array '" << nephoscope::arrays::TextureCoordinates << "' has "
                                  << coordinates->GetNumberOfComponents()
                                  << " components; give positions, 3, in metres.");
    return 0;
  }
  output->ShallowCopy(input);

  nephoscope::CloudTextureParameters parameters;
  parameters.wavelength = this->Wavelength;
  parameters.octaves = this->Octaves;
  parameters.amplitudeRatio = this->AmplitudeRatio;
  parameters.offset = this->Offset;
  parameters.threshold = this->Threshold;
  parameters.rimThreshold = this->Threshold;
  parameters.range = this->Range;
  parameters.turned = this->Turned;
  parameters.seed = this->Seed;
  const nephoscope::CloudTexture texture(parameters);

  const vtkIdType points = input->GetNumberOfPoints();
  vtkNew<vtkFloatArray> opacity;
  opacity->SetName(nephoscope::arrays::Opacity);
  opacity->SetNumberOfTuples(points);
  float* values = opacity->GetPointer(0);
  const double scale = coordinates ? 1 : this->MetersPerUnit;
  const double footprint = this->SamplingDistance;
  vtkSMPTools::For(0, points,
    [input, coordinates, values, &texture, scale, footprint](vtkIdType begin, vtkIdType end)
    {
      double x[3];
      for (vtkIdType id = begin; id < end; ++id)
      {
        coordinates ? coordinates->GetTuple(id, x) : input->GetPoint(id, x);
        const double meters[3] = { scale * x[0], scale * x[1], scale * x[2] };
        values[id] = static_cast<float>(texture.opacity(meters, footprint));
      }
    });
  output->GetPointData()->AddArray(opacity);
  return 1;
}

void vtkCloudTexture::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Wavelength: " << this->Wavelength << '\n'
     << indent << "Octaves: " << this->Octaves << '\n'
     << indent << "AmplitudeRatio: " << this->AmplitudeRatio << '\n'
     << indent << "Offset: " << this->Offset << '\n'
     << indent << "Threshold: " << this->Threshold << '\n'
     << indent << "Range: " << this->Range << '\n'
     << indent << "Turned: " << this->Turned << '\n'
     << indent << "Seed: " << this->Seed << '\n'
     << indent << "SamplingDistance: " << this->SamplingDistance << '\n'
     << indent << "MetersPerUnit: " << this->MetersPerUnit << '\n';
}
