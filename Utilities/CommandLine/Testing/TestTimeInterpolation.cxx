// SPDX-License-Identifier: BSD-3-Clause
// Clouds carried along the wind against clouds that fade, on files of which steps are left out and interpolated from their neighbours.
#include <CloudArrays.h>
#include <vtkCloudNetCDFReader.h>
#include <vtkCloudTimeInterpolator.h>
#include <vtkDataArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkStructuredGrid.h>
#include <vtkStructuredGridAlgorithm.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

namespace
{
using namespace nephoscope;
using Pipeline = vtkStreamingDemandDrivenPipeline;

/// Passes its input, of which only every n-th time step is said to be there.
class LeaveOut : public vtkStructuredGridAlgorithm
{
public:
  static LeaveOut* New();
  vtkTypeMacro(LeaveOut, vtkStructuredGridAlgorithm);
  int Stride = 2;

protected:
  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override
  {
    vtkInformation* const in = inputs[0]->GetInformationObject(0);
    const double* const times = in->Get(Pipeline::TIME_STEPS());
    std::vector<double> kept;
    for (int n = 0; n < in->Length(Pipeline::TIME_STEPS()); n += this->Stride)
    {
      kept.push_back(times[n]);
    }
    vtkInformation* const out = outputs->GetInformationObject(0);
    out->Set(Pipeline::TIME_STEPS(), kept.data(), static_cast<int>(kept.size()));
    const double range[2] = { kept.front(), kept.back() };
    out->Set(Pipeline::TIME_RANGE(), range, 2);
    return 1;
  }
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override
  {
    vtkStructuredGrid::GetData(outputs)->ShallowCopy(vtkStructuredGrid::GetData(inputs[0]));
    return 1;
  }
};
vtkStandardNewMacro(LeaveOut);

std::vector<double> fieldOf(vtkStructuredGrid* grid, const char* name)
{
  vtkDataArray* const array = grid->GetPointData()->GetArray(name);
  std::vector<double> values;
  for (vtkIdType n = 0; array && n < array->GetNumberOfTuples(); ++n)
  {
    values.push_back(array->GetComponent(n, 0));
  }
  return values;
}

/// Sum of the products of two fields' differences of neighbours along the levels.
double gradientProduct(const std::vector<double>& f, const std::vector<double>& g, const int n[3])
{
  double sum = 0;
  for (std::size_t p = 0; p < f.size(); ++p)
  {
    const int i = static_cast<int>(p) % n[0];
    const int j = static_cast<int>(p) / n[0] % n[1];
    sum += i + 1 < n[0] ? (f[p + 1] - f[p]) * (g[p + 1] - g[p]) : 0;
    sum += j + 1 < n[1] ? (f[p + n[0]] - f[p]) * (g[p + n[0]] - g[p]) : 0;
  }
  return sum;
}

struct Score
{
  double error = 0;   ///< root mean square
  double energy = 0;  ///< of gradients, over the true one
  double pattern = 0; ///< correlation of gradients with the true ones
};

/// Over all steps that are left out, for one quantity.
struct Comparison
{
  Score carried;
  Score faded;
};

Comparison compare(const std::string& file, const char* quantity, int stride)
{
  vtkNew<vtkCloudNetCDFReader> reader;
  reader->SetFileName((std::string(NEPHOSCOPE_SHARED_DATA_DIR) + "/" + file).c_str());
  reader->DiagnoseCloudFractionOn();
  vtkNew<LeaveOut> some;
  some->Stride = stride;
  some->SetInputConnection(reader->GetOutputPort());
  vtkNew<vtkCloudTimeInterpolator> interpolator;
  interpolator->SetInputConnection(some->GetOutputPort());
  reader->UpdateInformation();
  vtkInformation* const info = reader->GetOutputInformation(0);
  const double* const given = info->Get(Pipeline::TIME_STEPS());
  const std::vector<double> times(given, given + info->Length(Pipeline::TIME_STEPS()));
  Comparison result;
  double energy = 0;
  double points = 0;
  const auto steps = static_cast<int>(times.size());
  for (int step = 0; step < (steps - 1) / stride * stride; ++step)
  {
    if (step % stride == 0)
    {
      continue;
    }
    reader->UpdateTimeStep(times[step]);
    const std::vector<double> truth = fieldOf(reader->GetOutput(), quantity);
    int n[3];
    reader->GetOutput()->GetDimensions(n);
    energy += gradientProduct(truth, truth, n);
    points += static_cast<double>(truth.size());
    for (Score* score : { &result.carried, &result.faded })
    {
      interpolator->SetCarryClouds(score == &result.carried);
      interpolator->UpdateTimeStep(times[step]);
      const std::vector<double> guess = fieldOf(interpolator->GetOutput(), quantity);
      for (std::size_t p = 0; p < truth.size(); ++p)
      {
        score->error += std::pow(guess.at(p) - truth[p], 2);
      }
      score->energy += gradientProduct(guess, guess, n);
      score->pattern += gradientProduct(guess, truth, n);
    }
  }
  for (Score* score : { &result.carried, &result.faded })
  {
    score->error = std::sqrt(score->error / points);
    score->pattern /= std::sqrt(energy * score->energy);
    score->energy /= energy;
  }
  std::printf("%-22s %-13s 1 of %d  error carried %.3g, faded %.3g, ratio %.3f  "
              "gradient energy %.3f, %.3f; correlation %.3f, %.3f\n",
    file.c_str(), quantity, stride, result.carried.error, result.faded.error,
    result.carried.error / result.faded.error, result.carried.energy, result.faded.energy,
    result.carried.pattern, result.faded.pattern);
  return result;
}
}

