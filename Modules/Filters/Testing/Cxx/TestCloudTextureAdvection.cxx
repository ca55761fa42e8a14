// SPDX-License-Identifier: BSD-3-Clause
#include "CloudArrays.h"
#include "ErrorText.h"
#include "vtkCloudTexture.h"
#include "vtkCloudTextureAdvection.h"

#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"
#include "vtkStructuredGrid.h"
#include "vtkStructuredGridAlgorithm.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;
constexpr double Pi = 3.14159265358979323846;
constexpr double Radius = 6371229;
constexpr double Hour = 3600;

/// An atmosphere on a globe or in a plane whose wind is a function of place and time.
class Atmosphere : public vtkStructuredGridAlgorithm
{
public:
  static Atmosphere* New();
  vtkTypeMacro(Atmosphere, vtkStructuredGridAlgorithm);

  bool Globe = true;
  int Size[3] = { 33, 16, 3 };
  double HeightScale = 1;
  bool HasWind = true;
  std::vector<double> Times{ 0, 6 * Hour, 12 * Hour, 18 * Hour };
  std::function<void(const double position[3], double time, double wind[3])> Wind =
    [](const double*, double, double wind[3]) { wind[0] = wind[1] = wind[2] = 0; };
  std::multiset<double> Asked;

protected:
  Atmosphere() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkInformation* const out = outputs->GetInformationObject(0);
    const int extent[6] = { 0, this->Size[0] - 1, 0, this->Size[1] - 1, 0, this->Size[2] - 1 };
    out->Set(Pipeline::WHOLE_EXTENT(), extent, 6);
    if (!this->Times.empty())
    {
      out->Set(Pipeline::TIME_STEPS(), this->Times.data(), static_cast<int>(this->Times.size()));
      const double range[2] = { this->Times.front(), this->Times.back() };
      out->Set(Pipeline::TIME_RANGE(), range, 2);
    }
    return 1;
  }

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkInformation* const out = outputs->GetInformationObject(0);
    const double time =
      out->Has(Pipeline::UPDATE_TIME_STEP()) ? out->Get(Pipeline::UPDATE_TIME_STEP()) : 0;
    this->Asked.insert(time);
    vtkStructuredGrid* const grid = vtkStructuredGrid::GetData(outputs);
    grid->SetDimensions(this->Size);
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkFloatArray> wind;
    wind->SetName(nephoscope::arrays::Wind);
    wind->SetNumberOfComponents(3);
    vtkNew<vtkFloatArray> height;
    height->SetName(nephoscope::arrays::Height);
    for (int k = 0; k < this->Size[2]; ++k)
    {
      for (int j = 0; j < this->Size[1]; ++j)
      {
        for (int i = 0; i < this->Size[0]; ++i)
        {
          const double z = 1000.0 * (k + 1);
          double p[3] = { 1e4 * i, 1e4 * j, this->HeightScale * z };
          if (this->Globe)
          {
            const double lon = 2 * Pi * i / (this->Size[0] - 1);
            const double lat = -Pi / 2 + Pi * (j + 0.5) / this->Size[1];
            const double r = Radius + this->HeightScale * z;
            p[0] = r * std::cos(lat) * std::cos(lon);
            p[1] = r * std::cos(lat) * std::sin(lon);
            p[2] = r * std::sin(lat);
          }
          double v[3];
          this->Wind(p, time, v);
          points->InsertNextPoint(p);
          wind->InsertNextTuple(v);
          height->InsertNextValue(static_cast<float>(z));
        }
      }
    }
    grid->SetPoints(points);
    if (this->HasWind)
    {
      grid->GetPointData()->AddArray(wind);
    }
    grid->GetPointData()->AddArray(height);
    vtkNew<vtkStringArray> geometry;
    geometry->SetName(nephoscope::arrays::Geometry);
    geometry->InsertNextValue(this->Globe ? "Globe" : "Local");
    grid->GetFieldData()->AddArray(geometry);
    vtkNew<vtkDoubleArray> scale;
    scale->SetName(nephoscope::arrays::HeightScale);
    scale->InsertNextValue(this->HeightScale);
    grid->GetFieldData()->AddArray(scale);
    return 1;
  }
};
vtkStandardNewMacro(Atmosphere);

/// A turn about the axis in 12 days, with a swirl that grows in time.
void swirl(const double p[3], double time, double wind[3])
{
  const double omega = 2 * Pi / (12 * 24 * Hour);
  const double r = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  const double shear = 30 * (1 + time / (24 * Hour)) * p[2] / r;
  wind[0] = -omega * p[1] - shear * p[1] / r;
  wind[1] = omega * p[0] + shear * p[0] / r;
  wind[2] = 0;
}

std::vector<double> values(vtkCloudTextureAdvection* filter, const char* name)
{
  vtkDataArray* const array = filter->GetOutput()->GetPointData()->GetArray(name);
  std::vector<double> all;
  for (vtkIdType v = 0; array && v < array->GetNumberOfValues(); ++v)
  {
    all.push_back(array->GetVariantValue(v).ToDouble());
  }
  return all;
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
    const std::vector<double> c = values(filter, First);
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
  const std::vector<double> c = values(filter, First);
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
  const std::vector<double> c = values(filter, First);
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
    std::vector<double> both = values(filter, First);
    const std::vector<double> other = values(filter, Second);
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
      const std::vector<double> now = values(filter, n == 0 ? First : Second);
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
  // The period of its own is such that the stretch at full weight is about two.
  again->SetRestartPeriod(0);
  again->UpdateTimeStep(0);
  EXPECT_GT(again->GetUsedRestartPeriod(), 12 * Hour);
  again->UpdateTimeStep(again->GetUsedRestartPeriod());
  EXPECT_GT(again->GetMedianStretch(), 1.4);
  EXPECT_LT(again->GetMedianStretch(), 6); // a shear that doubled meanwhile
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
    for (const double c : values(filter, First))
    {
      ASSERT_TRUE(std::isfinite(c));
    }
    EXPECT_FALSE(values(filter, First).empty()) << shape;
  }
}

TEST(CloudTextureAdvection, CloudsThatAreSeenMoveWithTheWind)
{
  // Opacity along rows near the equator six hours apart, while textures cross-fade: the shift of greatest correlation.
  vtkNew<Atmosphere> air;
  air->Size[0] = 129;
  air->Size[1] = 64;
  air->Wind = [](const double p[3], double, double wind[3])
  {
    const double omega = 2 * Pi / (12 * 24 * Hour);
    wind[0] = -omega * p[1];
    wind[1] = omega * p[0];
    wind[2] = 0;
  };
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
