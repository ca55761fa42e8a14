// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudFit.h"

#include "CloudArrays.h"
#include "FitDensity.h"
#include "FitSubjects.h"

#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkRectilinearGrid.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>

vtkStandardNewMacro(vtkCloudFit);

namespace
{
using nephoscope::Calibration;
using nephoscope::Fit;
using nephoscope::FitError;
using nephoscope::FittedParameter;
using nephoscope::RemainingError;

/// Adds columns, a value for each parameter of each fit.
class Columns
{
public:
  Columns(const Calibration& calibration, vtkTable* table)
    : Source(calibration)
    , Table(table)
  {
  }

  template <class Array, class Value>
  void Add(const std::string& name, const Value& value)
  {
    vtkNew<Array> column;
    column->SetName(name.c_str());
    for (const Fit& fit : this->Source.fits)
    {
      for (const FittedParameter& parameter : fit.parameters)
      {
        column->InsertNextValue(value(fit, parameter));
      }
    }
    this->Table->AddColumn(column);
  }

  template <class Value>
  void OfParameter(const char* name, const Value& value)
  {
    this->Add<vtkDoubleArray>(
      name, [&value](const Fit&, const FittedParameter& p) -> double { return value(p); });
  }

  void OfError(const std::string& prefix, RemainingError Fit::*error)
  {
    const auto add = [this, &prefix, error](const char* name, double RemainingError::*part)
    {
      this->Add<vtkDoubleArray>(prefix + name,
        [error, part](const Fit& fit, const FittedParameter&) { return fit.*error.*part; });
    };
    this->Add<vtkIntArray>(prefix + "Cases",
      [error](const Fit& fit, const FittedParameter&) { return (fit.*error).cases; });
    add("Bias", &RemainingError::bias);
    add("RMS", &RemainingError::rms);
    add("Median", &RemainingError::median);
    add("95", &RemainingError::p95);
    add("Max", &RemainingError::max);
  }

  void Covariance()
  {
    std::size_t width = 1;
    for (const Fit& fit : this->Source.fits)
    {
      width = std::max(width, fit.parameters.size());
    }
    vtkNew<vtkDoubleArray> column;
    column->SetName("Covariance");
    column->SetNumberOfComponents(static_cast<int>(width));
    for (const Fit& fit : this->Source.fits)
    {
      const std::size_t n = fit.parameters.size();
      for (std::size_t i = 0; i < n; ++i)
      {
        std::vector<double> row(width, 0.0);
        std::copy_n(fit.covariance.begin() + static_cast<std::ptrdiff_t>(i * n), n, row.begin());
        column->InsertNextTuple(row.data());
      }
    }
    this->Table->AddColumn(column);
  }

private:
  const Calibration& Source;
  vtkTable* Table;
};

std::string joined(const std::vector<std::string>& lines)
{
  std::string text;
  for (const std::string& line : lines)
  {
    text += (text.empty() ? "" : "; ") + line;
  }
  return text;
}

void fill(vtkTable* table, const Calibration& calibration)
{
  Columns columns(calibration, table);
  columns.Add<vtkStringArray>(
    "Fit", [](const Fit& fit, const FittedParameter&) { return fit.name; });
  columns.Add<vtkStringArray>(
    "Parameter", [](const Fit&, const FittedParameter& p) { return p.name; });
  columns.OfParameter("Value", [](const FittedParameter& p) { return p.value; });
  columns.OfParameter("StandardError", [](const FittedParameter& p) { return p.standardError; });
  columns.OfParameter("Lower", [](const FittedParameter& p) { return p.lower; });
  columns.OfParameter("Upper", [](const FittedParameter& p) { return p.upper; });
  columns.OfParameter("AtBound", [](const FittedParameter& p) { return p.atBound; });
  columns.OfParameter("Determined", [](const FittedParameter& p) { return p.determined; });
  columns.Covariance();
  columns.Add<vtkStringArray>(
    "Residual", [](const Fit& fit, const FittedParameter&) { return fit.residual; });
  columns.OfError("Training", &Fit::training);
  columns.OfError("HeldOut", &Fit::heldOut);
  columns.Add<vtkIntArray>(
    "Iterations", [](const Fit& fit, const FittedParameter&) { return fit.iterations; });
  columns.Add<vtkDoubleArray>(
    "Seconds", [](const Fit& fit, const FittedParameter&) { return fit.seconds; });
  columns.Add<vtkStringArray>(
    "Warnings", [](const Fit& fit, const FittedParameter&) { return joined(fit.warnings); });
}

const char* const Density = "density";

/// The coordinates along an axis of an image or a rectilinear grid; none of other data.
std::vector<double> coordinatesOf(vtkDataObject* data, int axis)
{
  std::vector<double> all;
  if (auto* const image = vtkImageData::SafeDownCast(data))
  {
    const int* const extent = image->GetExtent();
    for (int i = extent[2 * axis]; i <= extent[2 * axis + 1]; ++i)
    {
      all.push_back(image->GetOrigin()[axis] + i * image->GetSpacing()[axis]);
    }
  }
  else if (auto* const grid = vtkRectilinearGrid::SafeDownCast(data))
  {
    vtkDataArray* const arrays[] = { grid->GetXCoordinates(), grid->GetYCoordinates(),
      grid->GetZCoordinates() };
    for (vtkIdType i = 0; i < arrays[axis]->GetNumberOfTuples(); ++i)
    {
      all.push_back(arrays[axis]->GetComponent(i, 0));
    }
  }
  return all;
}

std::vector<double> valuesOf(vtkDataArray* array)
{
  std::vector<double> values;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    values.push_back(array->GetComponent(i, 0));
  }
  return values;
}

