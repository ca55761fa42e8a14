// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudHeightFieldVolume.h"

#include "CloudArrays.h"
#include "HeightFieldInput.h"
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

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkCloudHeightFieldVolume);

namespace
{
/// The voxels of an image's columns.
class ColumnVoxels
{
public:
  ColumnVoxels(const nephoscope::HeightField& field, double plane, double extinction,
    vtkImageData* image, float* values)
    : Field(field)
    , Plane(plane)
    , Extinction(extinction)
    , Values(values)
  {
    image->GetDimensions(this->Size);
    image->GetOrigin(this->Origin);
    image->GetSpacing(this->Spacing);
  }

  vtkIdType GetNumberOfColumns() const
  {
    return static_cast<vtkIdType>(this->Size[0]) * this->Size[1];
  }

  void operator()(vtkIdType begin, vtkIdType end) const
  {
    for (vtkIdType column = begin; column < end; ++column)
    {
      this->Make(column);
    }
  }

private:
  void Make(vtkIdType column) const
  {
    const vtkIdType row = column / this->Size[0];
    const double x =
      this->Origin[0] + this->Spacing[0] * static_cast<double>(column % this->Size[0]);
    const double y = this->Origin[1] + this->Spacing[1] * static_cast<double>(row);
    const double f = this->Field.value(x, y);
    const bool isCloud = f > 0;
    // Heights in layers: voxel k is from k to k + 1.
    const double bottom = isCloud ? this->GetLayer(this->Field.bottom(f)) : 0;
    const double top = isCloud ? this->GetLayer(this->Field.top(f)) : 0;
    for (int k = 0; k < this->Size[2]; ++k)
    {
      const double share = std::min(k + 1.0, top) - std::max<double>(k, bottom);
      this->Values[k * this->GetNumberOfColumns() + column] =
        static_cast<float>(this->Extinction * std::max(0.0, share));
    }
  }

  double GetLayer(double height) const
  {
    return (this->Plane + height - this->Origin[2]) / this->Spacing[2] + 0.5;
  }

  const nephoscope::HeightField& Field;
  double Plane;
  double Extinction;
  float* Values;
  int Size[3];
  double Origin[3];
  double Spacing[3];
};
}

int vtkCloudHeightFieldVolume::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  return 1;
}

void vtkCloudHeightFieldVolume::GetGrid(double origin[3], double spacing[3]) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const double* const bounds = this->Bounds + 2 * axis;
    origin[axis] = bounds[0];
    spacing[axis] = (bounds[1] - bounds[0]) / (std::max(this->Dimensions[axis], 2) - 1);
  }
}

int vtkCloudHeightFieldVolume::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkInformation* const out = outputs->GetInformationObject(0);
  int extent[6] = { 0 };
  for (int axis = 0; axis < 3; ++axis)
  {
    extent[2 * axis + 1] = std::max(this->Dimensions[axis], 0) - 1;
  }
  double origin[3];
  double spacing[3];
  this->GetGrid(origin, spacing);
  out->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  out->Set(vtkDataObject::SPACING(), spacing, 3);
  out->Set(vtkDataObject::ORIGIN(), origin, 3);
  vtkDataObject::SetPointDataActiveScalarInfo(out, VTK_FLOAT, 1);
  return 1;
}

bool vtkCloudHeightFieldVolume::Validate()
{
  const int* const n = this->Dimensions;
  if (*std::min_element(n, n + 3) < 2 || static_cast<double>(n[0]) * n[1] * n[2] > (1 << 28))
  {
    vtkErrorMacro("Dimensions " << n[0] << " x " << n[1] << " x " << n[2]
                                << " are not 2 x 2 x 2 to 2^28 points; give others.");
    return false;
  }
  double origin[3];
  double spacing[3];
  this->GetGrid(origin, spacing);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(spacing[axis] > 0) || !std::isfinite(spacing[axis]))
    {
      vtkErrorMacro("Bounds " << this->Bounds[2 * axis] << " to " << this->Bounds[2 * axis + 1]
                              << " of axis "
                              << "xyz"[axis] << " have to be numbers, the second above the first.");
      return false;
    }
  }
  if (!(this->Extinction >= 0 && this->Extinction <= 1e9))
  {
    vtkErrorMacro("Extinction " << this->Extinction << " has to be 0 to 1e9, 1/m.");
    return false;
  }
  return true;
}

int vtkCloudHeightFieldVolume::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  nephoscope::HeightFieldShape shape;
  double plane = 0;
  if (!this->Validate() || !readHeightField(this, inputs, shape, plane))
  {
    return 0;
  }
  double origin[3];
  double spacing[3];
  this->GetGrid(origin, spacing);
  vtkImageData* const image = vtkImageData::GetData(outputs);
  image->SetDimensions(this->Dimensions);
  image->SetOrigin(origin);
  image->SetSpacing(spacing);
  vtkNew<vtkFloatArray> extinction;
  extinction->SetName(nephoscope::arrays::Extinction);
  extinction->SetNumberOfTuples(image->GetNumberOfPoints());
  const nephoscope::HeightField field(shape);
  const ColumnVoxels voxels(field, plane, this->Extinction, image, extinction->GetPointer(0));
  constexpr int Parts = 32; // between which progress is told
  for (int part = 0; part < Parts; ++part)
  {
    const vtkIdType columns = voxels.GetNumberOfColumns();
    vtkSMPTools::For(columns * part / Parts, columns * (part + 1) / Parts, voxels);
    this->UpdateProgress(static_cast<double>(part + 1) / Parts);
    if (this->GetAbortExecute())
    {
      image->Initialize();
      return 1;
    }
  }
  image->GetPointData()->SetScalars(extinction);
  return 1;
}

void vtkCloudHeightFieldVolume::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Extinction: " << this->Extinction << '\n';
  os << indent << "Dimensions: " << this->Dimensions[0] << ' ' << this->Dimensions[1] << ' '
     << this->Dimensions[2] << '\n';
  os << indent << "Bounds:";
  for (const double bound : this->Bounds)
  {
    os << ' ' << bound;
  }
  os << '\n';
}
