// SPDX-License-Identifier: BSD-3-Clause
// What the reader makes of small files whose right answer is known in closed form.
#include "SmallFile.h"

#include "CloudArrays.h"
#include "VerticalCoordinate.h"

#include <netcdf.h>

#include <vtkDataSetAttributes.h>
#include <vtkFieldData.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <cmath>

using namespace nephoscope;

namespace
{
constexpr double Radius = 6371229;
constexpr double Degree = 3.14159265358979323846 / 180;

/// 3 longitudes, 2 latitudes, `levels` levels named lev.
void axes(SmallFile& file, std::size_t levels)
{
  file.dimension("lev", levels).dimension("lat", 2).dimension("lon", 3);
  file.variable("lon", { "lon" }, { 0, 1, 2 }, { { "units", "degrees_east" } });
  file.variable("lat", { "lat" }, { 10, 11 }, { { "units", "degrees_north" } });
}

void cloud(SmallFile& file, std::size_t values)
{
  file.variable(
    "cl", { "lev", "lat", "lon" }, std::vector<double>(values, 0.25), { { "units", "1" } });
}

const std::vector<double> SurfacePressure = { 101325, 95000, 70000, 52000, 101000, 99000 };

void surfacePressure(SmallFile& file)
{
  file.variable("ps", { "lat", "lon" }, SurfacePressure, { { "units", "Pa" } });
}

void read(vtkCloudNetCDFReader* reader, SmallFile& file)
{
  reader->SetFileName(file.path());
  EXPECT_EQ(messageOf(reader), "");
}

/// pressure[k][column] of the output against a law.
template <class Law>
void expectPressure(vtkCloudNetCDFReader* reader, int levels, const Law& law)
{
  for (int k = 0; k < levels; ++k)
  {
    for (int c = 0; c < 6; ++c)
    {
      const double expected = law(k, SurfacePressure[static_cast<std::size_t>(c)]);
      EXPECT_NEAR(
        at(reader, arrays::Pressure, c % 3, c / 3, k), expected, 6e-8 * expected); // float
    }
  }
}
}

TEST(NetCDFReader, HybridPressureInEverySpelling)
{
  const double a[] = { 0.0, 0.1, 0.02 }; // from the ground up
  const double b[] = { 0.99, 0.5, 0.0 };
  const auto law = [&](int k, double ps) { return a[k] * 1e5 + b[k] * ps; };
  for (int spelling = 0; spelling < 5; ++spelling)
  {
    const bool topFirst = spelling % 2 == 0;
    std::vector<double> fa(a, a + 3);
    std::vector<double> fb(b, b + 3);
    if (topFirst)
    {
      std::reverse(fa.begin(), fa.end());
      std::reverse(fb.begin(), fb.end());
    }
    SmallFile file;
    axes(file, 3);
    surfacePressure(file);
    const char* standard = "atmosphere_hybrid_sigma_pressure_coordinate";
    if (spelling < 2) // a b p0 ps, two orders of the terms
    {
      file.variable("lev", { "lev" }, { 1, 2, 3 },
        { { "standard_name", standard },
          { "formula_terms", spelling ? "a: A b: B p0: P0 ps: ps" : "ps: ps p0: P0 b: B a: A" } });
      file.variable("P0", {}, { 1000 }, { { "units", "hPa" } });
      file.variable("A", { "lev" }, fa).variable("B", { "lev" }, fb);
    }
    else if (spelling < 4) // ap b ps, and names only
    {
      std::for_each(fa.begin(), fa.end(), [](double& v) { v *= 1e5; });
      const bool formula = spelling == 2;
      file.variable("lev", { "lev" }, { 1, 2, 3 },
        formula ? SmallFile::Text{ { "standard_name", standard },
                    { "formula_terms", "b: hybm ps: ps ap: hyam" } }
                : SmallFile::Text{});
      file.variable("hyam", { "lev" }, fa, { { "units", "Pa" } }).variable("hybm", { "lev" }, fb);
    }
    else // CAM: hyam, hybm, P0, PS
    {
      file.variable("lev", { "lev" }, { 20, 600, 990 },
        { { "units", "hPa" }, { "long_name", "hybrid level at midpoints" },
          { "positive", "down" } });
      file.variable("P0", {}, { 1e5 }, { { "units", "Pa" } });
      file.variable("hyam", { "lev" }, fa).variable("hybm", { "lev" }, fb);
    }
    cloud(file, 18);
    vtkNew<vtkCloudNetCDFReader> reader;
    read(reader, file);
    EXPECT_STREQ(reader->GetVerticalCoordinate(), "hybrid sigma-pressure") << spelling;
    expectPressure(reader, 3, law);
  }
}

