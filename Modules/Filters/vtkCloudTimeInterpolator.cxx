// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudTimeInterpolator.h"

#include "AirSnapshot.h"
#include "CarriedField.h"
#include "CloudArrays.h"
#include "InputPipeline.h"
#include "PieceOfWhole.h"

#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

vtkStandardNewMacro(vtkCloudTimeInterpolator);

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;
using nephoscope::GridError;

const char* const Carried[] = { nephoscope::arrays::CloudFraction, nephoscope::arrays::LiquidWater,
  nephoscope::arrays::IceWater };

/// The wind of an interval, and how it is followed.
struct Motion
{
  nephoscope::AirGrid Air;
  nephoscope::AirSnapshot Ends[2];
  std::unique_ptr<nephoscope::AirInterval> Wind;
  nephoscope::RowSchemes Schemes;

  Motion(vtkStructuredGrid* begin, vtkStructuredGrid* end, const double times[2], double tolerance)
    : Air(nephoscope::airGridOf(begin))
  {
    this->Ends[0] = nephoscope::airSnapshotOf(this->Air, begin, times[0]);
    this->Ends[1] = nephoscope::airSnapshotOf(this->Air, end, times[1]);
    this->Wind = std::make_unique<nephoscope::AirInterval>(this->Air, this->Ends[0], this->Ends[1]);
    this->Schemes = this->Wind->schemes(
      nephoscope::Integrator::RungeKutta2, nephoscope::Interpolation::Linear, tolerance);
  }
};

bool isReal(vtkDataArray* array)
{
  return array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
}

std::vector<float> floatsOf(vtkDataArray* array)
{
  std::vector<float> values(static_cast<std::size_t>(array->GetNumberOfTuples()));
  vtkSMPTools::For(0, array->GetNumberOfTuples(),
    [array, &values](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType n = begin; n < end; ++n)
      {
        values[n] = static_cast<float>(array->GetComponent(n, 0));
      }
    });
  return values;
}

/// Each value linear in time; where one is not finite, that of the nearer time.
vtkSmartPointer<vtkDataArray> faded(vtkDataArray* begin, vtkDataArray* end, double at)
{
  auto result = vtk::TakeSmartPointer(begin->NewInstance());
  result->SetName(begin->GetName());
  const int components = begin->GetNumberOfComponents();
  result->SetNumberOfComponents(components);
  result->SetNumberOfTuples(begin->GetNumberOfTuples());
  vtkSMPTools::For(0, begin->GetNumberOfTuples(),
    [&result, begin, end, components, at](vtkIdType first, vtkIdType last)
    {
      for (vtkIdType n = first; n < last; ++n)
      {
        for (int c = 0; c < components; ++c)
        {
          const double a = begin->GetComponent(n, c);
          const double b = end->GetComponent(n, c);
          const double between = a + at * (b - a);
          result->SetComponent(n, c, std::isfinite(between) ? between : at > 0.5 ? b : a);
        }
      }
    });
  return result;
}

/// A cloud array carried along the wind. Where the wind brings no value, the point's own of the nearer time.
vtkSmartPointer<vtkDataArray> carried(vtkDataArray* begin, vtkDataArray* end, double at,
  const Motion& motion, nephoscope::Interpolation interpolation)
{
  const std::vector<float> values[2] = { floatsOf(begin), floatsOf(end) };
  const float* const fields[2] = { values[0].data(), values[1].data() };
  const auto result = vtkSmartPointer<vtkFloatArray>::New();
  result->SetName(begin->GetName());
  result->SetNumberOfTuples(begin->GetNumberOfTuples());
  float* const out = result->GetPointer(0);
  const nephoscope::WindPair& wind = motion.Wind->motion().wind;
  const int nx = wind.grid->columns();
  const int ny = wind.grid->rows();
  // The column that closes a circle is the first one again.
  const int period = wind.grid->isPeriodic() ? wind.grid->period() : nx;
  vtkSMPTools::For(0, static_cast<vtkIdType>(motion.Air.points()),
    [&](vtkIdType first, vtkIdType last)
    {
      for (vtkIdType p = first; p < last; ++p)
      {
        const int i = static_cast<int>(p % nx) % period;
        const int j = static_cast<int>(p / nx % ny);
        const int k = static_cast<int>(p / nx / ny);
        const double value = nephoscope::carriedValue(fields, motion.Air.points() / wind.levels,
          nephoscope::carriedStencils(wind, motion.Schemes.at(j, k), interpolation, i, j, k, at),
          at);
        out[p] = std::isfinite(value) ? static_cast<float>(value) : fields[at > 0.5 ? 1 : 0][p];
      }
    });
  return result;
}
}

