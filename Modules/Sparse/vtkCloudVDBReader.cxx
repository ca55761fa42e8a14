// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudVDBReader.h"

#include "CloudArrays.h"
#include "VDBFile.h"
#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkCloudVDBReader);

namespace
{
using nephoscope::VDBError;
using nephoscope::VoxelGrid;
namespace arrays = nephoscope::arrays;

void addText(vtkFieldData* data, const std::string& name, const std::string& text)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name.c_str());
  array->InsertNextValue(text);
  data->AddArray(array);
}

void addMetadata(const VoxelGrid& grid, vtkFieldData* data)
{
  for (const auto& [name, text] : grid.metadata.texts)
  {
    addText(data, name, text);
  }
  for (const auto& [name, number] : grid.metadata.numbers)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name.c_str());
    array->InsertNextValue(number);
    data->AddArray(array);
  }
  addText(data, "GridName", grid.name);
}

void makeBricks(const VoxelGrid& grid, vtkPolyData* output)
{
  const auto bricks = static_cast<vtkIdType>(grid.bricks.size());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(bricks);
  vtkNew<vtkIntArray> origins;
  origins->SetName(arrays::VoxelOrigins);
  origins->SetNumberOfComponents(3);
  origins->SetNumberOfTuples(bricks);
  vtkNew<vtkCellArray> vertices;
  const auto& m = grid.indexToWorld;
  for (vtkIdType b = 0; b < bricks; ++b)
  {
    const auto& first = grid.bricks[static_cast<std::size_t>(b)];
    double place[3];
    for (std::size_t c = 0; c < 3; ++c)
    {
      place[c] =
        m[4 * c] * first[0] + m[4 * c + 1] * first[1] + m[4 * c + 2] * first[2] + m[4 * c + 3];
    }
    points->SetPoint(b, place);
    origins->SetTypedTuple(b, first.data());
    vertices->InsertNextCell(1, &b);
  }
  vtkNew<vtkFloatArray> values;
  values->SetName(arrays::VoxelBricks);
  values->SetNumberOfComponents(static_cast<int>(grid.floatsPerBrick()));
  values->SetNumberOfTuples(bricks);
  std::copy(grid.values.begin(), grid.values.end(), values->GetPointer(0));
  vtkNew<vtkDoubleArray> matrix;
  matrix->SetName(arrays::VoxelToScene);
  for (const double entry : m)
  {
    matrix->InsertNextValue(entry);
  }
  output->SetPoints(points);
  output->SetVerts(vertices);
  output->GetPointData()->AddArray(values);
  output->GetPointData()->AddArray(origins);
  output->GetFieldData()->AddArray(matrix);
}

/// Calls visit(index of the voxel, its values) for each voxel that is not 0.
template <class Visit>
void forEachFilled(const VoxelGrid& grid, Visit&& visit)
{
  const auto n = static_cast<std::size_t>(grid.components);
  for (std::size_t b = 0; b < grid.bricks.size(); ++b)
  {
    for (std::size_t v = 0; v < VoxelGrid::Volume; ++v)
    {
      const float* const values = grid.values.data() + b * grid.floatsPerBrick() + n * v;
      if (std::any_of(values, values + n, [](float value) { return value != 0; }))
      {
        const std::array<int, 3> at{ grid.bricks[b][0] + static_cast<int>(v % 8),
          grid.bricks[b][1] + static_cast<int>(v / 8 % 8),
          grid.bricks[b][2] + static_cast<int>(v / 64) };
        visit(at, values);
      }
    }
  }
}

/// The extent of the voxels that are not 0; inverted if there are none.
void findFilled(const VoxelGrid& grid, int extent[6])
{
  const int empty[6] = { 0, -1, 0, -1, 0, -1 };
  std::copy_n(empty, 6, extent);
  bool first = true;
  forEachFilled(grid,
    [extent, &first](const std::array<int, 3>& at, const float*)
    {
      for (std::size_t c = 0; c < 3; ++c)
      {
        extent[2 * c] = first ? at[c] : std::min(extent[2 * c], at[c]);
        extent[2 * c + 1] = first ? at[c] : std::max(extent[2 * c + 1], at[c]);
      }
      first = false;
    });
}

/// Lays the image so that its points are the voxels' centres. Returns false if the voxels are no boxes.
bool placeImage(const VoxelGrid& grid, vtkImageData* image)
{
  const auto& m = grid.indexToWorld;
  double spacing[3];
  double direction[9];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    spacing[axis] = std::hypot(m[axis], m[4 + axis], m[8 + axis]);
    for (std::size_t c = 0; c < 3; ++c)
    {
      direction[3 * c + axis] = m[4 * c + axis] / spacing[axis];
    }
  }
  for (std::size_t a = 0; a < 3; ++a)
  {
    const std::size_t b = (a + 1) % 3;
    const double cosine = direction[a] * direction[b] + direction[3 + a] * direction[3 + b] +
      direction[6 + a] * direction[6 + b];
    if (std::abs(cosine) > 1e-6)
    {
      return false;
    }
  }
  image->SetOrigin(m[3], m[7], m[11]);
  image->SetSpacing(spacing);
  image->SetDirectionMatrix(direction);
  return true;
}
}

vtkCloudVDBReader::vtkCloudVDBReader()
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(1);
}

