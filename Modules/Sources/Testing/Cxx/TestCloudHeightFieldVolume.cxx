// SPDX-License-Identifier: BSD-3-Clause
#include "CloudArrays.h"
#include "Cumulus.h"
#include "HeightFieldScattering.h"
#include "vtkCallbackCommand.h"
#include "vtkCloudHeightFieldVolume.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkTestErrorObserver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace
{
constexpr double Plane = 700;

class CloudHeightFieldVolume : public ::testing::Test
{
protected:
  CloudHeightFieldVolume()
    : Field(makeShape())
  {
    const std::vector<double> numbers = nephoscope::numbersOf(this->Field.shape(), Plane);
    vtkNew<vtkDoubleArray> array;
    array->SetName(nephoscope::arrays::HeightField);
    array->SetNumberOfValues(static_cast<vtkIdType>(numbers.size()));
    std::copy(numbers.begin(), numbers.end(), array->GetPointer(0));
    vtkNew<vtkPolyData> input;
    input->GetFieldData()->AddArray(array);
    this->Volume->SetInputData(input);
    this->Volume->SetExtinction(Extinction);
    this->Volume->SetDimensions(37, 23, 19);
    this->Volume->SetBounds(-600, 700, -500, 400, 620, 890);
  }

  static nephoscope::HeightFieldShape makeShape()
  {
    nephoscope::HeightFieldShape shape;
    shape.polynomial[0] = 20;
    shape.waves = { { 60, 0.011, 0.004, 0.3 }, { 45, -0.006, 0.014, 1.1 },
      { 20, 0.021, 0.017, 2.5, nephoscope::WaveShape::Absolute } };
    return shape;
  }

  /// The voxels, x fastest.
  std::vector<float> Values()
  {
    this->Volume->Update();
    auto* const array = vtkFloatArray::SafeDownCast(
      this->Volume->GetOutput()->GetPointData()->GetArray(nephoscope::arrays::Extinction));
    return array
      ? std::vector<float>(array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues())
      : std::vector<float>();
  }

  static constexpr double Extinction = 0.0123;
  nephoscope::HeightField Field;
  vtkNew<vtkCloudHeightFieldVolume> Volume;
};

/// Extinction between points, of 8 weights.
class Trilinear
{
public:
  Trilinear(vtkImageData* image, std::vector<float> values)
    : Values(std::move(values))
  {
    image->GetDimensions(this->Size);
    image->GetOrigin(this->Origin);
    image->GetSpacing(this->Spacing);
  }

  double operator()(const double place[3]) const
  {
    int low[3];
    double part[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      const double at = (place[axis] - this->Origin[axis]) / this->Spacing[axis];
      low[axis] = std::clamp(static_cast<int>(std::floor(at)), 0, this->Size[axis] - 2);
      part[axis] = at - low[axis];
    }
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner)
    {
      std::size_t index = 0;
      double weight = 1;
      for (int axis = 2; axis >= 0; --axis)
      {
        const int up = corner >> axis & 1;
        index = index * this->Size[axis] + low[axis] + up;
        weight *= up ? part[axis] : 1 - part[axis];
      }
      sum += weight * this->Values[index];
    }
    return sum;
  }

private:
  std::vector<float> Values;
  int Size[3];
  double Origin[3];
  double Spacing[3];
};

/// Rays from under the clouds into all directions.
nephoscope::CloudSlice sliceOf(int ray)
{
  nephoscope::CloudSlice slice;
  slice.ux = std::cos(0.4 + 0.41 * ray);
  slice.uy = std::sin(0.4 + 0.41 * ray);
  slice.x = 50 - 350 * slice.ux;
  slice.y = -50 - 350 * slice.uy;
  slice.z = 625;
  slice.far = 700;
  return slice;
}

double slopeOf(int ray)
{
  return 0.2 + 0.01 * ray;
}

