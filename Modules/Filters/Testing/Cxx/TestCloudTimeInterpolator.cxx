// SPDX-License-Identifier: BSD-3-Clause
#include "Atmosphere.h"
#include "CloudArrays.h"
#include "ErrorText.h"
#include "vtkCloudTimeInterpolator.h"

#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;
constexpr double Hour = Atmosphere::Hour;
constexpr double Step = 36e3; // m between columns: 10 m/s goes one an hour

/// A cloud with a steep edge that goes with a wind of one column an hour.
double drifting(double x, double y, int level, double hours)
{
  const double from = std::abs(x - hours - 8 - level);
  return from < 2.5 && std::abs(y - 5) < 3 ? 0.8 - 0.1 * from : 0.05 * level;
}

const char* const Fraction = nephoscope::arrays::CloudFraction;
}

class CloudTimeInterpolator : public ::testing::Test
{
protected:
  void SetUp() override
  {
    // Clouds on a plane in a wind along x; the levels rise with time.
    this->Air->Globe = false;
    this->Air->Spacing = Step;
    this->Air->Size[0] = 23;
    this->Air->Size[1] = 11;
    this->Air->Size[2] = 4;
    this->Air->Times = { 0, 2 * Hour, 4 * Hour };
    this->Air->Height = [](int level, double time) { return 1000.0 * (level + 1) + time / 100; };
    this->blow(10);
    this->Air->Cloud = drifting;
    this->Filter->SetInputConnection(this->Air->GetOutputPort());
  }
  void blow(double speed)
  {
    this->Air->Wind = [speed](const double*, double, double wind[3])
    {
      wind[0] = speed;
      wind[1] = 0;
      wind[2] = 0.01;
    };
  }
  double at(int i, int j, int k)
  {
    return this->Filter->GetOutput()->GetPointData()->GetArray(Fraction)->GetComponent(
      i + 23 * (j + 11 * k), 0);
  }
  vtkNew<Atmosphere> Air;
  vtkNew<vtkCloudTimeInterpolator> Filter;
};

TEST_F(CloudTimeInterpolator, CloudThatDriftsWholeCellsIsExactHalfWay)
{
  for (const int interpolation :
    { vtkCloudTimeInterpolator::Linear, vtkCloudTimeInterpolator::Cubic })
  {
    this->Filter->SetInterpolation(interpolation);
    for (const double hours : { 1.0, 3.0 })
    {
      this->Filter->UpdateTimeStep(hours * Hour);
      for (int k = 0; k < 4; ++k)
      {
        for (int j = 0; j < 11; ++j)
        {
          for (int i = 1; i < 22; ++i) // at the edges air comes from beyond
          {
            EXPECT_NEAR(this->at(i, j, k), drifting(i, j, k, hours), 1e-5)
              << i << ' ' << j << ' ' << k << ' ' << hours;
          }
        }
      }
      ASSERT_NE(this->Filter->GetOutput()->GetPointData()->GetScalars(), nullptr);
      EXPECT_STREQ(this->Filter->GetOutput()->GetPointData()->GetScalars()->GetName(), Fraction);
    }
  }
  // Fading shows it twice.
  this->Filter->CarryCloudsOff();
  this->Filter->UpdateTimeStep(1 * Hour);
  EXPECT_NEAR(this->at(6, 5, 0), drifting(6, 5, 0, 0) / 2, 1e-6);
  EXPECT_NEAR(this->at(12, 5, 0), drifting(12, 5, 0, 2) / 2, 1e-6);
}

TEST_F(CloudTimeInterpolator, AllElseIsLinearInTime)
{
  for (const double hours : { 0.25, 1.0, 3.5 })
  {
    this->Filter->UpdateTimeStep(hours * Hour);
    vtkStructuredGrid* const grid = this->Filter->GetOutput();
    vtkDataArray* const height = grid->GetPointData()->GetArray(nephoscope::arrays::Height);
    for (int k = 0; k < 4; ++k)
    {
      const vtkIdType point = 7 + 23 * (3 + 11 * k);
      const double z = 1000.0 * (k + 1) + 36 * hours;
      EXPECT_NEAR(grid->GetPoint(point)[2], z, 1e-3);
      EXPECT_NEAR(height->GetComponent(point, 0), z, 1e-3);
    }
    EXPECT_NE(grid->GetFieldData()->GetAbstractArray(nephoscope::arrays::Geometry), nullptr);
    EXPECT_EQ(grid->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), hours * Hour);
  }
}

TEST_F(CloudTimeInterpolator, FileTimesAreTheFileToTheBit)
{
  for (const double hours : { 0.0, 2.0, 4.0 })
  {
    this->Air->UpdateTimeStep(hours * Hour);
    vtkDataArray* const file = this->Air->GetOutput()->GetPointData()->GetArray(Fraction);
    std::vector<double> expected;
    for (vtkIdType v = 0; v < file->GetNumberOfValues(); ++v)
    {
      expected.push_back(file->GetComponent(v, 0));
    }
    this->Filter->UpdateTimeStep(hours * Hour);
    EXPECT_EQ(pointValues(this->Filter, Fraction), expected);
  }
}

