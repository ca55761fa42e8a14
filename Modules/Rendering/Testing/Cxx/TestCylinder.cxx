// SPDX-License-Identifier: BSD-3-Clause
#include "RenderingTest.h"
#include "vtkCloudCellVolume.h"
#include "vtkCloudGlobe.h"
#include "vtkCloudPlane.h"
#include "vtkCloudSurface.h"
#include "vtkCloudUniformMedium.h"
#include "vtkMath.h"
#include "vtkTestErrorObserver.h"

class CylindricalPicture : public RenderingTest
{
protected:
  void SetUp() override
  {
    this->RenderingTest::SetUp();
    this->Scape->SetCylinderAngle(180);
    this->Scape->SetSize(181, 97);
  }
  static constexpr double Pixel = 3.14159265358979323846 / 181;
};

TEST_F(CylindricalPicture, ShowsSpheresAtTheirAzimuths)
{
  // From (0, -5, 0) along +y: balls ahead, 60 degrees to the right and 90 to the left.
  for (double azimuth : { 0.0, 60.0, -89.0 })
  {
    const double angle = vtkMath::RadiansFromDegrees(azimuth);
    vtkNew<vtkCloudGlobe> ball;
    ball->SetCenter(4 * std::sin(angle), -5 + 4 * std::cos(angle), 0);
    ball->SetRadius(0.2);
    this->Draw({ ball });
    const int x = static_cast<int>(std::floor(90.5 + angle / Pixel));
    EXPECT_EQ(this->Transmittance(x, 48), 0) << azimuth;
    // A pixel's centre is up to 0.05 from the ball's: the square root of 0.2^2 - 0.05^2 is 0.0064 short.
    EXPECT_NEAR(this->Depth(x, 48), 3.8, 0.0065) << azimuth;
    // 0.2 at 4 is seen as 2.9 degrees each way.
    EXPECT_EQ(this->Transmittance(x, 48 + 2), 0);
    EXPECT_EQ(this->Transmittance(x, 48 + 5), 1);
  }
}

TEST_F(CylindricalPicture, HorizonIsARowAndThePlaneIsSquare)
{
  vtkNew<vtkCloudPlane> plane;
  plane->SetHeight(-1);
  vtkNew<vtkCloudUniformMedium> haze;
  haze->SetExtinction(0, 0, 0);
  this->Draw({ plane, haze });
  for (int x = 0; x < 181; x += 30)
  {
    EXPECT_EQ(this->Transmittance(x, 48), 1) << x;
    EXPECT_EQ(this->Transmittance(x, 47), 0) << x;
    // The slope of row 20 is (20.5 - 48.5) pixels.
    const double slope = 28 * Pixel;
    EXPECT_NEAR(this->Depth(x, 20), std::sqrt(1 + 1 / (slope * slope)), 1e-4) << x;
  }
}

TEST_F(CylindricalPicture, SamplesDoNotMoveIt)
{
  vtkNew<vtkCloudPlane> plane;
  plane->SetHeight(-1);
  this->Scape->SetSamples(2);
  this->Draw({ plane });
  EXPECT_NEAR(this->Transmittance(3, 48), 0.5, 1e-6) << "the horizon is in the pixel's middle";
}

TEST_F(CylindricalPicture, IsRefusedByWhatIsProjected)
{
  vtkNew<vtkCloudSurface> surface;
  vtkNew<vtkCloudCellVolume> volume;
  const nephoscope::Camera camera =
    nephoscope::Camera::cylindrical({ 0, -5, 0 }, { 0, 0, 0 }, { 0, 0, 1 }, 180, 181, 97);
  for (vtkCloudBody* body : std::initializer_list<vtkCloudBody*>{ surface, volume })
  {
    vtkNew<vtkTest::ErrorObserver> errors;
    body->AddObserver(vtkCommand::ErrorEvent, errors);
    EXPECT_FALSE(body->Prepare(camera));
    EXPECT_NE(
      errors->GetErrorMessage().find("not straight in a cylindrical picture"), std::string::npos);
    EXPECT_NE(errors->GetErrorMessage().find(body->GetClassName()), std::string::npos);
  }
}
