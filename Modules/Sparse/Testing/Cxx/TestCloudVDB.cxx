// SPDX-License-Identifier: BSD-3-Clause
// Clouds to OpenVDB and back: values, places, metadata, mass; and what OpenVDB's own tool says of the file.
#include "Optics.h"
#include "SparseTesting.h"
#include "vtkCallbackCommand.h"
#include "vtkCloudVDBWriter.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkStringArray.h"
#include "vtkStructuredGrid.h"

#include <gtest/gtest.h>

#include <openvdb/openvdb.h>

#include <algorithm>
#include <cstdio>
#include <numeric>

using namespace sparse_testing;
namespace arrays = nephoscope::arrays;

namespace
{
constexpr double Pi = 3.14159265358979323846;

vtkSmartPointer<vtkFloatArray> named(const char* name, int components, vtkIdType tuples)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}

/// A sector of a shell: longitudes 0 to 40, latitudes 10 to 60 degrees, heights from 0 to 200 above a radius of 1000, unevenly.
vtkSmartPointer<vtkStructuredGrid> shell()
{
  const int n[3] = { 9, 12, 7 };
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(n);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const vtkIdType count = static_cast<vtkIdType>(n[0]) * n[1] * n[2];
  const auto extinction = named(arrays::Extinction, 1, count);
  const auto liquid = named(arrays::LiquidWater, 1, count);
  const auto wind = named(arrays::Wind, 3, count);
  for (int k = 0; k < n[2]; ++k)
  {
    for (int j = 0; j < n[1]; ++j)
    {
      for (int i = 0; i < n[0]; ++i)
      {
        const double longitude = 40.0 * i / (n[0] - 1) * Pi / 180;
        const double latitude = (10 + 50.0 * j / (n[1] - 1)) * Pi / 180;
        const double r = 1000 + 200 * std::pow(k / (n[2] - 1.0), 1.5);
        const vtkIdType p = points->InsertNextPoint(r * std::cos(latitude) * std::cos(longitude),
          r * std::cos(latitude) * std::sin(longitude), r * std::sin(latitude));
        const double inside = i > 1 && i < 7 && j > 2 && j < 9 && k > 0 && k < 6 ? 1 : 0;
        extinction->SetValue(p, static_cast<float>(inside * (1 + 0.3 * std::sin(i + 2.0 * j - k))));
        liquid->SetValue(p, static_cast<float>(1e-3 * inside));
        wind->SetTuple3(p, 10, -5, 2);
      }
    }
  }
  grid->SetPoints(points);
  for (const auto& array : { extinction, liquid, wind })
  {
    grid->GetPointData()->AddArray(array);
  }
  return grid;
}

double sumOf(vtkPolyData* bricks)
{
  auto* const values =
    vtkFloatArray::SafeDownCast(bricks->GetPointData()->GetArray(arrays::VoxelBricks));
  return std::accumulate(
    values->GetPointer(0), values->GetPointer(0) + values->GetNumberOfValues(), 0.0);
}

double numberOf(vtkDataObject* data, const char* name)
{
  vtkDataArray* const array = data->GetFieldData()->GetArray(name);
  return array ? array->GetComponent(0, 0) : std::nan("");
}

std::string textOf(vtkDataObject* data, const char* name)
{
  auto* const array = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name));
  return array ? std::string(array->GetValue(0)) : "(none)";
}

void write(vtkDataObject* data, const std::string& path, double voxel, bool half = false)
{
  vtkNew<vtkCloudVDBWriter> writer;
  writer->SetInputData(data);
  writer->SetFileName(path.c_str());
  writer->SetVoxelSize(voxel, voxel, voxel);
  writer->SetHalf(half);
  ASSERT_EQ(writer->Write(), 1);
}

vtkPolyData* bricksOf(const Read& read)
{
  return vtkPolyData::SafeDownCast(read.data);
}
}