TEST(NetCDFReader, SigmaAndLnPressure)
{
  SmallFile file;
  axes(file, 2);
  surfacePressure(file);
  file.variable("ptop", {}, { 50 }, { { "units", "hPa" } });
  file.variable("lev", { "lev" }, { 0.9, 0.2 },
    { { "standard_name", "atmosphere_sigma_coordinate" },
      { "formula_terms", "sigma: lev ps: ps ptop: ptop" } });
  cloud(file, 12);
  vtkNew<vtkCloudNetCDFReader> reader;
  read(reader, file);
  expectPressure(reader, 2, [](int k, double ps) { return 5000 + (k ? 0.2 : 0.9) * (ps - 5000); });

  SmallFile logarithmic;
  axes(logarithmic, 2);
  logarithmic.variable("p0", {}, { 1e5 }, { { "units", "Pa" } });
  logarithmic.variable("lev", { "lev" }, { 0.1, 2 },
    { { "standard_name", "atmosphere_ln_pressure_coordinate" },
      { "formula_terms", "p0: p0 lev: lev" } });
  cloud(logarithmic, 12);
  vtkNew<vtkCloudNetCDFReader> other;
  read(other, logarithmic);
  expectPressure(other, 2, [](int k, double) { return 1e5 * std::exp(k ? -2 : -0.1); });
}

TEST(NetCDFReader, SleveHeightsFollowTheTerrain)
{
  SmallFile file;
  axes(file, 2);
  const std::vector<double> large = { 0, 100, 200, 300, 400, 500 };
  const std::vector<double> small = { 50, 40, 30, 20, 10, 0 };
  file.variable("z1", { "lat", "lon" }, large, { { "units", "m" } });
  file.variable("z2", { "lat", "lon" }, small, { { "units", "m" } });
  file.variable("top", {}, { 30 }, { { "units", "km" } });
  file.variable("b1", { "lev" }, { 0.9, 0.3 }).variable("b2", { "lev" }, { 0.8, 0.1 });
  file.variable("lev", { "lev" }, { 0.1, 0.5 },
    { { "standard_name", "atmosphere_sleve_coordinate" },
      { "formula_terms", "a: lev b1: b1 b2: b2 ztop: top zsurf1: z1 zsurf2: z2" } });
  cloud(file, 12);
  vtkNew<vtkCloudNetCDFReader> reader;
  read(reader, file);
  for (int c = 0; c < 6; ++c)
  {
    EXPECT_NEAR(
      at(reader, arrays::Height, c % 3, c / 3, 0), 3000 + 90 * c + 0.8 * (50 - 10 * c), 1e-3);
    EXPECT_NEAR(
      at(reader, arrays::Height, c % 3, c / 3, 1), 15000 + 30 * c + 0.1 * (50 - 10 * c), 2e-3);
  }
}

