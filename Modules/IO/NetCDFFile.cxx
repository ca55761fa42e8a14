// SPDX-License-Identifier: BSD-3-Clause
#include "NetCDFFile.h"

#include "ClassicHeader.h"
#include "ReadError.h"

#include <netcdf.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <limits>
#include <system_error>

namespace nephoscope
{
namespace
{
constexpr double Missing = std::numeric_limits<double>::quiet_NaN();
// deflate reaches 1:1032; what claims more than that of its file does not hold it.
constexpr double LargestRatio = 1100;
constexpr double AlwaysAllowed = 64e6; // bytes
constexpr std::size_t LongestAttribute = 1 << 20;

void check(int status, const std::string& what)
{
  if (status != NC_NOERR)
  {
    throw ReadError(
      what + ": " + nc_strerror(status) + "; the file may be damaged: fetch or write it again");
  }
}

bool numeric(int type)
{
  return type >= NC_BYTE && type <= NC_UINT64 && type != NC_CHAR;
}

FileAttribute readAttribute(int file, int variable, const char* name)
{
  FileAttribute attribute;
  std::size_t length = 0;
  if (nc_inq_att(file, variable, name, &attribute.type, &length) != NC_NOERR ||
    length > LongestAttribute)
  {
    return attribute;
  }
  if (attribute.type == NC_CHAR)
  {
    attribute.text.resize(length);
    if (length > 0 && nc_get_att_text(file, variable, name, attribute.text.data()) != NC_NOERR)
    {
      attribute.text.clear();
    }
    attribute.text.resize(std::min(length, attribute.text.find('\0')));
  }
  else if (attribute.type == NC_STRING && length > 0)
  {
    std::vector<char*> strings(length, nullptr);
    if (nc_get_att_string(file, variable, name, strings.data()) == NC_NOERR)
    {
      attribute.text = strings[0] ? strings[0] : "";
      nc_free_string(length, strings.data());
    }
  }
  else if (numeric(attribute.type) && length > 0)
  {
    attribute.numbers.resize(length);
    if (nc_get_att_double(file, variable, name, attribute.numbers.data()) != NC_NOERR)
    {
      attribute.numbers.clear();
    }
  }
  return attribute;
}

std::map<std::string, FileAttribute> readAttributes(int file, int variable, int count)
{
  std::map<std::string, FileAttribute> attributes;
  for (int i = 0; i < count; ++i)
  {
    char name[NC_MAX_NAME + 1] = "";
    if (nc_inq_attname(file, variable, i, name) == NC_NOERR)
    {
      attributes[name] = readAttribute(file, variable, name);
    }
  }
  return attributes;
}

double defaultFill(int type)
{
  switch (type)
  {
    case NC_SHORT:
      return NC_FILL_SHORT;
    case NC_INT:
      return NC_FILL_INT;
    case NC_FLOAT:
      return static_cast<double>(NC_FILL_FLOAT);
    case NC_DOUBLE:
      return NC_FILL_DOUBLE;
    default: // all values of a byte are data by the conventions; others are hardly used for fields
      return Missing;
  }
}

/// How raw values become values: which are missing (before unpacking), then scale and offset.
class Unpacking
{
public:
  explicit Unpacking(const FileVariable& variable)
    : Type(variable.type)
  {
    this->Scale = this->number(variable, "scale_factor", 1);
    this->Offset = this->number(variable, "add_offset", 0);
    const std::string isUnsigned = variable.text("_Unsigned");
    this->UnsignedByte = variable.type == NC_BYTE && (isUnsigned == "true" || isUnsigned == "1");
    for (const char* name : { "_FillValue", "missing_value", "FillValue" })
    {
      const auto found = variable.attributes.find(name);
      if (found != variable.attributes.end())
      {
        for (double value : found->second.numbers)
        {
          this->Fills.push_back(this->rounded(this->asUnsigned(value)));
        }
      }
    }
    if (!variable.has("_FillValue"))
    {
      this->Fills.push_back(this->rounded(defaultFill(variable.type)));
    }
    this->readRange(variable);
  }

  double operator()(double raw) const
  {
    raw = this->asUnsigned(raw);
    bool missing = !std::isfinite(raw) || raw < this->Lowest || raw > this->Highest;
    for (double fill : this->Fills)
    {
      missing = missing || raw == fill;
    }
    return missing ? Missing : raw * this->Scale + this->Offset;
  }

private:
  static double number(const FileVariable& variable, const char* name, double otherwise)
  {
    const auto found = variable.attributes.find(name);
    const bool usable = found != variable.attributes.end() && !found->second.numbers.empty() &&
      std::isfinite(found->second.numbers[0]);
    return usable ? found->second.numbers[0] : otherwise;
  }

