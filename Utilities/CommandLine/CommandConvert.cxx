// SPDX-License-Identifier: BSD-3-Clause
// nephoscope convert: a model's file as VTK data.
#include "Commands.h"
#include "Failure.h"
#include "Messages.h"
#include "ModelFile.h"
#include "OutputFile.h"
#include "Progress.h"
#include "Tetrahedra.h"
#include "VDBOutput.h"

#include <CLI/CLI.hpp>
#include <CloudArrays.h>
#include <NumberText.h>
#include <vtkCloudContour.h>
#include <vtkCloudNetCDFReader.h>
#include <vtkPolyData.h>
#include <vtkStructuredGrid.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataObjectWriter.h>
#include <vtkXMLWriter.h>

#include <memory>

namespace nephoscope::program
{
namespace
{
struct ConvertOptions
{
  Data data;
  std::string output;
  double value = 0.15;
  VDBOptions vdb;
};

vtkSmartPointer<vtkDataSet> contourOf(
  vtkStructuredGrid* grid, double value, const std::string& file, Progress& progress)
{
  const vtkNew<vtkCloudContour> contour;
  contour->SetInputData(grid);
  contour->SetValue(0, value);
  progress.watch(contour, "contour");
  contour->Update();
  progress.forget();
  Messages::throwIfError(file);
  if (contour->GetOutput()->GetNumberOfCells() == 0)
  {
    note(file + ": the cloud fraction is " + numberText(value) + " nowhere; the contour is empty");
  }
  return vtkSmartPointer<vtkDataSet>(contour->GetOutput());
}

void write(vtkDataSet* data, const std::string& path)
{
  OutputFile file(path);
  const auto writer = vtkSmartPointer<vtkXMLWriter>::Take(
    vtkXMLDataObjectWriter::NewWriter(data->GetDataObjectType()));
  writer->SetInputData(data);
  writer->SetFileName(file.partial().c_str());
  const int written = writer->Write();
  // Of a full disk VTK's own words say less.
  if (writer->GetErrorCode())
  {
    throw Failure(path + ": cannot be written; is the disk full?");
  }
  Messages::throwIfError(path);
  if (!written)
  {
    throw Failure(path + ": cannot be written");
  }
  file.commit();
}

void runConvert(const ConvertOptions& options)
{
  const std::string kind = extensionOf(options.output);
  if (kind != "vts" && kind != "vtu" && kind != "vtp" && kind != "vdb")
  {
    throw UsageFailure(options.output +
      ": the name must end in .vts (grid), .vtu (tetrahedra), .vtp (contour) or .vdb (voxels)");
  }
  checkWritable(options.output, { options.data.file });
  if (kind == "vdb")
  {
    writeVDB(options.data, options.vdb, options.output);
    return;
  }
  const auto reader = openModelFile(options.data);
  Progress progress;
  progress.watch(reader, "read");
  const auto grid = readStep(reader, options.data.time, kind == "vtp");
  progress.forget();
  if (kind != "vts" && grid->GetDataDimension() < 3)
  {
    throw Failure(options.data.file +
      ": has one column or one level only, and so no cells; .vts can hold its points");
  }
  vtkSmartPointer<vtkDataSet> data = grid;
  if (kind == "vtu")
  {
    data = tetrahedraOf(grid);
  }
  else if (kind == "vtp")
  {
    data = contourOf(grid, options.value, options.data.file, progress);
  }
  write(data, options.output);
}

void addVDBOptions(CLI::App& command, VDBOptions& options)
{
  command
    .add_option("--voxel", options.voxel,
      ".vdb: edge of a voxel, or three X,Y,Z, scene units (metres); default: a 400th of the grid's "
      "longest side")
    ->type_name("SIZE")
    ->delimiter(',')
    ->expected(1, 3)
    ->check(numberFrom(1e-6, 1e9));
  command
    .add_option("--grids", options.grids,
      ".vdb: which of density, liquid, ice, wind, with commas; default: all that can be made")
    ->type_name("NAMES");
  command.add_flag("--half", options.half, ".vdb: 16-bit floats");
  command
    .add_option("--prune", options.prune,
      ".vdb: share of the largest value up to which a voxel counts as empty; default 1e-5")
    ->type_name("SHARE")
    ->check(numberFrom(0, 1));
  command
    .add_option("--to", options.to,
      ".vdb: last time step; with it a file for each step from --time on, OUT_0000.vdb, ...")
    ->type_name("T");
}
}

void addConvert(CLI::App& app)
{
  auto options = std::make_shared<ConvertOptions>();
  CLI::App* const command =
    app.add_subcommand("convert", "Write a time step of a NetCDF file as VTK data or OpenVDB.");
  command->add_option("file", options->data.file, "NetCDF file")->type_name("FILE")->required();
  command
    ->add_option("output", options->output,
      "file to write: .vts the grid, .vtu its cells as tetrahedra, .vtp the contour surface of the "
      "cloud fraction, .vdb sparse voxels of extinction, water and wind")
    ->type_name("OUT.{vts,vtu,vtp,vdb}")
    ->required();
  command
    ->add_option("--value", options->value, "cloud fraction of the contour, 0 to 1; default 0.15")
    ->type_name("V")
    ->check(numberFrom(0, 1));
  addVDBOptions(*command, options->vdb);
  addDataOptions(*command, options->data);
  addThreadsOption(*command);
  command->footer(
    "Examples:\n  nephoscope convert climate.nc clouds.vtp --value 0.15 --time 2001-10-01T06\n"
    "  nephoscope convert climate.nc clouds.vdb --exaggeration 10 --voxel 25000 --half");
  command->callback([options] { runConvert(*options); });
}
}
