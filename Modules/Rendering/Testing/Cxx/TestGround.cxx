// SPDX-License-Identifier: BSD-3-Clause
#include "RenderingTest.h"
#include "vtkCloudGlobe.h"
#include "vtkCloudPlane.h"
#include "vtkMath.h"
#include "vtkTestErrorObserver.h"

class CloudGround : public RenderingTest
{
protected:
  /// The whole world in degrees, a pixel a degree, seen from above under the sky alone: land 1, sea 0.
  void DrawWorld()
  {
    this->Plane->LandOn();
    this->Plane->SetLandColor(1, 1, 1);
    this->Plane->SetSeaColor(0, 0, 0);
    this->Plane->SetSkyColor(1, 1, 1);
    this->Plane->SetAmbient(1);
    this->Camera->SetPosition(0, 0, 10);
    this->Camera->SetFocalPoint(0, 0, 0);
    this->Camera->SetViewUp(0, 1, 0);
    this->Camera->ParallelProjectionOn();
    this->Camera->SetParallelScale(90);
    this->Scape->SetSize(360, 180);
    this->Draw({ this->Plane });
  }
  double Land(int longitude, int latitude)
  {
    return this->Radiance(longitude + 180, latitude + 90);
  }
  vtkNew<vtkCloudGlobe> Globe;
  vtkNew<vtkCloudPlane> Plane;
};

TEST_F(CloudGround, GlobeIsWhereTheSphereIs)
{
  this->Globe->SetRadius(0.8);
  this->Globe->SetCenter(0.1, 0.2, -0.1);
  this->Draw({ this->Globe });
  const nephoscope::Vector3 center{ 0.1, 0.2, -0.1 };
  int inside = 0;
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      const nephoscope::Ray ray = this->RayOf(x, y);
      const double b = dot(center - ray.origin, ray.direction);
      const double miss = length(center - ray.origin - b * ray.direction);
      if (miss < 0.75) // a pixel is 0.06 wide
      {
        ++inside;
        EXPECT_EQ(this->Transmittance(x, y), 0);
        EXPECT_NEAR(this->Depth(x, y), b - std::sqrt(0.64 - miss * miss), 1e-6);
      }
      else if (miss > 0.85)
      {
        EXPECT_EQ(this->Transmittance(x, y), 1);
      }
    }
  }
  EXPECT_GT(inside, 300);
}

TEST_F(CloudGround, SmoothLimbKeepsTheAreaOfTheDisc)
{
  this->Globe->SetRadius(1);
  const double pixel = this->KernelCamera().pixel();
  const double disc = vtkMath::Pi() / 24 / (pixel * pixel);
  double covered = 0;
  this->Draw({ this->Globe });
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      covered += 1 - this->Transmittance(x, y);
    }
  }
  // Of a disc of 16 pixels' radius; without smoothing the error of counting is some ten pixels.
  EXPECT_NEAR(covered, disc, 0.01 * disc);
}

TEST_F(CloudGround, GlobeIsLitByTheSun)
{
  this->Globe->SetRadius(1);
  this->Globe->LandOff();
  this->Globe->SetSeaColor(0.5, 0.5, 0.5);
  this->Globe->SetAmbient(0.2);
  this->Globe->SetSunColor(1, 1, 1);
  this->Globe->SetSkyColor(1, 1, 1);
  this->Globe->SetTowardSun(0, -2, 0);
  this->Draw({ this->Globe });
  EXPECT_NEAR(this->Radiance(30, 21), 0.5, 1e-6);
  this->Globe->SetTowardSun(0, 1, 0);
  this->Draw({ this->Globe });
  EXPECT_NEAR(this->Radiance(30, 21), 0.5 * 0.2, 1e-6);
}

TEST_F(CloudGround, ContinentsAreWhereTheyAre)
{
  this->DrawWorld();
  const int land[][2] = { { 10, 22 }, { -100, 45 }, { -60, -10 }, { 135, -25 }, { 90, 30 },
    { 0, -85 }, { 179, 67 }, { -179, 67 }, { -179, -85 }, { 179, -88 }, { -42, 75 } };
  const int sea[][2] = { { -150, 0 }, { 179, 0 }, { -179, 0 }, { -30, 40 }, { 80, -20 }, { 0, 88 },
    { 5, 40 }, { -90, 25 }, { 20, -55 } };
  for (const auto& place : land)
  {
    EXPECT_EQ(this->Land(place[0], place[1]), 1) << place[0] << ' ' << place[1];
  }
  for (const auto& place : sea)
  {
    EXPECT_EQ(this->Land(place[0], place[1]), 0) << place[0] << ' ' << place[1];
  }
}

