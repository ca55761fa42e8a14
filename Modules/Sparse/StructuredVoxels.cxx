// SPDX-License-Identifier: BSD-3-Clause
#include "StructuredVoxels.h"

#include "BrickSampler.h"
#include "NumberText.h"
#include "PointQuantities.h"
#include "TetrahedralSplit.h"
#include "vtkSMPThreadLocal.h"
#include "vtkSMPTools.h"
#include "vtkStructuredGrid.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <memory>
#include <new>

namespace nephoscope
{
namespace
{
constexpr double LargestIndex = 1 << 30;

// Most pairs of a cell and a brick that are allowed for each brick: memory of 16 bytes each.
constexpr double CellsABrick = 40;

/// Turns the cells that have cloud into bricks.
class Voxelizer
{
public:
  Voxelizer(vtkStructuredGrid* grid, const VoxelOrder& order)
    : Order(order)
    , Quantities(quantitiesOf(grid, order))
  {
    grid->GetDimensions(this->Size);
    this->Points.resize(static_cast<std::size_t>(grid->GetNumberOfPoints()));
    for (std::size_t p = 0; p < this->Points.size(); ++p)
    {
      grid->GetPoint(static_cast<vtkIdType>(p), this->Points[p].v);
    }
    this->Frame.spacing = { order.voxelSize[0], order.voxelSize[1], order.voxelSize[2] };
    this->Masses.assign(this->Quantities.size(), 0);
  }

  std::vector<FogGrid> make(const VoxelProgress& progress)
  {
    this->findCells();
    this->keepWanted();
    this->chooseSamples();
    this->allot();
    if (!this->sample(progress))
    {
      return {};
    }
    for (std::size_t q = 0; q < this->Grids.size(); ++q)
    {
      this->conserve(q);
    }
    return std::move(this->Grids);
  }

private:
  using Key = std::array<int, 3>;
  struct Pair
  {
    Key brick; ///< brick coordinates, z first so that bricks come in layers
    std::uint32_t cell;
    bool operator<(const Pair& other) const
    {
      return this->brick != other.brick ? this->brick < other.brick : this->cell < other.cell;
    }
  };
  struct Corners
  {
    std::array<std::size_t, 8> point;
    int parity;
  };

  Corners cornersOf(std::uint32_t cell) const
  {
    const int nx = this->Size[0] - 1;
    const int ny = this->Size[1] - 1;
    const int i = static_cast<int>(cell) % nx;
    const int j = static_cast<int>(cell) / nx % ny;
    const int k = static_cast<int>(cell) / nx / ny;
    Corners corners{ {}, splitParity(i, j, k) };
    for (int v = 0; v < 8; ++v)
    {
      corners.point[static_cast<std::size_t>(v)] = static_cast<std::size_t>(i + (v & 1)) +
        static_cast<std::size_t>(this->Size[0]) *
          (static_cast<std::size_t>(j + (v >> 1 & 1)) +
            static_cast<std::size_t>(this->Size[1]) * static_cast<std::size_t>(k + (v >> 2)));
    }
    return corners;
  }

  bool hasCloud(const Corners& corners) const
  {
    bool cloud = false;
    for (const Quantity& quantity : this->Quantities)
    {
      for (const std::size_t p : corners.point)
      {
        if (quantity.components == 1 && !std::isfinite(quantity.values[p]))
        {
          return false;
        }
        cloud = cloud || (quantity.components == 1 && quantity.values[p] > 0);
      }
    }
    return cloud;
  }

  /// Of bricks, z first as in a Key.
  struct Box
  {
    Key low{};
    Key high{};
    std::array<float, 3> extent{}; ///< voxels, x first
  };

  Box boxOf(const Corners& corners) const;
  void refuseTooMany(double bricks) const;
  void findCells();
  void keepWanted();
  void chooseSamples();
  void allot();
  bool sample(const VoxelProgress& progress);
  void conserve(std::size_t quantity);
  void addMass(const Corners& corners);
  void addCell(std::uint32_t cell, BrickSampler& sampler) const;
  void sampleBrick(std::size_t brick, BrickSampler& sampler, std::vector<float>& means);

