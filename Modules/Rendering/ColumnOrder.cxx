// SPDX-License-Identifier: BSD-3-Clause
#include "ColumnOrder.h"

#include "OrderedTile.h"
#include "RayGaps.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <array>
#include <limits>

using nephoscope::CellRelations;

namespace
{
constexpr vtkIdType ColumnsInAList = 256;
constexpr int TileEdge = 32;

std::array<nephoscope::Vector3, 4> at(
  const nephoscope::CellColumns& columns, const std::array<std::size_t, 4>& points)
{
  return { columns.points[points[0]], columns.points[points[1]], columns.points[points[2]],
    columns.points[points[3]] };
}
}

/// Calls visit(k, tetrahedron) for those of a column's drawn cells.
template <class Visit>
void ColumnOrder::ForEachTetrahedron(std::uint32_t column, Visit&& visit) const
{
  for (int k = this->Columns->first[column]; k < this->Columns->last[column]; ++k)
  {
    for (int t = 0; this->Tetrahedra->isDrawn(column, k) && t < 5; ++t)
    {
      visit(k, t);
    }
  }
}

void ColumnOrder::Read(
  const nephoscope::CellColumns& columns, const std::vector<std::uint32_t>& drawn)
{
  this->Columns = &columns;
  this->Drawn = &drawn;
  this->Tetrahedra = std::make_unique<nephoscope::ColumnTetrahedra>(columns);
}

bool ColumnOrder::Build(By by, const ScreenBins& bins, const nephoscope::Camera& camera)
{
  this->Cycles = 0;
  this->CellsInCycles = 0;
  std::vector<std::uint32_t> columns;
  for (std::size_t thing = 0; thing < this->Drawn->size(); ++thing)
  {
    if (!bins.GetBox(thing).empty())
    {
      columns.push_back((*this->Drawn)[thing]);
    }
  }
  this->Count = this->Tetrahedra->number(columns);
  if (this->Count > std::numeric_limits<std::uint32_t>::max())
  {
    return false;
  }
  const std::vector<double> depths = this->Depths(columns, camera);
  std::vector<std::uint32_t> order;
  if (by == By::Centroid)
  {
    order = nephoscope::distanceOrder(depths);
  }
  else
  {
    std::vector<CellRelations> lists;
    this->RelateAcrossFaces(columns, camera, lists);
    this->RelateAcrossGaps(bins, camera, lists);
    nephoscope::VisibilityOrder found = nephoscope::visibilityOrder(this->Count, lists, depths);
    this->Cycles = found.cycles;
    this->CellsInCycles = found.cellsInCycles;
    order = std::move(found.cells);
  }
  this->Rank.resize(this->Count);
  for (std::size_t rank = 0; rank < order.size(); ++rank)
  {
    this->Rank[order[rank]] = static_cast<std::uint32_t>(rank);
  }
  return true;
}

std::vector<double> ColumnOrder::Depths(
  const std::vector<std::uint32_t>& columns, const nephoscope::Camera& camera) const
{
  const nephoscope::ViewPoint view(camera);
  std::vector<double> depths(this->Count, 0);
  vtkSMPTools::For(0, static_cast<vtkIdType>(columns.size()), ColumnsInAList,
    [this, &columns, &view, &depths](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType c = begin; c < end; ++c)
      {
        const std::uint32_t column = columns[c];
        this->ForEachTetrahedron(column,
          [this, &view, &depths, column](int k, int t)
          {
            depths[this->Tetrahedra->number(column, k, t)] =
              view.depth(this->Tetrahedra->middle(column, k, t));
          });
      }
    });
  return depths;
}

void ColumnOrder::RelateAcrossFaces(const std::vector<std::uint32_t>& columns,
  const nephoscope::Camera& camera, std::vector<CellRelations>& lists) const
{
  const nephoscope::ViewPoint view(camera);
  const auto all = static_cast<vtkIdType>(columns.size());
  const std::size_t before = lists.size();
  const vtkIdType more = (all + ColumnsInAList - 1) / ColumnsInAList;
  lists.resize(before + more);
  vtkSMPTools::For(0, more, 1,
    [this, &columns, &view, &lists, all, before](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType list = begin; list < end; ++list)
      {
        const vtkIdType past = std::min(all, (list + 1) * ColumnsInAList);
        for (vtkIdType c = list * ColumnsInAList; c < past; ++c)
        {
          this->Tetrahedra->relate(columns[c], view, lists[before + list]);
        }
      }
    });
}

