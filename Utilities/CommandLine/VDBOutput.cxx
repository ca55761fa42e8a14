// SPDX-License-Identifier: BSD-3-Clause
#include "VDBOutput.h"

#include "Failure.h"
#include "Messages.h"
#include "ModelFile.h"
#include "OutputFile.h"
#include "Progress.h"

#include <NumberText.h>
#include <vtkCallbackCommand.h>
#include <vtkCloudNetCDFReader.h>
#ifdef NEPHOSCOPE_OPENVDB
#include <vtkCloudVDBWriter.h>
#endif
#include <vtkStructuredGrid.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <sstream>

namespace nephoscope::program
{
#ifdef NEPHOSCOPE_OPENVDB
namespace
{
/// The time of a step as a text that means it and no other.
std::string exactTime(vtkCloudNetCDFReader* reader, int step)
{
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.17g", reader->GetTimeValue(step));
  return digits;
}

/// clouds.vdb and 7 as clouds_0007.vdb
std::string numbered(const std::string& output, int number)
{
  char digits[16];
  std::snprintf(digits, sizeof digits, "_%04d", number);
  const std::filesystem::path path(output);
  return (path.parent_path() / (path.stem().string() + digits + path.extension().string()))
    .string();
}

void setUp(vtkCloudVDBWriter* writer, const Data& data, const VDBOptions& options)
{
  if (!options.voxel.empty())
  {
    const auto& v = options.voxel;
    writer->SetVoxelSize(v[0], v[v.size() > 1 ? 1 : 0], v[v.size() > 2 ? 2 : 0]);
  }
  std::istringstream names(options.grids);
  for (std::string name; std::getline(names, name, ',');)
  {
    writer->AddGridName(name);
  }
  writer->SetHalf(options.half);
  writer->SetPruningTolerance(options.prune);
  writer->SetSource(std::filesystem::path(data.file).filename().string());
}

void tell(vtkCloudVDBWriter* writer, const std::string& path)
{
  for (int g = 0; g < writer->GetNumberOfGrids(); ++g)
  {
    const double factor = writer->GetMassFactor(g);
    note(path + ": " + writer->GetGridName(g) + ", " +
      std::to_string(writer->GetNumberOfVoxels(g)) + " voxels" +
      (factor > 0 ? ", sampled mass times " + numberText(factor) : ""));
  }
}
}

void writeVDB(const Data& data, const VDBOptions& options, const std::string& output)
{
  if (options.voxel.size() == 2)
  {
    throw UsageFailure("--voxel takes one size or three, X,Y,Z");
  }
  const auto reader = openModelFile(data);
  const int first = timeStepOf(reader, data.time);
  const int last = options.to ? timeStepOf(reader, options.to) : first;
  if (last < first)
  {
    throw UsageFailure("--to " + *options.to + " is before --time; give a later one");
  }
  Progress progress;
  const vtkNew<vtkCloudVDBWriter> writer;
  setUp(writer, data, options);
  const vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { static_cast<vtkCloudVDBWriter*>(caller)->SetAbortExecute(OutputFile::isInterrupted()); });
  writer->AddObserver(vtkCommand::ProgressEvent, stop);
  for (int step = first; step <= last; ++step)
  {
    progress.watch(reader, "read");
    const auto grid = readStep(reader, options.to ? exactTime(reader, step) : data.time, false);
    progress.forget();
    const std::string path = options.to ? numbered(output, step - first) : output;
    OutputFile file(path);
    const char* const label = reader->GetTimeLabel(step);
    writer->SetTime(label ? label : "");
    writer->SetInputData(grid);
    writer->SetFileName(file.partial().c_str());
    progress.watch(writer, "voxels");
    writer->Write();
    progress.forget();
    if (writer->GetErrorCode())
    {
      throw Failure(path + ": cannot be written; is the disk full?");
    }
    Messages::throwIfError(data.file);
    if (OutputFile::isInterrupted())
    {
      return;
    }
    file.commit();
    tell(writer, path);
  }
}
#else
void writeVDB(const Data&, const VDBOptions&, const std::string& output)
{
  throw Failure(output +
    ": this nephoscope was built without OpenVDB; install libopenvdb-dev and build it again");
}
#endif
}
