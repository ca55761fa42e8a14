// SPDX-License-Identifier: BSD-3-Clause
// Each bad input: one line that names the file, the variable and the remedy.
#include "SmallFile.h"

#include <netcdf.h>
#include <unistd.h>

#include <fstream>

namespace
{
/// What the reader says of a file, less the file's name, which must come first.
std::string refusal(SmallFile& file, double time = -1)
{
  vtkNew<vtkCloudNetCDFReader> reader;
  const std::string path = file.path();
  reader->SetFileName(path.c_str());
  std::string text;
  if (time >= 0)
  {
    vtkNew<ErrorListener> listener;
    reader->AddObserver(vtkCommand::ErrorEvent, listener);
    reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, listener);
    reader->UpdateTimeStep(time);
    text = listener->Message.substr(listener->Message.find("): ") + 3);
    text.erase(text.find_last_not_of('\n') + 1);
  }
  else
  {
    text = messageOf(reader);
  }
  EXPECT_EQ(text.rfind(path + ": ", 0), 0u) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  return text.substr(std::min(text.size(), path.size() + 2));
}

using Text = SmallFile::Text;

/// 3 x 2 columns on pressure levels, without the cloud.
void axes(SmallFile& file, std::size_t levels = 2)
{
  file.dimension("lev", levels).dimension("lat", 2).dimension("lon", 3);
  file.variable("lon", { "lon" }, { 0, 1, 2 }, { { "units", "degrees_east" } });
  file.variable("lat", { "lat" }, { 10, 11 }, { { "units", "degrees_north" } });
}

void levels(
  SmallFile& file, const std::vector<double>& values = { 1000, 500 }, const char* units = "hPa")
{
  file.variable("lev", { "lev" }, values, { { "units", units } });
}

void cloud(SmallFile& file, double value = 0.5, const char* units = "1")
{
  file.variable(
    "cl", { "lev", "lat", "lon" }, std::vector<double>(12, value), { { "units", units } });
}
}

TEST(NetCDFReaderErrors, MissingFile)
{
  vtkNew<vtkCloudNetCDFReader> reader;
  reader->SetFileName("/no/such/file.nc");
  EXPECT_EQ(messageOf(reader), "/no/such/file.nc: there is no such file; check the path");
}

TEST(NetCDFReaderErrors, NotNetCDF)
{
  SmallFile file;
  std::ofstream(file.path()) << "This is not NetCDF, it is a letter to a friend.";
  EXPECT_EQ(refusal(file),
    "it cannot be opened as NetCDF (NetCDF: Unknown file format); it may be another format, or cut "
    "short: try ncdump -h, or fetch it again");
}

TEST(NetCDFReaderErrors, CutShortAtAnyByte)
{
  for (const int format : { 0, NC_NETCDF4 | NC_CLASSIC_MODEL })
  {
    SmallFile file(format);
    axes(file);
    levels(file);
    cloud(file);
    const std::size_t size = std::filesystem::file_size(file.path());
    for (std::size_t cut : { size - 8, size / 2, std::size_t(40), std::size_t(0) })
    {
      std::filesystem::resize_file(file.path(), cut);
      EXPECT_NE(refusal(file).find("cut short"), std::string::npos) << cut;
    }
  }
}

TEST(NetCDFReaderErrors, NoCloudVariableListsWhatThereIs)
{
  SmallFile file;
  axes(file);
  levels(file);
  file.variable("ta", { "lev", "lat", "lon" }, std::vector<double>(12, 280), { { "units", "K" } });
  file.variable("hus", { "lev", "lat", "lon" }, std::vector<double>(12, 0), { { "units", "1" } });
  EXPECT_EQ(refusal(file),
    "no variable of cloud fraction, liquid or ice was found among: ta, hus; name one with "
    "SetVariableName");
}

TEST(NetCDFReaderErrors, UnknownVerticalCoordinate)
{
  SmallFile file;
  axes(file);
  levels(file, { 1, 2 }, "1");
  cloud(file);
  EXPECT_EQ(refusal(file),
    "variable cl: the vertical coordinate 'lev' is not known; give lev units of pressure or height "
    "or "
    "formula_terms, or the file a pressure or height field");
}

