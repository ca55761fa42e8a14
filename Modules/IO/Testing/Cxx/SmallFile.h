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

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

/// A file in the temporary folder that goes when the object goes.
class SmallFile
{
public:
  static constexpr int NetCDF4 = -1; ///< format: netCDF-4 by the classic model
  static constexpr int Double = 0;   ///< type

  /// @param format mode of nc_create
  explicit SmallFile(int format = NetCDF4);
  ~SmallFile();
  SmallFile(const SmallFile&) = delete;
  SmallFile& operator=(const SmallFile&) = delete;

  using Text = std::vector<std::pair<const char*, const char*>>;
  using Numbers = std::vector<std::pair<const char*, double>>;

  SmallFile& dimension(const char* name, std::size_t size);
  /// Defines a variable with its attributes and, if there are any, its values. _FillValue and missing_value get its type.
  SmallFile& variable(const char* name, const std::vector<const char*>& dimensions,
    const std::vector<double>& values, const Text& attributes = {}, int type = Double,
    const Numbers& numbers = {});
  SmallFile& number(const char* variable, const char* key, double value);
  const char* path(); ///< of the file, which is complete from then on

private:
  void close();
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