TEST(CloudVDB, AnImageComesBackAsItWasInFloat)
{
  const Folder folder;
  const auto image = blob();
  write(image, folder.file("blob.vdb"), 0);
  const Read read = readAs(vtkCloudVDBReader::Image, folder.file("blob.vdb"));
  EXPECT_EQ(read.said, "");
  auto* const back = vtkImageData::SafeDownCast(read.data);
  ASSERT_NE(back, nullptr);
  vtkDataArray* const values = back->GetPointData()->GetArray("density");
  ASSERT_NE(values, nullptr);
  double sum = 0;
  vtkDataArray* const given = image->GetPointData()->GetScalars();
  for (vtkIdType p = 0; p < back->GetNumberOfPoints(); ++p)
  {
    double place[3];
    back->GetPoint(p, place);
    const vtkIdType at = image->FindPoint(place);
    double expected[3];
    image->GetPoint(at, expected);
    ASSERT_NEAR(vtkMath::Distance2BetweenPoints(place, expected), 0, 1e-18);
    EXPECT_EQ(values->GetComponent(p, 0), given->GetComponent(at, 0));
    sum += values->GetComponent(p, 0);
  }
  double all = 0;
  for (vtkIdType p = 0; p < image->GetNumberOfPoints(); ++p)
  {
    all += given->GetComponent(p, 0);
  }
  EXPECT_NEAR(sum / all, 1, 1e-12);
}

TEST(CloudVDB, PiecesOfAnImageAreItsBlocksAndBricksAreWhole)
{
  const Folder folder;
  write(blob(), folder.file("blob.vdb"), 0);
  vtkNew<vtkCloudVDBReader> reader;
  reader->SetFileName(folder.file("blob.vdb").c_str());
  reader->UpdatePiece(1, 3, 0);
  const vtkIdType bricks =
    vtkPolyData::SafeDownCast(reader->GetOutputDataObject(0))->GetNumberOfPoints();
  EXPECT_GT(bricks, 0);
  reader->UpdateWholeExtent();
  EXPECT_EQ(vtkPolyData::SafeDownCast(reader->GetOutputDataObject(0))->GetNumberOfPoints(), bricks);

  const Read whole = readAs(vtkCloudVDBReader::Image, folder.file("blob.vdb"));
  auto* const all = vtkImageData::SafeDownCast(whole.data);
  reader->SetOutputFormToImage();
  vtkIdType cells = 0;
  for (int piece = 0; piece < 3; ++piece)
  {
    reader->UpdatePiece(piece, 3, 0);
    auto* const image = vtkImageData::SafeDownCast(reader->GetOutputDataObject(0));
    cells += image->GetNumberOfCells();
    EXPECT_LT(image->GetNumberOfPoints(), all->GetNumberOfPoints());
    for (vtkIdType p = 0; p < image->GetNumberOfPoints(); ++p)
    {
      const vtkIdType same = all->FindPoint(image->GetPoint(p));
      ASSERT_EQ(image->GetPointData()->GetScalars()->GetComponent(p, 0),
        all->GetPointData()->GetScalars()->GetComponent(same, 0));
    }
  }
  EXPECT_EQ(cells, all->GetNumberOfCells());
}

TEST(CloudVDB, HalfFloatsAreWithinTheirPrecisionAndSmaller)
{
  const Folder folder;
  write(blob(), folder.file("whole.vdb"), 0);
  write(blob(), folder.file("half.vdb"), 0, true);
  const Read whole = readAs(vtkCloudVDBReader::Bricks, folder.file("whole.vdb"));
  const Read half = readAs(vtkCloudVDBReader::Bricks, folder.file("half.vdb"));
  vtkDataArray* const a = bricksOf(whole)->GetPointData()->GetArray(arrays::VoxelBricks);
  vtkDataArray* const b = bricksOf(half)->GetPointData()->GetArray(arrays::VoxelBricks);
  ASSERT_EQ(a->GetNumberOfValues(), b->GetNumberOfValues());
  bool any = false;
  for (vtkIdType t = 0; t < a->GetNumberOfTuples(); ++t)
  {
    for (int c = 0; c < 512; ++c)
    {
      const double x = a->GetComponent(t, c);
      const double y = b->GetComponent(t, c);
      EXPECT_LE(std::abs(x - y), x * std::ldexp(1, -11)); // 11 bits, rounded
      any = any || x != y;
    }
  }
  EXPECT_TRUE(any);
  EXPECT_LT(std::filesystem::file_size(folder.file("half.vdb")),
    std::filesystem::file_size(folder.file("whole.vdb")));
}