vtkCloudVDBReader::~vtkCloudVDBReader()
{
  this->SetFileName(nullptr);
}

int vtkCloudVDBReader::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataObject");
  return 1;
}

int vtkCloudVDBReader::RequestDataObject(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkInformation* const info = outputs->GetInformationObject(0);
  vtkDataObject* const old = info->Get(vtkDataObject::DATA_OBJECT());
  const bool image = this->OutputForm == Image;
  if (!old || (vtkImageData::SafeDownCast(old) != nullptr) != image)
  {
    vtkSmartPointer<vtkDataObject> fresh = image
      ? vtkSmartPointer<vtkDataObject>(vtkSmartPointer<vtkImageData>::New())
      : vtkSmartPointer<vtkDataObject>(vtkSmartPointer<vtkPolyData>::New());
    info->Set(vtkDataObject::DATA_OBJECT(), fresh);
  }
  return 1;
}

/// Read the grid unless it is there. Returns false, after vtkErrorMacro, if it cannot be.
bool vtkCloudVDBReader::Load()
{
  if (this->Loaded)
  {
    return true;
  }
  try
  {
    nephoscope::VDBReadResult read =
      nephoscope::readVDB(this->FileName, this->GridName, this->MaximumVoxels);
    for (const std::string& warning : read.warnings)
    {
      vtkWarningMacro(<< warning << ".");
    }
    this->Loaded = std::make_shared<VoxelGrid>(std::move(read.grid));
    return true;
  }
  catch (const VDBError& error)
  {
    vtkErrorMacro(<< error.what() << ".");
  }
  catch (const std::bad_alloc&)
  {
    vtkErrorMacro(<< this->FileName
                  << ": there is not enough memory for its voxels; resample it to larger ones.");
  }
  return false;
}

/// An image's extent is known only once the tree has been read, so that it is read here; bricks wait for RequestData.
int vtkCloudVDBReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  this->Loaded.reset();
  vtkInformation* const output = outputs->GetInformationObject(0);
  // Said before anything fails, as otherwise only the process of the first piece has an error.
  output->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  if (!this->FileName || !*this->FileName)
  {
    vtkErrorMacro("There is no name of a file to read; set FileName.");
    return 0;
  }
  if (this->OutputForm == Image)
  {
    int extent[6];
    if (!this->Load() || !this->FindExtent(extent))
    {
      return 0;
    }
    output->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
    output->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
    output->Remove(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST()); // the pipeline makes blocks
  }
  return 1;
}

int vtkCloudVDBReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkDataObject* const output = vtkDataObject::GetData(outputs);
  output->Initialize();
  if (!this->Load())
  {
    return 0;
  }
  const auto grid = std::move(this->Loaded);
  if (auto* const image = vtkImageData::SafeDownCast(output))
  {
    const int* const wanted =
      outputs->GetInformationObject(0)->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT());
    if (!this->FillImage(*grid, wanted, image))
    {
      return 0;
    }
  }
  else
  {
    makeBricks(*grid, vtkPolyData::SafeDownCast(output));
  }
  addMetadata(*grid, output->GetFieldData());
  return 1;
}

bool vtkCloudVDBReader::FindExtent(int extent[6])
{
  findFilled(*this->Loaded, extent);
  double points = 1;
  for (int c = 0; c < 3; ++c)
  {
    points *= 1.0 + extent[2 * c + 1] - static_cast<double>(extent[2 * c]);
  }
  if (points > this->MaximumVoxels)
  {
    vtkErrorMacro(<< this->FileName << ": an image of the grid '" << this->Loaded->name
                  << "' would have " << static_cast<long long>(points) << " points, more than the "
                  << static_cast<long long>(this->MaximumVoxels)
                  << " allowed; read it as bricks, or raise MaximumVoxels.");
    return false;
  }
  return true;
}

bool vtkCloudVDBReader::FillImage(const VoxelGrid& grid, const int extent[6], vtkImageData* image)
{
  if (extent[0] > extent[1])
  {
    return true;
  }
  if (!placeImage(grid, image))
  {
    vtkErrorMacro(<< this->FileName << ": the grid '" << grid.name
                  << "' has a transform with shear, which no image has; read it as bricks.");
    return false;
  }
  image->SetExtent(extent[0], extent[1], extent[2], extent[3], extent[4], extent[5]);
  vtkNew<vtkFloatArray> array;
  array->SetName(grid.name.c_str());
  array->SetNumberOfComponents(grid.components);
  array->SetNumberOfTuples(image->GetNumberOfPoints());
  array->Fill(0);
  forEachFilled(grid,
    [image, extent, &array](const std::array<int, 3>& at, const float* values)
    {
      int place[3] = { at[0], at[1], at[2] };
      bool inside = true;
      for (int c = 0; c < 3; ++c)
      {
        inside = inside && place[c] >= extent[2 * c] && place[c] <= extent[2 * c + 1];
      }
      if (inside)
      {
        array->SetTypedTuple(image->ComputePointId(place), values);
      }
    });
  image->GetPointData()->SetScalars(array);
  return true;
}

void vtkCloudVDBReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << '\n';
  os << indent << "GridName: " << this->GridName << '\n';
  os << indent << "OutputForm: " << (this->OutputForm == Image ? "Image" : "Bricks") << '\n';
  os << indent << "MaximumVoxels: " << this->MaximumVoxels << '\n';
}