TEST(NetCDFReader, EveryDimensionOrderAndDirectionGivesTheSameGrid)
{
  const char* orders[][3] = { { "lev", "lat", "lon" }, { "lon", "lat", "lev" },
    { "lat", "lon", "lev" }, { "lon", "lev", "lat" } };
  for (int turn = 0; turn < 8; ++turn)
  {
    for (const auto& order : orders)
    {
      const bool flip[3] = { (turn & 1) != 0, (turn & 2) != 0, (turn & 4) != 0 };
      const std::size_t size[3] = { 4, 3, 2 };
      SmallFile file;
      file.dimension("lev", 2).dimension("lat", 3).dimension("lon", 4);
      const auto axis = [](std::vector<double> v, bool reverse)
      {
        if (reverse)
        {
          std::reverse(v.begin(), v.end());
        }
        return v;
      };
      file.variable(
        "lon", { "lon" }, axis({ 5, 6, 8, 9 }, flip[0]), { { "units", "degrees_east" } });
      file.variable(
        "lat", { "lat" }, axis({ -30, 0, 20 }, flip[1]), { { "units", "degrees_north" } });
      file.variable("lev", { "lev" }, axis({ 900, 300 }, flip[2]), { { "units", "hPa" } });
      std::size_t stride[3] = { 0, 0, 0 };
      std::size_t step = 1;
      for (int d = 2; d >= 0; --d)
      {
        const int which = std::string(order[d]) == "lon" ? 0
          : std::string(order[d]) == "lat"               ? 1
                                                         : 2;
        stride[which] = step;
        step *= size[which];
      }
      std::vector<double> values(24);
      for (std::size_t n = 0; n < 24; ++n)
      {
        const std::size_t place[3] = { n % 4, n / 4 % 3, n / 12 };
        std::size_t to = 0;
        for (int d = 0; d < 3; ++d)
        {
          to += stride[d] * (flip[d] ? size[d] - 1 - place[d] : place[d]);
        }
        values[to] = static_cast<double>(n) / 32;
      }
      file.variable("cl", { order[0], order[1], order[2] }, values, { { "units", "1" } });
      vtkNew<vtkCloudNetCDFReader> reader;
      reader->SetMapUnits(vtkCloudNetCDFReader::Degrees);
      read(reader, file);
      for (int n = 0; n < 24; ++n)
      {
        EXPECT_EQ(at(reader, arrays::CloudFraction, n % 4, n / 4 % 3, n / 12), n / 32.0);
      }
      double p[3];
      pointAt(reader, 2, 2, 0, p);
      EXPECT_NEAR(p[0], 8, 1e-12);
      EXPECT_NEAR(p[1], 20, 1e-12);
      EXPECT_NEAR(p[2], standardHeight(90000) / (Radius * Degree), 1e-8);
    }
  }
}

TEST(NetCDFReader, MasksBeforeUnpackingAndHidesWhatIsMissing)
{
  SmallFile file;
  axes(file, 2);
  file.variable("lev", { "lev" }, { 1000, 500 }, { { "units", "hPa" } });
  // Raw 50 unpacks to 0.5; raw 100 is the fill although 100 * 0.01 = 1 were a good fraction; 120 is outside valid_max.
  file.variable("cl", { "lev", "lat", "lon" }, { 50, 100, 120, 0, 99, 101, 1, 2, 3, 4, 5, 6 },
    { { "units", "1" } }, NC_SHORT,
    { { "_FillValue", 100 }, { "missing_value", 101 }, { "scale_factor", 0.01 } });
  file.number("cl", "valid_max", 1.1);
  vtkNew<vtkCloudNetCDFReader> reader;
  read(reader, file);
  EXPECT_FLOAT_EQ(at(reader, arrays::CloudFraction, 0, 0, 0), 0.5F);
  EXPECT_FLOAT_EQ(at(reader, arrays::CloudFraction, 1, 1, 0), 0.99F);
  const int missing[][2] = { { 1, 0 }, { 2, 0 }, { 2, 1 } };
  vtkDataArray* ghosts =
    reader->GetOutput()->GetPointData()->GetArray(vtkDataSetAttributes::GhostArrayName());
  ASSERT_NE(ghosts, nullptr);
  for (const auto& place : missing)
  {
    EXPECT_TRUE(std::isnan(at(reader, arrays::CloudFraction, place[0], place[1], 0)));
    EXPECT_EQ(at(reader, vtkDataSetAttributes::GhostArrayName(), place[0], place[1], 0),
      vtkDataSetAttributes::HIDDENPOINT);
  }
  EXPECT_EQ(ghosts->GetRange(0)[0], 0);
}

TEST(NetCDFReader, PerCentWithAndWithoutUnits)
{
  for (const bool named : { true, false })
  {
    SmallFile file;
    axes(file, 2);
    file.variable("lev", { "lev" }, { 1000, 500 }, { { "units", "hPa" } });
    file.variable("cl", { "lev", "lat", "lon" }, std::vector<double>(12, 30),
      named ? SmallFile::Text{ { "units", "%" } } : SmallFile::Text{});
    vtkNew<vtkCloudNetCDFReader> reader;
    read(reader, file);
    EXPECT_FLOAT_EQ(at(reader, arrays::CloudFraction, 1, 1, 1), 0.3F);
    const std::string said = named ? "" : reader->GetWarning(reader->GetNumberOfWarnings() - 1);
    EXPECT_EQ(said.find("taken for per cent") != std::string::npos, !named);
  }
}