TEST(CloudVDB, BricksLieWhereTheVoxelsAre)
{
  const Folder folder;
  write(blob(), folder.file("blob.vdb"), 0);
  const Read read = readAs(vtkCloudVDBReader::Bricks, folder.file("blob.vdb"));
  vtkPolyData* const bricks = bricksOf(read);
  ASSERT_GT(bricks->GetNumberOfPoints(), 8);
  EXPECT_EQ(bricks->GetNumberOfVerts(), bricks->GetNumberOfPoints());
  auto* const origins =
    vtkIntArray::SafeDownCast(bricks->GetPointData()->GetArray(arrays::VoxelOrigins));
  vtkDataArray* const matrix = bricks->GetFieldData()->GetArray(arrays::VoxelToScene);
  ASSERT_EQ(matrix->GetNumberOfValues(), 16);
  const auto image = blob();
  vtkDataArray* const given = image->GetPointData()->GetScalars();
  vtkDataArray* const values = bricks->GetPointData()->GetArray(arrays::VoxelBricks);
  for (vtkIdType b = 0; b < bricks->GetNumberOfPoints(); ++b)
  {
    double place[3];
    bricks->GetPoint(b, place);
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_EQ(origins->GetTypedComponent(b, c) % 8, 0);
      EXPECT_NEAR(place[c],
        image->GetOrigin()[c] + image->GetSpacing()[c] * origins->GetTypedComponent(b, c), 1e-9);
    }
    for (int v = 0; v < 512; ++v)
    {
      int at[3] = { origins->GetTypedComponent(b, 0) + v % 8,
        origins->GetTypedComponent(b, 1) + v / 8 % 8, origins->GetTypedComponent(b, 2) + v / 64 };
      const int* const e = image->GetExtent();
      const bool inside = at[0] >= e[0] && at[0] <= e[1] && at[1] >= e[2] && at[1] <= e[3] &&
        at[2] >= e[4] && at[2] <= e[5];
      EXPECT_EQ(
        values->GetComponent(b, v), inside ? given->GetComponent(image->ComputePointId(at), 0) : 0);
    }
  }
}

TEST(CloudVDB, TheMassOfACurvilinearGridIsConserved)
{
  const Folder folder;
  const auto grid = shell();
  for (const bool half : { false, true })
  {
    for (const double voxel : { 6.0, 17.0 })
    {
      const std::string path = folder.file("shell.vdb");
      vtkNew<vtkCloudVDBWriter> writer;
      writer->SetInputData(grid);
      writer->SetFileName(path.c_str());
      writer->SetVoxelSize(voxel, voxel, voxel);
      writer->SetHalf(half);
      ASSERT_EQ(writer->Write(), 1);
      ASSERT_EQ(writer->GetNumberOfGrids(), 3);
      for (const char* const name : { "density", "liquid" })
      {
        const Read read = readAs(vtkCloudVDBReader::Bricks, path, name);
        const double mass = numberOf(read.data, "mass");
        EXPECT_GT(mass, 0);
        EXPECT_NEAR(sumOf(bricksOf(read)) * voxel * voxel * voxel / mass, 1, 1e-3) << name;
        EXPECT_NEAR(numberOf(read.data, "mass_factor"), 1, 0.02) << name << ' ' << voxel;
      }
      EXPECT_EQ(writer->GetGridName(0), "density");
      EXPECT_GT(writer->GetNumberOfVoxels(0), 1000);
    }
  }
}