TEST_F(CloudGround, LandCoversTheShareOfTheEarthThatItDoes)
{
  this->DrawWorld();
  double land = 0;
  double all = 0;
  for (int latitude = -90; latitude < 90; ++latitude)
  {
    const double weight = std::cos(vtkMath::RadiansFromDegrees(latitude + 0.5));
    for (int longitude = -180; longitude < 180; ++longitude)
    {
      land += weight * this->Land(longitude, latitude);
      all += weight;
    }
  }
  // 29.2 % of the Earth is land; these coasts lack the smaller islands and ice shelves.
  EXPECT_NEAR(land / all, 0.292, 0.015);
}

TEST_F(CloudGround, GlobeAndPlaneAgreeOnTheLand)
{
  // The globe from above 20 E, 10 N, in its middle; a place that is land and one that is sea.
  this->Camera->ParallelProjectionOn();
  this->Camera->SetParallelScale(0.02);
  this->Globe->SetRadius(1);
  this->Globe->SetLandColor(1, 0, 0);
  this->Globe->SetSeaColor(0, 0, 1);
  this->Globe->SetAmbient(1);
  this->Globe->SetSkyColor(1, 1, 1);
  for (const auto& place : { std::array<double, 2>{ 20, 10 }, std::array<double, 2>{ -30, 10 } })
  {
    const double longitude = vtkMath::RadiansFromDegrees(place[0]);
    const double latitude = vtkMath::RadiansFromDegrees(place[1]);
    this->Camera->SetPosition(5 * std::cos(latitude) * std::cos(longitude),
      5 * std::cos(latitude) * std::sin(longitude), 5 * std::sin(latitude));
    this->Draw({ this->Globe });
    EXPECT_EQ(this->Radiance(30, 21, 0), place[0] > 0 ? 1 : 0);
    EXPECT_EQ(this->Radiance(30, 21, 2), place[0] > 0 ? 0 : 1);
  }
}

TEST_F(CloudGround, PlaneEndsAtItsBoundsAndHidesWhatIsBelow)
{
  this->Plane->SetHeight(-0.5);
  this->Plane->SetBounds(-0.6, 0.7, -1.1, 1.2);
  this->Draw({ this->Plane });
  int hits = 0;
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      const nephoscope::Ray ray = this->RayOf(x, y);
      const double t = -0.5 / ray.direction[2];
      const nephoscope::Vector3 at = ray.origin + t * ray.direction;
      const bool hit = t > 0 && at[0] >= -0.6 && at[0] <= 0.7 && at[1] >= -1.1 && at[1] <= 1.2;
      hits += hit ? 1 : 0;
      ASSERT_EQ(this->Transmittance(x, y), hit ? 0 : 1);
    }
  }
  EXPECT_GT(hits, 30);
}

TEST_F(CloudGround, GraticuleRunsAlongMeridiansAndParallels)
{
  this->Plane->SetGraticule(30);
  this->Plane->SetLineColor(1, 0, 0);
  this->Camera->SetPosition(0.5, 0.5, 10);
  this->Camera->SetFocalPoint(0.5, 0.5, 0);
  this->DrawWorld();
  // Pixel centres are at whole degrees plus a half: lines at multiples of 30 are shared by two pixels.
  EXPECT_GT(this->Radiance(180, 100), 0.1);
  EXPECT_GT(this->Radiance(100, 120), 0.1);
  EXPECT_EQ(this->Radiance(195, 105, 0), this->Radiance(195, 105, 1));
  // On a map meridians are as narrow near the pole.
  EXPECT_GT(this->Radiance(180, 175, 0), this->Radiance(180, 175, 1));
  EXPECT_EQ(this->Radiance(183, 175, 0), this->Radiance(183, 175, 1));
}

TEST_F(CloudGround, BadSizesAreRefused)
{
  vtkNew<vtkTest::ErrorObserver> errors;
  this->Globe->AddObserver(vtkCommand::ErrorEvent, errors);
  this->Globe->SetRadius(-1);
  EXPECT_FALSE(this->Globe->Prepare(this->KernelCamera()));
  EXPECT_NE(errors->GetErrorMessage().find("Radius -1"), std::string::npos);
  vtkNew<vtkTest::ErrorObserver> planeErrors;
  this->Plane->AddObserver(vtkCommand::ErrorEvent, planeErrors);
  this->Plane->SetBounds(1, -1, 0, 1);
  EXPECT_FALSE(this->Plane->Prepare(this->KernelCamera()));
  EXPECT_NE(planeErrors->GetErrorMessage().find("ascending"), std::string::npos);
  planeErrors->Clear();
  this->Plane->SetDegreesPerUnit(0);
  EXPECT_FALSE(this->Plane->Prepare(this->KernelCamera()));
  EXPECT_NE(planeErrors->GetErrorMessage().find("DegreesPerUnit 0"), std::string::npos);
}
