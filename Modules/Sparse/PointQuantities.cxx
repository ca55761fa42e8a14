// SPDX-License-Identifier: BSD-3-Clause
#include "PointQuantities.h"

#include "CloudArrays.h"
#include "NumberText.h"
#include "Optics.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkStructuredGrid.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
/// Point arrays of a grid by name, checked.
class PointArrays
{
public:
  explicit PointArrays(vtkStructuredGrid* grid)
    : Grid(grid)
  {
  }

  vtkDataArray* find(const char* name, int components = 1) const
  {
    vtkDataArray* const array = this->Grid->GetPointData()->GetArray(name);
    if (array &&
      (array->GetNumberOfComponents() != components ||
        array->GetNumberOfTuples() != this->Grid->GetNumberOfPoints()))
    {
      throw VDBError("The array " + std::string(name) + " has " +
        std::to_string(array->GetNumberOfTuples()) + " tuples of " +
        std::to_string(array->GetNumberOfComponents()) + " for " +
        std::to_string(this->Grid->GetNumberOfPoints()) + " points; give one of " +
        std::to_string(components) + " for each point");
    }
    return array;
  }

  double airDensity(vtkIdType point) const
  {
    return this->Pressure && this->Temperature
      ? nephoscope::airDensity(
          this->Pressure->GetComponent(point, 0), this->Temperature->GetComponent(point, 0))
      : standardAirDensity(this->Height ? this->Height->GetComponent(point, 0) : 0);
  }

private:
  vtkStructuredGrid* Grid;
  vtkDataArray* Pressure = this->find(arrays::Pressure);
  vtkDataArray* Temperature = this->find(arrays::Temperature);
  vtkDataArray* Height = this->find(arrays::Height);
};

double heightScaleOf(vtkDataSet* grid)
{
  vtkDataArray* const array = grid->GetFieldData()->GetArray(arrays::HeightScale);
  const double scale = array && array->GetNumberOfValues() > 0 ? array->GetComponent(0, 0) : 1;
  if (!(scale > 0 && std::isfinite(scale)))
  {
    throw VDBError(std::string("The field data's ") + arrays::HeightScale + " is " +
      numberText(scale) + "; it has to be positive, scene units per metre");
  }
  return scale;
}

/// Calls rule(point) for each point and keeps what is usable.
template <class Rule>
Quantity scalarOf(const char* name, const char* units, vtkIdType points, Rule&& rule)
{
  Quantity made{ name, units, 1, std::vector<float>(static_cast<std::size_t>(points)) };
  for (vtkIdType p = 0; p < points; ++p)
  {
    made.values[static_cast<std::size_t>(p)] = usableExtinction(rule(p));
  }
  return made;
}

Quantity densityOf(vtkStructuredGrid* grid, const PointArrays& found, const VoxelOrder& order)
{
  const double perUnit = 1 / heightScaleOf(grid);
  const vtkIdType points = grid->GetNumberOfPoints();
  const char* const units = perUnit == 1 ? "1/m" : "1/(scene unit), heights being exaggerated";
  vtkDataArray* const extinction = found.find(arrays::Extinction);
  vtkDataArray* const liquid = found.find(arrays::LiquidWater);
  vtkDataArray* const ice = found.find(arrays::IceWater);
  vtkDataArray* const fraction = found.find(arrays::CloudFraction);
  if (extinction)
  {
    return scalarOf("density", units, points,
      [=](vtkIdType p) { return perUnit * extinction->GetComponent(p, 0); });
  }
  if (liquid || ice)
  {
    const Particles droplets{ 2, order.liquidRadius, LiquidWaterDensity };
    const Particles crystals{ 2, order.iceRadius, IceDensity };
    return scalarOf("density", units, points,
      [&, perUnit](vtkIdType p)
      {
        const double air = found.airDensity(p);
        const auto of = [p, air](vtkDataArray* array, const Particles& particles) {
          return array ? condensateExtinctionPerMeter(array->GetComponent(p, 0), air, particles)
                       : 0;
        };
        return perUnit * (of(liquid, droplets) + of(ice, crystals));
      });
  }
  if (fraction)
  {
    return scalarOf("density", units, points,
      [&, perUnit](vtkIdType p)
      { return perUnit * order.fullCoverExtinction * fraction->GetComponent(p, 0); });
  }
  throw VDBError(std::string("The grid has none of the point arrays ") + arrays::Extinction + ", " +
    arrays::LiquidWater + ", " + arrays::IceWater + " and " + arrays::CloudFraction +
    "; give one that says where clouds are");
}

}

std::vector<Quantity> quantitiesOf(vtkStructuredGrid* grid, const VoxelOrder& order)
{
  const PointArrays found(grid);
  const vtkIdType points = grid->GetNumberOfPoints();
  std::vector<Quantity> made{ densityOf(grid, found, order) };
  for (const auto& [name, array] : { std::make_pair("liquid", found.find(arrays::LiquidWater)),
         std::make_pair("ice", found.find(arrays::IceWater)) })
  {
    if (array)
    {
      vtkDataArray* const ratio = array;
      made.push_back(scalarOf(name, "kg/m3", points,
        [&found, ratio](vtkIdType p) { return found.airDensity(p) * ratio->GetComponent(p, 0); }));
    }
  }
  if (vtkDataArray* const wind = found.find(arrays::Wind, 3))
  {
    Quantity vectors{ "wind", "m/s", 3, std::vector<float>(static_cast<std::size_t>(3 * points)) };
    for (std::size_t v = 0; v < vectors.values.size(); ++v)
    {
      const auto value = static_cast<float>(
        wind->GetComponent(static_cast<vtkIdType>(v / 3), static_cast<int>(v % 3)));
      vectors.values[v] = std::isfinite(value) ? value : 0.0F;
    }
    made.push_back(std::move(vectors));
  }
  for (const std::string& name : order.names)
  {
    if (std::none_of(
          made.begin(), made.end(), [&name](const Quantity& q) { return q.name == name; }))
    {
      throw VDBError("The grid has nothing to make '" + name +
        "' of; it can be density, liquid, ice or wind if their arrays are there");
    }
  }
  return made;
}
}