TEST(CloudVDB, EachPartOfACloudKeepsItsMass)
{
  // A slab of constant density in slanted cells: voxels inside have that density, and each third along x a third of the mass.
  const Folder folder;
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(13, 5, 4);
  vtkNew<vtkPoints> points;
  const auto extinction = named(arrays::Extinction, 1, 13 * 5 * 4);
  for (int k = 0; k < 4; ++k)
  {
    for (int j = 0; j < 5; ++j)
    {
      for (int i = 0; i < 13; ++i)
      {
        extinction->SetValue(
          points->InsertNextPoint(10 * i, 12 * j + 0.3 * i, 7 * k + i + 0.5 * j), 0.02F);
      }
    }
  }
  grid->SetPoints(points);
  grid->GetPointData()->AddArray(extinction);
  write(grid, folder.file("slab.vdb"), 2);
  const Read read = readAs(vtkCloudVDBReader::Image, folder.file("slab.vdb"));
  auto* const image = vtkImageData::SafeDownCast(read.data);
  double thirds[3] = {};
  for (vtkIdType p = 0; p < image->GetNumberOfPoints(); ++p)
  {
    double place[3];
    image->GetPoint(p, place);
    const double value = image->GetPointData()->GetScalars()->GetComponent(p, 0);
    thirds[std::min(2, std::max(0, static_cast<int>(place[0] / 40)))] += value * 8;
    const double y = place[1] - 0.03 * place[0];
    const double z = place[2] - 0.1 * place[0] - 0.5 * y / 12;
    if (place[0] > 3 && place[0] < 117 && y > 3 && y < 45 && z > 3 && z < 18)
    {
      EXPECT_NEAR(value, 0.02, 2e-4); // within the factor
    }
  }
  const double mass = 0.02 * 120 * 48 * 21;
  EXPECT_NEAR(numberOf(read.data, "mass") / mass, 1, 1e-6);
  EXPECT_NEAR((thirds[0] + thirds[1] + thirds[2]) / mass, 1, 1e-5);
  // The boundary at x = 40 and 80 cuts voxels in halves, which are counted on one side: half a voxel of 40 m, 2.5 %.
  for (const double third : thirds)
  {
    EXPECT_NEAR(third / mass, 1.0 / 3, 0.01);
  }
}

TEST(CloudVDB, WaterIsInKilogramsAndTheWindIsAVector)
{
  const Folder folder;
  const auto grid = shell();
  grid->GetPointData()->RemoveArray(arrays::Extinction);
  write(grid, folder.file("shell.vdb"), 8);
  const Read wind = readAs(vtkCloudVDBReader::Bricks, folder.file("shell.vdb"), "wind");
  EXPECT_EQ(textOf(wind.data, "units"), "m/s");
  vtkDataArray* const vectors = bricksOf(wind)->GetPointData()->GetArray(arrays::VoxelBricks);
  ASSERT_EQ(vectors->GetNumberOfComponents(), 1536);
  int met = 0;
  for (vtkIdType b = 0; b < vectors->GetNumberOfTuples(); ++b)
  {
    for (int v = 0; v < 512; ++v)
    {
      if (vectors->GetComponent(b, 3 * v) != 0)
      {
        ++met;
        EXPECT_NEAR(vectors->GetComponent(b, 3 * v), 10, 1e-4);
        EXPECT_NEAR(vectors->GetComponent(b, 3 * v + 1), -5, 1e-4);
        EXPECT_NEAR(vectors->GetComponent(b, 3 * v + 2), 2, 1e-4);
      }
    }
  }
  EXPECT_GT(met, 1000);
  // Without an extinction, that of the water: Q 3/(4 r) / rho_water of its mass, Q = 2, r = 10 um.
  const Read density = readAs(vtkCloudVDBReader::Bricks, folder.file("shell.vdb"), "density");
  const Read liquid = readAs(vtkCloudVDBReader::Bricks, folder.file("shell.vdb"), "liquid");
  EXPECT_EQ(textOf(liquid.data, "units"), "kg/m3");
  EXPECT_EQ(textOf(density.data, "units"), "1/m");
  EXPECT_NEAR(sumOf(bricksOf(density)) / sumOf(bricksOf(liquid)), 150, 1e-3);
}