TEST_F(CloudTimeInterpolator, AnyOrderOfRequestsGivesTheSameBits)
{
  this->blow(13.7);
  const auto at = [this](const std::vector<double>& hours)
  {
    vtkNew<vtkCloudTimeInterpolator> filter;
    filter->SetInputConnection(this->Air->GetOutputPort());
    for (const double hour : hours)
    {
      filter->UpdateTimeStep(hour * Hour);
    }
    return pointValues(filter, Fraction);
  };
  for (const double hour : { 0.3, 2.0, 3.1 })
  {
    const std::vector<double> direct = at({ hour });
    ASSERT_EQ(direct.size(), 23U * 11 * 4);
    EXPECT_EQ(direct, at({ 4, 1, hour }));
    EXPECT_EQ(direct, at({ 0, 1.9, 2.1, 2, hour }));
  }
}

TEST_F(CloudTimeInterpolator, NoValueIsBeyondThoseOfBothTimes)
{
  this->blow(17.3);
  this->Air->Cloud = [](double x, double y, int level, double hours)
  {
    return std::fmod(std::abs(std::sin(12.9 * x + 78.2 * y + 3.1 * level + hours) * 43758.5), 1) >
      0.5;
  };
  for (const double hours : { 0.1, 1.3, 3.9 })
  {
    this->Filter->UpdateTimeStep(hours * Hour);
    for (const double value : pointValues(this->Filter, Fraction))
    {
      ASSERT_GE(value, 0);
      ASSERT_LE(value, 1);
    }
  }
  this->Air->Cloud = [](double, double, int, double) { return 0.3F; };
  this->Air->Modified();
  this->Filter->UpdateTimeStep(1.7 * Hour);
  for (const double value : pointValues(this->Filter, Fraction))
  {
    ASSERT_EQ(value, 0.3F);
  }
}

TEST_F(CloudTimeInterpolator, VisiblePointsHaveValuesAmongHiddenOnes)
{
  this->blow(7.1);
  this->Air->Cloud = [](double x, double y, int level, double hours)
  {
    const bool hidden = (x > 9 + hours && x < 13) || (y > 8 && level == 0);
    return hidden ? std::nan("") : 0.25 + 0.01 * x;
  };
  for (const double hours : { 0.4, 1.0, 1.8 })
  {
    this->Filter->UpdateTimeStep(hours * Hour);
    const std::vector<double> cloud = pointValues(this->Filter, Fraction);
    vtkStructuredGrid* const grid = this->Filter->GetOutput();
    int hidden = 0;
    for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
    {
      hidden += grid->IsPointVisible(p) ? 0 : 1;
      if (grid->IsPointVisible(p))
      {
        ASSERT_TRUE(cloud[p] >= 0.25F && cloud[p] <= 0.471F) << cloud[p];
      }
    }
    const int columns = hours > 1 ? 1 : 3; // those of the nearer time
    EXPECT_EQ(hidden, columns * 11 * 4 + 2 * (23 - columns));
  }
}

TEST_F(CloudTimeInterpolator, WithoutTimesTheInputPasses)
{
  this->Air->Times.clear();
  this->Filter->Update();
  EXPECT_EQ(pointValues(this->Filter, Fraction).size(), 23U * 11 * 4);
  this->Air->Times = { 7 };
  this->Air->Modified();
  this->Filter->UpdateTimeStep(7);
  EXPECT_EQ(pointValues(this->Filter, Fraction).size(), 23U * 11 * 4);
}

/// Asked for the next time again and again it would never end.
TEST_F(CloudTimeInterpolator, AnInputThatFailsAtItsSecondTimeEndsTheUpdate)
{
  this->Air->FailsFrom = 1;
  this->Filter->UpdateInformation();
  this->Filter->GetOutputInformation(0)->Set(Pipeline::UPDATE_TIME_STEP(), 0.5 * Hour);
  EXPECT_NE(inputErrorOf(this->Filter, this->Air).find("The input has failed"), std::string::npos);
}

TEST_F(CloudTimeInterpolator, FailuresSayWhatAndWhere)
{
  const auto errorAt = [this](double time)
  {
    this->Air->Modified();
    this->Filter->UpdateInformation();
    this->Filter->GetOutputInformation(0)->Set(Pipeline::UPDATE_TIME_STEP(), time);
    return errorTextOf(this->Filter);
  };
  EXPECT_NE(errorAt(1e6).find("not within the input's, 0 to 14400 s"), std::string::npos);
  this->Air->HasWind = false;
  EXPECT_NE(errorAt(1 * Hour).find("no point array Wind"), std::string::npos);
  this->Filter->CarryCloudsOff();
  EXPECT_EQ(errorAt(1 * Hour), "");
  this->Air->Shrinks = true;
  EXPECT_NE(
    errorAt(1 * Hour).find("1012 points at one time and 968 at the next"), std::string::npos);
  this->Air->Times = { 0, 5, 4 };
  this->Air->Modified();
  EXPECT_NE(errorTextOf(this->Filter).find("Time step 2 is not later"), std::string::npos);
}
