// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudCellVolume.h"

#include "Camera.h"
#include "CellColumns.h"
#include "CloudArrays.h"
#include "ColumnOrder.h"
#include "Optics.h"
#include "ScreenBins.h"
#include "StructuredColumns.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <array>
#include <cmath>
#include <string>

vtkStandardNewMacro(vtkCloudCellVolume);

namespace
{
std::string namesOfArrays(vtkDataSet* grid)
{
  std::string names;
  for (int a = 0; a < grid->GetPointData()->GetNumberOfArrays(); ++a)
  {
    const char* const name = grid->GetPointData()->GetArrayName(a);
    names += (names.empty() ? "" : ", ") + std::string(name ? name : "(unnamed)");
  }
  return names.empty() ? "none" : names;
}

}

/// The arrays of a rule, and the rule: extinction of a point per scene unit.
struct vtkCloudCellVolume::ExtinctionAtPoint
{
  vtkDataArray* Fraction = nullptr;
  vtkDataArray* Liquid = nullptr;
  vtkDataArray* Ice = nullptr;
  vtkDataArray* Pressure = nullptr;
  vtkDataArray* Temperature = nullptr;
  vtkDataArray* Height = nullptr;
  nephoscope::Particles Droplets;
  nephoscope::Particles Crystals;
  double FullCover = 0;
  double Scale = 1;
  float Least = 0;

  double AirDensity(vtkIdType point) const
  {
    if (this->Pressure && this->Temperature)
    {
      return nephoscope::airDensity(
        this->Pressure->GetComponent(point, 0), this->Temperature->GetComponent(point, 0));
    }
    return nephoscope::standardAirDensity(this->Height ? this->Height->GetComponent(point, 0) : 0);
  }

  float operator()(vtkIdType point) const
  {
    double sigma = 0;
    if (this->Fraction)
    {
      sigma = this->FullCover * this->Fraction->GetComponent(point, 0);
    }
    else
    {
      const double air = this->AirDensity(point);
      for (const auto& kind :
        { std::make_pair(this->Liquid, this->Droplets), std::make_pair(this->Ice, this->Crystals) })
      {
        sigma += kind.first ? nephoscope::condensateExtinctionPerMeter(
                                kind.first->GetComponent(point, 0), air, kind.second)
                            : 0;
      }
    }
    const float usable = nephoscope::usableExtinction(this->Scale * sigma);
    return usable < this->Least ? 0 : usable; // NaN stays
  }
};

struct vtkCloudCellVolume::Internals
{
  nephoscope::CellColumns Columns;
  std::vector<std::uint32_t> Drawn; ///< the columns with cells to draw
  ScreenBins Bins;
  ColumnOrder Order; ///< of the cells, if they are to have one
  bool ToldOfCycles = false;
  vtkMTimeType Read = 0;
  vtkMTimeType OrderRead = 0;
  vtkIdType DrawnCells = 0;
};

vtkCloudCellVolume::vtkCloudCellVolume()
  : Data(std::make_unique<Internals>())
{
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, nephoscope::arrays::CloudFraction);
  this->SetInputArrayToProcess(
    1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, nephoscope::arrays::SourceColor);
}

vtkCloudCellVolume::~vtkCloudCellVolume() = default;

int vtkCloudCellVolume::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  return 1;
}

vtkDataArray* vtkCloudCellVolume::FindArray(
  vtkDataSet* grid, vtkDataArray* array, const char* name, bool required)
{
  if (!array)
  {
    if (required)
    {
      vtkErrorMacro("The grid has no point array " << name << " (it has: " << namesOfArrays(grid)
                                                   << "); name another with "
                                                      "SetInputArrayToProcess or choose another "
                                                      "ExtinctionRule.");
    }
    return nullptr;
  }
  if (array->GetNumberOfTuples() != grid->GetNumberOfPoints() ||
    array->GetNumberOfComponents() != 1)
  {
    vtkErrorMacro("The array " << name << " has " << array->GetNumberOfTuples() << " tuples of "
                               << array->GetNumberOfComponents() << " for "
                               << grid->GetNumberOfPoints()
                               << " points; give one value for each point.");
    return nullptr;
  }
  return array;
}