nephoscope::DensityGrid densityOf(vtkDataObject* input)
{
  auto* const data = vtkDataSet::SafeDownCast(input);
  vtkDataArray* const extinction =
    data ? data->GetPointData()->GetArray(nephoscope::arrays::Extinction) : nullptr;
  std::array<std::vector<double>, 3> coordinates;
  for (int axis = 0; axis < 3; ++axis)
  {
    coordinates[axis] = coordinatesOf(input, axis);
  }
  if (!extinction || extinction->GetNumberOfComponents() != 1 || coordinates[0].empty())
  {
    throw FitError(
      std::string("density needs an input that is a vtkImageData or a vtkRectilinearGrid with "
                  "the point array ") +
      nephoscope::arrays::Extinction + " of one component, 1/m");
  }
  return { coordinates, valuesOf(extinction) };
}

/// Depths that occur, without those of rays that miss all cloud. None without an input.
std::vector<double> depthsOf(vtkDataObject* input)
{
  if (!input)
  {
    return {};
  }
  auto* const table = vtkTable::SafeDownCast(input);
  auto* const column = vtkDataArray::SafeDownCast(
    table && table->GetNumberOfColumns() > 0 ? table->GetColumn(0) : nullptr);
  if (!column || column->GetNumberOfComponents() != 1)
  {
    throw FitError("the input has to be a vtkTable whose first column is optical depths; only "
                   "density takes a grid");
  }
  std::vector<double> depths = valuesOf(column);
  depths.erase(std::remove(depths.begin(), depths.end(), 0.0), depths.end());
  if (depths.empty())
  {
    throw FitError("the input has no optical depth above 0");
  }
  return depths;
}
}

vtkCloudFit::vtkCloudFit() = default;

vtkCloudFit::~vtkCloudFit() = default;

void vtkCloudFit::SetSubject(const char* subject)
{
  const std::string name = subject ? subject : "";
  if (name != this->Subject)
  {
    this->Subject = name;
    this->Modified();
  }
}

int vtkCloudFit::GetNumberOfSubjects()
{
  return static_cast<int>(nephoscope::fitSubjects().size()) + 1;
}

const char* vtkCloudFit::GetSubjectName(int index)
{
  const auto& all = nephoscope::fitSubjects();
  const int count = static_cast<int>(all.size());
  return index >= 0 && index < count ? all[index].name.c_str() : index == count ? Density : nullptr;
}

int vtkCloudFit::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

int vtkCloudFit::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* const input = vtkDataObject::GetData(inputVector[0]);
  std::optional<nephoscope::FitRange> range;
  if (this->Range[0] != 0 || this->Range[1] != 0)
  {
    range = nephoscope::FitRange{ this->Range[0], this->Range[1] };
  }
  const auto progress = [this](double done)
  {
    this->UpdateProgress(done);
    return !this->GetAbortExecute();
  };
  try
  {
    const Calibration calibration = this->Subject == Density
      ? Calibration{ Density, {},
          nephoscope::fitDensity(densityOf(input), { this->Tolerance, this->Terms }, progress) }
      : nephoscope::runFit(this->Subject, range, progress, depthsOf(input));
    fill(vtkTable::GetData(outputVector), calibration);
  }
  catch (const FitError& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

void vtkCloudFit::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Subject: " << this->Subject << '\n'
     << indent << "Range: " << this->Range[0] << ' ' << this->Range[1] << '\n'
     << indent << "Tolerance: " << this->Tolerance << '\n'
     << indent << "Terms: " << this->Terms << '\n';
}
