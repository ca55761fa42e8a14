// SPDX-License-Identifier: BSD-3-Clause
#include "HorizontalImage.h"
#include "RenderingTest.h"
#include "vtkCloudPlane.h"
#include "vtkCloudTerrain.h"
#include "vtkTestErrorObserver.h"

class CloudTerrain : public RenderingTest
{
protected:
  void SetUp() override
  {
    this->RenderingTest::SetUp();
    this->Camera->SetPosition(0, -3, 2);
    this->Camera->SetFocalPoint(0, 0, 0);
    for (vtkCloudLitBody* body :
      std::initializer_list<vtkCloudLitBody*>{ this->Hills, this->Plane })
    {
      body->SetTowardSun(-1, 0, 2);
      body->SetAmbient(0.2);
    }
    // One colour, no finer noise: the light alone.
    this->Hills->SetRoughness(0);
    this->SetHeights([](double, double) { return -0.5; });
  }
  template <class Function>
  void SetHeights(Function function)
  {
    this->Hills->SetInputData(imageOf(nephoscope::arrays::Height, 0, function));
  }
  void SetShadow(double z, double value)
  {
    this->Hills->SetInputDataObject(1,
      imageOf(nephoscope::arrays::SunTransmittance, z,
        [value](double x, double) { return x < -1 ? value : 1; }));
  }

  vtkNew<vtkCloudTerrain> Hills;
  vtkNew<vtkCloudPlane> Plane;
};

TEST_F(CloudTerrain, FlatGroundLiesWhereAPlaneDoes)
{
  this->Plane->SetHeight(-0.5);
  this->Draw({ this->Plane });
  std::vector<double> depths;
  for (int x = 0; x < Width; ++x)
  {
    depths.push_back(this->Depth(x, 10));
  }
  this->Draw({ this->Hills });
  for (int x = 0; x < Width; ++x)
  {
    EXPECT_NEAR(this->Depth(x, 10), depths[x], 1e-6);
    EXPECT_EQ(this->Transmittance(x, 10), 0);
  }
}

TEST_F(CloudTerrain, CloudsTakeTheSunAndLeaveTheSky)
{
  this->Draw({ this->Hills });
  std::vector<double> lit;
  for (int x = 0; x < Width; ++x)
  {
    lit.push_back(this->Radiance(x, 20));
  }
  // The plane is 1 above the ground: the shadow of x < -1 falls on x < -0.5 under a sun at (-1, 0, 2).
  this->SetShadow(0.5, 0.25);
  this->Hills->SetSunColor(1, 1, 1);
  this->Hills->SetSkyColor(1, 1, 1);
  this->Draw({ this->Hills });
  std::vector<double> half;
  for (int x = 0; x < Width; ++x)
  {
    half.push_back(this->Radiance(x, 20));
  }
  this->SetShadow(0.5, 1);
  this->Draw({ this->Hills });
  const double facing = 2 / std::sqrt(5.0);
  const double shaded = (0.8 * 0.25 * facing + 0.2) / (0.8 * facing + 0.2);
  int dark = 0;
  for (int x = 0; x < Width; ++x)
  {
    const nephoscope::Ray ray = this->RayOf(x, 20);
    const double at = ray.direction[0] * (2.5 / -ray.direction[2]);
    if (at < -1.01 || at > -0.49) // the map is linear between -1.5 and -1
    {
      dark += at < -1.01 ? 1 : 0;
      EXPECT_NEAR(half[x] / this->Radiance(x, 20), at < -0.7 ? shaded : 1, 1e-5) << at;
    }
  }
  EXPECT_GT(dark, 2);
}

TEST_F(CloudTerrain, CloudsGoOnBeyondTheirMapAsTheyAreInTheMean)
{
  this->Hills->SetAmbient(0);
  this->Draw({ this->Hills });
  const double lit = this->Radiance(58, 25);
  // Nothing of this map lies over the ground that is seen; half of it is dark.
  vtkSmartPointer<vtkImageData> map = imageOf(
    nephoscope::arrays::SunTransmittance, 0.5, [](double x, double) { return x < -0.1 ? 0 : 1; });
  map->SetOrigin(-5e3, 0, 0.5);
  this->Hills->SetInputDataObject(1, map);
  this->Draw({ this->Hills });
  EXPECT_NEAR(this->Radiance(58, 25) / lit, 0.5, 0.05);
}

TEST_F(CloudTerrain, HillsStandInTheSun)
{
  // A wall at x < -1, 2 high, shades the ground to its east under a sun in the west, 45 degrees high.
  this->SetHeights([](double x, double) { return x < -1.2 ? 1.5 : -0.5; });
  this->Hills->SetTowardSun(-1, 0, 1);
  this->Hills->SetAmbient(0);
  this->Camera->SetPosition(0.5, 0, 9);
  this->Camera->SetFocalPoint(0.5, 0, 0);
  this->Camera->SetViewUp(0, 1, 0);
  this->Draw({ this->Hills });
  const auto at = [this](double x)
  {
    return this->Radiance(
      30 + static_cast<int>(std::lround((x - 0.5) / 9.5 / this->KernelCamera().pixel())), 21);
  };
  EXPECT_EQ(at(0), 0);
  EXPECT_GT(at(1.2), 0.01);
}

TEST_F(CloudTerrain, BadInputIsRefused)
{
  vtkNew<vtkTest::ErrorObserver> errors;
  this->Hills->AddObserver(vtkCommand::ErrorEvent, errors);
  this->Hills->SetInputData(imageOf("Depth", 0, [](double, double) { return 1; }));
  EXPECT_FALSE(this->Hills->Prepare(this->KernelCamera()));
  EXPECT_NE(errors->GetErrorMessage().find("point array Height"), std::string::npos);
  errors->Clear();
  this->SetHeights([](double, double) { return 1; });
  this->Hills->SetInputDataObject(1, imageOf("Height", 0, [](double, double) { return 1; }));
  EXPECT_FALSE(this->Hills->Prepare(this->KernelCamera()));
  EXPECT_NE(errors->GetErrorMessage().find("SunTransmittance"), std::string::npos);
  errors->Clear();
  this->Hills->SetHeightScale(0);
  EXPECT_FALSE(this->Hills->Prepare(this->KernelCamera()));
  EXPECT_NE(errors->GetErrorMessage().find("HeightScale 0"), std::string::npos);
}
