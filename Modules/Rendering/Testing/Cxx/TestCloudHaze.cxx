// SPDX-License-Identifier: BSD-3-Clause
#include "HorizontalImage.h"
#include "PhaseFunction.h"
#include "RenderingTest.h"
#include "vtkCloudHaze.h"
#include "vtkCloudPlane.h"
#include "vtkTestErrorObserver.h"

using nephoscope::arrays::SunTransmittance;

class CloudHaze : public RenderingTest
{
protected:
  void SetUp() override
  {
    this->RenderingTest::SetUp();
    this->Haze->SetExtinction(0.02, 0.05, 0.1);
    this->Haze->SetTowardSun(1, 2, 2);
    this->Haze->SetHeight(3);
  }
  /// What a wholly lit ray of a pixel shows.
  double Lit(int x, int y, int c)
  {
    const nephoscope::Ray ray = this->RayOf(x, y);
    const double sine = 2.0 / 3;
    const double tau = this->Haze->GetExtinction()[c];
    const double far = ray.direction[2] > 0 ? 3 / ray.direction[2] : 100 / 0.02;
    const double eps = tau * (1 - ray.direction[2] / sine);
    const nephoscope::Vector3 sun{ 1.0 / 3, 2.0 / 3, 2.0 / 3 };
    const double source = this->Haze->GetSunColor()[c] * this->Haze->GetAlbedo()[c] *
      std::acos(-1.0) * nephoscope::henyeyGreenstein(0.6, dot(ray.direction, sun));
    return source * tau * std::exp(-3 * tau / sine) * -std::expm1(-eps * far) / eps -
      this->Haze->GetSkyColor()[c] * std::expm1(-tau * far);
  }
  vtkNew<vtkCloudHaze> Haze;
};

TEST_F(CloudHaze, WithoutCloudsGlowsAsTheClosedFormSays)
{
  // Level and upward rays; those downward never end but in haze.
  for (int method : { vtkCloudHaze::Exact, vtkCloudHaze::March, vtkCloudHaze::Moments })
  {
    this->Haze->SetMethod(method);
    this->Haze->SetStep(0.5);
    this->Draw({ this->Haze });
    for (int y : { 21, 30, 42 })
    {
      for (int x : { 0, 30, 60 })
      {
        for (int c = 0; c < 3; ++c)
        {
          EXPECT_NEAR(this->Radiance(x, y, c) / this->Lit(x, y, c), 1, 1e-3)
            << method << ' ' << x << ' ' << y << ' ' << c;
        }
      }
    }
  }
}

TEST_F(CloudHaze, UnderACoverOnlyTheSkysLightIsLeft)
{
  this->Haze->SetInputData(imageOf(SunTransmittance, 3, [](double, double) { return 0; }));
  vtkNew<vtkCloudPlane> ground;
  ground->SetHeight(-1);
  this->Draw({ this->Haze, ground });
  const nephoscope::Ray ray = this->RayOf(30, 2);
  const double way = -1 / ray.direction[2];
  EXPECT_NEAR(this->Depth(30, 2), way, 1e-5);
  this->Draw({ ground });
  const double bare = this->Radiance(30, 2);
  this->Draw({ this->Haze, ground });
  EXPECT_NEAR(
    this->Radiance(30, 2), std::exp(-0.02 * way) * bare - 0.1 * std::expm1(-0.02 * way), 1e-5);
}

TEST_F(CloudHaze, ShaftsStandUnderGaps)
{
  // A gap at x > 0; a sun overhead: the right half of the picture glows, the left has the sky's light.
  this->Haze->SetTowardSun(0, 0, 1);
  this->Haze->SetInputData(
    imageOf(SunTransmittance, 3, [](double x, double) { return x > 0 ? 1 : 0; }));
  this->Camera->SetPosition(0, -3.9, 0); // under the image
  this->Haze->SetRange(7);
  this->Draw({ this->Haze });
  EXPECT_GT(this->Radiance(45, 21) - this->Radiance(15, 21), 0.005);
  EXPECT_NEAR(this->Radiance(15, 21), -0.1 * std::expm1(-0.02 * 7), 1e-4);
}

TEST_F(CloudHaze, BadValuesAreRefused)
{
  vtkNew<vtkTest::ErrorObserver> errors;
  this->Haze->AddObserver(vtkCommand::ErrorEvent, errors);
  const auto refuses = [this, &errors](const char* words)
  {
    EXPECT_FALSE(this->Haze->Prepare(this->KernelCamera()));
    EXPECT_NE(errors->GetErrorMessage().find(words), std::string::npos) << words;
    errors->Clear();
  };
  this->Haze->SetExtinction(0, -1, 0);
  refuses("Extinction -1");
  this->Haze->SetExtinction(0, 1, 0);
  this->Haze->SetTowardSun(1, 0, 0);
  refuses("above the horizon");
  this->Haze->SetTowardSun(1, 0, 1);
  this->Haze->SetStep(0);
  refuses("Step 0");
  this->Haze->SetStep(1);
  this->Haze->SetInputData(imageOf("Height", 3, [](double, double) { return 0; }));
  refuses("SunTransmittance");
  EXPECT_FALSE(this->Haze->Prepare(
    nephoscope::Camera::parallel({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, 3, 8, 6)));
  EXPECT_NE(errors->GetErrorMessage().find("choose Exact or March"), std::string::npos);
}
