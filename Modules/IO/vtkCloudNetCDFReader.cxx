// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudNetCDFReader.h"

#include "CloudArrays.h"
#include "CloudFields.h"
#include "CloudFile.h"
#include "CloudRoles.h"
#include "HorizontalGrid.h"
#include "NumberText.h"
#include "ReadError.h"
#include "SceneLayout.h"
#include "StructuredOutput.h"
#include "VerticalReader.h"

#include <vtkDataArraySelection.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkStringArray.h>
#include <vtkStructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkCloudNetCDFReader);

using namespace nephoscope;

struct vtkCloudNetCDFReader::Internals
{
  std::map<std::string, std::string> Choices;
  vtkNew<vtkDataArraySelection> Kept;

  // What the last RequestInformation learned; null after an error.
  std::unique_ptr<CloudFile> File;
  std::unique_ptr<HorizontalGrid> Horizontal;
  std::unique_ptr<VerticalReader> Vertical;
  SceneOptions Options;
  OutputGrid Output;
  int FileDimensions[3] = { 0, 0, 0 };
  int Dimensions[3] = { 0, 0, 0 };
  std::vector<Role> Roles;
  std::vector<std::string> Labels;
  std::string Units;

  void Clear()
  {
    this->Vertical.reset();
    this->Horizontal.reset();
    this->File.reset();
    this->Roles.clear();
    this->Labels.clear();
    this->Units.clear();
    std::fill_n(this->FileDimensions, 3, 0);
    std::fill_n(this->Dimensions, 3, 0);
  }

  std::map<Role, std::string> RoleChoices() const
  {
    std::map<Role, std::string> choices;
    for (const auto& [name, variable] : this->Choices)
    {
      const Role role = roleOfName(name);
      if (role == Role::Count)
      {
        std::string message = "role '" + name + "' is not known; the roles are ";
        for (int r = 0; r < static_cast<int>(Role::Count); ++r)
        {
          message += r ? ", " : "";
          message += ruleOf(static_cast<Role>(r)).name;
        }
        throw ReadError(message);
      }
      choices[role] = variable;
    }
    return choices;
  }

  void Open(const char* name, const SceneOptions& wanted, bool automatic, bool diagnose)
  {
    this->File = std::make_unique<CloudFile>(name, this->RoleChoices());
    CloudFile& file = *this->File;
    this->Horizontal = std::make_unique<HorizontalGrid>(file);
    this->Vertical = std::make_unique<VerticalReader>(file);
    describeFields(file, diagnose);
    this->Options = wanted;
    if (automatic)
    {
      this->Options.geometry = this->Horizontal->Global ? SceneGeometry::Globe
        : this->Horizontal->Plain                       ? SceneGeometry::Map
                                                        : SceneGeometry::Local;
    }
    this->Output = OutputGrid(file.Grid, *this->Horizontal, this->Options.geometry);
    const std::size_t sizes[3] = { file.Grid.nx, file.Grid.ny, file.Grid.nz };
    for (int axis = 0; axis < 3; ++axis)
    {
      this->FileDimensions[axis] = static_cast<int>(sizes[axis]);
      this->Dimensions[axis] = this->Output.size(axis);
    }
    for (int r = 0; r < static_cast<int>(Role::Count); ++r)
    {
      if (file.find(static_cast<Role>(r)))
      {
        this->Roles.push_back(static_cast<Role>(r));
      }
    }
    for (double time : file.Times)
    {
      this->Labels.push_back(file.HasClock ? file.Clock.label(time) : std::string());
    }
    this->Units = file.HasClock ? file.Clock.units() : std::string();
  }

