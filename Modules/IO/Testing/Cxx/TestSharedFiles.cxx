// SPDX-License-Identifier: BSD-3-Clause
// The files of the shared data folder. The numbers come from the raw values, unpacked by python3-netcdf4 (an
// implementation that shares only netCDF-C with the reader) and combined with numpy by the formulas of the comments.
#include "SmallFile.h"

#include "CloudArrays.h"
#include "VerticalCoordinate.h"

using namespace nephoscope;

namespace
{
bool open(vtkCloudNetCDFReader* reader, const char* name)
{
  const std::string path = std::string(NEPHOSCOPE_SHARED_DATA_DIR "/") + name;
  reader->SetFileName(path.c_str());
  return std::filesystem::exists(path);
}

bool says(vtkCloudNetCDFReader* reader, const std::string& text)
{
  for (int i = 0; i < reader->GetNumberOfDerivations(); ++i)
  {
    if (text == reader->GetDerivation(i))
    {
      return true;
    }
  }
  return false;
}
}

#define OPEN_OR_SKIP(reader, name)                                                                 \
  if (!open(reader, name))                                                                         \
  GTEST_SKIP() << "the shared data folder has no " << (name)

TEST(SharedFiles, Era5GlobeClosesAndKeepsEveryValue)
{
  vtkNew<vtkCloudNetCDFReader> reader;
  OPEN_OR_SKIP(reader, "era5_tl31.nc");
  reader->SetVerticalExaggeration(40);
  reader->Update();
  EXPECT_EQ(reader->GetChosenGeometry(), vtkCloudNetCDFReader::Globe);
  const int expected[3] = { 65, 34, 37 }; // 64 x 32 and the seam, two poles
  EXPECT_TRUE(std::equal(expected, expected + 3, reader->GetDimensions()));
  // level 600 hPa is the 14th from the ground of 37; file indices longitude 10, latitude 20
  EXPECT_FLOAT_EQ(at(reader, arrays::LiquidWater, 10, 21, 13), 5.904539e-08F);
  EXPECT_NEAR(at(reader, arrays::Height, 10, 21, 13), 4291.89034, 1e-3);
  EXPECT_FLOAT_EQ(at(reader, arrays::Temperature, 10, 21, 13), 268.91327F);
  EXPECT_FLOAT_EQ(at(reader, arrays::Pressure, 10, 21, 13), 60000);
  EXPECT_FLOAT_EQ(at(reader, arrays::LiquidWater, 50, 24, 36 - 29), 0.00030611534F); // the maximum
  // east 18.31016, north 1.9202733 m/s at 56.25 E 24.91993 N, upward 0
  const double lon = 56.25 * 3.14159265358979 / 180;
  const double lat = 24.91992862994862 * 3.14159265358979 / 180;
  EXPECT_NEAR(at(reader, arrays::Wind, 10, 21, 13, 0),
    -18.31016 * std::sin(lon) - 1.9202733 * std::sin(lat) * std::cos(lon), 1e-5);
  EXPECT_NEAR(at(reader, arrays::Wind, 10, 21, 13, 2), 1.9202733 * std::cos(lat), 1e-5);
  double p[3];
  pointAt(reader, 10, 21, 13, p);
  EXPECT_NEAR(std::hypot(p[0], p[1], p[2]), 6371229 + 40 * 4291.89034, 0.1);
  EXPECT_NEAR(std::asin(p[2] / std::hypot(p[0], p[1], p[2])), lat, 1e-12);
  for (int k = 0; k < 37; k += 12)
  {
    double q[3];
    pointAt(reader, 0, 5, k, p);
    pointAt(reader, 64, 5, k, q);
    EXPECT_TRUE(std::equal(p, p + 3, q)); // the seam, to the last bit
    pointAt(reader, 31, 33, k, p);
    EXPECT_EQ(p[0], 0);
    EXPECT_GT(p[2], 6371000);
  }
  EXPECT_EQ(reader->GetOutput()->GetPointData()->GetArray(arrays::CloudFraction), nullptr);
}