  double asUnsigned(double raw) const { return this->UnsignedByte && raw < 0 ? raw + 256 : raw; }

  /// 1e20 as the float that a float variable holds.
  double rounded(double value) const
  {
    const bool fits = std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max());
    return this->Type == NC_FLOAT && fits ? static_cast<double>(static_cast<float>(value)) : value;
  }

  void readRange(const FileVariable& variable)
  {
    const auto range = variable.attributes.find("valid_range");
    if (range != variable.attributes.end() && range->second.numbers.size() == 2)
    {
      this->Lowest = range->second.numbers[0];
      this->Highest = range->second.numbers[1];
    }
    this->Lowest = this->number(variable, "valid_min", this->Lowest);
    this->Highest = this->number(variable, "valid_max", this->Highest);
    // A range of another type than the packed one is that of the unpacked values (netCDF user's guide, appendix A).
    for (const char* name : { "valid_range", "valid_min", "valid_max" })
    {
      const auto found = variable.attributes.find(name);
      const bool unpacked = found != variable.attributes.end() && variable.has("scale_factor") &&
        found->second.type != variable.type && found->second.type >= NC_FLOAT;
      if (unpacked && this->Scale != 0)
      {
        double low = (this->Lowest - this->Offset) / this->Scale;
        double high = (this->Highest - this->Offset) / this->Scale;
        this->Lowest = std::min(low, high);
        this->Highest = std::max(low, high);
        break;
      }
    }
    // Floats are compared as floats.
    this->Lowest -= 1e-7 * std::abs(this->Lowest);
    this->Highest += 1e-7 * std::abs(this->Highest);
  }

  int Type;
  double Scale;
  double Offset;
  bool UnsignedByte = false;
  double Lowest = -std::numeric_limits<double>::max();
  double Highest = std::numeric_limits<double>::max();
  std::vector<double> Fills;
};

std::size_t product(const std::vector<std::size_t>& sizes)
{
  std::size_t n = 1;
  for (std::size_t size : sizes)
  {
    n *= size;
  }
  return n;
}
}

std::string FileVariable::text(const std::string& attribute) const
{
  const auto found = this->attributes.find(attribute);
  return found == this->attributes.end() ? std::string() : found->second.text;
}

bool FileVariable::isNumeric() const
{
  return numeric(this->type);
}

NetCDFFile::NetCDFFile(const std::string& path)
{
  std::error_code error;
  if (!std::filesystem::exists(path, error))
  {
    throw ReadError("there is no such file; check the path");
  }
  if (!std::filesystem::is_regular_file(path, error))
  {
    throw ReadError("it is not a file; name a NetCDF file");
  }
  this->FileSize = static_cast<std::size_t>(std::filesystem::file_size(path, error));
  checkClassicHeader(path, this->FileSize);
  const int status = nc_open(path.c_str(), NC_NOWRITE, &this->Id);
  if (status != NC_NOERR)
  {
    this->Id = -1;
    if (status == EACCES)
    {
      throw ReadError("its permissions forbid reading; allow it with chmod u+r");
    }
    throw ReadError(std::string("it cannot be opened as NetCDF (") + nc_strerror(status) +
      "); it may be another format, or cut short: try ncdump -h, or fetch it again");
  }
  try
  {
    this->catalogue();
  }
  catch (...)
  {
    this->close();
    throw;
  }
}

NetCDFFile::~NetCDFFile()
{
  this->close();
}

void NetCDFFile::close()
{
  if (this->Id >= 0)
  {
    nc_close(this->Id);
    this->Id = -1;
  }
}