namespace
{
/// A zonal wind of 10 m/s and a fraction that grows with the file's longitude index, on 8 x 4 columns.
void globalFile(SmallFile& file, double first, bool wrapInside, bool closed)
{
  const std::size_t nx = closed ? 9 : 8;
  file.dimension("lev", 2).dimension("lat", 4).dimension("lon", nx);
  std::vector<double> lon;
  std::vector<double> values;
  for (std::size_t i = 0; i < nx; ++i)
  {
    const double x = first + 45 * static_cast<double>(i);
    lon.push_back(wrapInside && x >= 180 ? x - 360 : x);
  }
  for (std::size_t n = 0; n < nx * 8; ++n)
  {
    values.push_back(static_cast<double>(n % nx % 8) / 8);
  }
  file.variable("lon", { "lon" }, lon, { { "units", "degrees_east" } });
  file.variable("lat", { "lat" }, { 67.5, 22.5, -22.5, -67.5 }, { { "units", "degrees_north" } });
  file.variable("lev", { "lev" }, { 200, 850 }, { { "units", "hPa" } });
  file.variable("cl", { "lev", "lat", "lon" }, values, { { "units", "1" } });
  file.variable(
    "ua", { "lev", "lat", "lon" }, std::vector<double>(nx * 8, 10), { { "units", "m s-1" } });
  file.variable(
    "va", { "lev", "lat", "lon" }, std::vector<double>(nx * 8, 0), { { "units", "m s-1" } });
}
}

TEST(NetCDFReader, GlobeIsClosedWhateverTheLongitudes)
{
  for (int way = 0; way < 4; ++way)
  {
    SmallFile file;
    globalFile(file, way == 1 ? -180 : 0, way == 2, way == 3);
    vtkNew<vtkCloudNetCDFReader> reader;
    read(reader, file);
    EXPECT_EQ(reader->GetChosenGeometry(), vtkCloudNetCDFReader::Globe) << way;
    const int expected[3] = { 9, 6, 2 };
    ASSERT_TRUE(std::equal(expected, expected + 3, reader->GetDimensions())) << way;
    for (int j = 0; j < 6; ++j)
    {
      double a[3];
      double b[3];
      pointAt(reader, 0, j, 1, a);
      pointAt(reader, 8, j, 1, b);
      for (int c = 0; c < 3; ++c)
      {
        EXPECT_NEAR(a[c], b[c], 1e-8);
      }
      EXPECT_EQ(
        at(reader, arrays::CloudFraction, 0, j, 1), at(reader, arrays::CloudFraction, 8, j, 1));
    }
    for (int i = 0; i < 9; ++i)
    {
      double pole[3];
      pointAt(reader, i, 5, 0, pole);
      EXPECT_NEAR(pole[2], Radius + standardHeight(85000), 0.01);
      EXPECT_EQ(std::hypot(pole[0], pole[1]), 0);
      if (way != 3)
      {
        EXPECT_FLOAT_EQ(
          at(reader, arrays::CloudFraction, i, 5, 0), 3.5F / 8); // the mean of the row
        EXPECT_NEAR(
          at(reader, arrays::Wind, i, 5, 0, 0), 0, 1e-5); // a zonal wind has no mean at the pole
      }
    }
    const double lon = (way == 1 ? -180 : 0) * Degree;
    EXPECT_NEAR(at(reader, arrays::Wind, 0, 2, 0, 0), -10 * std::sin(lon), 1e-5);
    EXPECT_NEAR(at(reader, arrays::Wind, 0, 2, 0, 1), 10 * std::cos(lon), 1e-5);
  }
}

