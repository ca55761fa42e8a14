// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudHeightFieldSource.h"

#include "CloudArrays.h"
#include "Cumulus.h"
#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkCloudHeightFieldSource);

namespace
{
/// The points of one surface over a grid.
class SurfacePoints
{
public:
  SurfacePoints(const nephoscope::HeightField& field, double plane, const int dimensions[2],
    const double bounds[4])
    : Field(field)
    , Plane(plane)
    , Across(dimensions[0])
    , Dx((bounds[1] - bounds[0]) / (dimensions[0] - 1))
    , Dy((bounds[3] - bounds[2]) / (dimensions[1] - 1))
    , X0(bounds[0])
    , Y0(bounds[2])
  {
  }

  void operator()(vtkIdType begin, vtkIdType end)
  {
    for (vtkIdType point = begin; point < end; ++point)
    {
      this->Make(point);
    }
  }

  float* Places[2] = { nullptr, nullptr };  ///< of tops, of bottoms
  float* Normals[2] = { nullptr, nullptr }; ///< the same
  unsigned char* Covered = nullptr;

private:
  void Make(vtkIdType point)
  {
    const vtkIdType row = point / this->Across;
    const double x = this->X0 + this->Dx * static_cast<double>(point % this->Across);
    const double y = this->Y0 + this->Dy * static_cast<double>(row);
    const nephoscope::HeightGradient f = this->Field.gradient(x, y);
    this->Covered[point] = f.value > 0 ? 1 : 0;
    const nephoscope::HeightGradient heights[2] = { this->Field.top(f), this->Field.bottom(f) };
    for (int side = 0; side < 2; ++side)
    {
      const nephoscope::HeightGradient& h = heights[side];
      float* const place = this->Places[side] + 3 * point;
      place[0] = static_cast<float>(x);
      place[1] = static_cast<float>(y);
      place[2] = static_cast<float>(this->Plane + (f.value > 0 ? h.value : 0));
      const double up = side == 0 ? 1 : -1;
      const double length = std::sqrt(1 + h.x * h.x + h.y * h.y);
      float* const normal = this->Normals[side] + 3 * point;
      normal[0] = static_cast<float>(-up * h.x / length);
      normal[1] = static_cast<float>(-up * h.y / length);
      normal[2] = static_cast<float>(up / length);
    }
  }

  const nephoscope::HeightField& Field;
  double Plane;
  vtkIdType Across;
  double Dx, Dy, X0, Y0;
};

/// Quadrangles over the grid cells that have cloud, tops counter-clockwise from above, bottoms from below.
vtkSmartPointer<vtkCellArray> cellsOf(const unsigned char* covered, const int dimensions[2])
{
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  const vtkIdType across = dimensions[0];
  const vtkIdType count = across * dimensions[1];
  for (int side = 0; side < 2; ++side)
  {
    for (vtkIdType j = 0; j + 1 < dimensions[1]; ++j)
    {
      for (vtkIdType i = 0; i + 1 < across; ++i)
      {
        const vtkIdType a = j * across + i;
        const vtkIdType ring[4] = { a, a + 1, a + 1 + across, a + across };
        if (std::any_of(ring, ring + 4, [covered](vtkIdType p) { return covered[p] != 0; }))
        {
          cells->InsertNextCell(4);
          for (int c = 0; c < 4; ++c)
          {
            cells->InsertCellPoint(side * count + ring[side == 0 ? c : 3 - c]);
          }
        }
      }
    }
  }
  return cells;
}

void makeSurfaces(vtkPolyData* output, const nephoscope::HeightField& field, double plane,
  const int dimensions[2], const double bounds[4])
{
  const vtkIdType count = static_cast<vtkIdType>(dimensions[0]) * dimensions[1];
  const vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  points->SetNumberOfPoints(2 * count);
  const vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(2 * count);
  std::vector<unsigned char> covered(static_cast<std::size_t>(count));
  SurfacePoints make(field, plane, dimensions, bounds);
  auto* const places = vtkFloatArray::SafeDownCast(points->GetData())->GetPointer(0);
  for (int side = 0; side < 2; ++side)
  {
    make.Places[side] = places + 3 * side * count;
    make.Normals[side] = normals->GetPointer(3 * side * count);
  }
  make.Covered = covered.data();
  vtkSMPTools::For(0, count, make);
  output->SetPoints(points);
  output->GetPointData()->SetNormals(normals);
  output->SetPolys(cellsOf(covered.data(), dimensions));
}
}

struct vtkCloudHeightFieldSource::Waves
{
  std::vector<nephoscope::HeightWave> List;
};

vtkCloudHeightFieldSource::vtkCloudHeightFieldSource()
  : Added(std::make_unique<Waves>())
{
  this->SetNumberOfInputPorts(0);
}

