// SPDX-License-Identifier: BSD-3-Clause
#include "StructuredOutput.h"

#include "CloudArrays.h"
#include "ReadError.h"

#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSMPTools.h>
#include <vtkStringArray.h>
#include <vtkStructuredGrid.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
vtkIdType pointsOf(const int extent[6])
{
  vtkIdType n = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    n *= extent[2 * axis + 1] - extent[2 * axis] + 1;
  }
  return n;
}

void addArray(vtkStructuredGrid* output, const char* name, const std::vector<float>& values)
{
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  output->GetPointData()->AddArray(array);
}

void addString(vtkStructuredGrid* output, const char* name, const std::vector<std::string>& values)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const std::string& value : values)
  {
    array->InsertNextValue(value);
  }
  output->GetFieldData()->AddArray(array);
}

void addNumber(vtkStructuredGrid* output, const char* name, double value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  output->GetFieldData()->AddArray(array);
}
}

const char* geometryName(SceneGeometry geometry)
{
  static const char* const names[] = { "Map", "Globe", "Local" };
  return names[static_cast<int>(geometry)];
}

OutputGrid::OutputGrid(const GridAxes& axes, const HorizontalGrid& grid, SceneGeometry geometry)
  : Axes(axes)
  , Geometry(geometry)
  , South(geometry == SceneGeometry::Globe && grid.SouthPole)
  , North(geometry == SceneGeometry::Globe && grid.NorthPole)
{
  if (geometry == SceneGeometry::Local)
  {
    this->Axes.periodic = false;
  }
}

int OutputGrid::size(int axis) const
{
  return axis == 0 ? static_cast<int>(this->Axes.nx) + (this->Axes.periodic ? 1 : 0)
    : axis == 1    ? static_cast<int>(this->Axes.ny) + (this->South ? 1 : 0) + (this->North ? 1 : 0)
                   : static_cast<int>(this->Axes.nz);
}

bool OutputGrid::hasPole(const int extent[6]) const
{
  return (this->South && extent[2] == 0) || (this->North && extent[3] == this->size(1) - 1);
}

Region OutputGrid::region(const int extent[6], std::size_t time) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const bool outside = extent[2 * axis] < 0 || extent[2 * axis + 1] >= this->size(axis);
    if ((outside && !(axis == 0 && this->isRing())) || extent[2 * axis] > extent[2 * axis + 1])
    {
      throw ReadError("the requested extent lies outside the grid; ask for a part of WHOLE_EXTENT");
    }
  }
  Region region;
  region.time = time;
  const bool whole = this->hasPole(extent);
  const int last = static_cast<int>(this->Axes.nx) - 1;
  for (int i = whole ? 0 : extent[0]; i <= (whole ? last : extent[1]); ++i)
  {
    region.columns.push_back(this->column(i));
  }
  const int shift = this->South ? 1 : 0;
  const int rows = static_cast<int>(this->Axes.ny);
  const int first = std::clamp(extent[2] - shift, 0, rows - 1);
  for (int j = first; j <= std::clamp(extent[3] - shift, 0, rows - 1); ++j)
  {
    region.rows.push_back(static_cast<std::size_t>(j));
  }
  return region;
}

OutputGrid::Row OutputGrid::row(int j, const Region& region) const
{
  const int real = j - (this->South ? 1 : 0);
  Row row;
  row.pole = real < 0 ? -1 : real >= static_cast<int>(this->Axes.ny) ? 1 : 0;
  row.at = row.pole < 0 ? 0
    : row.pole > 0      ? region.rows.size() - 1
                        : static_cast<std::size_t>(real) - region.rows.front();
  return row;
}