TEST(TimeInterpolation, CarriedAgainstFaded)
{
  if (!std::filesystem::exists(NEPHOSCOPE_SHARED_DATA_DIR))
  {
    GTEST_SKIP() << "no folder " << NEPHOSCOPE_SHARED_DATA_DIR;
  }
  // Clouds of the upper troposphere drift: the error is less and the structures are where they belong.
  const char* const era5 = "era5_fraction_13h.nc";
  Comparison found = compare(era5, arrays::CloudFraction, 2);
  EXPECT_LT(found.carried.error, 0.92 * found.faded.error);
  EXPECT_GT(found.carried.pattern, found.faded.pattern + 0.1);
  found = compare(era5, arrays::CloudFraction, 3);
  EXPECT_LT(found.carried.error, 0.75 * found.faded.error);
  EXPECT_GT(found.carried.pattern, found.faded.pattern + 0.25);
  // Ice of an hour's step: no gain in error, five per cent of loss.
  found = compare(era5, arrays::IceWater, 2);
  EXPECT_LT(found.carried.error, 1.06 * found.faded.error);
  EXPECT_GT(found.carried.pattern, found.faded.pattern);
  found = compare(era5, arrays::IceWater, 3);
  EXPECT_LT(found.carried.error, 0.92 * found.faded.error);
  EXPECT_GT(found.carried.pattern, found.faded.pattern + 0.1);
}

TEST(TimeInterpolation, CarryingLosesInAHurricaneAsItsHeaderSays)
{
  if (!std::filesystem::exists(NEPHOSCOPE_SHARED_DATA_DIR))
  {
    GTEST_SKIP() << "no folder " << NEPHOSCOPE_SHARED_DATA_DIR;
  }
  for (const int stride : { 2, 3 })
  {
    for (const char* const quantity : { arrays::LiquidWater, arrays::CloudFraction })
    {
      const Comparison found = compare("wrf_katrina.nc", quantity, stride);
      EXPECT_GT(found.carried.error, found.faded.error);
      EXPECT_LT(found.carried.error, 1.8 * found.faded.error);
    }
  }
}
