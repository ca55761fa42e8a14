// SPDX-License-Identifier: BSD-3-Clause
// Cumulus over water, in haze with the shafts of light between them: HeightFieldClouds OUT.png
#include <vtkCamera.h>
#include <vtkCloudGradedBackdrop.h>
#include <vtkCloudHaze.h>
#include <vtkCloudHeightField.h>
#include <vtkCloudHeightFieldShadow.h>
#include <vtkCloudHeightFieldSource.h>
#include <vtkCloudPictureWriter.h>
#include <vtkCloudWater.h>
#include <vtkCloudscape.h>
#include <vtkNew.h>

int main(int argc, char* argv[])
{
  if (argc != 2)
  {
    return 2;
  }
  const vtkNew<vtkCloudHeightFieldSource> source;
  source->SetPlaneHeight(1200);
  source->SetCover(0.4);
  source->SetRelief(110);
  source->SetRoundness(150);
  const vtkNew<vtkCloudHeightField> clouds;
  clouds->SetInputConnection(source->GetOutputPort());
  // What the clouds leave of the sun's light, about the eye.
  const vtkNew<vtkCloudHeightFieldShadow> shadow;
  shadow->SetInputConnection(source->GetOutputPort());
  const vtkNew<vtkCloudWater> water;
  water->SetInputConnection(0, shadow->GetOutputPort());
  const vtkNew<vtkCloudGradedBackdrop> sky;
  sky->SetZenith(0.06, 0.15, 0.42);
  sky->SetHorizon(0.5, 0.64, 0.82);
  water->SetBackdrop(sky);
  const vtkNew<vtkCloudHaze> haze;
  haze->SetInputConnection(0, shadow->GetOutputPort());
  haze->SetExtinction(2e-5, 2.4e-5, 3e-5);
  haze->SetSkyColor(0.3, 0.38, 0.48);
  haze->SetHeight(1200);
  const double sun[3] = { -1, 1, 2 };
  clouds->SetTowardSun(sun);
  water->SetTowardSun(sun);
  haze->SetTowardSun(sun);
  const vtkNew<vtkCamera> camera;
  camera->SetPosition(0, 0, 250);
  camera->SetFocalPoint(0, 1000, 400);
  camera->SetViewUp(0, 0, 1);
  const vtkNew<vtkCloudscape> scape;
  scape->SetCamera(camera);
  scape->SetSize(320, 240);
  scape->SetBackdrop(sky);
  scape->AddBody(clouds);
  scape->AddBody(water);
  scape->AddBody(haze);
  const vtkNew<vtkCloudPictureWriter> writer;
  writer->SetInputConnection(scape->GetOutputPort());
  writer->SetFileName(argv[1]);
  return writer->Write() && scape->GetNumberOfSegments() > 0 ? 0 : 1;
}