  /// The block that is asked for, and its points with those of its neighbours. Returns false if there is none.
  bool PieceOf(vtkInformation* info, PointExtent& block, PointExtent& points) const
  {
    using Pipeline = vtkStreamingDemandDrivenPipeline;
    PointExtent asked;
    info->Get(Pipeline::UPDATE_EXTENT(), asked.data());
    const int pieces = std::max(info->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()), 1);
    if (!columnBlock(asked, info->Get(Pipeline::UPDATE_PIECE_NUMBER()), pieces, block))
    {
      return false;
    }
    const bool round = asked[0] == 0 && asked[1] == this->Dimensions[0] - 1;
    const int levels = pieces > 1 ? info->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS()) : 0;
    points = withGhosts(asked, block, levels, round && this->Output.isRing());
    return true;
  }

  /// Adds the arrays that the output can have to those to choose from; what was chosen stays.
  void ListArrays(bool diagnose)
  {
    const CloudFile& file = *this->File;
    const auto add = [this](const char* name, bool there)
    {
      if (there)
      {
        this->Kept->AddArray(name);
      }
    };
    add(arrays::CloudFraction, file.find(Role::CloudFraction) || (diagnose && canDiagnose(file)));
    add(arrays::LiquidWater, file.find(Role::LiquidWater));
    add(arrays::IceWater, file.find(Role::IceWater));
    add(arrays::Wind, file.find(Role::EastwardWind) && file.find(Role::NorthwardWind));
    add(arrays::Pressure, true);
    add(arrays::Temperature, file.find(Role::Temperature) || file.find(Role::PotentialTemperature));
    add(arrays::SpecificHumidity, file.find(Role::SpecificHumidity));
    const RoleVariable* theta = file.find(Role::PotentialTemperature);
    add(arrays::PotentialTemperature, theta && theta->chosen);
  }

  void KeepChosen(vtkStructuredGrid* output) const
  {
    for (int index = 0; index < this->Kept->GetNumberOfArrays(); ++index)
    {
      if (!this->Kept->GetArraySetting(index))
      {
        output->GetPointData()->RemoveArray(this->Kept->GetArrayName(index));
      }
    }
  }

  /// The step nearest to a time. @throws ReadError outside the file's range
  std::size_t StepAt(double time) const
  {
    const std::vector<double>& times = this->File->Times;
    if (times.size() < 2)
    {
      return 0; // a still: any time shows it
    }
    const double slack = 1e-6 * (times.back() - times.front());
    if (!(time >= times.front() - slack && time <= times.back() + slack))
    {
      throw ReadError("time " + numberText(time, 10) + " s is out of range; the file has " +
        numberText(times.front(), 10) + " to " + numberText(times.back(), 10) + " " + this->Units);
    }
    const auto after = std::lower_bound(times.begin(), times.end(), time);
    std::size_t step = static_cast<std::size_t>(after - times.begin());
    step = std::min(step, times.size() - 1);
    return step > 0 && time - times[step - 1] < times[step] - time ? step - 1 : step;
  }
};

vtkCloudNetCDFReader::vtkCloudNetCDFReader()
  : FileName(nullptr)
  , Geometry(Automatic)
  , MapUnits(Metres)
  , VerticalExaggeration(1)
  , DiagnoseCloudFraction(false)
  , Internal(new Internals)
{
  this->SetNumberOfInputPorts(0);
}

vtkCloudNetCDFReader::~vtkCloudNetCDFReader()
{
  this->SetFileName(nullptr);
}

void vtkCloudNetCDFReader::SetVariableName(const char* role, const char* name)
{
  if (!role)
  {
    return;
  }
  const std::string value = name ? name : "";
  const auto found = this->Internal->Choices.find(role);
  if (found == this->Internal->Choices.end() || found->second != value)
  {
    this->Internal->Choices[role] = value;
    this->Modified();
  }
}

const char* vtkCloudNetCDFReader::GetVariableName(const char* role)
{
  const auto found = this->Internal->Choices.find(role ? role : "");
  return found == this->Internal->Choices.end() ? nullptr : found->second.c_str();
}

void vtkCloudNetCDFReader::ClearVariableNames()
{
  if (!this->Internal->Choices.empty())
  {
    this->Internal->Choices.clear();
    this->Modified();
  }
}

int vtkCloudNetCDFReader::GetNumberOfKnownRoles()
{
  return static_cast<int>(Role::Count);
}

const char* vtkCloudNetCDFReader::GetKnownRole(int index)
{
  return index >= 0 && index < GetNumberOfKnownRoles() ? ruleOf(static_cast<Role>(index)).name
                                                       : nullptr;
}

int vtkCloudNetCDFReader::GetNumberOfPointArrays()
{
  return this->Internal->Kept->GetNumberOfArrays();
}

const char* vtkCloudNetCDFReader::GetPointArrayName(int index)
{
  return this->Internal->Kept->GetArrayName(index);
}