TEST(NetCDFReader, PiecesAreTheWhole)
{
  SmallFile file;
  globalFile(file, 0, false, false);
  vtkNew<vtkCloudNetCDFReader> whole;
  read(whole, file);
  vtkNew<vtkCloudNetCDFReader> piece;
  piece->SetFileName(file.path());
  piece->UpdateInformation();
  const int extents[][6] = { { 0, 3, 0, 2, 0, 1 }, { 5, 8, 1, 3, 1, 1 }, { 8, 8, 3, 5, 0, 1 } };
  for (const auto& extent : extents)
  {
    piece->UpdateExtent(extent);
    vtkStructuredGrid* part = piece->GetOutput();
    EXPECT_TRUE(std::equal(extent, extent + 6, part->GetExtent()));
    vtkIdType at = 0;
    for (int k = extent[4]; k <= extent[5]; ++k)
    {
      for (int j = extent[2]; j <= extent[3]; ++j)
      {
        for (int i = extent[0]; i <= extent[1]; ++i, ++at)
        {
          const vtkIdType all = (k * 6 + j) * 9 + i;
          double a[3];
          double b[3];
          part->GetPoint(at, a);
          whole->GetOutput()->GetPoint(all, b);
          EXPECT_TRUE(std::equal(a, a + 3, b));
          for (const char* name : { arrays::CloudFraction, arrays::Pressure, arrays::Wind })
          {
            EXPECT_EQ(part->GetPointData()->GetArray(name)->GetComponent(at, 0),
              whole->GetOutput()->GetPointData()->GetArray(name)->GetComponent(all, 0));
          }
        }
      }
    }
  }
}

TEST(NetCDFReader, HeightsAreHypsometric)
{
  SmallFile file;
  axes(file, 3);
  surfacePressure(file);
  file.variable("lev", { "lev" }, { 500, 300, 100 }, { { "units", "hPa" } });
  file.variable("ta", { "lev", "lat", "lon" }, std::vector<double>(18, 250), { { "units", "K" } });
  file.variable("orog", { "lat", "lon" }, std::vector<double>(6, 200), { { "units", "m" } });
  cloud(file, 18);
  vtkNew<vtkCloudNetCDFReader> reader;
  read(reader, file);
  const double p[] = { 5e4, 3e4, 1e4 };
  for (int k = 0; k < 3; ++k)
  {
    const double z = 200 + 287.05 * 250 / 9.80665 * std::log(101325 / p[k]);
    EXPECT_NEAR(at(reader, arrays::Height, 0, 0, k), z, 1e-3);
  }
}

TEST(NetCDFReader, ExaggerationLeavesHeightAlone)
{
  SmallFile file;
  axes(file, 2);
  file.variable(
    "lev", { "lev" }, { 100, 3000 }, { { "units", "m" }, { "standard_name", "altitude" } });
  cloud(file, 12);
  vtkNew<vtkCloudNetCDFReader> reader;
  reader->SetVerticalExaggeration(25);
  for (const int geometry :
    { vtkCloudNetCDFReader::Map, vtkCloudNetCDFReader::Globe, vtkCloudNetCDFReader::Local })
  {
    reader->SetGeometry(geometry);
    read(reader, file);
    EXPECT_EQ(at(reader, arrays::Height, 1, 1, 1), 3000);
    double low[3];
    double high[3];
    pointAt(reader, 1, 1, 0, low);
    pointAt(reader, 1, 1, 1, high);
    EXPECT_NEAR(std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]), 25 * 2900, 1e-6);
    vtkFieldData* said = reader->GetOutput()->GetFieldData();
    EXPECT_EQ(said->GetArray(arrays::HeightScale)->GetComponent(0, 0), 25);
    const auto* name = vtkStringArray::SafeDownCast(said->GetAbstractArray(arrays::Geometry));
    ASSERT_NE(name, nullptr);
  }
}

TEST(NetCDFReader, StaggeredWindsMeetAtTheCentres)
{
  SmallFile file;
  axes(file, 2);
  file.dimension("slon", 4).dimension("slat", 3);
  file.variable("lev", { "lev" }, { 1000, 500 }, { { "units", "hPa" } });
  file.variable("slon", { "slon" }, { -0.5, 0.5, 1.5, 2.5 }, { { "units", "degrees_east" } });
  std::vector<double> u;
  std::vector<double> v;
  for (int n = 0; n < 16; ++n)
  {
    u.push_back(n % 4); // u = lon + 0.5
  }
  for (int n = 0; n < 18; ++n)
  {
    v.push_back(n / 3 % 3); // faces j - 1/2: v = j at face j
  }
  file.variable("u", { "lev", "lat", "slon" }, u, { { "units", "m s-1" } });
  file.variable("v", { "lev", "slat", "lon" }, v, { { "units", "m s-1" } });
  cloud(file, 12);
  vtkNew<vtkCloudNetCDFReader> reader;
  read(reader, file);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_FLOAT_EQ(at(reader, arrays::Wind, i, 1, 0, 0), static_cast<float>(i + 0.5));
    EXPECT_FLOAT_EQ(at(reader, arrays::Wind, i, 1, 0, 1), 1.5F);
  }
}