/// What is known of the two times about the request. Refilled as needed; it never changes a result.
struct vtkCloudTimeInterpolator::Interval
{
  std::vector<double> Times;
  double Target = 0;
  int Before = 0; // step at or before the target
  int After = 0;  // the one at or after it
  std::map<int, vtkSmartPointer<vtkStructuredGrid>> Grids;
  std::unique_ptr<Motion> Air;
  int AirOf = -1;

  void aim(double target)
  {
    this->Target = target;
    const auto above = std::upper_bound(this->Times.begin(), this->Times.end(), target);
    this->Before = std::max(static_cast<int>(above - this->Times.begin()) - 1, 0);
    this->After = this->Times[this->Before] < target ? this->Before + 1 : this->Before;
    for (auto grid = this->Grids.begin(); grid != this->Grids.end();)
    {
      const bool used = grid->first == this->Before || grid->first == this->After;
      grid = used ? std::next(grid) : this->Grids.erase(grid);
    }
  }

  /// The first step that has to be asked for, or -1.
  int missing() const
  {
    for (const int step : { this->Before, this->After })
    {
      if (this->Grids.count(step) == 0)
      {
        return step;
      }
    }
    return -1;
  }

  void take(vtkStructuredGrid* grid)
  {
    const auto copy = vtkSmartPointer<vtkStructuredGrid>::New();
    copy->ShallowCopy(grid);
    this->Grids[this->missing()] = copy;
  }

  const Motion& motion(double tolerance)
  {
    if (this->AirOf != this->Before)
    {
      this->AirOf = -1;
      const double ends[2] = { this->Times[this->Before], this->Times[this->After] };
      this->Air = std::make_unique<Motion>(
        this->Grids.at(this->Before), this->Grids.at(this->After), ends, tolerance);
      this->AirOf = this->Before;
    }
    return *this->Air;
  }

  double fraction() const
  {
    const double begin = this->Times[this->Before];
    return (this->Target - begin) / (this->Times[this->After] - begin);
  }
};

vtkCloudTimeInterpolator::vtkCloudTimeInterpolator() = default;
vtkCloudTimeInterpolator::~vtkCloudTimeInterpolator() = default;

vtkExecutive* vtkCloudTimeInterpolator::CreateDefaultExecutive()
{
  return nephoscope::InputPipeline::New();
}

int vtkCloudTimeInterpolator::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  // Called whenever this or the input has changed: nothing from before holds.
  this->Between = std::make_unique<Interval>();
  vtkInformation* const in = inputs[0]->GetInformationObject(0);
  if (in->Has(Pipeline::TIME_STEPS()))
  {
    const double* const steps = in->Get(Pipeline::TIME_STEPS());
    this->Between->Times.assign(steps, steps + in->Length(Pipeline::TIME_STEPS()));
  }
  const std::vector<double>& times = this->Between->Times;
  for (std::size_t n = 1; n < times.size(); ++n)
  {
    if (!(times[n] > times[n - 1]))
    {
      vtkErrorMacro("Time step " << n
                                 << " is not later than the one before: there is nothing "
                                    "between them. Give a file whose times rise.");
      return 0;
    }
  }
  return 1;
}

int vtkCloudTimeInterpolator::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkInformation* const in = inputs[0]->GetInformationObject(0);
  nephoscope::askForWhole(in);
  const std::vector<double>& times = this->Between->Times;
  if (times.empty())
  {
    return 1;
  }
  vtkInformation* const out = outputs->GetInformationObject(0);
  const double target =
    out->Has(Pipeline::UPDATE_TIME_STEP()) ? out->Get(Pipeline::UPDATE_TIME_STEP()) : times.front();
  if (!(target >= times.front() && target <= times.back()))
  {
    vtkErrorMacro("Time " << target << " s is not within the input's, " << times.front() << " to "
                          << times.back() << " s.");
    return 0;
  }
  this->Between->aim(target);
  const int step = std::max(this->Between->missing(), this->Between->Before);
  in->Set(Pipeline::UPDATE_TIME_STEP(), times[step]);
  return 1;
}