bool vtkCloudCellVolume::SetUpExtinction(vtkDataSet* grid, ExtinctionAtPoint& extinction)
{
  using namespace nephoscope;
  extinction.FullCover = this->FullCoverExtinction;
  extinction.Droplets = { this->ExtinctionEfficiency, this->LiquidRadius, LiquidWaterDensity };
  extinction.Crystals = { this->ExtinctionEfficiency, this->IceRadius, IceDensity };
  extinction.Scale = this->ExtinctionScale;
  extinction.Least = static_cast<float>(this->LeastExtinction);
  if (vtkDataArray* const heightScale = grid->GetFieldData()->GetArray(arrays::HeightScale))
  {
    const double scale = heightScale->GetNumberOfValues() > 0 ? heightScale->GetComponent(0, 0) : 0;
    if (!(scale > 0 && std::isfinite(scale)))
    {
      vtkErrorMacro("The field data's " << arrays::HeightScale << " is " << scale
                                        << "; it has to be positive, scene units per metre.");
      return false;
    }
    extinction.Scale /= scale;
  }
  if (this->ExtinctionRule == vtkCloudCellVolume::CloudFraction)
  {
    vtkDataArray* const chosen = this->GetInputArrayToProcess(0, grid);
    extinction.Fraction = this->FindArray(grid, chosen, arrays::CloudFraction, true);
    return extinction.Fraction != nullptr;
  }
  vtkPointData* const points = grid->GetPointData();
  vtkDataArray** const found[] = { &extinction.Liquid, &extinction.Ice, &extinction.Pressure,
    &extinction.Temperature, &extinction.Height };
  const char* const names[] = { arrays::LiquidWater, arrays::IceWater, arrays::Pressure,
    arrays::Temperature, arrays::Height };
  for (int a = 0; a < 5; ++a)
  {
    vtkDataArray* const array = points->GetArray(names[a]);
    const bool required = a == 1 && !extinction.Liquid;
    *found[a] = this->FindArray(grid, array, names[a], required);
    if (!*found[a] && (array || required))
    {
      return false;
    }
  }
  return true;
}

std::vector<vtkIdType> vtkCloudCellVolume::CountPoints(const std::vector<double>& least)
{
  if (this->GetNumberOfInputConnections(0) > 0)
  {
    this->GetInputAlgorithm(0, 0)->Update();
  }
  auto* const grid = vtkDataSet::SafeDownCast(this->GetInputDataObject(0, 0));
  ExtinctionAtPoint extinction;
  if (!grid || !this->SetUpExtinction(grid, extinction))
  {
    return {};
  }
  extinction.Least = 0;
  std::vector<vtkIdType> counts(least.size(), 0);
  for (vtkIdType point = 0; point < grid->GetNumberOfPoints(); ++point)
  {
    const float sigma = extinction(point);
    for (std::size_t i = 0; i < least.size() && sigma > 0 && sigma >= least[i]; ++i)
    {
      ++counts[i];
    }
  }
  return counts;
}

bool vtkCloudCellVolume::ReadGrid()
{
  auto* const grid = vtkDataSet::SafeDownCast(this->GetInputDataObject(0, 0));
  int extent[6];
  if (!grid || !extentOf(grid, extent))
  {
    vtkErrorMacro("The input is " << (grid ? grid->GetClassName() : "no data set")
                                  << "; give a vtkStructuredGrid, vtkRectilinearGrid or "
                                     "vtkImageData.");
    return false;
  }
  const std::array<int, 3> size = pointsIn(extent);
  if (size[0] < 2 || size[1] < 2 || size[2] < 2)
  {
    vtkErrorMacro("The grid of " << size[0] << " x " << size[1] << " x " << size[2]
                                 << " points has no cells; give two at least along each axis.");
    return false;
  }
  const vtkIdType places = static_cast<vtkIdType>(size[0]) * size[1] * size[2];
  if (grid->GetNumberOfPoints() != places)
  {
    vtkErrorMacro("The grid of " << size[0] << " x " << size[1] << " x " << size[2] << " has "
                                 << grid->GetNumberOfPoints()
                                 << " points; give one for each place.");
    return false;
  }
  ExtinctionAtPoint extinction;
  if (!this->SetUpExtinction(grid, extinction))
  {
    return false;
  }
  fillColumns(this->Data->Columns, grid, extent, extinction);
  return this->ReadColors(grid);
}

/// The colours of the points, if they have any, times that of the body; what is negative or not a number is black.
bool vtkCloudCellVolume::ReadColors(vtkDataSet* grid)
{
  nephoscope::CellColumns& columns = this->Data->Columns;
  columns.color.clear();
  vtkDataArray* const array = this->GetInputArrayToProcess(1, grid);
  if (!array)
  {
    return true;
  }
  if (array->GetNumberOfTuples() != grid->GetNumberOfPoints() ||
    array->GetNumberOfComponents() != 3)
  {
    vtkErrorMacro("The array " << nephoscope::arrays::SourceColor << " has "
                               << array->GetNumberOfTuples() << " tuples of "
                               << array->GetNumberOfComponents() << " for "
                               << grid->GetNumberOfPoints()
                               << " points; give red, green and blue for each point.");
    return false;
  }
  columns.color.resize(columns.points.size());
  const vtkIdType lines = static_cast<vtkIdType>(columns.nx) * columns.ny;
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    nephoscope::RGB& color = columns.color[p % lines * columns.nz + p / lines];
    for (int c = 0; c < 3; ++c)
    {
      const double value = this->Color[c] * array->GetComponent(p, c);
      color[c] = value > 0 && std::isfinite(value) ? static_cast<float>(value) : 0;
    }
  }
  return true;
}

