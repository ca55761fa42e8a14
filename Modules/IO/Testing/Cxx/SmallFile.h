// SPDX-License-Identifier: BSD-3-Clause
// Small NetCDF files made by the tests, and what a reader makes of them.
#ifndef SmallFile_h
#define SmallFile_h

#include "vtkCloudNetCDFReader.h"

#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkExecutive.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStructuredGrid.h>

#include <gtest/gtest.h>
#include <netcdf.h>

#include <filesystem>
#include <string>
#include <unistd.h>
#include <utility>
#include <vector>

/// A file in the temporary folder that goes when the object goes.
class SmallFile
{
public:
  explicit SmallFile(int format = NC_CLASSIC_MODEL | NC_NETCDF4)
  {
    static int count = 0;
    const std::string name =
      "nephoscope-" + std::to_string(getpid()) + "-" + std::to_string(count++) + ".nc";
    this->Path = (std::filesystem::temp_directory_path() / name).string();
    expect(nc_create(this->Path.c_str(), NC_CLOBBER | format, &this->Id));
  }
  ~SmallFile()
  {
    this->close();
    std::filesystem::remove(this->Path);
  }
  SmallFile(const SmallFile&) = delete;
  SmallFile& operator=(const SmallFile&) = delete;

  using Text = std::vector<std::pair<const char*, const char*>>;

  SmallFile& dimension(const char* name, std::size_t size)
  {
    int id = 0;
    expect(nc_def_dim(this->Id, name, size, &id));
    return *this;
  }
  /// Defines a variable and its text attributes; the values may be fewer than it holds (the rest is filled).
  SmallFile& variable(const char* name, const std::vector<const char*>& dimensions,
    const std::vector<double>& values, const Text& attributes = {}, nc_type type = NC_DOUBLE,
    const std::vector<std::pair<const char*, double>>& numbers = {})
  {
    int dims[8] = {};
    for (std::size_t d = 0; d < dimensions.size(); ++d)
    {
      expect(nc_inq_dimid(this->Id, dimensions[d], &dims[d]));
    }
    int id = 0;
    expect(nc_def_var(this->Id, name, type, static_cast<int>(dimensions.size()), dims, &id));
    for (const auto& [key, text] : attributes)
    {
      expect(nc_put_att_text(this->Id, id, key, std::string(text).size(), text));
    }
    for (const auto& [key, number] : numbers)
    {
      const bool packed = std::string(key) == "_FillValue" || std::string(key) == "missing_value";
      expect(nc_put_att_double(this->Id, id, key, packed ? type : NC_DOUBLE, 1, &number));
    }
    expect(nc_enddef(this->Id));
    if (!values.empty())
    {
      expect(nc_put_var_double(this->Id, id, values.data()));
    }
    expect(nc_redef(this->Id));
    return *this;
  }
  SmallFile& attribute(const char* variable, const char* key, const char* text)
  {
    int id = NC_GLOBAL;
    if (variable)
    {
      expect(nc_inq_varid(this->Id, variable, &id));
    }
    expect(nc_put_att_text(this->Id, id, key, std::string(text).size(), text));
    return *this;
  }
  SmallFile& number(const char* variable, const char* key, double value)
  {
    int id = NC_GLOBAL;
    if (variable)
    {
      expect(nc_inq_varid(this->Id, variable, &id));
    }
    expect(nc_put_att_double(this->Id, id, key, NC_DOUBLE, 1, &value));
    return *this;
  }
  const char* path()
  {
    this->close();
    return this->Path.c_str();
  }

private:
  static void expect(int status) { EXPECT_EQ(status, NC_NOERR) << nc_strerror(status); }
  void close()
  {
    if (this->Id >= 0)
    {
      expect(nc_close(this->Id));
      this->Id = -1;
    }
  }
  int Id = -1;
  std::string Path;
};

/// Remembers the last error of a reader instead of printing it.
class ErrorListener : public vtkCommand
{
public:
  static ErrorListener* New() { return new ErrorListener; }
  void Execute(vtkObject*, unsigned long, void* text) override
  {
    if (this->Message.empty())
    {
      this->Message = static_cast<const char*>(text);
    }
  }
  std::string Message;
};

/// The reader's message for a file, empty if it read it.
inline std::string messageOf(vtkCloudNetCDFReader* reader)
{
  vtkNew<ErrorListener> listener;
  reader->AddObserver(vtkCommand::ErrorEvent, listener);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, listener);
  reader->Update();
  std::string text = listener->Message;
  const std::size_t line =
    text.find("): "); // after VTK's "ERROR: In file, line n\nclass (0x...): "
  text = line == std::string::npos ? text : text.substr(line + 3);
  text.erase(text.find_last_not_of('\n') + 1);
  return text;
}

/// Component of a point array at (i, j, k) of the output.
inline double at(
  vtkCloudNetCDFReader* reader, const char* array, int i, int j, int k, int component = 0)
{
  vtkStructuredGrid* grid = reader->GetOutput();
  vtkDataArray* values = grid->GetPointData()->GetArray(array);
  if (!values)
  {
    ADD_FAILURE() << "no array " << array;
    return 0;
  }
  int* n = grid->GetDimensions();
  return values->GetComponent((static_cast<vtkIdType>(k) * n[1] + j) * n[0] + i, component);
}

inline void pointAt(vtkCloudNetCDFReader* reader, int i, int j, int k, double point[3])
{
  int* n = reader->GetOutput()->GetDimensions();
  reader->GetOutput()->GetPoint((static_cast<vtkIdType>(k) * n[1] + j) * n[0] + i, point);
}
#endif
