// SPDX-License-Identifier: BSD-3-Clause
#include "CloudArrays.h"
#include "FogBall.h"
#include "vtkCamera.h"
#include "vtkCloudGradedBackdrop.h"
#include "vtkCloudscape.h"
#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkTestErrorObserver.h"

#include <gtest/gtest.h>

namespace
{
double chord(const nephoscope::Ray& ray)
{
  const double middle = -dot(ray.origin, ray.direction);
  const double miss2 = dot(ray.origin, ray.origin) - middle * middle;
  return miss2 < 1 ? 2 * std::sqrt(1 - miss2) : 0;
}
}

class Cloudscape : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Ball->Glow[1] = this->Ball->Glow[2] = 0;
    this->Camera->SetPosition(0, -5, 0);
    this->Camera->SetFocalPoint(0, 0, 0);
    this->Camera->SetViewUp(0, 0, 1);
    this->Camera->SetViewAngle(30);
    this->Backdrop->SetColor(0, 0.5, 0);
    this->Scape->SetCamera(this->Camera);
    this->Scape->SetBackdrop(this->Backdrop);
    this->Scape->SetSize(45, 31);
    this->Scape->SetTileSize(8);
    this->Scape->AddBody(this->Ball);
  }
  vtkNew<vtkCamera> Camera;
  vtkNew<vtkCloudGradedBackdrop> Backdrop;
  vtkNew<FogBall> Ball;
  vtkNew<vtkCloudscape> Scape;
};

TEST_F(Cloudscape, FogBallBeforeABackdropFollowsBeersLaw)
{
  this->Scape->Update();
  vtkImageData* const image = this->Scape->GetOutput();
  ASSERT_EQ(image->GetNumberOfPoints(), 45 * 31);
  vtkDataArray* const radiance = image->GetPointData()->GetArray(nephoscope::arrays::Radiance);
  const auto camera =
    nephoscope::Camera::perspective({ 0, -5, 0 }, { 0, 0, 0 }, { 0, 0, 1 }, 30, 45, 31);
  for (int y = 0; y < 31; ++y)
  {
    for (int x = 0; x < 45; ++x)
    {
      const double t = std::exp(-chord(camera.ray(x + 0.5, y + 0.5)));
      EXPECT_NEAR(radiance->GetComponent(y * 45 + x, 0), 1 - t, 1e-6);
      EXPECT_NEAR(radiance->GetComponent(y * 45 + x, 1), 0.5 * t, 1e-6);
    }
  }
  EXPECT_GT(this->Scape->GetNumberOfSegments(), 100);
}

TEST_F(Cloudscape, PictureDoesNotDependOnTilesOrThreads)
{
  // From many to few: TBB does not raise its limit again.
  vtkSMPTools::Initialize(4);
  this->Scape->Update();
  vtkNew<vtkImageData> first;
  first->DeepCopy(this->Scape->GetOutput());
  for (int threads : { 2, 1 })
  {
    vtkSMPTools::Initialize(threads);
    this->Scape->SetTileSize(threads == 2 ? 5 : 64);
    this->Scape->Update();
    for (int a = 0; a < 3; ++a)
    {
      vtkDataArray* const one = first->GetPointData()->GetArray(a);
      vtkDataArray* const other = this->Scape->GetOutput()->GetPointData()->GetArray(a);
      for (vtkIdType v = 0; v < one->GetNumberOfValues(); ++v)
      {
        ASSERT_EQ(one->GetVariantValue(v).ToDouble(), other->GetVariantValue(v).ToDouble());
      }
    }
  }
}

TEST_F(Cloudscape, ChangesAreDrawnAndNothingElse)
{
  this->Scape->Update();
  const vtkMTimeType before = this->Scape->GetOutput()->GetMTime();
  this->Scape->Update();
  EXPECT_EQ(this->Scape->GetOutput()->GetMTime(), before);
  this->Backdrop->SetColor(1, 0, 0);
  this->Scape->Update();
  EXPECT_GT(this->Scape->GetOutput()->GetMTime(), before);
  const double* const corner =
    this->Scape->GetOutput()->GetPointData()->GetArray(nephoscope::arrays::Radiance)->GetTuple3(0);
  EXPECT_EQ(corner[0], 1);
}

TEST_F(Cloudscape, ErrorsSayWhatIsWrong)
{
  vtkNew<vtkTest::ErrorObserver> errors;
  vtkNew<vtkTest::ErrorObserver> pipelineErrors;
  this->Scape->AddObserver(vtkCommand::ErrorEvent, errors);
  this->Scape->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, pipelineErrors);
  this->Scape->SetSize(0, 5);
  this->Scape->Update();
  EXPECT_NE(errors->GetErrorMessage().find("size 0 x 5"), std::string::npos);
  errors->Clear();
  this->Scape->SetSize(16385, 5);
  this->Scape->SetSamples(2);
  this->Scape->Update();
  EXPECT_NE(errors->GetErrorMessage().find("within 1 to 16384"), std::string::npos);
  errors->Clear();
  this->Scape->SetSize(4, 5);
  this->Ball->Drawable = false;
  this->Scape->Update();
  EXPECT_NE(errors->GetErrorMessage().find("FogBall cannot be drawn"), std::string::npos);
  errors->Clear();
  this->Scape->SetCamera(nullptr);
  this->Scape->Update();
  EXPECT_NE(errors->GetErrorMessage().find("no camera"), std::string::npos);
}

TEST(GradedBackdrop, GoesFromNadirByHorizonToZenith)
{
  vtkNew<vtkCloudGradedBackdrop> backdrop;
  backdrop->SetUp(0, 3, 0);
  backdrop->SetZenith(0, 0, 1);
  backdrop->SetHorizon(1, 1, 1);
  backdrop->SetNadir(0.5, 0, 0);
  float light[3];
  const double level[3] = { 1, 0, 0 };
  backdrop->GetRadiance(level, light);
  EXPECT_FLOAT_EQ(light[0], 1);
  const double half[3] = { std::sqrt(0.75), 0.5, 0 };
  backdrop->GetRadiance(half, light);
  EXPECT_FLOAT_EQ(light[0], 0.5F);
  const double down[3] = { 0, -1, 0 };
  backdrop->GetRadiance(down, light);
  EXPECT_FLOAT_EQ(light[0], 0.5F);
  EXPECT_FLOAT_EQ(light[1], 0);
}
