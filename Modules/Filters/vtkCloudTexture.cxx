// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudTexture.h"

#include "CloudArrays.h"
#include "CloudTexture.h"
#include "WholeData.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"

vtkStandardNewMacro(vtkCloudTexture);

namespace
{
/// Where the texture is looked up for each point: at one place, or at two that are cross-faded.
class Places
{
public:
  Places(vtkDataSet* input, double metersPerUnit)
    : Input(input)
    , First(input->GetPointData()->GetArray(nephoscope::arrays::TextureCoordinates))
    , Scale(this->First ? 1 : metersPerUnit)
  {
    vtkDataArray* const weights =
      input->GetFieldData()->GetArray(nephoscope::arrays::TextureWeights);
    if (this->First && weights && weights->GetNumberOfValues() == 2)
    {
      this->Second = input->GetPointData()->GetArray(nephoscope::arrays::OtherTextureCoordinates);
      this->Weight = weights->GetVariantValue(0).ToDouble();
    }
  }

  double value(const nephoscope::CloudTexture& texture, double footprint, vtkIdType id) const
  {
    double x[3];
    this->First ? this->First->GetTuple(id, x) : this->Input->GetPoint(id, x);
    const double meters[3] = { this->Scale * x[0], this->Scale * x[1], this->Scale * x[2] };
    if (!this->Second)
    {
      return texture.value(meters, footprint);
    }
    double y[3];
    this->Second->GetTuple(id, y);
    return texture.blended(meters, y, this->Weight, footprint);
  }

private:
  vtkDataSet* Input;
  vtkDataArray* First;
  double Scale;
  vtkDataArray* Second = nullptr;
  double Weight = 1;
};

void evaluate(const nephoscope::CloudTexture& texture, const Places& places, double footprint,
  vtkFloatArray* opacity)
{
  float* const values = opacity->GetPointer(0);
  vtkSMPTools::For(0, opacity->GetNumberOfTuples(),
    [values, &texture, &places, footprint](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType id = begin; id < end; ++id)
      {
        values[id] = static_cast<float>(texture.opacityOf(places.value(texture, footprint, id)));
      }
    });
}
}

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
  const std::string missing = nephoscope::whatIsMissing(input);
  if (!missing.empty())
  {
    vtkErrorMacro(<< missing);
    return 0;
  }
  vtkPointData* const data = input->GetPointData();
  for (const char* name :
    { nephoscope::arrays::TextureCoordinates, nephoscope::arrays::OtherTextureCoordinates })
  {
    vtkDataArray* const array = data->GetArray(name);
    if (array && array->GetNumberOfComponents() != 3)
    {
      vtkErrorMacro("Point array '" << name << "' has " << array->GetNumberOfComponents()
                                    << " components; give positions, 3, in metres.");
      return 0;
    }
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

  const Places places(input, this->MetersPerUnit);
  vtkNew<vtkFloatArray> opacity;
  opacity->SetName(nephoscope::arrays::Opacity);
  opacity->SetNumberOfTuples(input->GetNumberOfPoints());
  evaluate(nephoscope::CloudTexture(parameters), places, this->SamplingDistance, opacity);
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