int vtkCloudNetCDFReader::GetPointArrayStatus(const char* name)
{
  return this->Internal->Kept->ArrayIsEnabled(name);
}

void vtkCloudNetCDFReader::SetPointArrayStatus(const char* name, int keep)
{
  const vtkMTimeType before = this->Internal->Kept->GetMTime();
  this->Internal->Kept->SetArraySetting(name, keep);
  if (this->Internal->Kept->GetMTime() != before)
  {
    this->Modified();
  }
}

int vtkCloudNetCDFReader::CanReadFile(const char* name)
{
  try
  {
    const CloudFile file(name ? name : "", {});
    return 1;
  }
  catch (const std::exception&)
  {
    return 0;
  }
}

int vtkCloudNetCDFReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  Internals& own = *this->Internal;
  own.Clear();
  // Pieces are the reader's own blocks: the pipeline's would divide the levels too, and end at the seam. Said before anything
  // fails, as otherwise the pipeline makes empty pieces, without an error, for all processes but the first.
  vtkInformation* const output = outputs->GetInformationObject(0);
  output->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  if (!this->FileName || !this->FileName[0])
  {
    vtkErrorMacro("no file: SetFileName is needed");
    return 0;
  }
  try
  {
    SceneOptions wanted;
    wanted.geometry = this->Geometry == Globe ? SceneGeometry::Globe
      : this->Geometry == Local               ? SceneGeometry::Local
                                              : SceneGeometry::Map;
    wanted.degrees = this->MapUnits == Degrees;
    wanted.exaggeration = this->VerticalExaggeration;
    own.Open(this->FileName, wanted, this->Geometry == Automatic, this->DiagnoseCloudFraction);
    own.ListArrays(this->DiagnoseCloudFraction);
  }
  catch (const std::exception& error)
  {
    own.Clear();
    vtkErrorMacro("" << this->FileName << ": " << error.what());
    return 0;
  }
  const int whole[6] = { 0, own.Dimensions[0] - 1, 0, own.Dimensions[1] - 1, 0,
    own.Dimensions[2] - 1 };
  output->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), whole, 6);
  const std::vector<double>& times = own.File->Times;
  if (times.empty())
  {
    output->Remove(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
    output->Remove(vtkStreamingDemandDrivenPipeline::TIME_RANGE());
  }
  else
  {
    const double range[2] = { times.front(), times.back() };
    output->Set(
      vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
    output->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
  }
  return 1;
}

int vtkCloudNetCDFReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  Internals& own = *this->Internal;
  vtkInformation* info = outputs->GetInformationObject(0);
  vtkStructuredGrid* output = vtkStructuredGrid::GetData(info);
  if (!own.File)
  {
    return 0; // RequestInformation has said why
  }
  try
  {
    CloudFile& file = *own.File;
    PointExtent block;
    PointExtent points;
    if (!own.PieceOf(info, block, points))
    {
      output->Initialize(); // more pieces than columns
      return 1;
    }
    const int* const extent = points.data();
    const bool timed = info->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP());
    const std::size_t step =
      timed ? own.StepAt(info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP())) : 0;
    const Region region = own.Output.region(extent, step);
    const CloudFields fields = readFields(file, *own.Vertical, region, this->DiagnoseCloudFraction);
    this->UpdateProgress(0.7);
    if (this->GetAbortExecute())
    {
      return 1;
    }
    const SceneLayout layout(*own.Horizontal, file.Grid, own.Options, isGridWind(file));
    own.Output.fill(output, extent, region, fields, layout, file);
    own.KeepChosen(output);
    own.Output.attach(output, *own.Horizontal, layout, file);
    OutputGrid::markGhosts(output, points, block);
    if (!file.Times.empty())
    {
      output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), file.Times[step]);
    }
  }
  catch (const std::exception& error)
  {
    output->Initialize();
    vtkErrorMacro("" << this->FileName << ": " << error.what());
    return 0;
  }
  this->UpdateProgress(1);
  return 1;
}

int* vtkCloudNetCDFReader::GetFileDimensions()
{
  return this->Internal->FileDimensions;
}

int* vtkCloudNetCDFReader::GetDimensions()
{
  return this->Internal->Dimensions;
}

namespace
{
template <class T>
bool within(int index, const T& list)
{
  return index >= 0 && static_cast<std::size_t>(index) < list.size();
}
}