void ColumnOrder::RelateAcrossGaps(
  const ScreenBins& bins, const nephoscope::Camera& camera, std::vector<CellRelations>& lists) const
{
  const nephoscope::RaySpace space(camera);
  const int across = (camera.width() + TileEdge - 1) / TileEdge;
  const int up = (camera.height() + TileEdge - 1) / TileEdge;
  const std::size_t before = lists.size();
  lists.resize(before + static_cast<std::size_t>(across) * up);
  vtkSMPTools::For(0, static_cast<vtkIdType>(across) * up, 1,
    [this, &bins, &camera, &space, &lists, before, across](vtkIdType begin, vtkIdType end)
    {
      nephoscope::RayGaps gaps(space, camera.width(), camera.height());
      for (vtkIdType number = begin; number < end; ++number)
      {
        const int x0 = static_cast<int>(number % across) * TileEdge;
        const int y0 = static_cast<int>(number / across) * TileEdge;
        const nephoscope::TileExtent tile{ x0, y0, std::min(TileEdge, camera.width() - x0),
          std::min(TileEdge, camera.height() - y0) };
        gaps.reset(tile);
        bins.ForEach(tile, std::numeric_limits<double>::infinity(),
          [this, &gaps](std::uint32_t thing)
          {
            const std::uint32_t column = (*this->Drawn)[thing];
            this->ForEachTetrahedron(column,
              [this, &gaps, column](int k, int t)
              {
                if (this->Tetrahedra->isAtGap(column, k, t))
                {
                  gaps.add(this->Tetrahedra->number(column, k, t),
                    at(*this->Columns, this->Tetrahedra->points(column, k, t)));
                }
              });
          });
        gaps.relate(lists[before + number]);
      }
    });
}

/// The tetrahedra of the cells that may touch a tile, in order.
std::vector<ColumnOrder::Ranked> ColumnOrder::RankedInTile(
  const ScreenBins& bins, const nephoscope::Camera& camera, const nephoscope::TileRays& rays) const
{
  nephoscope::ColumnRays columnRays(
    *this->Columns, nephoscope::RaySpace(camera), camera.width(), camera.height());
  std::vector<Ranked> ranked;
  bins.ForEach(rays.extent(), rays.limit(),
    [this, &columnRays, &rays, &ranked](std::uint32_t thing)
    {
      const std::uint32_t column = (*this->Drawn)[thing];
      columnRays.look(column);
      this->ForEachTetrahedron(column,
        [this, &columnRays, &rays, &ranked, column](int k, int t)
        {
          const bool touches = t == 0
            ? columnRays.touches(k, rays)
            : !ranked.empty() && ranked.back().column == column && ranked.back().k == k;
          if (touches)
          {
            ranked.push_back({ this->Rank[this->Tetrahedra->number(column, k, t)], column, k, t });
          }
        });
    });
  std::sort(
    ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) { return a.rank < b.rank; });
  return ranked;
}

void ColumnOrder::Emit(const ScreenBins& bins, const nephoscope::Camera& camera,
  const nephoscope::RGB& color, nephoscope::DeepTile& tile) const
{
  const nephoscope::CellColumns& columns = *this->Columns;
  const nephoscope::RaySpace space(camera);
  const nephoscope::TileRays rays(space, tile);
  const nephoscope::TetrahedronScan scan(space, camera.width(), camera.height());
  nephoscope::OrderedTile ordered(tile);
  for (const Ranked& cell : this->RankedInTile(bins, camera, rays))
  {
    const auto points = this->Tetrahedra->points(cell.column, cell.k, cell.tetrahedron);
    nephoscope::RayCorner corners[4];
    const nephoscope::RayCorner* corner[4];
    float extinction[4];
    const nephoscope::RGB* colors[4];
    for (std::size_t n = 0; n < 4; ++n)
    {
      corners[n] = scan.corner(columns.points[points[n]]);
      corner[n] = corners + n;
      extinction[n] = columns.extinction[points[n]];
      colors[n] = columns.color.empty() ? &color : &columns.color[points[n]];
    }
    scan.isParallel() ? scan.emitInOrder<true>(ordered, rays, corner, extinction, colors)
                      : scan.emitInOrder<false>(ordered, rays, corner, extinction, colors);
  }
}
