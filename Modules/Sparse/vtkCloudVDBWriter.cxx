// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudVDBWriter.h"

#include "CloudArrays.h"
#include "NumberText.h"
#include "StructuredVoxels.h"
#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"
#include "vtkStructuredGrid.h"

#include <algorithm>
#include <filesystem>
#include <unistd.h>

vtkStandardNewMacro(vtkCloudVDBWriter);

namespace
{
using nephoscope::VDBError;

constexpr double Sampling = 0.6; // share of the time

/// Another name in the same folder, whose file is removed unless it was renamed.
class Beside
{
public:
  explicit Beside(const std::string& path)
    : Path(path)
    , Partial(std::filesystem::path(path).parent_path() /
        (".nephoscope." + std::to_string(::getpid()) + ".part.vdb"))
  {
  }
  ~Beside()
  {
    std::error_code ignored;
    std::filesystem::remove(this->Partial, ignored);
  }
  Beside(const Beside&) = delete;
  void operator=(const Beside&) = delete;

  std::string partial() const { return this->Partial.string(); }
  void commit() const
  {
    std::error_code error;
    std::filesystem::rename(this->Partial, this->Path, error);
    if (error)
    {
      throw VDBError(this->Path.string() + ": cannot be written: " + error.message());
    }
  }

private:
  std::filesystem::path Path;
  std::filesystem::path Partial;
};

void takeFieldData(vtkFieldData* from, nephoscope::VoxelMetadata& to)
{
  using namespace nephoscope::arrays;
  for (const char* const name : { Geometry, Projection })
  {
    auto* const text = vtkStringArray::SafeDownCast(from->GetAbstractArray(name));
    if (text && text->GetNumberOfValues() > 0)
    {
      to.texts[name] = text->GetValue(0);
    }
  }
  for (const char* const name : { PlanetRadius, HeightScale })
  {
    vtkDataArray* const number = from->GetArray(name);
    if (number && number->GetNumberOfValues() > 0)
    {
      to.numbers[name] = number->GetComponent(0, 0);
    }
  }
}

/// The edges that were asked for; none is a 400th of the longest side.
std::array<double, 3> voxelSizeOf(const double given[3], vtkDataSet* data)
{
  if (given[0] > 0 && given[1] > 0 && given[2] > 0)
  {
    return { given[0], given[1], given[2] };
  }
  if (given[0] != 0 || given[1] != 0 || given[2] != 0)
  {
    throw VDBError("The voxel size " + nephoscope::numberText(given[0]) + " x " +
      nephoscope::numberText(given[1]) + " x " + nephoscope::numberText(given[2]) +
      " has to be above 0");
  }
  double bounds[6];
  data->GetBounds(bounds);
  const double longest =
    std::max({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
  if (!(longest > 0))
  {
    throw VDBError("The grid has no extent; give one with cells");
  }
  return { longest / 400, longest / 400, longest / 400 };
}
}

vtkCloudVDBWriter::vtkCloudVDBWriter()
{
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(0);
}

vtkCloudVDBWriter::~vtkCloudVDBWriter()
{
  this->SetFileName(nullptr);
}

void vtkCloudVDBWriter::SetInputData(vtkDataObject* data)
{
  this->SetInputDataObject(0, data);
}

void vtkCloudVDBWriter::AddGridName(const std::string& name)
{
  this->GridNames.push_back(name);
  this->Modified();
}

void vtkCloudVDBWriter::ClearGridNames()
{
  this->GridNames.clear();
  this->Modified();
}

int vtkCloudVDBWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkStructuredGrid");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkCloudVDBWriter::Write()
{
  this->Written = false;
  if (this->GetNumberOfInputConnections(0) < 1)
  {
    vtkErrorMacro("There is no input to write; connect a grid or an image.");
    return 0;
  }
  this->Modified(); // a file that was removed is written again
  this->UpdateWholeExtent();
  return this->Written ? 1 : 0;
}

vtkTypeBool vtkCloudVDBWriter::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (!request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    return this->Superclass::ProcessRequest(request, inputs, outputs);
  }
  try
  {
    this->WriteData(vtkDataObject::GetData(inputs[0]));
  }
  catch (const VDBError& error)
  {
    vtkErrorMacro(<< error.what() << ".");
    return 0;
  }
  catch (const std::bad_alloc&)
  {
    vtkErrorMacro("There is not enough memory for the voxels of "
      << this->FileName << "; choose larger ones, or fewer grids.");
    return 0;
  }
  this->Written = !this->GetAbortExecute();
  return 1;
}

std::vector<nephoscope::FogGrid> vtkCloudVDBWriter::MakeGrids(vtkDataObject* data)
{
  using namespace nephoscope;
  VoxelOrder order;
  order.names = this->GridNames;
  order.tolerance = this->PruningTolerance;
  order.maximumVoxels = this->MaximumVoxels;
  order.liquidRadius = this->LiquidRadius;
  order.iceRadius = this->IceRadius;
  order.fullCoverExtinction = this->FullCoverExtinction;
  if (auto* const image = vtkImageData::SafeDownCast(data))
  {
    return voxelsOf(image, order);
  }
  auto* const grid = vtkStructuredGrid::SafeDownCast(data);
  order.voxelSize = voxelSizeOf(this->VoxelSize, grid);
  return voxelsOf(grid, order,
    [this](double done)
    {
      this->UpdateProgress(Sampling * done);
      return !this->GetAbortExecute();
    });
}

void vtkCloudVDBWriter::WriteData(vtkDataObject* data)
{
  using namespace nephoscope;
  if (!this->FileName || !*this->FileName)
  {
    throw VDBError("There is no name of a file to write; set FileName");
  }
  std::vector<FogGrid> grids = this->MakeGrids(data);
  if (this->GetAbortExecute())
  {
    return;
  }
  VoxelMetadata about;
  about.texts["creator"] = "Nephoscope";
  takeFieldData(data->GetFieldData(), about);
  for (const auto& [key, text] :
    { std::make_pair("Source", this->Source), std::make_pair("Time", this->Time) })
  {
    if (!text.empty())
    {
      about.texts[key] = text;
    }
  }
  this->Grids.clear();
  for (const FogGrid& grid : grids)
  {
    const auto number = [&grid](const char* key)
    {
      const auto found = grid.metadata.numbers.find(key);
      return found == grid.metadata.numbers.end() ? 0 : found->second;
    };
    this->Grids.push_back({ grid.name(), static_cast<vtkIdType>(grid.voxels()), number("mass"),
      number("mass_factor") });
  }
  this->SetErrorCode(vtkErrorCode::CannotOpenFileError);
  const Beside file(this->FileName);
  const bool whole = writeVDB(file.partial(), grids, this->Half, about,
    [this](double done)
    {
      this->UpdateProgress(Sampling + (1 - Sampling) * done);
      return !this->GetAbortExecute();
    });
  if (whole)
  {
    file.commit();
    this->UpdateProgress(1);
  }
  this->SetErrorCode(vtkErrorCode::NoError);
}

int vtkCloudVDBWriter::GetNumberOfGrids() const
{
  return static_cast<int>(this->Grids.size());
}

std::string vtkCloudVDBWriter::GetGridName(int grid) const
{
  return this->Grids.at(static_cast<std::size_t>(grid)).Name;
}

vtkIdType vtkCloudVDBWriter::GetNumberOfVoxels(int grid) const
{
  return this->Grids.at(static_cast<std::size_t>(grid)).Voxels;
}

double vtkCloudVDBWriter::GetMass(int grid) const
{
  return this->Grids.at(static_cast<std::size_t>(grid)).Mass;
}

double vtkCloudVDBWriter::GetMassFactor(int grid) const
{
  return this->Grids.at(static_cast<std::size_t>(grid)).Factor;
}

void vtkCloudVDBWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << '\n';
  os << indent << "VoxelSize: " << this->VoxelSize[0] << ' ' << this->VoxelSize[1] << ' '
     << this->VoxelSize[2] << '\n';
  os << indent << "Half: " << this->Half << '\n';
  os << indent << "PruningTolerance: " << this->PruningTolerance << '\n';
  os << indent << "MaximumVoxels: " << this->MaximumVoxels << '\n';
}