int vtkCloudNetCDFReader::GetNumberOfTimeSteps()
{
  return static_cast<int>(this->Internal->Labels.size());
}

double vtkCloudNetCDFReader::GetTimeValue(int step)
{
  return within(step, this->Internal->Labels)
    ? this->Internal->File->Times[static_cast<std::size_t>(step)]
    : std::numeric_limits<double>::quiet_NaN();
}

const char* vtkCloudNetCDFReader::GetTimeLabel(int step)
{
  return within(step, this->Internal->Labels)
    ? this->Internal->Labels[static_cast<std::size_t>(step)].c_str()
    : nullptr;
}

const char* vtkCloudNetCDFReader::GetTimeUnits()
{
  return this->Internal->Units.c_str();
}

const char* vtkCloudNetCDFReader::GetCalendar()
{
  return this->Internal->File && this->Internal->File->HasClock
    ? this->Internal->File->Clock.calendar()
    : "";
}

double vtkCloudNetCDFReader::GetTimeOfDate(const char* date)
{
  const std::string text = date ? date : "";
  if (this->Internal->File && this->Internal->File->HasClock &&
    text.find_first_not_of("0123456789-:.T Z") == std::string::npos)
  {
    try
    {
      const nephoscope::TimeAxis& clock = this->Internal->File->Clock;
      return clock.secondsTo(nephoscope::TimeAxis("seconds since " + text, clock.calendar()));
    }
    catch (const nephoscope::ReadError&)
    {
      return std::numeric_limits<double>::quiet_NaN();
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

const char* vtkCloudNetCDFReader::GetVerticalCoordinate()
{
  return this->Internal->Vertical ? this->Internal->Vertical->kind().c_str() : "";
}

int vtkCloudNetCDFReader::GetChosenGeometry()
{
  return Map + static_cast<int>(this->Internal->Options.geometry);
}

const char* vtkCloudNetCDFReader::GetChosenGeometryAsString()
{
  return geometryName(this->Internal->Options.geometry);
}

int vtkCloudNetCDFReader::GetNumberOfRoles()
{
  return static_cast<int>(this->Internal->Roles.size());
}

const char* vtkCloudNetCDFReader::GetRoleName(int index)
{
  return within(index, this->Internal->Roles)
    ? ruleOf(this->Internal->Roles[static_cast<std::size_t>(index)]).name
    : nullptr;
}

const char* vtkCloudNetCDFReader::GetVariableOfRole(int index)
{
  return this->GetVariableOfRole(this->GetRoleName(index));
}

const char* vtkCloudNetCDFReader::GetVariableOfRole(const char* role)
{
  const Role known = role ? roleOfName(role) : Role::Count;
  const RoleVariable* found =
    this->Internal->File && known != Role::Count ? this->Internal->File->find(known) : nullptr;
  return found ? found->variable->name.c_str() : nullptr;
}

int vtkCloudNetCDFReader::GetNumberOfDerivations()
{
  return this->Internal->File ? static_cast<int>(this->Internal->File->Derivations.size()) : 0;
}

const char* vtkCloudNetCDFReader::GetDerivation(int index)
{
  return index >= 0 && index < this->GetNumberOfDerivations()
    ? this->Internal->File->Derivations[static_cast<std::size_t>(index)].c_str()
    : nullptr;
}

int vtkCloudNetCDFReader::GetNumberOfWarnings()
{
  return this->Internal->File ? static_cast<int>(this->Internal->File->Warnings.size()) : 0;
}

const char* vtkCloudNetCDFReader::GetWarning(int index)
{
  return index >= 0 && index < this->GetNumberOfWarnings()
    ? this->Internal->File->Warnings[static_cast<std::size_t>(index)].c_str()
    : nullptr;
}

void vtkCloudNetCDFReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n"
     << indent << "Geometry: " << this->Geometry << "\n"
     << indent << "MapUnits: " << this->MapUnits << "\n"
     << indent << "VerticalExaggeration: " << this->VerticalExaggeration << "\n"
     << indent << "DiagnoseCloudFraction: " << this->DiagnoseCloudFraction << "\n";
  for (const auto& [role, name] : this->Internal->Choices)
  {
    os << indent << "Variable of " << role << ": " << name << "\n";
  }
}
