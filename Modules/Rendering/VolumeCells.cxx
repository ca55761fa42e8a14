// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeCells.h"

#include "Optics.h"
#include "StructuredColumns.h"
#include "vtkColorTransferFunction.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

using nephoscope::RGB;
using nephoscope::Vector3;

namespace
{
void place(std::vector<Vector3>& points, vtkMatrix4x4* matrix)
{
  if (matrix->IsIdentity())
  {
    return;
  }
  for (Vector3& point : points)
  {
    const double from[4] = { point[0], point[1], point[2], 1 };
    double to[4];
    matrix->MultiplyPoint(from, to);
    point = { to[0], to[1], to[2] };
  }
}
}

std::string VolumeCells::Read(
  vtkDataSet* cells, vtkDataArray* scalars, vtkVolumeProperty* property, vtkMatrix4x4* matrix)
{
  this->Columns = {};
  this->Mesh = {};
  this->Drawn.clear();
  if (cells->GetNumberOfPoints() > std::numeric_limits<std::uint32_t>::max())
  {
    return "The input has more than 4,294,967,295 points; draw pieces of it.";
  }
  this->ReadOptics(scalars, property);
  int extent[6];
  this->Structured = extentOf(cells, extent);
  std::string wrong =
    this->Structured ? this->ReadStructured(cells, extent) : this->ReadTetrahedra(cells);
  place(this->Structured ? this->Columns.points : this->Mesh.points, matrix);
  this->Extinction = {};
  this->Color = {};
  return wrong;
}

/// The transfer functions at the points.
void VolumeCells::ReadOptics(vtkDataArray* scalars, vtkVolumeProperty* property)
{
  const vtkIdType points = scalars->GetNumberOfTuples();
  vtkPiecewiseFunction* const opacity = property->GetScalarOpacity();
  const double unit = property->GetScalarOpacityUnitDistance();
  vtkPiecewiseFunction* const gray =
    property->GetColorChannels() == 1 ? property->GetGrayTransferFunction() : nullptr;
  vtkColorTransferFunction* const color = gray ? nullptr : property->GetRGBTransferFunction();
  this->Extinction.resize(points);
  this->Color.resize(points);
  for (vtkIdType p = 0; p < points; ++p)
  {
    const double scalar = scalars->GetComponent(p, 0);
    double rgb[3] = { 0, 0, 0 };
    if (std::isfinite(scalar) && color)
    {
      color->GetColor(scalar, rgb);
    }
    else if (std::isfinite(scalar) && gray)
    {
      std::fill(rgb, rgb + 3, gray->GetValue(scalar));
    }
    this->Extinction[p] = std::isfinite(scalar)
      ? nephoscope::usableExtinction(opacity->GetValue(scalar) / unit)
      : std::nanf("");
    this->Color[p] = { static_cast<float>(rgb[0]), static_cast<float>(rgb[1]),
      static_cast<float>(rgb[2]) };
  }
  this->KeepOneColor();
}

/// If every point has one colour, the pieces need no sort.
void VolumeCells::KeepOneColor()
{
  this->OneColor = this->Color.empty() ? RGB{ 0, 0, 0 } : this->Color.front();
  if (std::all_of(this->Color.begin(), this->Color.end(),
        [this](const RGB& color) { return color == this->OneColor; }))
  {
    this->Color = {};
  }
}

std::string VolumeCells::ReadStructured(vtkDataSet* cells, const int extent[6])
{
  const std::array<int, 3> n = pointsIn(extent);
  if (n[0] < 2 || n[1] < 2 || n[2] < 2)
  {
    return "The grid of " + std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " +
      std::to_string(n[2]) + " points has no cells; give two at least along each axis.";
  }
  if (cells->GetNumberOfPoints() != static_cast<vtkIdType>(n[0]) * n[1] * n[2])
  {
    return "The grid of " + std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " +
      std::to_string(n[2]) + " has " + std::to_string(cells->GetNumberOfPoints()) +
      " points; give one for each place.";
  }
  fillColumns(
    this->Columns, cells, extent, [this](vtkIdType point) { return this->Extinction[point]; });
  if (!this->Color.empty())
  {
    this->Columns.color.resize(this->Color.size());
    for (std::size_t p = 0; p < this->Color.size(); ++p)
    {
      const std::size_t line = p % (static_cast<std::size_t>(n[0]) * n[1]);
      this->Columns.color[line * n[2] + p / (static_cast<std::size_t>(n[0]) * n[1])] =
        this->Color[p];
    }
  }
  for (std::size_t column = 0; column < this->Columns.numberOfColumns(); ++column)
  {
    if (this->Columns.first[column] < this->Columns.last[column])
    {
      this->Drawn.push_back(static_cast<std::uint32_t>(column));
    }
  }
  return {};
}