std::vector<float> OutputGrid::place(
  const std::vector<float>& values, const int extent[6], const Region& region) const
{
  std::vector<float> placed(static_cast<std::size_t>(pointsOf(extent)));
  const int ny = extent[3] - extent[2] + 1;
  const std::size_t nx = static_cast<std::size_t>(extent[1] - extent[0] + 1);
  const bool whole = this->hasPole(extent);
  vtkSMPTools::For(0, static_cast<vtkIdType>(ny) * (extent[5] - extent[4] + 1),
    [&, whole, nx, ny](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType line = begin; line < end; ++line)
      {
        const Row row = this->row(extent[2] + static_cast<int>(line % ny), region);
        const std::size_t k = static_cast<std::size_t>(extent[4] + line / ny);
        const float* source =
          values.data() + (k * region.rows.size() + row.at) * region.columns.size();
        float* target = placed.data() + static_cast<std::size_t>(line) * nx;
        if (row.pole)
        {
          double sum = 0;
          int count = 0;
          for (std::size_t c = 0; c < region.columns.size(); ++c)
          {
            sum += std::isnan(source[c]) ? 0 : source[c];
            count += std::isnan(source[c]) ? 0 : 1;
          }
          std::fill_n(target, nx, count ? static_cast<float>(sum / count) : NAN);
          continue;
        }
        for (std::size_t i = 0; i < nx; ++i)
        {
          target[i] = source[whole ? this->column(extent[0] + static_cast<int>(i)) : i];
        }
      }
    });
  return placed;
}

void OutputGrid::addPoints(vtkStructuredGrid* output, const std::vector<float>& height,
  const int extent[6], const SceneLayout& layout) const
{
  vtkNew<vtkDoubleArray> places;
  places->SetNumberOfComponents(3);
  places->SetNumberOfTuples(static_cast<vtkIdType>(height.size()));
  double* xyz = places->GetPointer(0);
  const std::size_t nx = static_cast<std::size_t>(extent[1] - extent[0] + 1);
  const std::size_t layer = nx * static_cast<std::size_t>(extent[3] - extent[2] + 1);
  const int shift = this->South ? 1 : 0;
  const int rows = static_cast<int>(this->Axes.ny);
  std::size_t c = 0;
  for (int j = extent[2]; j <= extent[3]; ++j) // PROJ is used: one thread
  {
    for (int i = extent[0]; i <= extent[1]; ++i, ++c)
    {
      const int real = j - shift;
      const bool pole = real < 0 || real >= rows;
      const SceneColumn column = pole
        ? layout.pole(this->column(i), real < 0 ? -1 : 1, this->turn(i))
        : layout.column(this->column(i), static_cast<std::size_t>(real), this->turn(i));
      for (std::size_t at = c; at < height.size(); at += layer)
      {
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          xyz[3 * at + axis] =
            column.base[axis] + column.rise[axis] * static_cast<double>(height[at]);
        }
      }
    }
  }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetData(places);
  output->SetPoints(points);
}

void OutputGrid::addWind(vtkStructuredGrid* output, const CloudFields& fields, const int extent[6],
  const Region& region, const SceneLayout& layout) const
{
  const std::size_t layer = region.layer();
  std::vector<float> component[3];
  for (std::vector<float>& values : component)
  {
    values.resize(fields.east.size());
  }
  for (std::size_t c = 0; c < layer; ++c)
  {
    const SceneColumn column = layout.column(
      region.columns[c % region.columns.size()], region.rows[c / region.columns.size()], 0);
    for (std::size_t at = c; at < fields.east.size(); at += layer)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        component[axis][at] = static_cast<float>(fields.east[at] * column.along[axis] +
          fields.north[at] * column.across[axis] + fields.up[at] * column.up[axis]);
      }
    }
  }
  vtkNew<vtkFloatArray> wind;
  wind->SetName(arrays::Wind);
  wind->SetNumberOfComponents(3);
  wind->SetNumberOfTuples(pointsOf(extent));
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::vector<float> placed = this->place(component[axis], extent, region);
    for (std::size_t i = 0; i < placed.size(); ++i)
    {
      wind->SetTypedComponent(static_cast<vtkIdType>(i), axis, placed[i]);
    }
  }
  output->GetPointData()->AddArray(wind);
}

