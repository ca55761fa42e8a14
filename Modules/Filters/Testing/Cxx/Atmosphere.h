// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Atmosphere.h
 * @brief A test's model output: a grid with levels in a plane or round a globe, whose wind, heights and cloud are functions.
 *
 * On the globe column i of n lies at longitude 2 pi i / (n - 1), so that the last is the first again, and row j of n at
 * latitude -pi/2 + pi (j + 1/2) / n. In the plane columns and rows are Spacing apart.
 */
#ifndef Atmosphere_h
#define Atmosphere_h

#include "CloudArrays.h"

#include "vtkDataSetAttributes.h"
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
#include "vtkUnsignedCharArray.h"

#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <vector>

class Atmosphere : public vtkStructuredGridAlgorithm
{
public:
  static Atmosphere* New() { VTK_STANDARD_NEW_BODY(Atmosphere); }
  vtkTypeMacro(Atmosphere, vtkStructuredGridAlgorithm);

  static constexpr double Radius = 6371229; ///< m
  static constexpr double Hour = 3600;      ///< s

  bool Globe = true;
  int Size[3] = { 33, 16, 3 };
  double Spacing = 1e4; ///< m, in the plane
  double HeightScale = 1;
  bool HasWind = true;
  bool Shrinks = false;    ///< has a column less after time 0
  double FailsFrom = 1e30; ///< s, as a file that ends too early
  std::vector<double> Times{ 0, 6 * Hour, 12 * Hour, 18 * Hour };
  std::function<void(const double position[3], double time, double wind[3])> Wind =
    [](const double*, double, double wind[3]) { wind[0] = wind[1] = wind[2] = 0; };
  std::function<double(int level, double time)> Height = [](int level, double)
  { return 1000.0 * (level + 1); };
  /// Cloud fraction, NaN where a point is hidden; without a function there is no such array.
  std::function<double(int i, int j, int level, double hours)> Cloud;
  std::multiset<double> Asked; ///< the times that were requested

  /// The wind of a turn round the axis in 12 days.
  static void rotation(const double p[3], double, double wind[3])
  {
    const double omega = 2 * Pi / (12 * 24 * Hour);
    wind[0] = -omega * p[1];
    wind[1] = omega * p[0];
    wind[2] = 0;
  }

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
    if (time >= this->FailsFrom)
    {
      vtkErrorMacro("The file ends before " << time << " s.");
      return 0;
    }
    vtkStructuredGrid* const grid = vtkStructuredGrid::GetData(outputs);
    const int columns = this->Size[0] - (this->Shrinks && time > 0 ? 1 : 0);
    grid->SetDimensions(columns, this->Size[1], this->Size[2]);
    this->addAir(grid, time);
    if (this->Cloud)
    {
      this->addCloud(grid, time);
    }
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

private:
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  static constexpr double Pi = 3.14159265358979323846;

  void place(int i, int j, double height, double p[3]) const
  {
    p[0] = this->Spacing * i;
    p[1] = this->Spacing * j;
    p[2] = this->HeightScale * height;
    if (this->Globe)
    {
      const double longitude = 2 * Pi * i / (this->Size[0] - 1);
      const double latitude = -Pi / 2 + Pi * (j + 0.5) / this->Size[1];
      const double r = Radius + this->HeightScale * height;
      p[0] = r * std::cos(latitude) * std::cos(longitude);
      p[1] = r * std::cos(latitude) * std::sin(longitude);
      p[2] = r * std::sin(latitude);
    }
  }

  /// f(i, j, k) in the order of the points.
  template <class F>
  static void forEachPoint(vtkStructuredGrid* grid, F&& f)
  {
    int n[3];
    grid->GetDimensions(n);
    for (int k = 0; k < n[2]; ++k)
    {
      for (int j = 0; j < n[1]; ++j)
      {
        for (int i = 0; i < n[0]; ++i)
        {
          f(i, j, k);
        }
      }
    }
  }

  void addAir(vtkStructuredGrid* grid, double time) const
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkFloatArray> wind;
    wind->SetName(nephoscope::arrays::Wind);
    wind->SetNumberOfComponents(3);
    vtkNew<vtkFloatArray> height;
    height->SetName(nephoscope::arrays::Height);
    forEachPoint(grid,
      [&](int i, int j, int k)
      {
        const double z = this->Height(k, time);
        double p[3];
        this->place(i, j, z, p);
        double v[3];
        this->Wind(p, time, v);
        points->InsertNextPoint(p);
        wind->InsertNextTuple(v);
        height->InsertNextValue(static_cast<float>(z));
      });
    grid->SetPoints(points);
    grid->GetPointData()->AddArray(height);
    if (this->HasWind)
    {
      grid->GetPointData()->AddArray(wind);
    }
  }

  void addCloud(vtkStructuredGrid* grid, double time) const
  {
    vtkNew<vtkFloatArray> cloud;
    cloud->SetName(nephoscope::arrays::CloudFraction);
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
    forEachPoint(grid,
      [&](int i, int j, int k)
      {
        const double value = this->Cloud(i, j, k, time / Hour);
        cloud->InsertNextValue(static_cast<float>(value));
        ghosts->InsertNextValue(std::isnan(value) ? vtkDataSetAttributes::HIDDENPOINT : 0);
      });
    grid->GetPointData()->SetScalars(cloud);
    grid->GetPointData()->AddArray(ghosts);
  }
};

/// The numbers of a filter's point array, one after the other; none if it is not there.
inline std::vector<double> pointValues(vtkStructuredGridAlgorithm* filter, const char* name)
{
  vtkDataArray* const array = filter->GetOutput()->GetPointData()->GetArray(name);
  std::vector<double> all;
  for (vtkIdType t = 0; array && t < array->GetNumberOfTuples(); ++t)
  {
    for (int c = 0; c < array->GetNumberOfComponents(); ++c)
    {
      all.push_back(array->GetComponent(t, c));
    }
  }
  return all;
}
#endif