TEST(NetCDFReader, WindTurnsWithTheProjection)
{
  // Polar stereographic, lon_0 = 0: at longitude 90 E true north points along -x of the plane.
  SmallFile file;
  file.dimension("z", 2).dimension("y", 2).dimension("x", 2);
  file.variable("x", { "x" }, { 1000, 1100 },
    { { "units", "km" }, { "standard_name", "projection_x_coordinate" } });
  file.variable(
    "y", { "y" }, { -1, 1 }, { { "units", "km" }, { "standard_name", "projection_y_coordinate" } });
  file.variable("z", { "z" }, { 100, 1000 }, { { "units", "m" } });
  file.variable("ps_map", {}, { 0 }, { { "grid_mapping_name", "polar_stereographic" } }, NC_INT,
    { { "latitude_of_projection_origin", 90 }, { "straight_vertical_longitude_from_pole", 0 },
      { "standard_parallel", 90 } });
  const std::vector<double> eight(8, 0.5);
  file.variable("cl", { "z", "y", "x" }, eight, { { "units", "1" }, { "grid_mapping", "ps_map" } });
  file.variable("ua", { "z", "y", "x" }, std::vector<double>(8, 0),
    { { "units", "m s-1" }, { "standard_name", "eastward_wind" } });
  file.variable("va", { "z", "y", "x" }, std::vector<double>(8, 7),
    { { "units", "m s-1" }, { "standard_name", "northward_wind" } });
  vtkNew<vtkCloudNetCDFReader> reader;
  read(reader, file);
  EXPECT_EQ(reader->GetChosenGeometry(), vtkCloudNetCDFReader::Local);
  EXPECT_NEAR(at(reader, arrays::Wind, 0, 0, 0, 0), -7, 1e-4);
  EXPECT_NEAR(at(reader, arrays::Wind, 0, 0, 0, 1), 7e-3, 1e-4); // y = -1 km at x = 1000 km
  double p[3];
  pointAt(reader, 1, 1, 0, p);
  EXPECT_EQ(p[0], 1100e3);
  reader->SetGeometryToMap();
  reader->SetMapUnits(vtkCloudNetCDFReader::Degrees);
  reader->Update();
  pointAt(reader, 1, 1, 0, p);
  EXPECT_NEAR(p[0], 90, 0.06); // degrees east
  // Sphere, true at the pole: r = 2 R tan((90 - lat) / 2)
  EXPECT_NEAR(p[1], 90 - 2 * std::atan(std::hypot(1100e3, 1e3) / (2 * Radius)) / Degree, 1e-9);
}

TEST(NetCDFReader, EveryCalendar)
{
  // 59 days after January 1, 2000 and 1 day after 1582-10-04; leap rules and the Gregorian gap decide.
  const char* expected[][3] = { { "standard", "2000-02-29T12:00:00", "1582-10-15T00:00:00" },
    { "proleptic_gregorian", "2000-02-29T12:00:00", "1582-10-05T00:00:00" },
    { "julian", "2000-02-29T12:00:00", "1582-10-05T00:00:00" },
    { "noleap", "2000-03-01T12:00:00", "1582-10-05T00:00:00" },
    { "all_leap", "2000-02-29T12:00:00", "1582-10-05T00:00:00" },
    { "360_day", "2000-02-30T12:00:00", "1582-10-05T00:00:00" } };
  for (const auto& row : expected)
  {
    for (int which = 0; which < 2; ++which)
    {
      SmallFile file;
      axes(file, 2);
      file.variable("lev", { "lev" }, { 1000, 500 }, { { "units", "hPa" } });
      file.variable("time", {}, { which ? 1.0 : 59.5 },
        { { "units", which ? "days since 1582-10-04" : "days since 2000-1-1 0:0:0" },
          { "calendar", row[0] } });
      cloud(file, 12);
      vtkNew<vtkCloudNetCDFReader> reader;
      read(reader, file);
      EXPECT_STREQ(reader->GetTimeLabel(0), row[1 + which]) << row[0];
      EXPECT_EQ(reader->GetTimeValue(0), (which ? 1.0 : 59.5) * 86400);
      EXPECT_EQ(reader->GetTimeOfDate(row[1 + which]), reader->GetTimeValue(0)) << row[0];
      EXPECT_TRUE(std::isnan(reader->GetTimeOfDate("tomorrow")));
      EXPECT_TRUE(std::isnan(reader->GetTimeOfDate("2000-13-01")));
      EXPECT_TRUE(std::isnan(reader->GetTimeOfDate(nullptr)));
    }
  }
}