int vtkCloudTimeInterpolator::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkStructuredGrid* const input = vtkStructuredGrid::GetData(inputs[0]);
  vtkStructuredGrid* const output = vtkStructuredGrid::GetData(outputs);
  Interval& between = *this->Between;
  const std::string wrong = nephoscope::whatInputLacks(this);
  if (!wrong.empty())
  {
    request->Remove(Pipeline::CONTINUE_EXECUTING());
    vtkErrorMacro(<< wrong);
    return 0;
  }
  if (between.Times.empty())
  {
    output->ShallowCopy(input);
    nephoscope::cutPiece(output, outputs->GetInformationObject(0));
    return 1;
  }
  if (between.missing() >= 0)
  {
    between.take(input);
    if (between.missing() >= 0)
    {
      request->Set(Pipeline::CONTINUE_EXECUTING(), 1);
      return 1;
    }
  }
  request->Remove(Pipeline::CONTINUE_EXECUTING());
  try
  {
    this->Interpolate(output);
    nephoscope::cutPiece(output, outputs->GetInformationObject(0));
  }
  catch (const GridError& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

void vtkCloudTimeInterpolator::Interpolate(vtkStructuredGrid* output)
{
  Interval& between = *this->Between;
  vtkStructuredGrid* const begin = between.Grids.at(between.Before);
  vtkStructuredGrid* const end = between.Grids.at(between.After);
  if (between.Before == between.After)
  {
    output->ShallowCopy(begin);
    return;
  }
  if (begin->GetNumberOfPoints() != end->GetNumberOfPoints())
  {
    throw GridError("the grid has " + std::to_string(begin->GetNumberOfPoints()) +
      " points at one time and " + std::to_string(end->GetNumberOfPoints()) +
      " at the next: nothing lies between them.");
  }
  const double at = between.fraction();
  output->ShallowCopy(at > 0.5 ? end : begin);
  output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), between.Target);
  vtkNew<vtkPoints> points;
  points->SetDataType(begin->GetPoints()->GetDataType());
  points->SetData(faded(begin->GetPoints()->GetData(), end->GetPoints()->GetData(), at));
  output->SetPoints(points);
  const auto interpolation = this->Interpolation == Cubic ? nephoscope::Interpolation::Cubic
                                                          : nephoscope::Interpolation::Linear;
  const int arrays = begin->GetPointData()->GetNumberOfArrays();
  for (int n = 0; n < arrays && !this->GetAbortExecute(); ++n)
  {
    vtkDataArray* const from = begin->GetPointData()->GetArray(n);
    vtkDataArray* const to =
      from && from->GetName() ? end->GetPointData()->GetArray(from->GetName()) : nullptr;
    if (!to || !isReal(from) || !isReal(to) ||
      from->GetNumberOfComponents() != to->GetNumberOfComponents())
    {
      continue;
    }
    const bool cloud = from->GetNumberOfComponents() == 1 &&
      std::any_of(std::begin(Carried), std::end(Carried),
        [from](const char* name) { return std::string(name) == from->GetName(); });
    // Replaces the array of that name and keeps its role, such as that of the scalars.
    output->GetPointData()->AddArray(this->CarryClouds && cloud
        ? carried(from, to, at, between.motion(this->Tolerance), interpolation)
        : faded(from, to, at));
    this->UpdateProgress(static_cast<double>(n + 1) / arrays);
  }
}

void vtkCloudTimeInterpolator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "CarryClouds: " << (this->CarryClouds ? "on" : "off") << '\n';
  os << indent << "Interpolation: " << (this->Interpolation == Cubic ? "Cubic" : "Linear") << '\n';
  os << indent << "Tolerance: " << this->Tolerance << " m\n";
}
