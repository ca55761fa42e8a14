// SPDX-License-Identifier: BSD-3-Clause
// The filter draws what vtkCloudscape draws of the same data, and frames it.
#include "CloudArrays.h"
#include "DisplayTransfer.h"
#include "vtkCamera.h"
#include "vtkCloudCellVolume.h"
#include "vtkCloudGradedBackdrop.h"
#include "vtkCloudPicture.h"
#include "vtkCloudPlane.h"
#include "vtkCloudSurface.h"
#include "vtkCloudscape.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkTestErrorObserver.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace nephoscope;

namespace
{
constexpr double Sigma = 0.7;

/// Fog between (-1, -1, -1) and (1, 1, 1), of 4 x 3 x 5 points.
vtkSmartPointer<vtkImageData> fog()
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(4, 3, 5);
  image->SetOrigin(-1, -1, -1);
  image->SetSpacing(2.0 / 3, 1, 0.5);
  const vtkNew<vtkFloatArray> fraction;
  fraction->SetName(arrays::CloudFraction);
  fraction->SetNumberOfTuples(image->GetNumberOfPoints());
  fraction->Fill(1);
  image->GetPointData()->AddArray(fraction);
  return image;
}

/// A triangle in the fog's middle, seen from -y.
vtkSmartPointer<vtkPolyData> sail()
{
  auto triangle = vtkSmartPointer<vtkPolyData>::New();
  const vtkNew<vtkPoints> points;
  points->InsertNextPoint(-1, 0, -1);
  points->InsertNextPoint(1, 0, -1);
  points->InsertNextPoint(1, 0, 1);
  triangle->SetPoints(points);
  triangle->AllocateExact(1, 3);
  const vtkIdType corners[3] = { 0, 1, 2 };
  triangle->InsertNextCell(VTK_TRIANGLE, 3, corners);
  return triangle;
}
}

class CloudPicture : public testing::Test
{
protected:
  static constexpr int Width = 60;
  static constexpr int Height = 44;

  void SetUp() override
  {
    this->Picture->SetSize(Width, Height);
    this->Picture->SetPosition(0, -1, 0);
    this->Picture->GetVolume()->SetFullCoverExtinction(Sigma);
    this->Picture->GetSurface()->SetOpacity(0.5);
  }

  vtkDataArray* Array(const char* name)
  {
    return this->Picture->GetOutput()->GetPointData()->GetArray(name);
  }

  std::string Message()
  {
    const vtkNew<vtkTest::ErrorObserver> errors;
    this->Picture->AddObserver("ErrorEvent", errors);
    this->Picture->GetExecutive()->AddObserver("ErrorEvent", errors);
    this->Picture->Update();
    return errors->GetErrorMessage();
  }

  vtkNew<vtkCloudPicture> Picture;
};

TEST_F(CloudPicture, FogFillsThePictureAndFollowsBeersLaw)
{
  this->Picture->SetInputData(fog());
  this->Picture->ParallelProjectionOn();
  this->Picture->Update();
  vtkDataArray* const radiance = this->Array(arrays::Radiance);
  vtkDataArray* const color = this->Array(arrays::DisplayColor);
  ASSERT_TRUE(radiance && color);
  EXPECT_EQ(this->Picture->GetOutput()->GetPointData()->GetScalars(), color);
  const double light = -std::expm1(-2 * Sigma);
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      // The fog's edges are at 1 / 1.1 of the picture's height.
      const double edge = Height / 2.2;
      const bool inside =
        std::max(std::abs(x + 0.5 - Width / 2.0), std::abs(y + 0.5 - Height / 2.0)) < edge;
      EXPECT_NEAR(radiance->GetTuple3(y * Width + x)[0], inside ? light : 0, 1e-5) << x << ' ' << y;
      EXPECT_EQ(color->GetTuple3(y * Width + x)[1],
        srgb8(static_cast<float>(radiance->GetTuple3(y * Width + x)[1])));
    }
  }
}