bool vtkCloudCellVolume::PutInOrder(const nephoscope::Camera& camera)
{
  Internals& data = *this->Data;
  const auto by =
    this->Order == Visibility ? ColumnOrder::By::Visibility : ColumnOrder::By::Centroid;
  if (data.OrderRead < data.Read)
  {
    data.Order.Read(data.Columns, data.Drawn);
    data.ToldOfCycles = false;
    data.OrderRead = data.Read;
  }
  if (!data.Order.Build(by, data.Bins, camera))
  {
    vtkErrorMacro("There are more than 4,294,967,295 tetrahedra in view, too many for the order "
      << this->GetOrderAsString() << "; call SetOrderToPixelDepth.");
    return false;
  }
  if (data.Order.GetNumberOfCycles() > 0 && !data.ToldOfCycles)
  {
    vtkWarningMacro("No order of the cells is right: "
      << data.Order.GetNumberOfCycles() << " cycles of " << data.Order.GetNumberOfCellsInCycles()
      << " tetrahedra, each before the next. Within each they are drawn by their centroids, each "
         "once; call SetOrderToPixelDepth for the exact picture.");
    data.ToldOfCycles = true;
  }
  return true;
}

bool vtkCloudCellVolume::Prepare(const nephoscope::Camera& camera)
{
  if (!this->IsFlat(camera))
  {
    return false;
  }
  Internals& data = *this->Data;
  const vtkMTimeType newest = this->GetInputsMTime();
  if (data.Read < newest)
  {
    data.Drawn.clear();
    if (!this->ReadGrid())
    {
      return false;
    }
    for (std::size_t column = 0; column < data.Columns.numberOfColumns(); ++column)
    {
      if (data.Columns.first[column] < data.Columns.last[column])
      {
        data.Drawn.push_back(static_cast<std::uint32_t>(column));
      }
    }
    data.Read = newest;
  }
  const nephoscope::RaySpace space(camera);
  data.Bins.Build(data.Drawn.size(), camera.width(), camera.height(),
    [&data, &space, &camera]() -> ScreenBins::BoxOf
    {
      const auto rays = std::make_shared<nephoscope::ColumnRays>(
        data.Columns, space, camera.width(), camera.height());
      return [rays, &data](std::size_t thing)
      {
        rays->look(data.Drawn[thing]);
        return rays->box();
      };
    });
  data.DrawnCells = 0;
  for (std::size_t thing = 0; thing < data.Drawn.size(); ++thing)
  {
    data.DrawnCells +=
      data.Bins.GetBox(thing).empty() ? 0 : data.Columns.numberOfDrawnCells(data.Drawn[thing]);
  }
  return this->Order == PixelDepth || this->PutInOrder(camera);
}

void vtkCloudCellVolume::Emit(const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const
{
  const Internals& data = *this->Data;
  const nephoscope::RGB color = { static_cast<float>(this->Color[0]),
    static_cast<float>(this->Color[1]), static_cast<float>(this->Color[2]) };
  if (this->Order != PixelDepth)
  {
    data.Order.Emit(data.Bins, camera, color, tile);
    return;
  }
  const nephoscope::RaySpace space(camera);
  const nephoscope::TileRays rays(space, tile);
  const std::uint32_t source = tile.addSource(color);
  if (data.Columns.color.empty())
  {
    tile.startSum(source);
  }
  nephoscope::ColumnRays column(data.Columns, space, camera.width(), camera.height());
  data.Bins.ForEach(tile.extent(), rays.limit(),
    [&data, &tile, &rays, source, &column](std::uint32_t thing)
    {
      column.look(data.Drawn[thing]);
      column.emit(tile, rays, source);
    });
}

vtkIdType vtkCloudCellVolume::GetNumberOfDrawnCells() const
{
  return this->Data->DrawnCells;
}

vtkIdType vtkCloudCellVolume::GetNumberOfCycles() const
{
  return this->Order == Visibility ? static_cast<vtkIdType>(this->Data->Order.GetNumberOfCycles())
                                   : 0;
}

const char* vtkCloudCellVolume::GetOrderAsString() const
{
  constexpr const char* Names[] = { "PixelDepth", "Visibility", "Centroid" };
  return Names[this->Order];
}

void vtkCloudCellVolume::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent
     << "ExtinctionRule: " << (this->ExtinctionRule == Condensate ? "Condensate" : "CloudFraction")
     << '\n';
  os << indent << "FullCoverExtinction: " << this->FullCoverExtinction << " 1/m\n";
  os << indent << "ExtinctionScale: " << this->ExtinctionScale << '\n';
  os << indent << "LeastExtinction: " << this->LeastExtinction << '\n';
  os << indent << "ExtinctionEfficiency: " << this->ExtinctionEfficiency << '\n';
  os << indent << "LiquidRadius: " << this->LiquidRadius << " m\n";
  os << indent << "IceRadius: " << this->IceRadius << " m\n";
  os << indent << "Color: " << this->Color[0] << ' ' << this->Color[1] << ' ' << this->Color[2]
     << '\n';
  os << indent << "Order: " << this->GetOrderAsString() << '\n';
}