TEST(CloudVDB, MetadataComeBack)
{
  const Folder folder;
  const auto grid = shell();
  const auto addText = [&grid](const char* name, const char* text)
  {
    vtkNew<vtkStringArray> array;
    array->SetName(name);
    array->InsertNextValue(text);
    grid->GetFieldData()->AddArray(array);
  };
  addText(arrays::Geometry, "Globe");
  addText(arrays::Projection, "+proj=laea +lat_0=52");
  for (const auto& [name, value] :
    { std::make_pair(arrays::PlanetRadius, 1000.0), std::make_pair(arrays::HeightScale, 4.0) })
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->InsertNextValue(value);
    grid->GetFieldData()->AddArray(array);
  }
  vtkNew<vtkCloudVDBWriter> writer;
  writer->SetInputData(grid);
  writer->SetFileName(folder.file("shell.vdb").c_str());
  writer->SetSource("model run 7.nc");
  writer->SetTime("2001-10-01T06:00:00");
  writer->AddGridName("density");
  ASSERT_EQ(writer->Write(), 1);
  const Read read = readAs(vtkCloudVDBReader::Bricks, folder.file("shell.vdb"));
  EXPECT_EQ(textOf(read.data, arrays::Geometry), "Globe");
  EXPECT_EQ(textOf(read.data, arrays::Projection), "+proj=laea +lat_0=52");
  EXPECT_EQ(numberOf(read.data, arrays::PlanetRadius), 1000);
  EXPECT_EQ(numberOf(read.data, arrays::HeightScale), 4);
  EXPECT_EQ(textOf(read.data, "Source"), "model run 7.nc");
  EXPECT_EQ(textOf(read.data, "Time"), "2001-10-01T06:00:00");
  EXPECT_EQ(textOf(read.data, "creator"), "Nephoscope");
  EXPECT_EQ(textOf(read.data, "GridName"), "density");
  EXPECT_EQ(textOf(read.data, "units"), "1/(scene unit), heights being exaggerated");
  EXPECT_NE(textOf(read.data, "interpolation").find("samples"), std::string::npos);
  EXPECT_EQ(writer->GetNumberOfGrids(), 1);
  EXPECT_EQ(folder.numberOfFiles(), 1U); // and nothing beside it
}

TEST(CloudVDB, OneThreadMakesTheSameVoxelsAsSeveral)
{
  const Folder folder;
  write(shell(), folder.file("several.vdb"), 5);
  vtkSMPTools::LocalScope(
    vtkSMPTools::Config{ 1 }, [&] { write(shell(), folder.file("one.vdb"), 5); });
  for (const char* const name : { "density", "liquid", "wind" })
  {
    const Read several = readAs(vtkCloudVDBReader::Bricks, folder.file("several.vdb"), name);
    const Read one = readAs(vtkCloudVDBReader::Bricks, folder.file("one.vdb"), name);
    auto* const a =
      vtkFloatArray::SafeDownCast(bricksOf(several)->GetPointData()->GetArray(arrays::VoxelBricks));
    auto* const b =
      vtkFloatArray::SafeDownCast(bricksOf(one)->GetPointData()->GetArray(arrays::VoxelBricks));
    ASSERT_EQ(a->GetNumberOfValues(), b->GetNumberOfValues());
    ASSERT_GT(a->GetNumberOfValues(), 0);
    EXPECT_TRUE(
      std::equal(a->GetPointer(0), a->GetPointer(0) + a->GetNumberOfValues(), b->GetPointer(0)))
      << name;
  }
}