  VoxelOrder Order;
  std::vector<Quantity> Quantities;
  int Channels = 0;       ///< components of all
  int VectorChannels = 0; ///< of vectors, which come last
  int Size[3] = {};
  std::vector<Vector3> Points;
  VoxelFrame Frame;
  std::vector<Pair> Pairs;
  std::vector<std::array<float, 3>> Extents; ///< of the cells, voxels
  std::vector<double> Masses;                ///< of the tetrahedra
  std::array<int, 3> Samples{ 2, 2, 2 };
  std::vector<std::size_t> Starts; ///< of the bricks in Pairs, and the end
  std::vector<double> Cuts;        ///< [quantity]: what a value has to exceed
  std::vector<FogGrid> Grids;      ///< [quantity]
};

/// The bricks that a cell's box touches, with a margin of half a voxel. @throw VDBError if they cannot be numbered
Voxelizer::Box Voxelizer::boxOf(const Corners& corners) const
{
  Box box;
  for (int c = 0; c < 3; ++c)
  {
    double least = INFINITY;
    double largest = -INFINITY;
    for (const std::size_t p : corners.point)
    {
      least = std::min(least, this->Points[p][c] / this->Frame.spacing[c]);
      largest = std::max(largest, this->Points[p][c] / this->Frame.spacing[c]);
    }
    if (!(least > -LargestIndex && largest < LargestIndex))
    {
      throw VDBError("The voxel size " + numberText(this->Frame.spacing[c]) +
        " is too small for the grid's coordinates, or these are not finite; choose larger voxels");
    }
    const auto axis = static_cast<std::size_t>(c);
    box.low[2 - axis] = static_cast<int>(std::floor((least - 0.5) / BrickSampler::Edge));
    box.high[2 - axis] = static_cast<int>(std::floor((largest + 0.5) / BrickSampler::Edge));
    box.extent[axis] = static_cast<float>(largest - least);
  }
  return box;
}

void Voxelizer::refuseTooMany(double bricks) const
{
  if (bricks > this->Order.maximumVoxels / BrickSampler::Volume)
  {
    const Vector3& size = this->Frame.spacing;
    throw VDBError("Voxels of " + numberText(size[0]) + " x " + numberText(size[1]) + " x " +
      numberText(size[2]) + " would be more than " +
      std::to_string(static_cast<long long>(this->Order.maximumVoxels)) + "; choose larger ones");
  }
}

void Voxelizer::findCells()
{
  const auto cells =
    static_cast<std::uint32_t>((this->Size[0] - 1) * (this->Size[1] - 1) * (this->Size[2] - 1));
  for (std::uint32_t cell = 0; cell < cells; ++cell)
  {
    const Corners corners = this->cornersOf(cell);
    if (!this->hasCloud(corners))
    {
      continue;
    }
    this->addMass(corners);
    const Box box = this->boxOf(corners);
    double touched = 1;
    for (std::size_t c = 0; c < 3; ++c)
    {
      touched *= 1.0 + box.high[c] - box.low[c];
    }
    this->refuseTooMany((static_cast<double>(this->Pairs.size()) + touched) / CellsABrick);
    this->Extents.push_back(box.extent);
    Key at{};
    for (at[0] = box.low[0]; at[0] <= box.high[0]; ++at[0])
    {
      for (at[1] = box.low[1]; at[1] <= box.high[1]; ++at[1])
      {
        for (at[2] = box.low[2]; at[2] <= box.high[2]; ++at[2])
        {
          this->Pairs.push_back({ at, cell });
        }
      }
    }
  }
  vtkSMPTools::Sort(this->Pairs.begin(), this->Pairs.end());
  for (std::size_t p = 0; p < this->Pairs.size(); ++p)
  {
    if (p == 0 || this->Pairs[p].brick != this->Pairs[p - 1].brick)
    {
      this->Starts.push_back(p);
    }
  }
  this->refuseTooMany(static_cast<double>(this->Starts.size()));
  this->Starts.push_back(this->Pairs.size());
}

void Voxelizer::addMass(const Corners& corners)
{
  for (const TetrahedronVertices& t : TetrahedralSplit[static_cast<std::size_t>(corners.parity)])
  {
    std::array<Vector3, 4> places;
    for (std::size_t v = 0; v < 4; ++v)
    {
      places[v] = this->Points[corners.point[t[v]]];
    }
    for (std::size_t q = 0; q < this->Quantities.size(); ++q)
    {
      const Quantity& quantity = this->Quantities[q];
      if (quantity.components == 1)
      {
        this->Masses[q] += linearMass(places,
          { quantity.values[corners.point[t[0]]], quantity.values[corners.point[t[1]]],
            quantity.values[corners.point[t[2]]], quantity.values[corners.point[t[3]]] });
      }
    }
  }
}

/// What says where clouds are is needed no more, unless it is asked for.
void Voxelizer::keepWanted()
{
  const auto& names = this->Order.names;
  std::vector<Quantity> wanted;
  std::vector<double> masses;
  for (std::size_t q = 0; q < this->Quantities.size(); ++q)
  {
    Quantity& quantity = this->Quantities[q];
    if (names.empty() || std::find(names.begin(), names.end(), quantity.name) != names.end())
    {
      this->Channels += quantity.components;
      this->VectorChannels += quantity.components == 3 ? 3 : 0;
      wanted.push_back(std::move(quantity));
      masses.push_back(this->Masses[q]);
    }
  }
  this->Quantities = std::move(wanted);
  this->Masses = std::move(masses);
}

/// Samples no farther apart than half of what all but a tenth of the cells measure along an axis; at least 2 a voxel.
void Voxelizer::chooseSamples()
{
  constexpr int Most = 16;
  constexpr int MostInAll = 256;
  for (int c = 0; c < 3 && !this->Extents.empty(); ++c)
  {
    std::vector<float> sizes;
    for (const auto& extent : this->Extents)
    {
      sizes.push_back(extent[static_cast<std::size_t>(c)]);
    }
    const auto tenth = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 10);
    std::nth_element(sizes.begin(), tenth, sizes.end());
    const double wanted = std::ceil(2 / std::max(static_cast<double>(*tenth), 1e-3));
    this->Samples[static_cast<std::size_t>(c)] =
      static_cast<int>(std::min(std::max(wanted, 2.0), static_cast<double>(Most)));
  }
  while (this->Samples[0] * this->Samples[1] * this->Samples[2] > MostInAll)
  {
    --*std::max_element(this->Samples.begin(), this->Samples.end());
  }
}

void Voxelizer::addCell(std::uint32_t cell, BrickSampler& sampler) const
{
  const Corners corners = this->cornersOf(cell);
  std::array<std::array<double, BrickSampler::MostQuantities>, 8> at; // [corner][channel]
  for (std::size_t corner = 0; corner < 8; ++corner)
  {
    std::size_t channel = 0;
    for (const Quantity& quantity : this->Quantities)
    {
      const auto n = static_cast<std::size_t>(quantity.components);
      for (std::size_t c = 0; c < n; ++c)
      {
        at[corner][channel++] = quantity.values[n * corners.point[corner] + c];
      }
    }
  }
  std::array<double, 4 * BrickSampler::MostQuantities> values{};
  for (const TetrahedronVertices& t : TetrahedralSplit[static_cast<std::size_t>(corners.parity)])
  {
    std::array<Vector3, 4> places;
    for (std::size_t v = 0; v < 4; ++v)
    {
      places[v] = this->Points[corners.point[t[v]]];
      for (std::size_t channel = 0; channel < static_cast<std::size_t>(this->Channels); ++channel)
      {
        values[4 * channel + v] = at[t[v]][channel];
      }
    }
    sampler.add(places, values.data());
  }
}

void Voxelizer::sampleBrick(std::size_t brick, BrickSampler& sampler, std::vector<float>& means)
{
  const Key& at = this->Pairs[this->Starts[brick]].brick;
  constexpr int Edge = BrickSampler::Edge;
  const std::array<int, 3> origin{ at[2] * Edge, at[1] * Edge, at[0] * Edge };
  sampler.begin(origin);
  for (std::size_t p = this->Starts[brick]; p < this->Starts[brick + 1]; ++p)
  {
    this->addCell(this->Pairs[p].cell, sampler);
  }
  sampler.average(means.data());
  float* values = means.data();
  for (std::size_t q = 0; q < this->Grids.size(); ++q)
  {
    float* const end = values + BrickSampler::Volume * this->Grids[q].components();
    const bool vector = this->Grids[q].components() == 3;
    bool any = false;
    for (float* value = values; value < end; ++value)
    {
      const bool keep = vector || static_cast<double>(*value) > this->Cuts[q];
      *value = keep ? *value : 0.0F;
      any = any || *value != 0;
    }
    if (any)
    {
      this->Grids[q].put(brick, origin, values);
    }
    values = end;
  }
}

/// A grid for each quantity, with places for all bricks.
void Voxelizer::allot()
{
  const Vector3& size = this->Frame.spacing;
  for (const Quantity& quantity : this->Quantities)
  {
    this->Grids.emplace_back(quantity.name, quantity.components, this->Starts.size() - 1);
    FogGrid& grid = this->Grids.back();
    grid.indexToWorld = { size[0], 0, 0, 0, 0, size[1], 0, 0, 0, 0, size[2], 0, 0, 0, 0, 1 };
    grid.metadata.texts["units"] = quantity.units;
    float largest = 0;
    for (const float value : quantity.values)
    {
      largest = value > largest ? value : largest; // not NaN
    }
    this->Cuts.push_back(this->Order.tolerance * static_cast<double>(largest));
  }
}

bool Voxelizer::sample(const VoxelProgress& progress)
{
  struct Own
  {
    std::shared_ptr<BrickSampler> sampler;
    std::vector<float> means;
  };
  const auto bricks = static_cast<vtkIdType>(this->Starts.size()) - 1;
  vtkSMPThreadLocal<Own> owned;
  std::atomic<bool> full{ false }; // memory, which no thread may throw
  const auto sampleBricks = [&owned, &full, this](vtkIdType begin, vtkIdType end)
  {
    try
    {
      Own& own = owned.Local();
      if (!own.sampler)
      {
        own.sampler = std::make_shared<BrickSampler>(
          this->Frame, this->Samples, this->Channels, this->VectorChannels);
        own.means.resize(static_cast<std::size_t>(this->Channels) * BrickSampler::Volume);
      }
      for (vtkIdType brick = begin; brick < end; ++brick)
      {
        this->sampleBrick(static_cast<std::size_t>(brick), *own.sampler, own.means);
      }
    }
    catch (const std::bad_alloc&)
    {
      full = true;
    }
  };
  constexpr vtkIdType Parts = 20;
  for (vtkIdType part = 0; part < Parts; ++part)
  {
    if (!progress(static_cast<double>(part) / Parts))
    {
      return false;
    }
    vtkSMPTools::For(bricks * part / Parts, bricks * (part + 1) / Parts, sampleBricks);
    if (full)
    {
      throw std::bad_alloc();
    }
  }
  return true;
}

/// Make the sum of a scalar's values that of the tetrahedra.
void Voxelizer::conserve(std::size_t quantity)
{
  FogGrid& grid = this->Grids[quantity];
  if (grid.components() != 1)
  {
    return;
  }
  const Vector3& size = this->Frame.spacing;
  const double mass = this->Masses[quantity];
  const double sum = grid.sum();
  if (mass > 0 && !(sum > 0))
  {
    throw VDBError("No voxel of " + numberText(size[0]) + " x " + numberText(size[1]) + " x " +
      numberText(size[2]) + " meets the clouds of '" + grid.name() +
      "'; choose smaller voxels, or prune less");
  }
  const double factor = sum > 0 ? mass / (sum * size[0] * size[1] * size[2]) : 1;
  grid.multiply(factor);
  grid.tolerance = factor * this->Cuts[quantity];
  grid.metadata.numbers["mass"] = mass;
  grid.metadata.numbers["mass_factor"] = factor;
  grid.metadata.numbers["pruning_tolerance"] = grid.tolerance;
  grid.metadata.texts["interpolation"] = "means over voxels, of " +
    std::to_string(this->Samples[0]) + " x " + std::to_string(this->Samples[1]) + " x " +
    std::to_string(this->Samples[2]) +
    " samples, of what is linear in five tetrahedra a cell; times mass_factor";
}
}

std::vector<FogGrid> voxelsOf(
  vtkStructuredGrid* grid, const VoxelOrder& order, const VoxelProgress& progress)
{
  int size[3];
  grid->GetDimensions(size);
  if (size[0] < 2 || size[1] < 2 || size[2] < 2)
  {
    throw VDBError("The grid of " + std::to_string(size[0]) + " x " + std::to_string(size[1]) +
      " x " + std::to_string(size[2]) + " points has no cells; give two at least along each axis");
  }
  if (static_cast<double>(size[0]) * size[1] * size[2] > 2e9 ||
    grid->GetNumberOfPoints() != static_cast<vtkIdType>(size[0]) * size[1] * size[2])
  {
    throw VDBError("The grid has " + std::to_string(grid->GetNumberOfPoints()) +
      " points, not those of its dimensions; give one for each place");
  }
  return Voxelizer(grid, order).make(progress);
}
}