double exactDepth(const nephoscope::HeightField& field, const nephoscope::CloudSlice& slice,
  double slope, double extinction)
{
  nephoscope::SliceLight light;
  nephoscope::HeightFieldScattering::make(
    "Exact", field, Plane, nephoscope::ScatteringDensities::physical(extinction))
    ->shine(slice, { slope }, light);
  return -std::log(light.rays[0].transmittance);
}

/// By midpoints of steps much smaller than voxels.
double depthThrough(const Trilinear& extinction, const nephoscope::CloudSlice& slice, double slope)
{
  constexpr int Steps = 4000;
  const double dr = slice.far / Steps;
  double depth = 0;
  for (int step = 0; step < Steps; ++step)
  {
    const double r = (step + 0.5) * dr;
    const double at[3] = { slice.x + r * slice.ux, slice.y + r * slice.uy, slice.z + r * slope };
    depth += extinction(at) * dr * std::sqrt(1 + slope * slope);
  }
  return depth;
}
}

// The points span Bounds, and each column's voxels hold what the cloud holds: rounding of floats is all that is lost.
TEST_F(CloudHeightFieldVolume, ColumnsHoldTheCloud)
{
  const std::vector<float> values = this->Values();
  vtkImageData* const image = this->Volume->GetOutput();
  ASSERT_EQ(values.size(), 37U * 23 * 19);
  double bounds[6];
  image->GetBounds(bounds);
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(bounds[i], this->Volume->GetBounds()[i], 1e-9);
  }
  int clear = 0;
  for (vtkIdType column = 0; column < 37 * 23; ++column)
  {
    double at[3];
    image->GetPoint(column, at);
    const double f = this->Field.value(at[0], at[1]);
    const double depth = f > 0 ? Extinction * (this->Field.top(f) - this->Field.bottom(f)) : 0;
    double sum = 0;
    for (int k = 0; k < 19; ++k)
    {
      sum += values[k * 37 * 23 + column];
    }
    EXPECT_NEAR(sum * image->GetSpacing()[2], depth, 6e-8 * depth + 1e-12);
    clear += depth == 0 ? 1 : 0;
  }
  EXPECT_GT(clear, 100);
  EXPECT_LT(clear, 37 * 23 - 100);
}

// A voxel is the share of its column that is inside, as found by samples, also where the grid cuts the cloud off; no voxel is below
// 0 or above the cloud's extinction.
TEST_F(CloudHeightFieldVolume, VoxelsAreSharesOfTheirColumns)
{
  this->Volume->SetDimensions(17, 29, 7);
  this->Volume->SetBounds(-600, 700, -500, 400, 670, 760);
  const std::vector<float> values = this->Values();
  vtkImageData* const image = this->Volume->GetOutput();
  ASSERT_EQ(values.size(), 17U * 29 * 7);
  constexpr int Samples = 500;
  const double dz = image->GetSpacing()[2];
  int full = 0;
  int partly = 0;
  for (vtkIdType point = 0; point < image->GetNumberOfPoints(); ++point)
  {
    double at[3];
    image->GetPoint(point, at);
    const double f = this->Field.value(at[0], at[1]);
    int inside = 0;
    for (int sample = 0; sample < Samples; ++sample)
    {
      const double zeta = at[2] + dz * ((sample + 0.5) / Samples - 0.5) - Plane;
      inside += this->Field.inside(f, zeta) > 0 ? 1 : 0;
    }
    const float value = values[point];
    // Either end is found to half a sample.
    EXPECT_NEAR(value / Extinction, inside / double(Samples), 1.01 / Samples);
    EXPECT_GE(value, 0);
    EXPECT_LE(value, static_cast<float>(Extinction));
    full += value == static_cast<float>(Extinction) ? 1 : 0;
    partly += value > 0 && value < static_cast<float>(Extinction) ? 1 : 0;
  }
  EXPECT_GT(full, 100);
  EXPECT_GT(partly, 100);
}