vtkCloudHeightFieldSource::~vtkCloudHeightFieldSource() = default;

void vtkCloudHeightFieldSource::AddWave(
  double amplitude, double p, double q, double phase, int shape)
{
  this->Added->List.push_back(
    { amplitude, p, q, phase, static_cast<nephoscope::WaveShape>(std::clamp(shape, 0, 2)) });
  this->Modified();
}

void vtkCloudHeightFieldSource::RemoveAllWaves()
{
  this->Added->List.clear();
  this->Modified();
}

bool vtkCloudHeightFieldSource::Validate()
{
  if (!(this->Wavelength > 0) || !(this->BaseDepth > 0) || !(this->Roundness >= 0) ||
    !std::isfinite(this->Wavelength + this->BaseDepth + this->Roundness + this->PlaneHeight))
  {
    vtkErrorMacro("Wavelength " << this->Wavelength << " and BaseDepth " << this->BaseDepth
                                << " have to be above 0, Roundness " << this->Roundness
                                << " not below, PlaneHeight " << this->PlaneHeight << " a number.");
    return false;
  }
  const int* const n = this->Dimensions;
  const bool isSurface = n[0] >= 2 && n[1] >= 2;
  if (isSurface &&
    (static_cast<double>(n[0]) * n[1] > (1 << 28) ||
      !(this->Bounds[0] < this->Bounds[1] && this->Bounds[2] < this->Bounds[3])))
  {
    vtkErrorMacro(
      "Dimensions " << n[0] << " x " << n[1]
                    << " are more than 2^28 points, or Bounds are not in ascending pairs.");
    return false;
  }
  return true;
}

int vtkCloudHeightFieldSource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  if (!this->Validate())
  {
    return 0;
  }
  nephoscope::Cumulus cumulus;
  cumulus.waves = this->NumberOfWaves;
  cumulus.billows = this->NumberOfBillows;
  cumulus.wavelength = this->Wavelength;
  cumulus.shortening = this->Shortening;
  cumulus.relief = this->Relief;
  cumulus.smoothness = this->Smoothness;
  cumulus.cover = this->Cover;
  cumulus.roundness = this->Roundness;
  cumulus.depth = this->BaseDepth;
  cumulus.seed = static_cast<std::uint32_t>(this->Seed);
  nephoscope::HeightFieldShape shape = nephoscope::cumulusShape(cumulus);
  if (!this->Added->List.empty())
  {
    shape.waves = this->Added->List;
    shape.polynomial[0] = 0;
  }
  for (int i = 0; i < 6; ++i)
  {
    shape.polynomial[i] += this->Polynomial[i];
  }
  const double vx = this->CycleVector[0];
  const double vy = this->CycleVector[1];
  shape =
    nephoscope::cycleFrame(nephoscope::repeating(shape, vx, vy), vx, vy, this->Frame, this->Frames);

  vtkPolyData* const output = vtkPolyData::GetData(outputs);
  const std::vector<double> numbers = nephoscope::numbersOf(shape, this->PlaneHeight);
  const vtkNew<vtkDoubleArray> array;
  array->SetName(nephoscope::arrays::HeightField);
  array->SetNumberOfValues(static_cast<vtkIdType>(numbers.size()));
  std::copy(numbers.begin(), numbers.end(), array->GetPointer(0));
  output->GetFieldData()->AddArray(array);
  if (this->Dimensions[0] >= 2 && this->Dimensions[1] >= 2)
  {
    makeSurfaces(
      output, nephoscope::HeightField(shape), this->PlaneHeight, this->Dimensions, this->Bounds);
  }
  return 1;
}

void vtkCloudHeightFieldSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto print = [&os, indent](const char* name, double value)
  { os << indent << name << ": " << value << '\n'; };
  print("PlaneHeight", this->PlaneHeight);
  print("Roundness", this->Roundness);
  print("BaseDepth", this->BaseDepth);
  print("Wavelength", this->Wavelength);
  print("Shortening", this->Shortening);
  print("Relief", this->Relief);
  print("Smoothness", this->Smoothness);
  print("Cover", this->Cover);
  print("NumberOfWaves", this->NumberOfWaves);
  print("NumberOfBillows", this->NumberOfBillows);
  print("Seed", this->Seed);
  print("Frame", this->Frame);
  print("Frames", this->Frames);
  os << indent << "AddedWaves: " << this->Added->List.size() << '\n';
  os << indent << "CycleVector: " << this->CycleVector[0] << ' ' << this->CycleVector[1] << '\n';
  os << indent << "Dimensions: " << this->Dimensions[0] << ' ' << this->Dimensions[1] << '\n';
  os << indent << "Bounds: " << this->Bounds[0] << ' ' << this->Bounds[1] << ' ' << this->Bounds[2]
     << ' ' << this->Bounds[3] << '\n';
}
