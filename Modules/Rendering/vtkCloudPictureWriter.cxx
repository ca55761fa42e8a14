// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudPictureWriter.h"

#include "CloudArrays.h"
#include "DisplayTransfer.h"
#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPNGWriter.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

vtkStandardNewMacro(vtkCloudPictureWriter);

namespace
{
namespace fs = std::filesystem;

std::string lowerExtension(const fs::path& path)
{
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::runtime_error systemError()
{
  return std::runtime_error(std::strerror(errno));
}

/// A new empty file beside another; removed at the end unless it was renamed to it.
class FileBeside
{
public:
  explicit FileBeside(const fs::path& target)
    : Target(target)
  {
    if (fs::is_directory(target))
    {
      throw std::runtime_error("it is a folder");
    }
    static std::atomic<unsigned> count{ 0 };
    for (int attempt = 0; attempt < 1000; ++attempt)
    {
      const std::string name =
        "." + target.filename().string() + "." + std::to_string(++count) + ".part";
      this->Temporary = target.parent_path() / name;
      if (std::FILE* file = std::fopen(this->Temporary.c_str(), "wxb"))
      {
        std::fclose(file);
        return;
      }
      if (errno != EEXIST)
      {
        break;
      }
    }
    const std::runtime_error error = systemError();
    this->Temporary.clear();
    throw error;
  }
  ~FileBeside()
  {
    std::error_code ignored;
    if (!this->Temporary.empty())
    {
      fs::remove(this->Temporary, ignored);
    }
  }
  FileBeside(const FileBeside&) = delete;
  void operator=(const FileBeside&) = delete;

  const char* path() const { return this->Temporary.c_str(); }
  void rename()
  {
    std::error_code error;
    fs::rename(this->Temporary, this->Target, error);
    if (error)
    {
      throw std::runtime_error(error.message());
    }
    this->Temporary.clear();
  }

private:
  fs::path Target;
  fs::path Temporary;
};

void writeBytes(const char* path, const unsigned char* bytes, std::size_t number)
{
  std::FILE* const file = std::fopen(path, "wb");
  if (!file)
  {
    throw systemError();
  }
  const bool written = std::fwrite(bytes, 1, number, file) == number;
  const std::runtime_error writeError = systemError();
  if (std::fclose(file) != 0 || !written)
  {
    throw written ? systemError() : writeError;
  }
}

/// A point array as rows of floats from the top down, if the picture has it.
std::vector<float> rowsFromTop(vtkImageData* picture, const char* name, int components)
{
  vtkDataArray* const array = picture->GetPointData()->GetArray(name);
  if (!array || array->GetNumberOfComponents() != components)
  {
    return {};
  }
  int size[3];
  picture->GetDimensions(size);
  const std::size_t row = static_cast<std::size_t>(size[0]) * components;
  std::vector<float> values(row * size[1]);
  for (int y = 0; y < size[1]; ++y)
  {
    float* const to = values.data() + row * (size[1] - 1 - y);
    for (std::size_t v = 0; v < row; ++v)
    {
      to[v] = static_cast<float>(array->GetComponent(
        static_cast<vtkIdType>(y) * size[0] + static_cast<vtkIdType>(v / components),
        static_cast<int>(v % components)));
    }
  }
  return values;
}

/// The channels of an OpenEXR file, which keep their values until it is written.
class Channels
{
public:
  Channels(int width, int height)
    : File(width, height)
    , Width(width)
    , Height(height)
  {
    this->File.compression() = Imf::ZIP_COMPRESSION;
  }

  /// Add values with as many components as there are names; nothing if there are no values.
  void add(
    const std::vector<float>& values, const std::vector<std::string>& names, Imf::PixelType type)
  {
    const std::size_t components = names.size();
    for (std::size_t c = 0; c < components && !values.empty(); ++c)
    {
      this->File.channels().insert(names[c], Imf::Channel(type));
      const float* from = values.data() + c;
      if (type == Imf::FLOAT)
      {
        // OpenEXR's slices are not const, but it only reads them.
        this->Frame.insert(names[c],
          Imf::Slice(type, reinterpret_cast<char*>(const_cast<float*>(from)),
            components * sizeof(float), components * sizeof(float) * this->Width));
        continue;
      }
      std::vector<half> halves(static_cast<std::size_t>(this->Width) * this->Height);
      for (half& h : halves)
      {
        h = half(*from);
        from += components;
      }
      this->Kept.push_back(std::move(halves));
      this->Frame.insert(names[c],
        Imf::Slice(type, reinterpret_cast<char*>(this->Kept.back().data()), sizeof(half),
          sizeof(half) * this->Width));
    }
  }

  void write(const char* path)
  {
    Imf::OutputFile file(path, this->File);
    file.setFrameBuffer(this->Frame);
    file.writePixels(this->Height);
  }

private:
  Imf::Header File;
  Imf::FrameBuffer Frame;
  std::vector<std::vector<half>> Kept;
  int Width;
  int Height;
};
}

vtkCloudPictureWriter::~vtkCloudPictureWriter()
{
  delete[] this->FileName;
}

int vtkCloudPictureWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkCloudPictureWriter::Write()
{
  this->SetErrorCode(vtkErrorCode::NoError);
  return this->Superclass::Write() && this->GetErrorCode() == vtkErrorCode::NoError ? 1 : 0;
}

void vtkCloudPictureWriter::Fail(const char* cause)
{
  this->SetErrorCode(vtkErrorCode::CannotOpenFileError);
  vtkErrorMacro(
    "Cannot write " << (this->FileName ? this->FileName : "the picture") << ": " << cause << '.');
}

void vtkCloudPictureWriter::WriteData()
{
  vtkImageData* const picture = vtkImageData::SafeDownCast(this->GetInput());
  if (!this->FileName || !*this->FileName)
  {
    this->Fail("no file name is set");
    return;
  }
  const std::string extension = lowerExtension(this->FileName);
  if (extension != ".png" && extension != ".exr")
  {
    this->Fail("the name has to end in .png or .exr");
    return;
  }
  vtkDataArray* const radiance =
    picture ? picture->GetPointData()->GetArray(nephoscope::arrays::Radiance) : nullptr;
  if (!radiance || radiance->GetNumberOfComponents() != 3 || picture->GetNumberOfPoints() < 1)
  {
    this->Fail("the input has no point array Radiance of 3 components; connect a vtkCloudscape");
    return;
  }
  if (picture->GetDimensions()[2] != 1)
  {
    this->Fail("the input is not a picture: it has several layers");
    return;
  }
  try
  {
    FileBeside file(this->FileName);
    if (extension == ".png")
    {
      this->WritePNG(picture, file.path());
    }
    else
    {
      this->WriteEXR(picture, file.path());
    }
    file.rename();
  }
  catch (const std::exception& error)
  {
    this->Fail(error.what());
  }
}

void vtkCloudPictureWriter::WritePNG(vtkImageData* picture, const char* path) const
{
  vtkDataArray* const radiance = picture->GetPointData()->GetArray(nephoscope::arrays::Radiance);
  vtkNew<vtkImageData> image;
  image->SetDimensions(picture->GetDimensions());
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* to = static_cast<std::uint8_t*>(image->GetScalarPointer());
  const double gain = std::exp2(this->Exposure);
  for (vtkIdType p = 0; p < picture->GetNumberOfPoints(); ++p)
  {
    for (int c = 0; c < 3; ++c)
    {
      *to++ = nephoscope::srgb8(
        nephoscope::shoulder(gain * radiance->GetComponent(p, c), this->Shoulder));
    }
  }
  vtkNew<vtkPNGWriter> png;
  png->SetInputData(image);
  png->WriteToMemoryOn();
  png->Write();
  vtkUnsignedCharArray* const bytes = png->GetResult();
  if (!bytes || bytes->GetNumberOfValues() == 0)
  {
    throw std::runtime_error("the picture cannot be coded as PNG");
  }
  writeBytes(path, bytes->GetPointer(0), static_cast<std::size_t>(bytes->GetNumberOfValues()));
}

void vtkCloudPictureWriter::WriteEXR(vtkImageData* picture, const char* path) const
{
  const Imf::PixelType type = this->FullFloat ? Imf::FLOAT : Imf::HALF;
  const std::vector<float> radiance = rowsFromTop(picture, nephoscope::arrays::Radiance, 3);
  const std::vector<float> transmittance =
    rowsFromTop(picture, nephoscope::arrays::Transmittance, 3);
  const std::vector<float> depth = rowsFromTop(picture, nephoscope::arrays::Depth, 1);
  Channels channels(picture->GetDimensions()[0], picture->GetDimensions()[1]);
  channels.add(radiance, { "R", "G", "B" }, type);
  channels.add(transmittance, { "T.R", "T.G", "T.B" }, type);
  channels.add(depth, { "Z" }, Imf::FLOAT);
  channels.write(path);
}

void vtkCloudPictureWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << '\n';
  os << indent << "Exposure: " << this->Exposure << '\n';
  os << indent << "Shoulder: " << this->Shoulder << '\n';
  os << indent << "FullFloat: " << this->FullFloat << '\n';
}
