// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudHeightFieldShadow.h"

#include "CloudArrays.h"
#include "HeightFieldInput.h"
#include "HeightFieldShadow.h"
#include "vtkDataObject.h"
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

vtkStandardNewMacro(vtkCloudHeightFieldShadow);

int vtkCloudHeightFieldShadow::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  return 1;
}

int vtkCloudHeightFieldShadow::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkInformation* const out = outputs->GetInformationObject(0);
  const int extent[6] = { 0, this->Dimensions[0] - 1, 0, this->Dimensions[1] - 1, 0, 0 };
  out->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  const double spacing[3] = { this->Spacing, this->Spacing, 1 };
  out->Set(vtkDataObject::SPACING(), spacing, 3);
  vtkDataObject::SetPointDataActiveScalarInfo(out, VTK_FLOAT, 1);
  return 1;
}

int vtkCloudHeightFieldShadow::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const int* const n = this->Dimensions;
  if (n[0] < 2 || n[1] < 2 || static_cast<double>(n[0]) * n[1] > (1 << 28) || !(this->Spacing > 0))
  {
    vtkErrorMacro("Dimensions " << n[0] << " x " << n[1]
                                << " are not 2 x 2 to 2^28 points, or Spacing " << this->Spacing
                                << " is not above 0.");
    return 0;
  }
  nephoscope::HeightFieldShape shape;
  double plane = 0;
  if (!readHeightField(this, inputs, shape, plane))
  {
    return 0;
  }
  vtkImageData* const image = vtkImageData::GetData(outputs);
  image->SetDimensions(n[0], n[1], 1);
  image->SetSpacing(this->Spacing, this->Spacing, 1);
  image->SetOrigin(this->GetFirst(0), this->GetFirst(1), plane);
  vtkNew<vtkFloatArray> shadow;
  shadow->SetName(nephoscope::arrays::SunTransmittance);
  shadow->SetNumberOfTuples(image->GetNumberOfPoints());
  float* const values = shadow->GetPointer(0);
  const nephoscope::HeightField field(shape);
  vtkSMPTools::For(0, n[1],
    [this, &field, values](vtkIdType begin, vtkIdType end)
    {
      nephoscope::HeightFieldShadow rows(field, this->Extinction);
      for (vtkIdType j = begin; j < end; ++j)
      {
        rows.row(this->GetFirst(0), this->GetFirst(1) + static_cast<double>(j) * this->Spacing,
          this->Spacing, static_cast<std::size_t>(this->Dimensions[0]),
          values + j * this->Dimensions[0]);
      }
    });
  image->GetPointData()->SetScalars(shadow);
  return 1;
}

void vtkCloudHeightFieldShadow::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Extinction: " << this->Extinction << '\n';
  os << indent << "Dimensions: " << this->Dimensions[0] << ' ' << this->Dimensions[1] << '\n';
  os << indent << "Center: " << this->Center[0] << ' ' << this->Center[1] << '\n';
  os << indent << "Spacing: " << this->Spacing << '\n';
}