TEST_F(CloudPicture, IsThatOfACloudscapeOfTheSameParts)
{
  const vtkNew<vtkCloudPlane> plane;
  plane->SetHeight(-1.5);
  const vtkNew<vtkCloudGradedBackdrop> sky;
  sky->SetColor(0.1, 0.2, 0.4);
  this->Picture->SetInputDataObject(0, sail());
  this->Picture->SetInputDataObject(1, fog());
  this->Picture->SetGround(plane);
  this->Picture->SetBackdrop(sky);
  this->Picture->FitToInputsOff();
  this->Picture->SetPosition(1, -6, 2);
  this->Picture->Update();

  const vtkNew<vtkCloudscape> scape;
  const vtkNew<vtkCamera> camera;
  const vtkNew<vtkCloudCellVolume> volume;
  const vtkNew<vtkCloudSurface> surface;
  volume->SetInputData(fog());
  volume->SetFullCoverExtinction(Sigma);
  surface->SetInputData(sail());
  surface->SetOpacity(0.5);
  camera->SetPosition(1, -6, 2);
  camera->SetViewUp(0, 0, 1);
  scape->SetCamera(camera);
  scape->SetSize(Width, Height);
  scape->SetBackdrop(sky);
  scape->AddBody(surface);
  scape->AddBody(volume);
  scape->AddBody(plane);
  scape->Update();
  for (const char* name : { arrays::Radiance, arrays::Transmittance, arrays::Depth })
  {
    vtkDataArray* const expected = scape->GetOutput()->GetPointData()->GetArray(name);
    for (vtkIdType i = 0; i < expected->GetNumberOfTuples(); ++i)
    {
      ASSERT_EQ(this->Array(name)->GetComponent(i, 0), expected->GetComponent(i, 0)) << name << i;
    }
  }
}

TEST_F(CloudPicture, FollowsItsPartsAndIsNotDrawnAgainWithoutNeed)
{
  this->Picture->SetInputData(fog());
  this->Picture->Update();
  const auto middle = Height / 2 * Width + Width / 2;
  const double before = this->Array(arrays::Radiance)->GetComponent(middle, 0);
  const vtkMTimeType drawn = this->Picture->GetOutput()->GetMTime();
  this->Picture->Update();
  EXPECT_EQ(this->Picture->GetOutput()->GetMTime(), drawn);
  this->Picture->GetVolume()->SetFullCoverExtinction(2 * Sigma);
  this->Picture->Update();
  EXPECT_GT(this->Array(arrays::Radiance)->GetComponent(middle, 0), before + 0.05);
}

TEST_F(CloudPicture, PutsAGlobeUnderCloudsThatAreRoundOne)
{
  const vtkSmartPointer<vtkImageData> image = fog();
  const vtkNew<vtkStringArray> geometry;
  geometry->SetName(arrays::Geometry);
  geometry->InsertNextValue("Globe");
  const vtkNew<vtkDoubleArray> radius;
  radius->SetName(arrays::PlanetRadius);
  radius->InsertNextValue(0.5);
  image->GetFieldData()->AddArray(geometry);
  image->GetFieldData()->AddArray(radius);
  this->Picture->SetInputData(image);
  this->Picture->Update();
  const auto middle = Height / 2 * Width + Width / 2;
  EXPECT_EQ(this->Array(arrays::Transmittance)->GetComponent(middle, 0), 0);
  this->Picture->AutomaticGroundOff();
  this->Picture->Update();
  EXPECT_NEAR(
    this->Array(arrays::Transmittance)->GetComponent(middle, 0), std::exp(-2 * Sigma), 1e-3);
}

TEST_F(CloudPicture, SaysWhatItCannotDraw)
{
  this->Picture->SetInputDataObject(0, fog());
  this->Picture->SetInputDataObject(1, fog());
  EXPECT_NE(this->Message().find("Both inputs are grids"), std::string::npos);
  EXPECT_EQ(this->Picture->GetOutput()->GetNumberOfPoints(), 0);
  this->Picture->SetInputDataObject(1, sail());
  this->Picture->SetVolume(nullptr);
  EXPECT_NE(this->Message().find("call SetVolume"), std::string::npos);
  this->Picture->SetInputDataObject(0, sail());
  EXPECT_NE(this->Message().find("Both inputs are surfaces; one of each is drawn. Append"),
    std::string::npos);
}
