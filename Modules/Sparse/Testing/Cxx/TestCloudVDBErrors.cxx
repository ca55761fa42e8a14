// SPDX-License-Identifier: BSD-3-Clause
// Files and orders that cannot be: one clear line each, and what is odd but readable.
#include "SparseTesting.h"
#include "vtkCloudVDBWriter.h"
#include "vtkFieldData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStructuredGrid.h"

#include <gtest/gtest.h>

#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <algorithm>
#include <fstream>

using namespace sparse_testing;

namespace
{
/// Expects that reading fails with one line that holds the words and the file's name.
void expectRefusal(const std::string& path, const std::string& words, const std::string& name = "",
  double maximumVoxels = 2e8, int form = vtkCloudVDBReader::Bricks)
{
  const Read read = readAs(form, path, name, maximumVoxels);
  EXPECT_NE(read.said.find(words), std::string::npos)
    << "'" << words << "' is not in " << read.said;
  EXPECT_NE(read.said.find(path), std::string::npos) << read.said;
  auto* const bricks = vtkPolyData::SafeDownCast(read.data);
  EXPECT_TRUE(!bricks || bricks->GetNumberOfPoints() == 0);
}

std::string bytesOf(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

void writeBytes(const std::string& path, const std::string& bytes)
{
  std::ofstream(path, std::ios::binary) << bytes;
}

void save(const std::string& path, const openvdb::GridBase::Ptr& grid, bool statistics = true)
{
  openvdb::io::File file(path);
  file.setGridStatsMetadataEnabled(statistics);
  file.write({ grid });
}

openvdb::FloatGrid::Ptr smallFog()
{
  openvdb::initialize();
  auto grid = openvdb::FloatGrid::create();
  grid->fill(openvdb::CoordBBox({ 1, 2, 3 }, { 9, 8, 7 }), 0.5F);
  grid->setName("density");
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  return grid;
}

vtkDataArray* valuesOf(const Read& read)
{
  return vtkPolyData::SafeDownCast(read.data)->GetPointData()->GetArray(
    nephoscope::arrays::VoxelBricks);
}
}

TEST(CloudVDBErrors, WhatIsNoFile)
{
  const Folder folder;
  expectRefusal(folder.file("none.vdb"), "cannot be opened");
  writeBytes(folder.file("text.vdb"), "This is a text, not a file of voxels.");
  expectRefusal(folder.file("text.vdb"), "is no OpenVDB file");
  writeBytes(folder.file("empty.vdb"), "");
  expectRefusal(folder.file("empty.vdb"), "is no OpenVDB file");
  save(folder.file("fog.vdb"), smallFog());
  std::string bytes = bytesOf(folder.file("fog.vdb"));
  bytes[8] = 99; // the version
  writeBytes(folder.file("new.vdb"), bytes);
  expectRefusal(folder.file("new.vdb"), "file version 99");
  bytes[8] = static_cast<char>(221);
  writeBytes(folder.file("old.vdb"), bytes);
  expectRefusal(folder.file("old.vdb"), "versions 222 to 224 are read");
}

TEST(CloudVDBErrors, AFileThatIsCutShortAnywhere)
{
  const Folder folder;
  save(folder.file("fog.vdb"), smallFog());
  const std::string bytes = bytesOf(folder.file("fog.vdb"));
  for (std::size_t length = 9; length < bytes.size(); length += bytes.size() / 23)
  {
    writeBytes(folder.file("short.vdb"), bytes.substr(0, length));
    expectRefusal(folder.file("short.vdb"), "is cut short or damaged");
  }
}

TEST(CloudVDBErrors, ABlockLongerThanItsNode)
{
  // One voxel: the file ends with its block, a length of 8 bytes, Blosc's header of 16 and a float.
  const Folder folder;
  auto grid = smallFog();
  grid->clear();
  grid->tree().setValueOn(openvdb::Coord(1, 2, 3), 0.5F);
  save(folder.file("fog.vdb"), grid);
  EXPECT_EQ(readAs(vtkCloudVDBReader::Bricks, folder.file("fog.vdb")).said, "");
  const std::string whole = bytesOf(folder.file("fog.vdb"));
  const std::size_t at = whole.size() - 28;
  ASSERT_EQ(whole.substr(at, 8), "\x14" + std::string(7, '\0'));
  const std::string minus20 = "\xec" + std::string(7, '\xff'); // 20 bytes that are not compressed
  for (const auto& [place, change] :
    { std::make_pair(at, minus20), std::make_pair(at, std::string("\x08")),
      std::make_pair(at + 7, std::string("\x7f")), std::make_pair(at + 12, std::string("\x08")),
      std::make_pair(at + 20, std::string("\x24")) })
  {
    std::string bytes = whole;
    bytes.replace(place, change.size(), change);
    writeBytes(folder.file("long.vdb"), bytes);
    expectRefusal(folder.file("long.vdb"), "is cut short or damaged");
  }
}

TEST(CloudVDBErrors, MetadataWhoseLengthIsNotThatOfTheirType)
{
  // What says 7 bytes and is called a vector is not read as one.
  const Folder folder;
  auto grid = smallFog();
  grid->insertMeta("note", openvdb::StringMetadata("seven b"));
  save(folder.file("fog.vdb"), grid);
  std::string bytes = bytesOf(folder.file("fog.vdb"));
  const std::size_t at = bytes.find("string", bytes.find("note"));
  bytes.replace(at - 4, 10, std::string("\x05\0\0\0vec3d", 9));
  const std::size_t length = bytes.find("seven b") - 4;
  bytes[length] = 8;
  bytes.insert(bytes.find("seven b"), "X"); // as long in all as before
  writeBytes(folder.file("odd.vdb"), bytes);
  const Read read = readAs(vtkCloudVDBReader::Bricks, folder.file("odd.vdb"));
  EXPECT_EQ(read.said, "");
  EXPECT_EQ(valuesOf(read)->GetNumberOfTuples(), 4);
}

TEST(CloudVDBErrors, GridsThatAreNotThereOrOfAnotherType)
{
  const Folder folder;
  save(folder.file("fog.vdb"), smallFog());
  expectRefusal(
    folder.file("fog.vdb"), "has no grid 'smoke'; it has 'density' (Tree_float_5_4_3)", "smoke");
  const auto mask = openvdb::Int32Grid::create();
  mask->setName("flags");
  save(folder.file("flags.vdb"), mask);
  expectRefusal(folder.file("flags.vdb"), "has no grid of floats; it has 'flags'");
  expectRefusal(folder.file("flags.vdb"), "is of type Tree_int32_5_4_3", "flags");
}

TEST(CloudVDBErrors, SizesThatAreTooLargeOrCannotBe)
{
  const Folder folder;
  auto grid = smallFog();
  using Base = openvdb::GridBase;
  grid->insertMeta(Base::META_FILE_VOXEL_COUNT, openvdb::Int64Metadata(1000000000));
  save(folder.file("declared.vdb"), grid, false);
  expectRefusal(folder.file("declared.vdb"), "declares 1000000000 active voxels, more than the");
  grid = smallFog();
  grid->insertMeta(Base::META_FILE_BBOX_MIN, openvdb::Vec3IMetadata({ 5, 5, 5 }));
  grid->insertMeta(Base::META_FILE_BBOX_MAX, openvdb::Vec3IMetadata({ 9, -5, 9 }));
  save(folder.file("inverted.vdb"), grid, false);
  expectRefusal(folder.file("inverted.vdb"), "a bounding box that ends before it begins");
  // Not declared: a tile of 4096^3 voxels in a file of some kB.
  grid = smallFog();
  grid->tree().setValue(openvdb::Coord(-4000, 8, 8), 1.0F); // a leaf before it
  grid->tree().addTile(2, openvdb::Coord(0, 0, 0), 1.0F, true);
  save(folder.file("tile.vdb"), grid, false);
  expectRefusal(folder.file("tile.vdb"), "voxels in its bricks, more than the", "", 1e6);
  // Two voxels far apart are few bricks, and a large image.
  grid = smallFog();
  grid->tree().setValueOn(openvdb::Coord(5000, 5000, 5000), 1.0F);
  save(folder.file("far.vdb"), grid);
  EXPECT_EQ(readAs(vtkCloudVDBReader::Bricks, folder.file("far.vdb")).said, "");
  expectRefusal(folder.file("far.vdb"), "read it as bricks", "", 2e8, vtkCloudVDBReader::Image);
}

TEST(CloudVDBErrors, TransformsThatVoxelsCannotHave)
{
  const Folder folder;
  auto grid = smallFog();
  const openvdb::BBoxd box(openvdb::Vec3d(0), openvdb::Vec3d(10));
  grid->setTransform(openvdb::math::Transform::createFrustumTransform(box, 0.5, 4.0));
  save(folder.file("frustum.vdb"), grid);
  expectRefusal(folder.file("frustum.vdb"), "has a frustum transform");
  grid = smallFog();
  openvdb::math::Mat4d shear = openvdb::math::Mat4d::identity();
  shear[1][0] = 0.5;
  grid->setTransform(openvdb::math::Transform::createLinearTransform(shear));
  save(folder.file("shear.vdb"), grid);
  expectRefusal(
    folder.file("shear.vdb"), "a transform with shear", "", 2e8, vtkCloudVDBReader::Image);
  const Read read = readAs(vtkCloudVDBReader::Bricks, folder.file("shear.vdb"));
  EXPECT_EQ(read.said, "");
  // x grows by half a voxel with each j.
  EXPECT_EQ(
    read.data->GetFieldData()->GetArray(nephoscope::arrays::VoxelToScene)->GetComponent(1, 0), 0.5);
}

TEST(CloudVDBErrors, AnEmptyTreeIsNoClouds)
{
  const Folder folder;
  openvdb::initialize();
  const auto grid = openvdb::FloatGrid::create();
  grid->setName("density");
  save(folder.file("empty.vdb"), grid);
  for (const int form : { vtkCloudVDBReader::Bricks, vtkCloudVDBReader::Image })
  {
    const Read read = readAs(form, folder.file("empty.vdb"));
    EXPECT_NE(read.said.find("has no active voxel"), std::string::npos) << read.said;
    EXPECT_EQ(vtkDataSet::SafeDownCast(read.data)->GetNumberOfPoints(), 0);
  }
}

TEST(CloudVDBErrors, OddButReadable)
{
  const Folder folder;
  auto grid = smallFog();
  grid->setName("smoke and fire");
  grid->setTransform(openvdb::math::Transform::createLinearTransform(
    openvdb::math::Mat4d(2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 5, 0, 7, 11, 13, 1)));
  save(folder.file("odd name.vdb"), grid);
  const Read odd = readAs(vtkCloudVDBReader::Image, folder.file("odd name.vdb"), "smoke and fire");
  EXPECT_EQ(odd.said, "");
  auto* const image = vtkImageData::SafeDownCast(odd.data);
  EXPECT_EQ(image->GetNumberOfPoints(), 9 * 7 * 5);
  double first[3];
  image->GetPoint(0, first);
  EXPECT_NEAR(first[0], 9, 1e-12);
  EXPECT_NEAR(first[1], 17, 1e-12);
  EXPECT_NEAR(first[2], 28, 1e-12);
  // Tiles are bricks of one value.
  grid = smallFog();
  grid->clear();
  grid->tree().addTile(1, openvdb::Coord(8, 16, -8), 2.0F, true);
  save(folder.file("tile.vdb"), grid);
  const Read tile = readAs(vtkCloudVDBReader::Bricks, folder.file("tile.vdb"));
  ASSERT_EQ(valuesOf(tile)->GetNumberOfTuples(), 1);
  EXPECT_EQ(valuesOf(tile)->GetComponent(0, 511), 2);
  EXPECT_EQ(valuesOf(tile)->GetComponent(0, 0), 2);
}

TEST(CloudVDBErrors, ALevelSetBecomesFogWithAWarning)
{
  const Folder folder;
  openvdb::initialize();
  const auto ball =
    openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(10, openvdb::Vec3f(1, 2, 3), 1.0F);
  ball->setName("ball");
  save(folder.file("ball.vdb"), ball);
  const Read read = readAs(vtkCloudVDBReader::Image, folder.file("ball.vdb"));
  EXPECT_NE(read.said.find("is a level set; made fog of it"), std::string::npos) << read.said;
  auto* const image = vtkImageData::SafeDownCast(read.data);
  int middle[3] = { 1, 2, 3 };
  EXPECT_EQ(image->GetPointData()->GetScalars()->GetComponent(image->ComputePointId(middle), 0), 1);
  double range[2];
  image->GetPointData()->GetScalars()->GetRange(range);
  EXPECT_GE(range[0], 0);
  EXPECT_LE(range[1], 1);
}

TEST(CloudVDBErrors, OrdersThatCannotBeWritten)
{
  const Folder folder;
  const auto expect = [&folder](vtkDataObject* data, const std::string& path, double voxel,
                        const std::string& grid, const std::string& words)
  {
    vtkNew<vtkCloudVDBWriter> writer;
    vtkNew<Said> said;
    said->listen(writer);
    writer->SetInputData(data);
    writer->SetFileName(path.empty() ? nullptr : path.c_str());
    writer->SetVoxelSize(voxel, voxel, voxel);
    if (!grid.empty())
    {
      writer->AddGridName(grid);
    }
    EXPECT_EQ(writer->Write(), 0);
    EXPECT_NE(said->Text.find(words), std::string::npos) << said->Text;
    EXPECT_EQ(folder.numberOfFiles(), 0U);
  };
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(3, 4, 2);
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> extinction;
  extinction->SetName(nephoscope::arrays::Extinction);
  for (int p = 0; p < 24; ++p)
  {
    const int row = p / 3;
    const int level = row / 4;
    points->InsertNextPoint(p % 3, row % 4, level);
    extinction->InsertNextValue(1);
  }
  grid->SetPoints(points);
  expect(grid, folder.file("a.vdb"), 0.1, "", "has none of the point arrays Extinction");
  grid->GetPointData()->AddArray(extinction);
  expect(grid, "", 0.1, "", "set FileName");
  expect(grid, folder.file("a.vdb"), -1, "", "has to be above 0");
  expect(grid, folder.file("a.vdb"), 1e-4, "", "choose larger ones");
  expect(grid, folder.file("a.vdb"), 0.1, "smoke", "nothing to make 'smoke' of");
  expect(grid, folder.file("no folder/a.vdb"), 0.1, "", "cannot be written");
  expect(blob(), folder.file("a.vdb"), 0, "smoke", "does not have all the point arrays");
  extinction->InsertNextValue(1);
  expect(grid, folder.file("a.vdb"), 0.1, "", "has 25 tuples of 1 for 24 points");
}
