// SPDX-License-Identifier: BSD-3-Clause
// Clouds carried along the wind against clouds that fade, on files of which steps are left out and interpolated from their neighbours.
#include "LeftOutSteps.h"

#include "ChartFiles.h"

#include <CloudArrays.h>
#include <vtkCloudNetCDFReader.h>
#include <vtkNew.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace
{
using namespace nephoscope;
using charts::LeftOutSteps;

LeftOutSteps compare(const std::string& file, const char* quantity, int stride)
{
  vtkNew<vtkCloudNetCDFReader> reader;
  reader->SetFileName((std::string(NEPHOSCOPE_SHARED_DATA_DIR) + "/" + file).c_str());
  reader->DiagnoseCloudFractionOn();
  return charts::leaveOut(reader, file, quantity, stride);
}
}

TEST(TimeInterpolation, CarriedAgainstFaded)
{
  if (!std::filesystem::exists(NEPHOSCOPE_SHARED_DATA_DIR))
  {
    GTEST_SKIP() << "no folder " << NEPHOSCOPE_SHARED_DATA_DIR;
  }
  // Clouds of the upper troposphere drift: the error is less and the structures are where they belong.
  const char* const era5 = "era5_fraction_13h.nc";
  LeftOutSteps found = compare(era5, arrays::CloudFraction, 2);
  EXPECT_LT(found.carried.error, 0.92 * found.faded.error);
  EXPECT_GT(found.carried.pattern, found.faded.pattern + 0.1);
  found = compare(era5, arrays::CloudFraction, 3);
  EXPECT_LT(found.carried.error, 0.75 * found.faded.error);
  EXPECT_GT(found.carried.pattern, found.faded.pattern + 0.25);
  // Ice of an hour's step: no gain in error, five per cent of loss.
  found = compare(era5, arrays::IceWater, 2);
  EXPECT_LT(found.carried.error, 1.06 * found.faded.error);
  EXPECT_GT(found.carried.pattern, found.faded.pattern);
  found = compare(era5, arrays::IceWater, 3);
  EXPECT_LT(found.carried.error, 0.92 * found.faded.error);
  EXPECT_GT(found.carried.pattern, found.faded.pattern + 0.1);
}

TEST(TimeInterpolation, CarryingLosesInAHurricaneAsItsHeaderSays)
{
  if (!std::filesystem::exists(NEPHOSCOPE_SHARED_DATA_DIR))
  {
    GTEST_SKIP() << "no folder " << NEPHOSCOPE_SHARED_DATA_DIR;
  }
  for (const int stride : { 2, 3 })
  {
    for (const char* const quantity : { arrays::LiquidWater, arrays::CloudFraction })
    {
      const LeftOutSteps found = compare("wrf_katrina.nc", quantity, stride);
      EXPECT_GT(found.carried.error, found.faded.error);
      EXPECT_LT(found.carried.error, 1.8 * found.faded.error);
    }
  }
}

TEST(LeftOutSteps, WhatCannotBeComparedIsSaid)
{
  vtkNew<vtkCloudNetCDFReader> reader;
  reader->SetFileName(NEPHOSCOPE_SOURCE_DIR "/Data/sample_climate.nc");
  const auto reasonFor = [&reader](const char* quantity, int stride) -> std::string
  {
    try
    {
      charts::leaveOut(reader, "sample", quantity, stride);
    }
    catch (const std::runtime_error& reason)
    {
      return reason.what();
    }
    return "none";
  };
  EXPECT_EQ(reasonFor("Fog", 2), "there is no array Fog at every step");
  EXPECT_EQ(
    reasonFor(arrays::CloudFraction, 4), "sample has 4 time steps; to keep one of 4 takes 5");
}

TEST(LeftOutSteps, AFieldThatChangesLinearlyIsFadedExactly)
{
  // Height hardly moves in the sample; here it is what the filter makes linear in time in either way.
  vtkNew<vtkCloudNetCDFReader> reader;
  reader->SetFileName(NEPHOSCOPE_SOURCE_DIR "/Data/sample_climate.nc");
  const LeftOutSteps found = charts::leaveOut(reader, "sample", arrays::Height, 2);
  EXPECT_DOUBLE_EQ(found.carried.error, found.faded.error);
  EXPECT_LT(found.faded.error, 0.01 * found.spread);
  EXPECT_NEAR(found.faded.pattern, 1, 0.05);
}

TEST(LeftOutSteps, TheChartHasALineForEachAndBothEnds)
{
  LeftOutSteps c;
  c.name = "a.nc";
  c.quantity = arrays::IceWater;
  c.spread = 2;
  c.carried = { 1, 0.5, 0.8 };
  c.faded = { 1.5, 0.6, 0.4 };
  const auto folder = std::filesystem::temp_directory_path() / "nephoscope_left_out_steps";
  std::filesystem::remove_all(folder);
  charts::makeFolder(folder.string());
  charts::writeInterpolationChart({ c, c }, folder.string());
  std::ifstream file(folder / "interpolation.svg");
  const std::string svg((std::istreambuf_iterator<char>(file)), {});
  std::size_t discs = 0;
  for (std::size_t at = svg.find("<circle"); at != std::string::npos;
       at = svg.find("<circle", at + 1))
  {
    ++discs;
  }
  EXPECT_EQ(discs, 4U);
  EXPECT_NE(svg.find("IceWater, 1 of 2 steps kept"), std::string::npos);
  std::filesystem::remove_all(folder);
}
