// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file SparseTesting.h
 * @brief A folder for files, what VTK's classes say, and a field to write.
 */
#ifndef SparseTesting_h
#define SparseTesting_h

#include "CloudArrays.h"
#include "vtkCloudVDBReader.h"
#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkExecutive.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace sparse_testing
{
/// A folder of its own that is removed at the end.
class Folder
{
public:
  Folder()
  {
    std::string name = (std::filesystem::temp_directory_path() / "sparse-XXXXXX").string();
    this->Path = ::mkdtemp(name.data());
  }
  ~Folder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(this->Path, ignored);
  }
  Folder(const Folder&) = delete;
  void operator=(const Folder&) = delete;

  std::string file(const std::string& name) const { return (this->Path / name).string(); }
  std::size_t numberOfFiles() const
  {
    const std::filesystem::directory_iterator files(this->Path);
    return static_cast<std::size_t>(std::distance(begin(files), end(files)));
  }

private:
  std::filesystem::path Path;
};

/// Keeps what an algorithm and its executive say instead of printing it.
class Said : public vtkCommand
{
public:
  vtkTypeMacro(Said, vtkCommand);
  static Said* New() { return new Said; }
  void Execute(vtkObject*, unsigned long, void* text) override
  {
    this->Text += static_cast<const char*>(text);
  }
  void listen(vtkAlgorithm* algorithm)
  {
    for (vtkObject* const object :
      { static_cast<vtkObject*>(algorithm), static_cast<vtkObject*>(algorithm->GetExecutive()) })
    {
      object->AddObserver(vtkCommand::ErrorEvent, this);
      object->AddObserver(vtkCommand::WarningEvent, this);
    }
  }
  std::string Text;
};

/// A blob of fog on a grid of unequal sides that begins at negative indices, 0 outside.
inline vtkSmartPointer<vtkImageData> blob()
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetExtent(-11, 9, 3, 18, -2, 29);
  image->SetOrigin(100, -20, 7);
  image->SetSpacing(2, 0.5, 1.25);
  vtkNew<vtkFloatArray> density;
  density->SetName(nephoscope::arrays::Extinction);
  density->SetNumberOfTuples(image->GetNumberOfPoints());
  int at[3];
  vtkIdType point = 0;
  for (at[2] = -2; at[2] <= 29; ++at[2])
  {
    for (at[1] = 3; at[1] <= 18; ++at[1])
    {
      for (at[0] = -11; at[0] <= 9; ++at[0])
      {
        const double r = std::hypot((at[0] + 1) / 10.0, (at[1] - 10) / 7.0, (at[2] - 13) / 15.0);
        density->SetValue(point++, r < 1 ? static_cast<float>(0.01 + (1 - r)) : 0.0F);
      }
    }
  }
  image->GetPointData()->SetScalars(density);
  return image;
}

/// What a reader makes of a file, and what it says.
struct Read
{
  vtkSmartPointer<vtkDataObject> data;
  std::string said;
};

inline Read readAs(
  int form, const std::string& path, const std::string& name = "", double maximumVoxels = 2e8)
{
  vtkNew<vtkCloudVDBReader> reader;
  vtkNew<Said> said;
  said->listen(reader);
  reader->SetFileName(path.c_str());
  reader->SetGridName(name);
  reader->SetOutputForm(form);
  reader->SetMaximumVoxels(maximumVoxels);
  reader->Update();
  return { reader->GetOutputDataObject(0), said->Text };
}
}
#endif