TEST(SharedFiles, Era5PackedFractionInReversedDimensionOrder)
{
  vtkNew<vtkCloudNetCDFReader> reader;
  OPEN_OR_SKIP(reader, "era5_fraction_13h.nc");
  reader->UpdateTimeStep(7 * 3600.0);
  EXPECT_EQ(reader->GetChosenGeometry(), vtkCloudNetCDFReader::Map);
  EXPECT_EQ(reader->GetNumberOfTimeSteps(), 13);
  EXPECT_STREQ(reader->GetTimeLabel(7), "2019-01-01T07:00:00");
  EXPECT_EQ(at(reader, arrays::CloudFraction, 5, 3, 2), 0);        // raw -32766: 0 after unpacking
  EXPECT_NEAR(at(reader, arrays::Pressure, 5, 3, 2), 22500, 1e-2); // 225 mb, not millibarn
  EXPECT_NEAR(at(reader, arrays::Height, 5, 3, 2), 10842.204618, 1e-3);
  // w = -omega Rd T (1 + 0.6077 q) / (p g), omega -0.0900921 Pa/s, T 217.674544, q 1.10812e-5
  const double w = 0.09009208348564535 * 287.05 * 217.67454419 / (22500 * 9.80665);
  EXPECT_NEAR(at(reader, arrays::Wind, 5, 3, 2, 2), w, 1e-5 * w + 1e-7);
  EXPECT_TRUE(says(reader,
    "Wind: eastward_wind, northward_wind, upward from lagrangian_tendency_of_air_pressure, "
    "hydrostatic, along the scene's axes"));
  double p[3];
  pointAt(reader, 5, 3, 2, p); // 33.5 W 54 N on a plate carree
  EXPECT_NEAR(p[0], -33.5 * 6371229 * 3.14159265358979 / 180, 1e-3);
  EXPECT_NEAR(p[1], 54 * 6371229 * 3.14159265358979 / 180, 1e-3);
}

TEST(SharedFiles, WrfDestaggersAndFindsItsMercatorPlane)
{
  vtkNew<vtkCloudNetCDFReader> reader;
  OPEN_OR_SKIP(reader, "wrf_katrina.nc");
  reader->UpdateInformation();
  EXPECT_EQ(reader->GetNumberOfTimeSteps(), 4);
  EXPECT_STREQ(reader->GetTimeLabel(3), "2005-08-28T21:00:00"); // as Times says
  EXPECT_STREQ(reader->GetTimeUnits(), "seconds since 2005-08-28T00:00:00");
  reader->UpdateTimeStep(reader->GetTimeValue(2));
  EXPECT_EQ(reader->GetChosenGeometry(), vtkCloudNetCDFReader::Local);
  // t 2, k 5, j 30, i 11; pressure P + PB, height the mean of the faces of (PH + PHB) / 9.81, T = theta (p/p0)^(2/7)
  EXPECT_NEAR(at(reader, arrays::Pressure, 11, 30, 5), 92157.4921875, 0.01);
  EXPECT_NEAR(at(reader, arrays::Height, 11, 30, 5), 697.747482, 1e-3);
  EXPECT_NEAR(at(reader, arrays::Temperature, 11, 30, 5), 296.557540, 1e-4);
  EXPECT_FLOAT_EQ(
    at(reader, arrays::LiquidWater, 38, 47, 9), 0.0013983792F); // the maximum of the step
  // Grid winds stay as they are in the grid's own plane.
  EXPECT_NEAR(at(reader, arrays::Wind, 11, 30, 5, 0), 11.456436157, 2e-4);
  EXPECT_NEAR(at(reader, arrays::Wind, 11, 30, 5, 1), -14.746974945, 2e-4);
  EXPECT_NEAR(at(reader, arrays::Wind, 11, 30, 5, 2), 0.0114347078, 1e-7);
  double a[3];
  double b[3];
  double c[3];
  pointAt(reader, 0, 0, 0, a);
  pointAt(reader, 47, 0, 0, b);
  pointAt(reader, 0, 47, 0, c);
  EXPECT_NEAR(b[0] - a[0], 470000, 5); // DX = 10000 m, from the longitudes in float
  EXPECT_NEAR(c[1] - a[1], 470000, 5);
  reader->SetDiagnoseCloudFraction(true);
  reader->Update();
  const double q = at(reader, arrays::SpecificHumidity, 38, 47, 9);
  EXPECT_NEAR(at(reader, arrays::CloudFraction, 38, 47, 9),
    cloudFractionXuRandall(at(reader, arrays::LiquidWater, 38, 47, 9), 0, q,
      at(reader, arrays::Temperature, 38, 47, 9), at(reader, arrays::Pressure, 38, 47, 9)),
    1e-6);
}

TEST(SharedFiles, UmCospAddsConvectiveWater)
{
  vtkNew<vtkCloudNetCDFReader> reader;
  OPEN_OR_SKIP(reader, "um_cosp.nc");
  reader->Update();
  EXPECT_NEAR(at(reader, arrays::Pressure, 3, 6, 12), 65393.82421875, 0.01);
  EXPECT_NEAR(at(reader, arrays::Height, 3, 6, 12), 3682.06787, 1e-3);
  EXPECT_NEAR(at(reader, arrays::Temperature, 3, 6, 12), 273.236145, 1e-4);
  double sum = 0;
  vtkDataArray* fraction = reader->GetOutput()->GetPointData()->GetArray(arrays::CloudFraction);
  for (vtkIdType i = 0; i < fraction->GetNumberOfTuples(); ++i)
  {
    sum += fraction->GetComponent(i, 0);
  }
  EXPECT_NEAR(sum, 340.2051, 1e-3); // of tca over all 17 x 9 x 38 boxes
  EXPECT_TRUE(says(reader, "LiquidWater: mr_lsliq + mr_ccliq"));
}