void NetCDFFile::catalogue()
{
  int dimensions = 0;
  int variables = 0;
  int attributes = 0;
  check(nc_inq(this->Id, &dimensions, &variables, &attributes, nullptr), "header");
  int unlimitedCount = 0;
  check(nc_inq_unlimdims(this->Id, &unlimitedCount, nullptr), "unlimited dimensions");
  std::vector<int> unlimited(std::max(unlimitedCount, 1));
  check(nc_inq_unlimdims(this->Id, &unlimitedCount, unlimited.data()), "unlimited dimensions");
  std::vector<int> ids(std::max(dimensions, 1));
  check(nc_inq_dimids(this->Id, &dimensions, ids.data(), 0), "dimensions");
  ids.resize(dimensions);
  for (int id : ids)
  {
    char name[NC_MAX_NAME + 1] = "";
    FileDimension dimension;
    check(nc_inq_dim(this->Id, id, name, &dimension.size), "dimension");
    dimension.name = name;
    dimension.record = std::find(unlimited.begin(), unlimited.begin() + unlimitedCount, id) !=
      unlimited.begin() + unlimitedCount;
    this->Dimensions.push_back(dimension);
  }
  for (int id = 0; id < variables; ++id)
  {
    char name[NC_MAX_NAME + 1] = "";
    int count = 0;
    int own[NC_MAX_VAR_DIMS];
    int ownAttributes = 0;
    FileVariable variable;
    variable.id = id;
    if (nc_inq_varndims(this->Id, id, &count) != NC_NOERR || count > 64)
    {
      continue;
    }
    check(nc_inq_var(this->Id, id, name, &variable.type, &count, own, &ownAttributes), "variable");
    variable.name = name;
    for (int i = 0; i < count; ++i)
    {
      const auto place = std::find(ids.begin(), ids.end(), own[i]);
      if (place == ids.end())
      {
        throw ReadError("variable " + variable.name + ": its dimension is not in the file");
      }
      variable.dimensions.push_back(static_cast<int>(place - ids.begin()));
    }
    variable.attributes = readAttributes(this->Id, id, ownAttributes);
    this->Variables.push_back(variable);
  }
  this->Globals = readAttributes(this->Id, NC_GLOBAL, attributes);
}

const FileVariable* NetCDFFile::find(const std::string& name) const
{
  for (const FileVariable& variable : this->Variables)
  {
    if (variable.name == name)
    {
      return &variable;
    }
  }
  return nullptr;
}

bool NetCDFFile::globalNumber(const std::string& name, double& value) const
{
  const auto found = this->Globals.find(name);
  if (found == this->Globals.end() || found->second.numbers.empty() ||
    !std::isfinite(found->second.numbers[0]))
  {
    return false;
  }
  value = found->second.numbers[0];
  return true;
}

std::size_t NetCDFFile::sizeOf(const FileVariable& variable, std::size_t axis) const
{
  return this->Dimensions[variable.dimensions[axis]].size;
}

void NetCDFFile::checkSize(
  const FileVariable& variable, const std::vector<std::size_t>& count) const
{
  double bytes = 8;
  for (std::size_t n : count)
  {
    bytes *= static_cast<double>(n);
  }
  if (bytes > std::max(AlwaysAllowed, LargestRatio * static_cast<double>(this->FileSize)))
  {
    throw ReadError("variable " + variable.name + ": it claims " +
      std::to_string(static_cast<long long>(bytes / 1e6)) + " MB, more than a file of " +
      std::to_string(this->FileSize) + " bytes can hold; the file is damaged: fetch it again");
  }
}

std::vector<double> NetCDFFile::read(const FileVariable& variable,
  const std::vector<std::size_t>& start, const std::vector<std::size_t>& count) const
{
  if (!variable.isNumeric())
  {
    throw ReadError("variable " + variable.name + ": it does not hold numbers; name another one");
  }
  this->checkSize(variable, count);
  std::vector<double> values(product(count));
  if (values.empty())
  {
    return values;
  }
  check(nc_get_vara_double(this->Id, variable.id, start.data(), count.data(), values.data()),
    "variable " + variable.name);
  const Unpacking unpack(variable);
  std::transform(values.begin(), values.end(), values.begin(), unpack);
  return values;
}

std::vector<double> NetCDFFile::readAll(const FileVariable& variable) const
{
  std::vector<std::size_t> count;
  for (std::size_t axis = 0; axis < variable.dimensions.size(); ++axis)
  {
    count.push_back(this->sizeOf(variable, axis));
  }
  return this->read(variable, std::vector<std::size_t>(count.size(), 0), count);
}

std::vector<std::string> NetCDFFile::readText(const FileVariable& variable) const
{
  std::vector<std::string> lines;
  if (variable.type != NC_CHAR || variable.dimensions.empty())
  {
    return lines;
  }
  std::vector<std::size_t> count;
  for (std::size_t axis = 0; axis < variable.dimensions.size(); ++axis)
  {
    count.push_back(this->sizeOf(variable, axis));
  }
  this->checkSize(variable, count);
  const std::size_t length = count.back();
  std::string all(product(count), '\0');
  if (all.empty())
  {
    return lines;
  }
  check(nc_get_var_text(this->Id, variable.id, all.data()), "variable " + variable.name);
  for (std::size_t i = 0; i < all.size(); i += length)
  {
    std::string line = all.substr(i, length);
    lines.push_back(line.substr(0, line.find('\0')));
  }
  return lines;
}
}