TEST(NetCDFReaderErrors, FormulaTermThatIsNotThere)
{
  SmallFile file;
  axes(file);
  file.variable("lev", { "lev" }, { 0.9, 0.5 },
    { { "standard_name", "atmosphere_sigma_coordinate" },
      { "formula_terms", "sigma: lev ps: ps ptop: ptop" } });
  cloud(file);
  EXPECT_EQ(
    refusal(file), "variable lev: it needs 'ptop', which is not in the file; add it to the file");
}

TEST(NetCDFReaderErrors, WrongUnits)
{
  SmallFile file;
  axes(file);
  levels(file);
  cloud(file, 0.5, "K");
  EXPECT_EQ(refusal(file),
    "variable cl: its units 'K' do not convert to '1' of CloudFraction; correct them, or name "
    "another "
    "variable with SetVariableName");
}

TEST(NetCDFReaderErrors, FractionBeyondOne)
{
  SmallFile file;
  axes(file);
  levels(file);
  cloud(file, 40);
  EXPECT_EQ(refusal(file),
    "variable cl: its largest value is 40, but a cloud fraction ends at 1; correct its "
    "units "
    "('1'), to '%' if it is in per cent");
}

TEST(NetCDFReaderErrors, NonMonotonicAxes)
{
  SmallFile file;
  axes(file, 3);
  levels(file, { 1000, 500, 700 });
  file.variable("cl", { "lev", "lat", "lon" }, std::vector<double>(18, 0), { { "units", "1" } });
  EXPECT_EQ(
    refusal(file), "variable lev: its levels are not monotonic at index 2; sort the levels");
  SmallFile other;
  other.dimension("lev", 2).dimension("lat", 3).dimension("lon", 3);
  other.variable("lon", { "lon" }, { 0, 1, 2 }, { { "units", "degrees_east" } });
  other.variable("lat", { "lat" }, { 10, 12, 11 }, { { "units", "degrees_north" } });
  levels(other);
  other.variable("cl", { "lev", "lat", "lon" }, std::vector<double>(18, 0), { { "units", "1" } });
  EXPECT_EQ(refusal(other), "variable lat: it is not monotonic at index 2; sort the axis");
}

TEST(NetCDFReaderErrors, AllFill)
{
  SmallFile file;
  axes(file);
  levels(file);
  cloud(file, NC_FILL_DOUBLE);
  EXPECT_EQ(refusal(file),
    "variable cl: every value of step 0 is missing; choose another time or variable");
}

TEST(NetCDFReaderErrors, OneLevel)
{
  SmallFile file;
  axes(file, 1);
  levels(file, { 1000 });
  file.variable("cl", { "lev", "lat", "lon" }, std::vector<double>(6, 0), { { "units", "1" } });
  EXPECT_EQ(
    refusal(file), "variable cl: it has one level only; a field of at least 2 levels is needed");
  SmallFile flat;
  axes(flat);
  flat.variable("cl", { "lat", "lon" }, std::vector<double>(6, 0), { { "units", "1" } });
  EXPECT_EQ(refusal(flat),
    "variable cl: it has no vertical axis, one level only; a field of at least 2 levels is needed");
}

TEST(NetCDFReaderErrors, OneColumn)
{
  SmallFile file;
  file.dimension("lev", 2).dimension("lat", 1).dimension("lon", 1);
  levels(file);
  file.variable("cl", { "lev", "lat", "lon" }, { 0, 0 }, { { "units", "1" } });
  EXPECT_EQ(
    refusal(file), "variable cl: it has one column only; a field of at least 2 columns is needed");
}

TEST(NetCDFReaderErrors, TimeOutOfRange)
{
  SmallFile file;
  file.dimension("time", 2);
  axes(file);
  levels(file);
  file.variable("time", { "time" }, { 0, 6 }, { { "units", "hours since 2000-01-01" } });
  file.variable(
    "cl", { "time", "lev", "lat", "lon" }, std::vector<double>(24, 0), { { "units", "1" } });
  EXPECT_EQ(refusal(file, 30000),
    "time 30000 s is out of range; the file has 0 to 21600 seconds since "
    "2000-01-01T00:00:00");
}