std::string VolumeCells::ReadTetrahedra(vtkDataSet* cells)
{
  auto* const grid = vtkUnstructuredGridBase::SafeDownCast(cells);
  if (!grid)
  {
    return std::string("The input is a ") + cells->GetClassName() +
      "; give a vtkStructuredGrid, vtkRectilinearGrid, vtkImageData or vtkUnstructuredGrid.";
  }
  vtkUnsignedCharArray* const pointGhosts = grid->GetPointGhostArray();
  vtkUnsignedCharArray* const ghosts = grid->GetCellGhostArray();
  this->Mesh.extinction = std::move(this->Extinction);
  this->Mesh.color = std::move(this->Color);
  this->Mesh.points.resize(grid->GetNumberOfPoints());
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    grid->GetPoint(p, this->Mesh.points[p].v);
    if (pointGhosts && (pointGhosts->GetValue(p) & vtkDataSetAttributes::HIDDENPOINT))
    {
      this->Mesh.extinction[p] = std::nanf("");
    }
  }
  constexpr int Hidden = vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::DUPLICATECELL |
    vtkDataSetAttributes::REFINEDCELL;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
  {
    grid->GetCellPoints(cell, ids);
    if (grid->GetCellType(cell) != VTK_TETRA || ids->GetNumberOfIds() != 4)
    {
      return "The cell " + std::to_string(cell) + " is of type " +
        std::to_string(grid->GetCellType(cell)) + " with " + std::to_string(ids->GetNumberOfIds()) +
        " points, not a tetrahedron (10); use vtkDataSetTriangleFilter first.";
    }
    const auto* const corners = ids->GetPointer(0);
    if (std::any_of(corners, corners + 4,
          [grid](vtkIdType id) { return id < 0 || id >= grid->GetNumberOfPoints(); }))
    {
      return "The cell " + std::to_string(cell) +
        " is on a point that the grid does not have: its " +
        std::to_string(grid->GetNumberOfPoints()) + " points are numbered from 0.";
    }
    if (!ghosts || !(ghosts->GetValue(cell) & Hidden))
    {
      this->Mesh.add(
        { static_cast<std::uint32_t>(corners[0]), static_cast<std::uint32_t>(corners[1]),
          static_cast<std::uint32_t>(corners[2]), static_cast<std::uint32_t>(corners[3]) });
    }
  }
  this->Drawn.resize(this->Mesh.tetrahedra.size());
  for (std::size_t t = 0; t < this->Drawn.size(); ++t)
  {
    this->Drawn[t] = static_cast<std::uint32_t>(t);
  }
  return {};
}

template <class Rays, class Cells>
void VolumeCells::LookAt(const Cells& cells, const nephoscope::Camera& camera)
{
  const nephoscope::RaySpace space(camera);
  this->Bins.Build(this->Drawn.size(), camera.width(), camera.height(),
    [this, &cells, &space, &camera]() -> ScreenBins::BoxOf
    {
      const auto rays = std::make_shared<Rays>(cells, space, camera.width(), camera.height());
      return [rays, this](std::size_t thing)
      {
        rays->look(this->Drawn[thing]);
        return rays->box();
      };
    });
}

void VolumeCells::Look(const nephoscope::Camera& camera)
{
  this->Structured ? this->LookAt<nephoscope::ColumnRays>(this->Columns, camera)
                   : this->LookAt<nephoscope::MeshRays>(this->Mesh, camera);
}

template <class Rays, class Cells>
void VolumeCells::EmitFrom(
  const Cells& cells, const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const
{
  const nephoscope::RaySpace space(camera);
  const nephoscope::TileRays tileRays(space, tile);
  const std::uint32_t source = tile.addSource(this->OneColor);
  if (cells.color.empty())
  {
    tile.startSum(source);
  }
  Rays rays(cells, space, camera.width(), camera.height());
  this->Bins.ForEach(tile.extent(), tileRays.limit(),
    [this, &tile, &tileRays, source, &rays](std::uint32_t thing)
    {
      rays.look(this->Drawn[thing]);
      rays.emit(tile, tileRays, source);
    });
}

void VolumeCells::Emit(const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const
{
  this->Structured ? this->EmitFrom<nephoscope::ColumnRays>(this->Columns, camera, tile)
                   : this->EmitFrom<nephoscope::MeshRays>(this->Mesh, camera, tile);
}