TEST(CloudVDB, ArraysThatShareANameAreGridsOfTheirOwn)
{
  const Folder folder;
  const auto image = blob();
  const auto twice = named("density", 1, image->GetNumberOfPoints()); // what Extinction is called
  const auto wind = named(arrays::Wind, 3, image->GetNumberOfPoints());
  for (vtkIdType p = 0; p < image->GetNumberOfPoints(); ++p)
  {
    const double value = image->GetPointData()->GetScalars()->GetComponent(p, 0);
    twice->SetValue(p, static_cast<float>(2 * value));
    wind->SetTuple3(p, value, 0, -3 * value);
  }
  image->GetPointData()->AddArray(twice);
  image->GetPointData()->AddArray(wind);
  vtkNew<vtkCloudVDBWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(folder.file("blob.vdb").c_str());
  ASSERT_EQ(writer->Write(), 1);
  ASSERT_EQ(writer->GetNumberOfGrids(), 3);
  EXPECT_EQ(writer->GetNumberOfVoxels(0), writer->GetNumberOfVoxels(2)); // vectors, not numbers
  const Read first = readAs(vtkCloudVDBReader::Bricks, folder.file("blob.vdb"));
  const Read third = readAs(vtkCloudVDBReader::Bricks, folder.file("blob.vdb"), "wind");
  const double sum = sumOf(bricksOf(first));
  EXPECT_GT(sum, 0);
  EXPECT_NEAR(sumOf(bricksOf(third)) / sum, 1 - 3, 1e-5);
  openvdb::io::File file(folder.file("blob.vdb"));
  file.open();
  double sums = 0;
  const auto grids = file.getGrids();
  for (const auto& grid : *grids)
  {
    if (const auto fog = openvdb::gridPtrCast<openvdb::FloatGrid>(grid))
    {
      for (auto value = fog->cbeginValueOn(); value; ++value)
      {
        sums += static_cast<double>(*value);
      }
    }
  }
  EXPECT_NEAR(sums / sum, 3, 1e-5);
}

TEST(CloudVDB, WhatIsStoppedLeavesNothing)
{
  const Folder folder;
  for (const double when : { 0.1, 0.62 }) // of the sampling, of the saving
  {
    vtkNew<vtkCloudVDBWriter> writer;
    writer->SetInputData(shell());
    writer->SetFileName(folder.file("shell.vdb").c_str());
    writer->SetVoxelSize(5, 5, 5);
    vtkNew<vtkCallbackCommand> stop;
    double progress = when;
    stop->SetClientData(&progress);
    stop->SetCallback(
      [](vtkObject* caller, unsigned long, void* data, void* done)
      {
        static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(
          *static_cast<double*>(done) > *static_cast<double*>(data));
      });
    writer->AddObserver(vtkCommand::ProgressEvent, stop);
    vtkSMPTools::LocalScope(vtkSMPTools::Config{ 1 }, [&writer] { EXPECT_EQ(writer->Write(), 0); });
    EXPECT_EQ(writer->GetErrorCode(), 0U); // it was told to
    EXPECT_EQ(folder.numberOfFiles(), 0U);
    EXPECT_LT(writer->GetProgress(), 1);
  }
}

TEST(CloudVDB, VdbPrintReadsWhatIsWritten)
{
  if (std::system("command -v vdb_print > /dev/null") != 0)
  {
    GTEST_SKIP() << "no vdb_print; install libopenvdb-tools";
  }
  const Folder folder;
  write(shell(), folder.file("shell.vdb"), 8, true);
  FILE* const pipe = ::popen(("vdb_print -l " + folder.file("shell.vdb")).c_str(), "r");
  std::string text;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe))
  {
    text += static_cast<char>(c);
  }
  EXPECT_EQ(::pclose(pipe), 0);
  for (const char* const words : { "Name: density", "Name: liquid", "Name: wind",
         "Tree_vec3s_5_4_3", "class: fog volume", "voxel size: 8", "is_saved_as_half_float: true",
         "units: kg/m3", "creator: Nephoscope", "vector_type: contravariant relative" })
  {
    EXPECT_NE(text.find(words), std::string::npos) << words << " is not in\n" << text;
  }
}
