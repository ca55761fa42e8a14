// SPDX-License-Identifier: BSD-3-Clause
#include "CloudArrays.h"
#include "DisplayTransfer.h"
#include "vtkCloudPictureWriter.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPNGReader.h"
#include "vtkPointData.h"
#include "vtkTestErrorObserver.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <vector>

namespace fs = std::filesystem;

namespace
{
constexpr int Width = 7;
constexpr int Height = 5;

float valueAt(int pixel, int component)
{
  return 0.03F * static_cast<float>(pixel) + 0.25F * static_cast<float>(component) - 0.05F;
}

void addArray(vtkImageData* picture, const char* name, int components)
{
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(picture->GetNumberOfPoints());
  for (int p = 0; p < picture->GetNumberOfPoints(); ++p)
  {
    for (int c = 0; c < components; ++c)
    {
      array->SetComponent(p, c, valueAt(p, c));
    }
  }
  picture->GetPointData()->AddArray(array);
}
}

class PictureWriter : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Folder = fs::path(testing::TempDir()) /
      ("nephoscope-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(this->Folder);
    fs::create_directories(this->Folder);
    this->Picture->SetDimensions(Width, Height, 1);
    addArray(this->Picture, nephoscope::arrays::Radiance, 3);
    addArray(this->Picture, nephoscope::arrays::Transmittance, 3);
    addArray(this->Picture, nephoscope::arrays::Depth, 1);
    this->Writer->SetInputData(this->Picture);
    this->Writer->AddObserver(vtkCommand::ErrorEvent, this->Errors);
  }
  void TearDown() override { fs::remove_all(this->Folder); }

  std::string Name(const char* file) { return (this->Folder / file).string(); }
  int WriteTo(const char* file)
  {
    this->Writer->SetFileName(this->Name(file).c_str());
    return this->Writer->Write();
  }
  /// Its message must have all of these words; nothing may be left in the folder but what is expected.
  void ExpectFailure(const std::vector<std::string>& words, std::ptrdiff_t filesLeft)
  {
    EXPECT_EQ(this->Writer->Write(), 0);
    const std::string message = this->Errors->GetErrorMessage();
    for (const std::string& word : words)
    {
      EXPECT_NE(message.find(word), std::string::npos) << word << " is not in: " << message;
    }
    this->Errors->Clear();
    EXPECT_EQ(
      std::distance(fs::directory_iterator(this->Folder), fs::directory_iterator()), filesLeft);
  }

  fs::path Folder;
  vtkNew<vtkImageData> Picture;
  vtkNew<vtkCloudPictureWriter> Writer;
  vtkNew<vtkTest::ErrorObserver> Errors;
};

TEST_F(PictureWriter, PNGHoldsTheExposedSRGB)
{
  this->Writer->SetExposure(1);
  this->Writer->SetShoulder(0.25);
  ASSERT_EQ(this->WriteTo("picture.PNG"), 1);
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(this->Name("picture.PNG").c_str());
  reader->Update();
  vtkImageData* const read = reader->GetOutput();
  ASSERT_EQ(read->GetDimensions()[0], Width);
  ASSERT_EQ(read->GetDimensions()[1], Height);
  ASSERT_EQ(read->GetScalarType(), VTK_UNSIGNED_CHAR);
  for (int p = 0; p < Width * Height; ++p)
  {
    for (int c = 0; c < 3; ++c)
    {
      const double light = nephoscope::shoulder(2.0 * valueAt(p, c), 0.25);
      EXPECT_EQ(read->GetPointData()->GetScalars()->GetComponent(p, c), nephoscope::srgb8(light));
    }
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(this->Folder), fs::directory_iterator()), 1);
}

