// SPDX-License-Identifier: BSD-3-Clause
#include "ModelFile.h"

#include "Failure.h"
#include "Messages.h"

#include <CloudArrays.h>
#include <vtkCloudNetCDFReader.h>
#include <vtkPointData.h>
#include <vtkStructuredGrid.h>

#include <cstdlib>
#include <filesystem>

namespace nephoscope::program
{
namespace
{
int geometryOf(const std::string& name)
{
  return name == "map" ? vtkCloudNetCDFReader::Map
    : name == "globe"  ? vtkCloudNetCDFReader::Globe
    : name == "local"  ? vtkCloudNetCDFReader::Local
                       : vtkCloudNetCDFReader::Automatic;
}

/// "0 (2001-01-01T00:00:00) to 3 (2001-01-01T18:00:00)"
std::string stepsOf(vtkCloudNetCDFReader* reader)
{
  const int last = reader->GetNumberOfTimeSteps() - 1;
  const auto step = [reader](int i)
  {
    const std::string label = reader->GetTimeLabel(i); // empty if the axis has no dates
    return std::to_string(i) + (label.empty() ? "" : " (" + label + ")");
  };
  return last < 0 ? "no time axis"
    : last == 0   ? "the one step " + step(0)
                  : "steps " + step(0) + " to " + step(last);
}

int stepOfDate(vtkCloudNetCDFReader* reader, std::string date)
{
  if (date.size() > 10 && date[10] == ' ')
  {
    date[10] = 'T';
  }
  if (!date.empty() && date.back() == 'Z')
  {
    date.pop_back();
  }
  for (int i = 0; i < reader->GetNumberOfTimeSteps(); ++i)
  {
    if (std::string(reader->GetTimeLabel(i)).rfind(date, 0) == 0)
    {
      return i;
    }
  }
  return -1;
}

int stepOfNumber(vtkCloudNetCDFReader* reader, const std::string& text)
{
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (text.empty() || *end)
  {
    return -1;
  }
  const int steps = reader->GetNumberOfTimeSteps();
  for (int i = 0; i < steps; ++i)
  {
    if (reader->GetTimeValue(i) == number)
    {
      return i;
    }
  }
  // A file without a time axis has one step.
  const int index = number >= 0 && number < (steps ? steps : 1) ? static_cast<int>(number) : -1;
  return index == number ? index : -1;
}

/// The step that a text names, or -1.
int stepOf(vtkCloudNetCDFReader* reader, const std::string& text)
{
  const int step = stepOfNumber(reader, text);
  return step < 0 && text.size() >= 4 ? stepOfDate(reader, text) : step;
}
}

vtkSmartPointer<vtkCloudNetCDFReader> openModelFile(const Data& data)
{
  std::error_code error;
  if (!std::filesystem::exists(data.file, error))
  {
    throw Failure(data.file + ": there is no such file");
  }
  auto reader = vtkSmartPointer<vtkCloudNetCDFReader>::New();
  reader->SetFileName(data.file.c_str());
  reader->SetGeometry(geometryOf(data.geometry));
  reader->SetVerticalExaggeration(data.exaggeration.value_or(1));
  for (const auto& [role, name] : data.variables)
  {
    reader->SetVariableName(role.c_str(), name.c_str());
  }
  reader->UpdateInformation();
  Messages::throwIfError(data.file);
  return reader;
}

int timeStepOf(vtkCloudNetCDFReader* reader, const std::optional<std::string>& time)
{
  const int step = time ? stepOf(reader, *time) : 0;
  if (step < 0)
  {
    throw Failure(std::string(reader->GetFileName()) + ": there is no time '" + *time +
      "'; the file has " + stepsOf(reader));
  }
  return step;
}

double timeOf(vtkCloudNetCDFReader* reader, const std::optional<std::string>& time)
{
  const int step = time ? stepOf(reader, *time) : 0;
  if (step >= 0)
  {
    return reader->GetTimeValue(step);
  }
  char* end = nullptr;
  const double number = std::strtod(time->c_str(), &end);
  const double seconds = *end ? reader->GetTimeOfDate(time->c_str()) : number;
  const int last = reader->GetNumberOfTimeSteps() - 1;
  if (!(seconds >= reader->GetTimeValue(0) && seconds <= reader->GetTimeValue(last)))
  {
    throw Failure(std::string(reader->GetFileName()) + ": '" + *time +
      "' is no time within the file's " + stepsOf(reader));
  }
  return seconds;
}

vtkSmartPointer<vtkStructuredGrid> readStep(
  vtkCloudNetCDFReader* reader, const std::optional<std::string>& time, bool needsFraction)
{
  const std::string file = reader->GetFileName();
  const int step = timeStepOf(reader, time);
  const int steps = reader->GetNumberOfTimeSteps();
  if (needsFraction && !reader->GetVariableOfRole(arrays::CloudFraction))
  {
    reader->DiagnoseCloudFractionOn();
  }
  if (steps > 0)
  {
    reader->UpdateTimeStep(reader->GetTimeValue(step));
  }
  else
  {
    reader->Update();
  }
  Messages::throwIfError(file);
  if (steps > 1)
  {
    const std::string label = reader->GetTimeLabel(step); // empty if the axis has no dates
    note(file + ": " + (label.empty() ? "" : "time " + label + ", ") + "step " +
      std::to_string(step) + " of 0 to " + std::to_string(steps - 1));
  }
  for (const std::string& warning : Messages::takeWarnings())
  {
    note("warning: " + warning);
  }
  vtkSmartPointer<vtkStructuredGrid> grid = reader->GetOutput();
  if (needsFraction && !grid->GetPointData()->GetArray(arrays::CloudFraction))
  {
    throw Failure(file +
      ": has no cloud fraction, and none can be diagnosed without condensate, temperature, "
      "humidity and pressure; name one with --variable CloudFraction=NAME");
  }
  if (needsFraction && reader->GetDiagnoseCloudFraction())
  {
    note(file +
      ": has no cloud fraction; diagnosed one from its condensate after Xu and Randall 1996");
  }
  return grid;
}
}
