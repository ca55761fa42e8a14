// SPDX-License-Identifier: BSD-3-Clause
#include "Atmosphere.h"
#include "CloudArrays.h"
#include "ErrorText.h"
#include "vtkCloudTexture.h"
#include "vtkCloudTextureAdvection.h"

#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;
constexpr double Radius = Atmosphere::Radius;
constexpr double Hour = Atmosphere::Hour;

/// A turn about the axis in 12 days, with a swirl that grows in time.
void swirl(const double p[3], double time, double wind[3])
{
  const double r = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  const double shear = 30 * (1 + time / (24 * Hour)) * p[2] / r;
  Atmosphere::rotation(p, time, wind);
  wind[0] -= shear * p[1] / r;
  wind[1] += shear * p[0] / r;
}

const char* const First = nephoscope::arrays::TextureCoordinates;
const char* const Second = nephoscope::arrays::OtherTextureCoordinates;
}

TEST(CloudTextureAdvection, CalmAirHasItsPlaceAsCoordinates)
{
  vtkNew<Atmosphere> air;
  air->HeightScale = 20;
  vtkNew<vtkCloudTextureAdvection> filter;
  filter->SetInputConnection(air->GetOutputPort());
  filter->CrossFadeOff();
  for (const double time : { 0.0, 1.5 * Hour, 12 * Hour, 18 * Hour })
  {
    filter->UpdateTimeStep(time);
    const std::vector<double> c = pointValues(filter, First);
    ASSERT_EQ(c.size(), 3U * 33 * 16 * 3);
    for (vtkIdType p = 0; p < filter->GetOutput()->GetNumberOfPoints(); ++p)
    {
      for (int n = 0; n < 3; ++n)
      {
        EXPECT_NEAR(c[3 * p + n], filter->GetOutput()->GetPoint(p)[n], 2);
      }
    }
    EXPECT_NEAR(filter->GetMaximumStretch(), 1, 1e-3);
  }
}

TEST(CloudTextureAdvection, UniformWindInAPlaneShiftsCoordinatesUpstream)
{
  vtkNew<Atmosphere> air;
  air->Globe = false;
  air->Size[0] = 21;
  air->Wind = [](const double*, double time, double wind[3])
  {
    wind[0] = 1 + time / (6 * Hour); // linear in time
    wind[1] = 0;
    wind[2] = 0;
  };
  vtkNew<vtkCloudTextureAdvection> filter;
  filter->SetInputConnection(air->GetOutputPort());
  filter->CrossFadeOff();
  const double time = 9 * Hour;
  filter->UpdateTimeStep(time);
  const double way = time + time * time / (12 * Hour);
  const std::vector<double> c = pointValues(filter, First);
  double p[3];
  filter->GetOutput()->GetPoint(15 + 21 * 7, p);
  EXPECT_NEAR(c[3 * (15 + 21 * 7)], p[0] - way, 0.1);
  EXPECT_NEAR(c[3 * (15 + 21 * 7) + 1], p[1], 0.1);
}

TEST(CloudTextureAdvection, AscentBringsTheLevelBelow)
{
  vtkNew<Atmosphere> air;
  air->HeightScale = 10;
  air->Wind = [](const double p[3], double, double wind[3])
  {
    const double r = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    for (int n = 0; n < 3; ++n)
    {
      wind[n] = 0.05 * p[n] / r; // 5 cm/s upward
    }
  };
  vtkNew<vtkCloudTextureAdvection> filter;
  filter->SetInputConnection(air->GetOutputPort());
  filter->CrossFadeOff();
  filter->UpdateTimeStep(3 * Hour);
  const std::vector<double> c = pointValues(filter, First);
  const vtkIdType middle = 5 + 33 * (7 + 16 * 1);
  const double radius = std::sqrt(c[3 * middle] * c[3 * middle] +
    c[3 * middle + 1] * c[3 * middle + 1] + c[3 * middle + 2] * c[3 * middle + 2]);
  EXPECT_NEAR(radius, Radius + 10 * (2000 - 0.05 * 3 * Hour), 2);
}

TEST(CloudTextureAdvection, AnyOrderOfRequestsGivesTheSameBits)
{
  const auto at = [](const std::vector<double>& times)
  {
    vtkNew<Atmosphere> air;
    air->Wind = swirl;
    vtkNew<vtkCloudTextureAdvection> filter;
    filter->SetInputConnection(air->GetOutputPort());
    filter->SetRestartPeriod(4 * Hour);
    for (const double time : times)
    {
      filter->UpdateTimeStep(time * Hour);
    }
    std::vector<double> both = pointValues(filter, First);
    const std::vector<double> other = pointValues(filter, Second);
    both.insert(both.end(), other.begin(), other.end());
    return both;
  };
  for (const double time : { 3.0, 6.0, 8.0, 13.5, 18.0 })
  {
    const std::vector<double> direct = at({ time });
    ASSERT_FALSE(direct.empty());
    EXPECT_EQ(direct, at({ 1, time }));
    EXPECT_EQ(direct, at({ 18, 2, 17, time }));
    EXPECT_EQ(direct, at({ 0, 5, 6, 11, 12, time }));
  }
}

