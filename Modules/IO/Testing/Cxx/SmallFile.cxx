// SPDX-License-Identifier: BSD-3-Clause
#include "SmallFile.h"

#include <netcdf.h>
#include <unistd.h>

namespace
{
void expect(int status)
{
  EXPECT_EQ(status, NC_NOERR) << nc_strerror(status);
}
}

SmallFile::SmallFile(int format)
{
  static int count = 0;
  const std::string name =
    "nephoscope-" + std::to_string(getpid()) + "-" + std::to_string(count++) + ".nc";
  this->Path = (std::filesystem::temp_directory_path() / name).string();
  const int mode = format == NetCDF4 ? NC_CLASSIC_MODEL | NC_NETCDF4 : format;
  expect(nc_create(this->Path.c_str(), NC_CLOBBER | mode, &this->Id));
}

SmallFile::~SmallFile()
{
  this->close();
  std::filesystem::remove(this->Path);
}

SmallFile& SmallFile::dimension(const char* name, std::size_t size)
{
  int id = 0;
  expect(nc_def_dim(this->Id, name, size, &id));
  return *this;
}

SmallFile& SmallFile::variable(const char* name, const std::vector<const char*>& dimensions,
  const std::vector<double>& values, const Text& attributes, int type, const Numbers& numbers)
{
  const nc_type stored = type == Double ? NC_DOUBLE : type;
  int dims[8] = {};
  for (std::size_t d = 0; d < dimensions.size(); ++d)
  {
    expect(nc_inq_dimid(this->Id, dimensions[d], &dims[d]));
  }
  int id = 0;
  expect(nc_def_var(this->Id, name, stored, static_cast<int>(dimensions.size()), dims, &id));
  for (const auto& [key, text] : attributes)
  {
    expect(nc_put_att_text(this->Id, id, key, std::string(text).size(), text));
  }
  for (const auto& [key, number] : numbers)
  {
    const bool packed = std::string(key) == "_FillValue" || std::string(key) == "missing_value";
    expect(nc_put_att_double(this->Id, id, key, packed ? stored : NC_DOUBLE, 1, &number));
  }
  expect(nc_enddef(this->Id));
  if (!values.empty() && stored == NC_CHAR)
  {
    const std::string text(values.begin(), values.end()); // the characters' numbers
    expect(nc_put_var_text(this->Id, id, text.data()));
  }
  else if (!values.empty())
  {
    expect(nc_put_var_double(this->Id, id, values.data()));
  }
  expect(nc_redef(this->Id));
  return *this;
}

SmallFile& SmallFile::number(const char* variable, const char* key, double value)
{
  int id = 0;
  expect(nc_inq_varid(this->Id, variable, &id));
  expect(nc_put_att_double(this->Id, id, key, NC_DOUBLE, 1, &value));
  return *this;
}

const char* SmallFile::path()
{
  this->close();
  return this->Path.c_str();
}

void SmallFile::close()
{
  if (this->Id >= 0)
  {
    expect(nc_close(this->Id));
    this->Id = -1;
  }
}
