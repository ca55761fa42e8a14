// SPDX-License-Identifier: BSD-3-Clause
#include "LeftOutSteps.h"

#include "ChartFiles.h"
#include "LogChart.h"

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

#include <cmath>
#include <stdexcept>

namespace nephoscope
{
namespace charts
{
namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

std::vector<double> timesOf(vtkInformation* info)
{
  const double* const times = info->Get(Pipeline::TIME_STEPS());
  return { times, times + info->Length(Pipeline::TIME_STEPS()) };
}

/// Passes its input, of which only every n-th time step is said to be there.
class StepsLeft : public vtkStructuredGridAlgorithm
{
public:
  static StepsLeft* New();
  vtkTypeMacro(StepsLeft, vtkStructuredGridAlgorithm);
  int Stride = 2;

protected:
  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override
  {
    const std::vector<double> times = timesOf(inputs[0]->GetInformationObject(0));
    std::vector<double> kept;
    for (std::size_t n = 0; n < times.size(); n += this->Stride)
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
vtkStandardNewMacro(StepsLeft);

/// A quantity on a grid.
struct Field
{
  int n[3] = {};
  std::vector<double> values;

  Field(vtkStructuredGrid* grid, const std::string& name)
  {
    vtkDataArray* const array = grid ? grid->GetPointData()->GetArray(name.c_str()) : nullptr;
    if (!array)
    {
      throw std::runtime_error("there is no array " + name + " at every step");
    }
    grid->GetDimensions(this->n);
    for (vtkIdType p = 0; p < array->GetNumberOfTuples(); ++p)
    {
      this->values.push_back(array->GetComponent(p, 0));
    }
  }
};

/// Sum of the products of two fields' differences of neighbours along the levels.
double gradientProduct(const Field& f, const Field& g)
{
  double sum = 0;
  for (std::size_t p = 0; p < f.values.size(); ++p)
  {
    const auto along = [&f, &g, p](std::size_t step)
    { return (f.values[p + step] - f.values[p]) * (g.values[p + step] - g.values[p]); };
    const int i = static_cast<int>(p) % f.n[0];
    const int j = static_cast<int>(p) / f.n[0] % f.n[1];
    sum += i + 1 < f.n[0] ? along(1) : 0;
    sum += j + 1 < f.n[1] ? along(f.n[0]) : 0;
  }
  return sum;
}

/// What is summed over the steps that are left out.
struct Sums
{
  double energy = 0;
  double points = 0;
  double values = 0;
  double squares = 0;

  void add(const Field& truth)
  {
    this->energy += gradientProduct(truth, truth);
    this->points += static_cast<double>(truth.values.size());
    for (const double value : truth.values)
    {
      this->values += value;
      this->squares += value * value;
    }
  }
  double spread() const
  {
    const double mean = this->values / this->points;
    return std::sqrt(std::max(this->squares / this->points - mean * mean, 0.0));
  }
};

void add(InterpolationScore& score, const Field& guess, const Field& truth)
{
  for (std::size_t p = 0; p < truth.values.size(); ++p)
  {
    score.error += std::pow(guess.values.at(p) - truth.values[p], 2);
  }
  score.energy += gradientProduct(guess, guess);
  score.pattern += gradientProduct(guess, truth);
}

void finish(InterpolationScore& score, const Sums& sums)
{
  score.error = std::sqrt(score.error / sums.points);
  score.pattern = score.energy > 0 ? score.pattern / std::sqrt(sums.energy * score.energy) : 0;
  score.energy /= sums.energy;
}
}

LeftOutSteps leaveOut(
  vtkAlgorithm* source, const std::string& name, const std::string& quantity, int stride)
{
  vtkNew<StepsLeft> some;
  some->Stride = stride;
  some->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkCloudTimeInterpolator> interpolator;
  interpolator->SetInputConnection(some->GetOutputPort());
  source->UpdateInformation();
  const std::vector<double> times = timesOf(source->GetOutputInformation(0));
  const int last = (static_cast<int>(times.size()) - 1) / stride * stride;
  if (last < stride)
  {
    throw std::runtime_error(name + " has " + std::to_string(times.size()) +
      " time steps; to keep one of " + std::to_string(stride) + " takes " +
      std::to_string(stride + 1));
  }
  LeftOutSteps result;
  result.name = name;
  result.quantity = quantity;
  result.stride = stride;
  Sums sums;
  for (int step = 1; step < last; ++step)
  {
    if (step % stride == 0)
    {
      continue;
    }
    source->UpdateTimeStep(times[step]);
    const Field truth(vtkStructuredGrid::SafeDownCast(source->GetOutputDataObject(0)), quantity);
    sums.add(truth);
    for (InterpolationScore* score : { &result.carried, &result.faded })
    {
      interpolator->SetCarryClouds(score == &result.carried);
      interpolator->UpdateTimeStep(times[step]);
      add(*score, Field(interpolator->GetOutput(), quantity), truth);
    }
  }
  if (!(sums.energy > 0))
  {
    throw std::runtime_error(quantity + " of " + name + " does not vary along its levels");
  }
  result.spread = sums.spread();
  finish(result.carried, sums);
  finish(result.faded, sums);
  return result;
}

void writeInterpolationChart(const std::vector<LeftOutSteps>& compared, const std::string& folder)
{
  LogChart chart;
  chart.title = "Steps left out and interpolated: carried along the wind against faded";
  chart.subtitle = "each line leads from faded to carried clouds; down is structure in its place, "
                   "left is less error";
  chart.xLabel = "RMS error over the standard deviation of the true field";
  chart.yLabel = "1 - correlation of horizontal differences with the true ones";
  chart.xUnit = Unit::Error;
  for (const LeftOutSteps& c : compared)
  {
    const std::string detail = c.quantity + ", 1 of " + std::to_string(c.stride) + " steps kept";
    ChartCurve curve;
    curve.points = { { c.faded.error / c.spread, 1 - c.faded.pattern, c.name, detail, false },
      { c.carried.error / c.spread, 1 - c.carried.pattern, c.name, detail, true } };
    chart.curves.push_back(curve);
  }
  writeChartFiles(chart, folder, "interpolation");
}
}
}