TEST_F(PictureWriter, OpenEXRHoldsEveryChannelUpright)
{
  this->Writer->FullFloatOn();
  this->Writer->SetExposure(3); // of no effect here
  const float infinity = std::numeric_limits<float>::infinity();
  this->Picture->GetPointData()->GetArray(nephoscope::arrays::Depth)->SetComponent(9, 0, infinity);
  ASSERT_EQ(this->WriteTo("picture.exr"), 1);
  Imf::InputFile file(this->Name("picture.exr").c_str());
  ASSERT_EQ(file.header().dataWindow().max.x, Width - 1);
  ASSERT_EQ(file.header().dataWindow().max.y, Height - 1);
  const std::vector<std::string> names{ "R", "G", "B", "T.R", "T.G", "T.B", "Z" };
  for (std::size_t n = 0; n < names.size(); ++n)
  {
    ASSERT_NE(file.header().channels().findChannel(names[n]), nullptr) << names[n];
    std::vector<float> values(Width * Height);
    Imf::FrameBuffer frame;
    frame.insert(names[n],
      Imf::Slice(
        Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float), sizeof(float) * Width));
    file.setFrameBuffer(frame);
    file.readPixels(0, Height - 1);
    for (int y = 0; y < Height; ++y)
    {
      for (int x = 0; x < Width; ++x)
      {
        const int pixel = (Height - 1 - y) * Width + x; // from the top there
        const float expected =
          names[n] == "Z" && pixel == 9 ? infinity : valueAt(pixel, static_cast<int>(n % 3));
        EXPECT_EQ(values[y * Width + x], expected) << names[n];
      }
    }
  }
}

TEST_F(PictureWriter, HalfOpenEXRIsRightToElevenBits)
{
  ASSERT_EQ(this->WriteTo("picture.exr"), 1);
  Imf::InputFile file(this->Name("picture.exr").c_str());
  EXPECT_EQ(file.header().channels().findChannel("R")->type, Imf::HALF);
  EXPECT_EQ(file.header().channels().findChannel("Z")->type, Imf::FLOAT);
  std::vector<float> red(Width * Height);
  Imf::FrameBuffer frame;
  frame.insert("G",
    Imf::Slice(
      Imf::FLOAT, reinterpret_cast<char*>(red.data()), sizeof(float), sizeof(float) * Width));
  file.setFrameBuffer(frame);
  file.readPixels(0, Height - 1);
  for (int x = 0; x < Width; ++x)
  {
    const float expected = valueAt((Height - 1) * Width + x, 1);
    EXPECT_NEAR(red[x], expected, expected / 2048);
  }
}

TEST_F(PictureWriter, FailuresNameFileAndCauseAndLeaveNothing)
{
  this->ExpectFailure({ "no file name" }, 0);
  this->Writer->SetFileName(this->Name("picture.jpg").c_str());
  this->ExpectFailure({ "picture.jpg", ".png or .exr" }, 0);
  this->Writer->SetFileName(this->Name("missing/picture.exr").c_str());
  this->ExpectFailure({ "missing/picture.exr", "No such file or directory" }, 0);
  fs::create_directory(this->Folder / "folder.png");
  this->Writer->SetFileName(this->Name("folder.png").c_str());
  this->ExpectFailure({ "folder.png", "it is a folder" }, 1);
}

TEST_F(PictureWriter, UnusableInputIsNamed)
{
  vtkNew<vtkImageData> empty;
  this->Writer->SetFileName(this->Name("picture.png").c_str());
  this->Writer->SetInputData(empty);
  this->ExpectFailure({ "picture.png", "no point array Radiance" }, 0);
  vtkNew<vtkImageData> deep;
  deep->SetDimensions(2, 2, 2);
  addArray(deep, nephoscope::arrays::Radiance, 3);
  this->Writer->SetInputData(deep);
  this->ExpectFailure({ "picture.png", "several layers" }, 0);
}

TEST_F(PictureWriter, FailureKeepsTheOldFileAndSuccessReplacesIt)
{
  std::ofstream(this->Name("old.png")) << "old";
  this->Writer->SetFileName((this->Folder / (std::string(250, 'x') + ".png")).c_str());
  this->ExpectFailure({ "File name too long" }, 1);
  EXPECT_EQ(fs::file_size(this->Name("old.png")), 3U);
  ASSERT_EQ(this->WriteTo("old.png"), 1);
  EXPECT_GT(fs::file_size(this->Name("old.png")), 60U);
}
