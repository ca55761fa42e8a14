// SPDX-License-Identifier: BSD-3-Clause
#include "WindSource.h"

#include "CloudArrays.h"
#include "ColumnBlocks.h"

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

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(WindSource);

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;
constexpr double Degree = 3.14159265358979323846 / 180;
constexpr double Radius = 6371229;

vtkSmartPointer<vtkFloatArray> arrayOf(const char* name, int components)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  return array;
}
}

int WindSource::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkInformation* const out = outputs->GetInformationObject(0);
  const int whole[6] = { 0, this->Columns - 1, 0, this->Rows - 1, 0, this->Levels - 1 };
  out->Set(Pipeline::WHOLE_EXTENT(), whole, 6);
  if (!this->Times.empty())
  {
    out->Set(Pipeline::TIME_STEPS(), this->Times.data(), static_cast<int>(this->Times.size()));
    const double range[2] = { this->Times.front(), this->Times.back() };
    out->Set(Pipeline::TIME_RANGE(), range, 2);
  }
  if (this->GivesPieces)
  {
    out->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  }
  return 1;
}

/// The point and its values. Columns beyond the ends of a ring are those of the other end.
void WindSource::AddPoint(int i, int j, int k, double time, vtkStructuredGrid* grid) const
{
  const bool globe = this->Geometry == "Globe";
  const int ring = this->Columns - 1;
  const int column = nephoscope::ringColumn({ 0, ring, 0, 0, 0, 0 }, i, 0);
  const double x = this->FirstLongitude + this->Spacing * column;
  const double y = this->FirstLatitude + this->RowSpacing * j;
  // The same at both ends of a ring, whose last column stands where the first does.
  const double scale = this->Geometry == "Local" ? 0.1 * Degree : Degree;
  const double phase = scale * (globe && column == ring ? this->FirstLongitude : x);
  const double days = time / 86400;
  const double height =
    500.0 + 900 * k + 300 * std::sin(3 * phase + days) * std::cos(2 * scale * y) + 40 * days;
  const double rough = (j / 2 + k / 2) % 2 == 0 ? this->Roughness : -this->Roughness;
  const double east =
    this->Speed * (std::cos(scale * y) + 0.3 * std::sin(2 * phase + 3 * days)) + rough;
  const double north = 0.4 * this->Speed * std::cos(3 * phase - days + k);
  const double up = 0.03 * std::sin(phase + k + days);
  double place[3] = { x, y, height };
  double wind[3] = { east, north, up };
  if (this->Geometry == "Local")
  {
    place[0] *= 1000;
    place[1] *= 1000;
  }
  if (globe)
  {
    const double a = Degree * x;
    const double b = Degree * y;
    const double outward[3] = { std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b) };
    const double toEast[3] = { -std::sin(a), std::cos(a), 0 };
    const double toNorth[3] = { -std::sin(b) * std::cos(a), -std::sin(b) * std::sin(a),
      std::cos(b) };
    for (int c = 0; c < 3; ++c)
    {
      place[c] = (Radius + height) * outward[c];
      wind[c] = east * toEast[c] + north * toNorth[c] + up * outward[c];
    }
  }
  grid->GetPoints()->InsertNextPoint(place);
  vtkPointData* const data = grid->GetPointData();
  data->GetArray(nephoscope::arrays::Height)->InsertNextTuple1(height);
  data->GetArray(nephoscope::arrays::Wind)->InsertNextTuple(wind);
}

/// Of the piece that is asked for, or all; false if there is nothing in it.
bool WindSource::FindExtent(vtkInformation* out, int extent[6]) const
{
  const nephoscope::PointExtent whole{ 0, this->Columns - 1, 0, this->Rows - 1, 0,
    this->Levels - 1 };
  nephoscope::PointExtent found = whole;
  const int pieces = this->GivesPieces ? out->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()) : 1;
  if (pieces > 1)
  {
    nephoscope::PointExtent block;
    if (!nephoscope::columnBlock(whole, out->Get(Pipeline::UPDATE_PIECE_NUMBER()), pieces, block))
    {
      return false;
    }
    found = nephoscope::withGhosts(
      whole, block, out->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS()), this->Geometry == "Globe");
  }
  std::copy(found.begin(), found.end(), extent);
  return true;
}

void WindSource::AddPoints(double time, vtkStructuredGrid* grid) const
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  grid->SetPoints(points);
  grid->GetPointData()->AddArray(arrayOf(nephoscope::arrays::Height, 1));
  grid->GetPointData()->AddArray(arrayOf(nephoscope::arrays::Wind, 3));
  int extent[6];
  grid->GetExtent(extent);
  for (int k = extent[4]; k <= extent[5]; ++k)
  {
    for (int j = extent[2]; j <= extent[3]; ++j)
    {
      for (int i = extent[0]; i <= extent[1]; ++i)
      {
        this->AddPoint(i, j, k, time, grid);
      }
    }
  }
}

int WindSource::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkInformation* const out = outputs->GetInformationObject(0);
  vtkStructuredGrid* const grid = vtkStructuredGrid::GetData(outputs);
  const double time =
    out->Has(Pipeline::UPDATE_TIME_STEP()) ? out->Get(Pipeline::UPDATE_TIME_STEP()) : 0;
  if (time >= this->FailsFrom)
  {
    vtkErrorMacro("Nothing can be read at " << time << " s.");
    return 0;
  }
  int extent[6];
  if (!this->FindExtent(out, extent))
  {
    grid->Initialize();
    return 1;
  }
  grid->SetExtent(extent);
  this->AddPoints(time, grid);
  if (time >= this->WithoutWindFrom)
  {
    grid->GetPointData()->RemoveArray(nephoscope::arrays::Wind);
  }
  vtkNew<vtkStringArray> geometry;
  geometry->SetName(nephoscope::arrays::Geometry);
  geometry->InsertNextValue(this->Geometry);
  grid->GetFieldData()->AddArray(geometry);
  this->LargestPiece = std::max(this->LargestPiece, grid->GetNumberOfPoints());
  return 1;
}