TEST(NetCDFReader, ExplicitChoiceWins)
{
  SmallFile file;
  axes(file, 2);
  file.variable("lev", { "lev" }, { 1000, 500 }, { { "units", "hPa" } });
  cloud(file, 12);
  file.variable(
    "other", { "lev", "lat", "lon" }, std::vector<double>(12, 0.75), { { "units", "1" } });
  vtkNew<vtkCloudNetCDFReader> reader;
  reader->SetVariableName("CloudFraction", "other");
  read(reader, file);
  EXPECT_STREQ(reader->GetVariableOfRole("CloudFraction"), "other");
  EXPECT_EQ(at(reader, arrays::CloudFraction, 2, 1, 1), 0.75);
}

TEST(NetCDFReader, PlaneInMetresNeedsNoPlaceOnEarth)
{
  SmallFile file;
  file.dimension("z", 3).dimension("y", 2).dimension("x", 4);
  file.variable("x", { "x" }, { 0.02, 0.04, 0.06, 0.08 }, { { "units", "km" } });
  file.variable("y", { "y" }, { 10, 50 }, { { "units", "m" } });
  file.variable("z", { "z" }, { 40, 80, 120 }, { { "units", "m" } });
  file.variable("ql", { "z", "y", "x" }, std::vector<double>(24, 0.5), { { "units", "g kg-1" } });
  vtkNew<vtkCloudNetCDFReader> reader;
  read(reader, file);
  EXPECT_EQ(reader->GetChosenGeometry(), vtkCloudNetCDFReader::Local);
  EXPECT_FLOAT_EQ(at(reader, arrays::LiquidWater, 3, 1, 2), 5e-4F);
  double p[3];
  pointAt(reader, 3, 1, 2, p);
  EXPECT_NEAR(p[0], 80, 1e-9);
  EXPECT_NEAR(p[1], 50, 1e-9);
  EXPECT_NEAR(p[2], 120, 1e-4);
  reader->SetGeometryToGlobe();
  EXPECT_NE(messageOf(reader).find("use SetGeometryToLocal"), std::string::npos);
}

TEST(NetCDFReader, TimesWrittenAsTextAreRead)
{
  SmallFile file;
  file.dimension("Time", 3).dimension("DateStrLen", 19);
  axes(file, 2);
  file.variable("lev", { "lev" }, { 85000, 50000 }, { { "units", "Pa" } });
  file.variable(
    "cl", { "Time", "lev", "lat", "lon" }, std::vector<double>(36, 0.25), { { "units", "1" } });
  const std::string lines = "2000-02-28_18:00:002000-02-29_00:00:002000-03-01_06:30:00";
  file.variable("Times", { "Time", "DateStrLen" }, { lines.begin(), lines.end() }, {}, NC_CHAR);
  vtkNew<vtkCloudNetCDFReader> reader;
  read(reader, file);
  ASSERT_EQ(reader->GetNumberOfTimeSteps(), 3);
  EXPECT_STREQ(reader->GetTimeUnits(), "seconds since 2000-02-28T18:00:00");
  EXPECT_EQ(reader->GetTimeValue(1), 6 * 3600.0);
  EXPECT_EQ(reader->GetTimeValue(2), 36.5 * 3600); // 2000 is a leap year
  EXPECT_STREQ(reader->GetTimeLabel(2), "2000-03-01T06:30:00");
}
