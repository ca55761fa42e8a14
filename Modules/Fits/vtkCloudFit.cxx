// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudFit.h"

#include "FitSubjects.h"

#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>

vtkStandardNewMacro(vtkCloudFit);

namespace
{
using nephoscope::Calibration;
using nephoscope::Fit;
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
}

vtkCloudFit::vtkCloudFit()
{
  this->SetNumberOfInputPorts(0);
}

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
  return static_cast<int>(nephoscope::fitSubjects().size());
}

const char* vtkCloudFit::GetSubjectName(int index)
{
  const auto& all = nephoscope::fitSubjects();
  return index >= 0 && index < static_cast<int>(all.size()) ? all[index].name.c_str() : nullptr;
}

int vtkCloudFit::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
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
    fill(vtkTable::GetData(outputVector), nephoscope::runFit(this->Subject, range, progress));
  }
  catch (const nephoscope::FitError& error)
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
     << indent << "Range: " << this->Range[0] << ' ' << this->Range[1] << '\n';
}