TEST(CloudTextureAdvection, TexturesAreContinuousInTimeAndWeightsSumToOne)
{
  vtkNew<Atmosphere> air;
  air->Wind = swirl;
  vtkNew<vtkCloudTextureAdvection> filter;
  filter->SetInputConnection(air->GetOutputPort());
  filter->SetRestartPeriod(5 * Hour);
  std::vector<double> before[2];
  double weightBefore[2] = { 0, 0 };
  for (double time = 0; time <= 18 * Hour; time += Hour / 4)
  {
    filter->UpdateTimeStep(time);
    vtkDataArray* const weights =
      filter->GetOutput()->GetFieldData()->GetArray(nephoscope::arrays::TextureWeights);
    ASSERT_NE(weights, nullptr);
    EXPECT_NEAR(weights->GetComponent(0, 0) + weights->GetComponent(1, 0), 1, 1e-12);
    for (int n = 0; n < 2; ++n)
    {
      const std::vector<double> now = pointValues(filter, n == 0 ? First : Second);
      const double weight = weights->GetComponent(n, 0);
      // A texture jumps only where it is not seen.
      if (!before[n].empty() && std::min(weight, weightBefore[n]) > 0.05)
      {
        double largest = 0;
        for (std::size_t v = 0; v < now.size(); ++v)
        {
          largest = std::max(largest, std::abs(now[v] - before[n][v]));
        }
        EXPECT_LT(largest, 130 * Hour / 4) << time; // no faster than the wind
      }
      EXPECT_NEAR(std::abs(weight - weightBefore[n]), time == 0 ? weight : 0.05, 1e-9);
      before[n] = now;
      weightBefore[n] = weight;
    }
  }
}

TEST(CloudTextureAdvection, RestartsBoundTheStretch)
{
  vtkNew<Atmosphere> air;
  air->Wind = swirl;
  air->Times = { 0, 24 * Hour, 48 * Hour, 72 * Hour, 96 * Hour, 120 * Hour, 144 * Hour };
  vtkNew<vtkCloudTextureAdvection> once;
  once->SetInputConnection(air->GetOutputPort());
  once->CrossFadeOff();
  once->UpdateTimeStep(72 * Hour);
  EXPECT_GT(once->GetMedianStretch(), 2);
  vtkNew<vtkCloudTextureAdvection> again;
  again->SetInputConnection(air->GetOutputPort());
  again->SetRestartPeriod(12 * Hour);
  again->UpdateTimeStep(72 * Hour);
  EXPECT_LT(again->GetMedianStretch(), 1.5); // at most 18 hours old where it is the heavier
}

TEST(CloudTextureAdvection, APeriodOfItsOwnLetsTheMostStrainedTwentiethStretchTwofoldUntilHalfFaded)
{
  vtkNew<Atmosphere> air;
  air->Wind = [](const double p[3], double, double wind[3]) { swirl(p, 0, wind); };
  air->Times = { 0, 24 * Hour, 48 * Hour, 72 * Hour, 96 * Hour };
  vtkNew<vtkCloudTextureAdvection> filter;
  filter->SetInputConnection(air->GetOutputPort());
  filter->UpdateTimeStep(0);
  const double period = filter->GetUsedRestartPeriod();
  ASSERT_LT(1.49 * period, 96 * Hour);
  filter->UpdateTimeStep(1.49 * period);
  std::vector<double> stretch = pointValues(filter, nephoscope::arrays::TextureStretch);
  std::sort(stretch.begin(), stretch.end());
  // Steady shear stretches less than exponentially: by 1 + s t + ..., not exp(s t).
  EXPECT_GT(stretch[stretch.size() * 95 / 100], 1.4);
  EXPECT_LT(stretch[stretch.size() * 95 / 100], 2.1);
}

TEST(CloudTextureAdvection, AsksOnlyForTheTimesItNeeds)
{
  vtkNew<Atmosphere> air;
  air->Wind = swirl;
  vtkNew<vtkCloudTextureAdvection> filter;
  filter->SetInputConnection(air->GetOutputPort());
  filter->SetRestartPeriod(3 * Hour);
  filter->UpdateTimeStep(14 * Hour);
  EXPECT_EQ(air->Asked.count(6 * Hour), 1U); // a texture starts at 9 h
  EXPECT_EQ(air->Asked.count(14 * Hour), 1U);
  air->Asked.clear();
  filter->UpdateTimeStep(15 * Hour);
  EXPECT_EQ(air->Asked, std::multiset<double>({ 15 * Hour }));
}

