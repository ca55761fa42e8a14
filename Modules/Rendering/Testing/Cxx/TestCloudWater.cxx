// SPDX-License-Identifier: BSD-3-Clause
#include "Fresnel.h"
#include "HorizontalImage.h"
#include "RenderingTest.h"
#include "vtkCloudTerrain.h"
#include "vtkCloudWater.h"
#include "vtkTestErrorObserver.h"

using nephoscope::arrays::SunTransmittance;

class CloudWater : public RenderingTest
{
protected:
  void SetUp() override
  {
    this->RenderingTest::SetUp();
    this->Water->SetLevel(-1);
    this->Sky->SetColor(1, 1, 1);
    this->Water->SetBackdrop(this->Sky);
    this->Water->SetSkyColor(1, 1, 1);
    this->Water->SetSunColor(0, 0, 0);
    this->Water->SetAmbient(1);
  }
  /// Of the lowest rows, which look down by 15 to 9 degrees.
  double Mean()
  {
    constexpr int Rows = 9;
    double sum = 0;
    for (int y = 0; y < Rows; ++y)
    {
      for (int x = 0; x < Width; ++x)
      {
        sum += this->Radiance(x, y) / (Rows * Width);
      }
    }
    return sum;
  }
  vtkNew<vtkCloudWater> Water;
  vtkNew<vtkCloudGradedBackdrop> Sky;
};

TEST_F(CloudWater, NeitherAddsNorLosesLight)
{
  // White depths under a white sky: whatever is mirrored and whatever comes out, it is white.
  this->Water->SetWaterColor(1, 1, 1);
  this->Water->SetWindSpeed(12);
  this->Draw({ this->Water });
  for (int y = 0; y < 21; ++y)
  {
    for (int x = 0; x < Width; x += 7)
    {
      ASSERT_NEAR(this->Radiance(x, y), 1, 1e-5) << x << ' ' << y;
    }
  }
  EXPECT_EQ(this->Transmittance(30, 40), 1);
}

TEST_F(CloudWater, MirrorsByFresnelsLaw)
{
  // Straight down on black depths: the share is that of normal incidence, however the slopes lie (to some per cent).
  this->Water->SetWaterColor(0, 0, 0);
  this->Water->SetWindSpeed(1);
  this->Camera->SetPosition(0, 0, 30);
  this->Camera->SetFocalPoint(0, 0, 0);
  this->Camera->SetViewUp(0, 1, 0);
  this->Camera->SetViewAngle(5);
  this->Draw({ this->Water });
  EXPECT_NEAR(this->Radiance(30, 21) / nephoscope::fresnel(1, 1.34), 1, 0.02);
  EXPECT_NEAR(this->Depth(30, 21), 31, 1e-5);
}

TEST_F(CloudWater, PicturesOfFewRaysHaveTheMeanOfThoseOfMany)
{
  this->Sky->SetHorizon(1, 1, 1);
  this->Sky->SetZenith(0.1, 0.1, 0.1);
  this->Water->SetWavelength(0.5);
  // Steep enough that what the eye sees of a face is nearly its area.
  this->Camera->SetPosition(0, -4, 6);
  this->Camera->SetFocalPoint(0, 0, -1);
  this->Draw({ this->Water });
  const double one = this->Mean();
  this->Scape->SetSamples(6);
  this->Draw({ this->Water });
  EXPECT_NEAR(one / this->Mean(), 1, 0.02);
}

TEST_F(CloudWater, CloudsTakeTheSun)
{
  this->Sky->SetColor(0, 0, 0);
  this->Water->SetAmbient(0);
  this->Water->SetSunColor(1, 1, 1);
  this->Water->SetTowardSun(0, 5, 1);
  this->Water->SetCloudEdgeColor(0, 0, 0);
  this->Water->SetCloudCoreColor(0, 0, 0);
  this->Draw({ this->Water });
  const double bright = this->Mean();
  EXPECT_GT(bright, 0.02);
  this->Water->SetInputData(imageOf(SunTransmittance, -0.9, [](double, double) { return 0.25; }));
  this->Draw({ this->Water });
  // The map covers what these rows see.
  EXPECT_NEAR(this->Mean() / bright, 0.25, 0.02);
}

TEST_F(CloudWater, ShowsCloudsUpsideDown)
{
  // Thick white clouds at x > 0, 1 above the water, in a black sky: the right half of the water is bright.
  this->Sky->SetColor(0, 0, 0);
  this->Water->SetWaterColor(0, 0, 0);
  this->Water->SetWindSpeed(0);
  this->Water->SetCloudCoreColor(1, 1, 1);
  this->Water->SetInputData(
    imageOf(SunTransmittance, 0, [](double x, double) { return x > 0 ? 0 : 1; }));
  this->Camera->SetPosition(0, -4, 2);
  this->Camera->SetFocalPoint(0, 0, -1);
  this->Draw({ this->Water });
  EXPECT_GT(this->Radiance(50, 21), 10 * this->Radiance(10, 21));
  EXPECT_GT(this->Radiance(50, 21), 0.02);
}

TEST_F(CloudWater, IsNotWorkedOutBehindHills)
{
  vtkNew<vtkCloudTerrain> hills;
  hills->SetInputData(
    imageOf(nephoscope::arrays::Height, 0, [](double x, double) { return x > 1 ? 0.5 : -4; }));
  this->Camera->SetPosition(0, -4, 2);
  this->Camera->SetFocalPoint(0, 0, -1);
  this->Draw({ hills, this->Water });
  const double before[2] = { this->Radiance(50, 21), this->Radiance(10, 21) };
  this->Draw({ this->Water, hills });
  EXPECT_EQ(this->Radiance(50, 21), before[0]);
  EXPECT_EQ(this->Radiance(10, 21), before[1]);
  // Whichever comes first, a ray meets one of them.
  EXPECT_EQ(this->Scape->GetNumberOfSegments(), Width * Height);
}

TEST_F(CloudWater, BadInputIsRefused)
{
  vtkNew<vtkTest::ErrorObserver> errors;
  this->Water->AddObserver(vtkCommand::ErrorEvent, errors);
  this->Water->SetTowardSun(0, 0, 0);
  EXPECT_FALSE(this->Water->Prepare(this->KernelCamera()));
  EXPECT_NE(errors->GetErrorMessage().find("no direction"), std::string::npos);
  errors->Clear();
  this->Water->SetInputDataObject(
    1, imageOf(SunTransmittance, 0, [](double, double) { return 1; }));
  EXPECT_FALSE(this->Water->Prepare(this->KernelCamera()));
  EXPECT_NE(errors->GetErrorMessage().find("Height"), std::string::npos);
}