TEST(NetCDFReaderErrors, TimeThatTurnsBack)
{
  SmallFile file;
  file.dimension("time", 2);
  axes(file);
  levels(file);
  file.variable("time", { "time" }, { 6, 6 }, { { "units", "hours since 2000-01-01" } });
  file.variable(
    "cl", { "time", "lev", "lat", "lon" }, std::vector<double>(24, 0), { { "units", "1" } });
  EXPECT_EQ(
    refusal(file), "variable time: its times do not increase at step 1; sort the file by time");
}

TEST(NetCDFReaderErrors, UnstructuredColumns)
{
  SmallFile file;
  file.dimension("lev", 2).dimension("ncol", 4);
  file.variable("lon", { "ncol" }, { 0, 90, 10, 200 }, { { "units", "degrees_east" } });
  file.variable("lat", { "ncol" }, { 0, 10, -20, 5 }, { { "units", "degrees_north" } });
  levels(file);
  file.variable("cl", { "lev", "ncol" }, std::vector<double>(8, 0), { { "units", "1" } });
  EXPECT_EQ(refusal(file),
    "variable cl: unstructured columns (dimension ncol) are not supported yet; put the field on a "
    "regular grid first, with cdo remapcon for example");
}

TEST(NetCDFReaderErrors, UnknownRole)
{
  SmallFile file;
  axes(file);
  levels(file);
  cloud(file);
  vtkNew<vtkCloudNetCDFReader> reader;
  reader->SetFileName(file.path());
  reader->SetVariableName("CloudFractoin", "cl");
  EXPECT_NE(
    messageOf(reader).find("role 'CloudFractoin' is not known; the roles are CloudFraction, "),
    std::string::npos);
  reader->ClearVariableNames();
  reader->SetVariableName("CloudFraction", "tcc");
  EXPECT_NE(messageOf(reader).find(
              "variable of role CloudFraction: it needs 'tcc', which is not in the file"),
    std::string::npos);
  reader->ClearVariableNames();
  EXPECT_EQ(messageOf(reader), ""); // and it recovers
}

TEST(NetCDFReaderErrors, LevelsThatNoAtmosphereHas)
{
  const auto refusalOf = [](const std::vector<double>& values, const char* units)
  {
    SmallFile file;
    axes(file);
    levels(file, values, units);
    cloud(file);
    return refusal(file);
  };
  EXPECT_EQ(refusalOf({ -1000, -500 }, "hPa"),
    "variable lev: a level lies at -100000 Pa, and must lie from 0 to 1e+08; correct its values or "
    "its units");
  EXPECT_NE(refusalOf({ 2e30, 1e30 }, "hPa").find("a level lies at 2e+32 Pa"), std::string::npos);
  EXPECT_NE(refusalOf({ 1e20, 1e21 }, "m").find("a level lies at 1e+20 m"), std::string::npos);
}

TEST(NetCDFReaderErrors, AnEmptyUnitOfAnAxisIsNoUnit)
{
  SmallFile file;
  file.dimension("lev", 2).dimension("lat", 2).dimension("lon", 3);
  file.variable("lon", { "lon" }, { 0, 120, 240 }, { { "units", "" } });
  file.variable("lat", { "lat" }, { 10, 11 }, { { "units", "" } });
  levels(file);
  cloud(file);
  vtkNew<vtkCloudNetCDFReader> reader;
  reader->SetFileName(file.path());
  reader->SetGeometryToGlobe();
  EXPECT_EQ(messageOf(reader), "") << "an empty unit is not a radian";
  double x[3];
  reader->GetOutput()->GetPoint(1 + 4 * 2, x); // south of it the pole's row may be put in
  EXPECT_NEAR(std::atan2(x[1], x[0]) * 180 / 3.14159265358979323846, 120, 1e-4);
}

TEST(NetCDFReaderErrors, ForbiddenFile)
{
  if (::geteuid() == 0)
  {
    GTEST_SKIP() << "root may read every file";
  }
  SmallFile file;
  axes(file);
  levels(file);
  cloud(file);
  std::filesystem::permissions(file.path(), std::filesystem::perms::none);
  EXPECT_EQ(refusal(file), "its permissions forbid reading; allow it with chmod u+r");
}