TEST(CloudTextureAdvection, WorksWithoutTimeAndWithOneLevelOrColumn)
{
  for (const int shape : { 0, 1, 2 })
  {
    vtkNew<Atmosphere> air;
    air->Wind = swirl;
    air->Globe = shape == 0;
    air->Times = shape == 0 ? std::vector<double>() : std::vector<double>{ 0, Hour };
    air->Size[2] = shape == 1 ? 1 : 3;
    air->Size[0] = shape == 2 ? 1 : 33;
    vtkNew<vtkCloudTextureAdvection> filter;
    filter->SetInputConnection(air->GetOutputPort());
    filter->Update();
    for (const double c : pointValues(filter, First))
    {
      ASSERT_TRUE(std::isfinite(c));
    }
    EXPECT_FALSE(pointValues(filter, First).empty()) << shape;
  }
}

TEST(CloudTextureAdvection, CloudsThatAreSeenMoveWithTheWind)
{
  // Opacity along rows near the equator six hours apart, while textures cross-fade: the shift of greatest correlation.
  vtkNew<Atmosphere> air;
  air->Size[0] = 129;
  air->Size[1] = 64;
  air->Wind = Atmosphere::rotation;
  vtkNew<vtkCloudTextureAdvection> advection;
  advection->SetInputConnection(air->GetOutputPort());
  advection->SetRestartPeriod(24 * Hour);
  vtkNew<vtkCloudTexture> texture;
  texture->SetInputConnection(advection->GetOutputPort());
  texture->SetWavelength(6e6);
  texture->SetOctaves(3);
  const auto opacityAt = [&texture](double time)
  {
    texture->UpdateTimeStep(time);
    return vtkFloatArray::SafeDownCast(vtkDataSet::SafeDownCast(texture->GetOutputDataObject(0))
                                         ->GetPointData()
                                         ->GetArray(nephoscope::arrays::Opacity));
  };
  for (const double begin : { 1.0, 5.5, 11.0 })
  {
    vtkNew<vtkFloatArray> first;
    first->DeepCopy(opacityAt(begin * Hour));
    vtkFloatArray* const second = opacityAt((begin + 6) * Hour);
    const auto difference = [&first, second](int shift)
    {
      double sum = 0;
      for (int j = 24; j < 40; ++j)
      {
        for (int i = 0; i < 128; ++i)
        {
          const double d =
            first->GetValue(i + 129 * j) - second->GetValue((i + shift + 128) % 128 + 129 * j);
          sum += d * d;
        }
      }
      return sum;
    };
    int best = 0;
    for (int shift = -20; shift <= 20; ++shift)
    {
      best = difference(shift) < difference(best) ? shift : best;
    }
    const double a = difference(best - 1);
    const double b = difference(best);
    const double c = difference(best + 1);
    const double shift = best + 0.5 * (a - c) / (a - 2 * b + c);
    const double expected = 128.0 * 6 / (12 * 24);
    EXPECT_NEAR(shift, expected, 0.1 * expected) << begin;
  }
}

/// Asked for the next time again and again it would never end.
TEST(CloudTextureAdvection, AnInputThatFailsAtALaterTimeEndsTheUpdate)
{
  vtkNew<Atmosphere> air;
  vtkNew<vtkCloudTextureAdvection> filter;
  filter->SetInputConnection(air->GetOutputPort());
  air->FailsFrom = 12 * Hour;
  filter->UpdateInformation();
  filter->GetOutputInformation(0)->Set(Pipeline::UPDATE_TIME_STEP(), 13 * Hour);
  EXPECT_NE(inputErrorOf(filter, air).find("The input has failed"), std::string::npos);
  filter->GetOutputInformation(0)->Set(Pipeline::UPDATE_TIME_STEP(), 7 * Hour);
  EXPECT_NE(inputErrorOf(filter, air).find("The input has failed"), std::string::npos);
  filter->GetOutputInformation(0)->Set(Pipeline::UPDATE_TIME_STEP(), 5 * Hour);
  EXPECT_EQ(errorTextOf(filter), "");
}

TEST(CloudTextureAdvection, FailuresSayWhatAndWhere)
{
  vtkNew<Atmosphere> air;
  vtkNew<vtkCloudTextureAdvection> filter;
  filter->SetInputConnection(air->GetOutputPort());
  filter->UpdateInformation();
  filter->GetOutputInformation(0)->Set(Pipeline::UPDATE_TIME_STEP(), 1e6);
  EXPECT_NE(errorTextOf(filter).find("not within the input's"), std::string::npos);
  filter->GetOutputInformation(0)->Set(Pipeline::UPDATE_TIME_STEP(), 0.0);
  air->HasWind = false;
  air->Modified();
  EXPECT_NE(errorTextOf(filter).find("no point array Wind"), std::string::npos);
  air->HasWind = true;
  air->Times = { 0, 5, 5, 7 };
  air->Modified();
  EXPECT_NE(errorTextOf(filter).find("time step 2 is not later"), std::string::npos);
}
