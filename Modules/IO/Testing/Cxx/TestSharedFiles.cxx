// SPDX-License-Identifier: BSD-3-Clause
// The files of the shared data folder. What is right was worked out from the raw values of ncdump and python3-netcdf4.
#include "vtkCloudNetCDFReader.h"

#include "CloudArrays.h"

#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStructuredGrid.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace
{
bool open(vtkCloudNetCDFReader* reader, const char* name)
{
  const std::string path = std::string(NEPHOSCOPE_SHARED_DATA_DIR "/") + name;
  reader->SetFileName(path.c_str());
  return std::filesystem::exists(path);
}

#define OPEN_OR_SKIP(reader, name)                                                                 \
  if (!open(reader, name))                                                                         \
  GTEST_SKIP() << "the shared data folder has no " << (name)
}

TEST(SharedFiles, WRFMercatorSpacingIsTenKilometres)
{
  // DX = 10000 m: XLONG and XLAT through MAP_PROJ = 3, TRUELAT1, STAND_LON must give it back.
  vtkNew<vtkCloudNetCDFReader> reader;
  OPEN_OR_SKIP(reader, "wrf_katrina.nc");
  reader->Update();
  vtkStructuredGrid* grid = reader->GetOutput();
  ASSERT_EQ(grid->GetNumberOfPoints(), 48 * 48 * 14);
  double a[3];
  double b[3];
  double c[3];
  grid->GetPoint(0, a);
  grid->GetPoint(47, b);
  grid->GetPoint(47 * 48, c);
  EXPECT_NEAR(b[0] - a[0], 470000, 5);
  EXPECT_NEAR(c[1] - a[1], 470000, 5);
  EXPECT_EQ(reader->GetChosenGeometry(), vtkCloudNetCDFReader::Local);
  EXPECT_EQ(reader->GetNumberOfTimeSteps(), 4);
  EXPECT_STREQ(reader->GetTimeLabel(3), "2005-08-28T21:00:00");
}