TEST(SharedFiles, Cmip6TurnsTheTermsOfItsBoundsRound)
{
  vtkNew<vtkCloudNetCDFReader> reader;
  OPEN_OR_SKIP(reader, "cmip6_cesm2_cl.nc");
  reader->UpdateInformation();
  ASSERT_EQ(reader->GetNumberOfTimeSteps(), 780);
  EXPECT_STREQ(reader->GetVerticalCoordinate(), "hybrid sigma-pressure");
  EXPECT_STREQ(reader->GetCalendar(), "noleap");
  EXPECT_STREQ(reader->GetTimeLabel(400), "1983-05-15T12:00:00"); // cftime
  reader->UpdateTimeStep(reader->GetTimeValue(400));
  // p0 mean(a_bnds) + mean(b_bnds) ps(400, 1, 2), terms reversed; level 0 of cl is the top
  const double pressure[3][2] = { { 0, 100209.5489718765 }, { 18, 16822.507977485657 },
    { 31, 364.346569404006 } };
  for (const auto& row : pressure)
  {
    EXPECT_NEAR(
      at(reader, arrays::Pressure, 2, 1, static_cast<int>(row[0])), row[1], 6e-8 * row[1]);
  }
  EXPECT_NEAR(
    at(reader, arrays::CloudFraction, 2, 1, 18), 0.5152987289, 1e-7); // per cent in the file
  EXPECT_NEAR(at(reader, arrays::CloudFraction, 2, 1, 0), 7.154315e-09, 1e-14);
  ASSERT_EQ(reader->GetNumberOfWarnings(), 2);
  EXPECT_STREQ(reader->GetWarning(0),
    "variable lev_bnds: the terms of its formula run against lev and were turned round");
}

TEST(SharedFiles, UmHybridHeightByNameOnItsRotatedPole)
{
  vtkNew<vtkCloudNetCDFReader> reader;
  OPEN_OR_SKIP(reader, "um_hybrid_height.nc");
  EXPECT_NE(messageOf(reader).find("no variable of cloud fraction, liquid or ice was found among: "
                                   "air_potential_temperature"),
    std::string::npos);
  reader->SetVariableName("PotentialTemperature", "air_potential_temperature");
  reader->Update();
  EXPECT_STREQ(reader->GetVerticalCoordinate(), "hybrid height");
  EXPECT_NEAR(
    at(reader, arrays::Height, 20, 70, 9), 754.3160369, 1e-4); // level_height + sigma orog
  EXPECT_NEAR(at(reader, arrays::PotentialTemperature, 20, 70, 9), 288.03513, 1e-4);
  EXPECT_STREQ(reader->GetTimeLabel(0), "2009-09-09T17:10:00");
  double p[3];
  pointAt(reader, 20, 70, 0, p);
  reader->SetGeometryToMap();
  reader->SetMapUnits(vtkCloudNetCDFReader::Degrees);
  reader->Update();
  double q[3];
  pointAt(reader, 20, 70, 0, q);
  EXPECT_NEAR(q[0], -3.1600309197, 1e-5); // the textbook rotation, in numpy
  EXPECT_NEAR(q[1], 52.4333611646, 1e-5);
}

TEST(SharedFiles, EcradMeridianIsACurtain)
{
  vtkNew<vtkCloudNetCDFReader> reader;
  OPEN_OR_SKIP(reader, "ecrad_meridian.nc");
  reader->Update();
  const int expected[3] = { 1, 32, 137 };
  EXPECT_TRUE(std::equal(expected, expected + 3, reader->GetDimensions()));
  // file column 7 (47.06964 N, descending), level 100 from the top; means of the half levels
  EXPECT_NEAR(at(reader, arrays::Pressure, 0, 24, 36), 59884.904296875, 0.01);
  EXPECT_NEAR(at(reader, arrays::Temperature, 0, 24, 36), 243.40534973, 1e-4);
  EXPECT_GT(at(reader, arrays::CloudFraction, 0, 31 - 5, 136 - 129), 0.9);
  double p[3];
  pointAt(reader, 0, 24, 36, p);
  EXPECT_NEAR(p[1], 47.06964 * 6371229 * 3.14159265358979 / 180, 1);
  EXPECT_NEAR(p[0], 135 * 6371229 * 3.14159265358979 / 180, 1);
  // Hydrostatic: the 500 hPa surface of mid-latitude January at 47 N over Asia lies between 5.0 and 5.6 km.
  int k = 0;
  while (at(reader, arrays::Pressure, 0, 24, k) > 50000)
  {
    ++k;
  }
  EXPECT_GT(at(reader, arrays::Height, 0, 24, k), 5000);
  EXPECT_LT(at(reader, arrays::Height, 0, 24, k), 5600);
}
