// SPDX-License-Identifier: BSD-3-Clause
#include "PictureFile.h"

#include "Failure.h"
#include "Messages.h"
#include "OutputFile.h"
#include "Scene.h"

#include <vtkCloudPictureWriter.h>
#include <vtkCloudscape.h>
#include <vtkImageData.h>
#include <vtkNew.h>

#include <cstdio>

namespace nephoscope::program
{
std::array<int, 2> sizeOf(const std::string& text)
{
  std::array<int, 2> size{};
  char extra = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &size[0], &size[1], &extra) != 2 || size[0] < 1 ||
    size[1] < 1 || size[0] > LargestSide || size[1] > LargestSide)
  {
    throw UsageFailure("--size " + text + " is not WIDTHxHEIGHT in pixels, each from 1 to " +
      std::to_string(LargestSide) + ", such as 1024x768");
  }
  return size;
}

void writePicture(vtkCloudscape* scape, double exposure, const std::string& path)
{
  OutputFile file(path);
  const vtkNew<vtkCloudPictureWriter> writer;
  writer->SetInputData(scape->GetOutput());
  writer->SetExposure(exposure);
  writer->SetShoulder(0.2);
  writer->SetFileName(file.partial().c_str());
  const int written = writer->Write();
  Messages::throwIfError(path);
  if (!written)
  {
    throw Failure(path + ": cannot be written; is the disk full?");
  }
  file.commit();
}
}
