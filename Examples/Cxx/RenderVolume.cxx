// SPDX-License-Identifier: BSD-3-Clause
// Draws a model's clouds as glowing fog on a globe: RenderVolume CLIMATE.nc OUT.png
#include <vtkCamera.h>
#include <vtkCloudCellVolume.h>
#include <vtkCloudGlobe.h>
#include <vtkCloudNetCDFReader.h>
#include <vtkCloudPictureWriter.h>
#include <vtkCloudscape.h>
#include <vtkNew.h>

int main(int argc, char* argv[])
{
  if (argc != 3)
  {
    return 2;
  }
  const vtkNew<vtkCloudNetCDFReader> reader;
  reader->SetFileName(argv[1]);
  reader->SetVerticalExaggeration(30);
  const vtkNew<vtkCloudCellVolume> volume;
  volume->SetInputConnection(reader->GetOutputPort());
  const vtkNew<vtkCamera> camera;
  camera->SetPosition(2.4e7, -1.4e7, 1e7);
  camera->SetViewUp(0, 0, 1);
  const vtkNew<vtkCloudGlobe> globe;
  globe->SetTowardSun(camera->GetPosition());
  const vtkNew<vtkCloudscape> scape;
  scape->SetCamera(camera);
  scape->SetSize(320, 240);
  scape->AddBody(globe);
  scape->AddBody(volume);
  const vtkNew<vtkCloudPictureWriter> writer;
  writer->SetInputConnection(scape->GetOutputPort());
  writer->SetFileName(argv[2]);
  return writer->Write() && scape->GetNumberOfSegments() > 0 ? 0 : 1;
}