void OutputGrid::hide(vtkStructuredGrid* output, const std::vector<float>& master,
  const std::vector<char>& groundless, const int extent[6], const Region& region) const
{
  std::vector<float> missing(groundless.size());
  bool any = false;
  for (std::size_t i = 0; i < missing.size(); ++i)
  {
    const bool is = groundless[i] || (!master.empty() && std::isnan(master[i]));
    missing[i] = is ? 1.0F : 0.0F;
    any = any || is;
  }
  if (!any)
  {
    return;
  }
  const std::vector<float> placed = this->place(missing, extent, region);
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfTuples(static_cast<vtkIdType>(placed.size()));
  std::transform(placed.begin(), placed.end(), ghosts->GetPointer(0),
    [](float m)
    { return static_cast<unsigned char>(m > 0.5F ? vtkDataSetAttributes::HIDDENPOINT : 0); });
  output->GetPointData()->AddArray(ghosts);
}

void OutputGrid::fill(vtkStructuredGrid* output, const int extent[6], const Region& region,
  const CloudFields& fields, const SceneLayout& layout, const CloudFile& file) const
{
  const std::vector<float>& master = !fields.fraction.empty() ? fields.fraction
    : !fields.liquid.empty()                                  ? fields.liquid
    : !fields.ice.empty()                                     ? fields.ice
                                                              : fields.air.temperature;
  const auto missing = [](float value) { return std::isnan(value); };
  const bool whole =
    pointsOf(extent) == static_cast<vtkIdType>(this->size(0)) * this->size(1) * this->size(2);
  if (whole && !master.empty() && std::all_of(master.begin(), master.end(), missing))
  {
    throw ReadError("variable " + file.master().name + ": every value of step " +
      std::to_string(region.time) + " is missing; choose another time or variable");
  }
  output->SetExtent(const_cast<int*>(extent));
  const std::vector<float> height = this->place(fields.air.height, extent, region);
  this->addPoints(output, height, extent, layout);
  addArray(output, arrays::Height, height);
  const std::pair<const char*, const std::vector<float>*> scalars[] = { { arrays::CloudFraction,
                                                                          &fields.fraction },
    { arrays::LiquidWater, &fields.liquid }, { arrays::IceWater, &fields.ice },
    { arrays::Pressure, &fields.air.pressure }, { arrays::Temperature, &fields.air.temperature },
    { arrays::SpecificHumidity, &fields.air.humidity },
    { arrays::PotentialTemperature, &fields.potential } };
  for (const auto& [name, values] : scalars)
  {
    if (!values->empty())
    {
      addArray(output, name, this->place(*values, extent, region));
    }
  }
  if (!fields.east.empty())
  {
    this->addWind(output, fields, extent, region, layout);
  }
  this->hide(output, master, fields.air.groundless, extent, region);
}

void OutputGrid::markGhosts(
  vtkStructuredGrid* output, const PointExtent& extent, const PointExtent& block)
{
  if (extent == block)
  {
    return;
  }
  vtkUnsignedCharArray* const points =
    output->GetPointGhostArray() ? output->GetPointGhostArray() : output->AllocatePointGhostArray();
  markOutside(extent, block, 0,
    [points](vtkIdType point)
    { points->SetValue(point, points->GetValue(point) | vtkDataSetAttributes::DUPLICATEPOINT); });
  vtkUnsignedCharArray* const cells = output->AllocateCellGhostArray();
  markOutside(extent, block, 1,
    [cells](vtkIdType cell) { cells->SetValue(cell, vtkDataSetAttributes::DUPLICATECELL); });
}

void OutputGrid::attach(vtkStructuredGrid* output, const HorizontalGrid& grid,
  const SceneLayout& layout, const CloudFile& file) const
{
  addString(output, arrays::Geometry, { geometryName(this->Geometry) });
  addNumber(output, arrays::HeightScale, layout.heightScale());
  if (this->Geometry == SceneGeometry::Globe)
  {
    addNumber(output, arrays::PlanetRadius, grid.Radius);
  }
  if (this->Geometry == SceneGeometry::Local)
  {
    addString(output, arrays::Projection, { layout.projection() });
  }
  addString(output, arrays::Derived, file.Derivations);
  if (output->GetPointData()->GetArray(arrays::CloudFraction))
  {
    output->GetPointData()->SetActiveScalars(arrays::CloudFraction);
  }
  if (output->GetPointData()->GetArray(arrays::Wind))
  {
    output->GetPointData()->SetActiveVectors(arrays::Wind);
  }
}
}
