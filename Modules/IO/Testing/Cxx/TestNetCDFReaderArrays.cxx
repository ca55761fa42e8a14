// SPDX-License-Identifier: BSD-3-Clause
// Which files the reader takes, and which of their arrays it keeps.
#include "SmallFile.h"

#include "CloudArrays.h"

#include <vtkPointData.h>

using namespace nephoscope;

namespace
{
/// 3 x 2 x 3 points on hybrid levels, with a cloud fraction or without.
void describe(SmallFile& file, bool cloudy)
{
  file.dimension("lev", 3).dimension("lat", 2).dimension("lon", 3);
  file.variable("lon", { "lon" }, { 0, 1, 2 }, { { "units", "degrees_east" } });
  file.variable("lat", { "lat" }, { 10, 11 }, { { "units", "degrees_north" } });
  file.variable("lev", { "lev" }, { 1, 2, 3 });
  file.variable("hyam", { "lev" }, { 0, 1e4, 2e3 }, { { "units", "Pa" } });
  file.variable("hybm", { "lev" }, { 0.99, 0.5, 0 });
  file.variable("ps", { "lat", "lon" }, std::vector<double>(6, 1e5), { { "units", "Pa" } });
  file.variable(cloudy ? "cl" : "oxygen", { "lev", "lat", "lon" }, std::vector<double>(18, 0.25),
    { { "units", "1" } });
}
}

TEST(NetCDFReader, KeepsTheArraysThatAreChosen)
{
  SmallFile file;
  describe(file, true);
  vtkNew<vtkCloudNetCDFReader> reader;
  reader->SetFileName(file.path());
  reader->UpdateInformation();
  std::vector<std::string> names;
  for (int i = 0; i < reader->GetNumberOfPointArrays(); ++i)
  {
    names.emplace_back(reader->GetPointArrayName(i));
    EXPECT_TRUE(reader->GetPointArrayStatus(reader->GetPointArrayName(i)));
  }
  EXPECT_EQ(names, (std::vector<std::string>{ arrays::CloudFraction, arrays::Pressure }));
  reader->SetPointArrayStatus(arrays::Pressure, 0);
  reader->Update();
  EXPECT_TRUE(reader->GetOutput()->GetPointData()->HasArray(arrays::CloudFraction));
  EXPECT_TRUE(reader->GetOutput()->GetPointData()->HasArray(arrays::Height));
  EXPECT_FALSE(reader->GetOutput()->GetPointData()->HasArray(arrays::Pressure));
  reader->SetPointArrayStatus(arrays::Pressure, 1);
  reader->Update();
  EXPECT_TRUE(reader->GetOutput()->GetPointData()->HasArray(arrays::Pressure));
}

TEST(NetCDFReader, KnowsWhichFilesItCanRead)
{
  SmallFile clouds;
  describe(clouds, true);
  EXPECT_EQ(vtkCloudNetCDFReader::CanReadFile(clouds.path()), 1);
  SmallFile other;
  describe(other, false);
  EXPECT_EQ(vtkCloudNetCDFReader::CanReadFile(other.path()), 0);
  EXPECT_EQ(vtkCloudNetCDFReader::CanReadFile(NEPHOSCOPE_SOURCE_DIR "/README.md"), 0);
  EXPECT_EQ(vtkCloudNetCDFReader::CanReadFile("nowhere.nc"), 0);
  EXPECT_EQ(vtkCloudNetCDFReader::CanReadFile(nullptr), 0);
}