// Rays at a slant through the interpolated voxels find the optical depth of the cloud itself, the better the smaller voxels are.
TEST_F(CloudHeightFieldVolume, OpticalDepthConverges)
{
  constexpr int Rays = 15;
  std::vector<double> errors; // root of mean square, of each size
  for (const int cells : { 4, 8, 16, 32 })
  {
    this->Volume->SetDimensions(6 * cells + 1, 5 * cells + 1, 4 * cells + 1);
    const std::vector<float> values = this->Values();
    const Trilinear extinction(this->Volume->GetOutput(), values);
    double sum = 0;
    for (int ray = 0; ray < Rays; ++ray)
    {
      const double exact = exactDepth(this->Field, sliceOf(ray), slopeOf(ray), Extinction);
      EXPECT_GT(exact, 0.5);
      const double error = depthThrough(extinction, sliceOf(ray), slopeOf(ray)) - exact;
      sum += error * error / Rays;
    }
    errors.push_back(std::sqrt(sum));
  }
  for (std::size_t size = 1; size < errors.size(); ++size)
  {
    EXPECT_LT(errors[size], 0.75 * errors[size - 1]);
  }
  EXPECT_LT(errors.back(), errors.front() / 8); // first order in all
}

TEST_F(CloudHeightFieldVolume, SameBitsForAnyNumberOfThreads)
{
  const auto bits = [this](int threads)
  {
    std::vector<float> values;
    vtkSMPTools::LocalScope(vtkSMPTools::Config{ threads },
      [this, &values]()
      {
        this->Volume->Modified();
        values = this->Values();
      });
    return values;
  };
  const std::vector<float> one = bits(1);
  EXPECT_FALSE(one.empty());
  EXPECT_EQ(one, bits(2));
}

TEST_F(CloudHeightFieldVolume, SaysWhatIsWrong)
{
  vtkNew<vtkTest::ErrorObserver> errors;
  this->Volume->AddObserver(vtkCommand::ErrorEvent, errors);
  this->Volume->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
  const auto expectError = [this, &errors](const char* part)
  {
    EXPECT_TRUE(this->Values().empty());
    EXPECT_EQ(this->Volume->GetOutput()->GetNumberOfPoints(), 0) << part;
    EXPECT_NE(errors->GetErrorMessage().find(part), std::string::npos) << errors->GetErrorMessage();
    errors->Clear();
  };
  for (const int few : { 1, 0, std::numeric_limits<int>::min() })
  {
    this->Volume->SetDimensions(20, 30, few);
    expectError("20 x 30 x ");
  }
  this->Volume->SetDimensions(100000, 100000, 2);
  expectError("2^28 points");
  this->Volume->SetDimensions(5, 4, 3);
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : { -500.0, -501.0, infinity, std::nan("") })
  {
    this->Volume->SetBounds(-600, 700, -500, bad, 620, 890);
    expectError("of axis y have to be numbers");
  }
  this->Volume->SetBounds(-600, 700, -500, 400, 620, 890);
  for (const double bad : { -1.0, infinity, std::nan("") })
  {
    this->Volume->SetExtinction(bad);
    expectError("has to be 0 to 1e9");
  }
  this->Volume->SetExtinction(1);
  vtkNew<vtkPolyData> nothing;
  this->Volume->SetInputData(nothing);
  expectError("no field data array HeightField");
}

// An abort leaves no half of a volume; the next update makes all of it.
TEST_F(CloudHeightFieldVolume, StopsWhenAsked)
{
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void*)
    {
      auto* const volume = static_cast<vtkCloudHeightFieldVolume*>(caller);
      volume->SetAbortExecute(volume->GetProgress() > 0.4 ? 1 : 0);
    });
  const unsigned long tag = this->Volume->AddObserver(vtkCommand::ProgressEvent, abort);
  EXPECT_TRUE(this->Values().empty());
  EXPECT_NEAR(this->Volume->GetProgress(), 13.0 / 32, 1e-9);
  EXPECT_EQ(this->Volume->GetOutput()->GetNumberOfPoints(), 0);
  this->Volume->RemoveObserver(tag);
  this->Volume->Modified();
  EXPECT_EQ(this->Values().size(), 37U * 23 * 19);
}
