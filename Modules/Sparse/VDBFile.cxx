// SPDX-License-Identifier: BSD-3-Clause
#include "VDBFile.h"

#include "VDBHeader.h"
#include "VDBStructure.h"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetUtil.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <type_traits>

namespace nephoscope
{
namespace
{
constexpr std::size_t Leaf = VoxelGrid::Volume;

/// Place of voxel (i, j, k) of a leaf in OpenVDB's order, which is z fastest.
constexpr std::size_t leafPlace(int i, int j, int k)
{
  return static_cast<std::size_t>((i << 6) | (j << 3) | k);
}

/// Calls visit(place in a brick, place in a leaf) for each voxel.
template <class Visit>
void forEachVoxel(Visit&& visit)
{
  std::size_t place = 0;
  for (int k = 0; k < VoxelGrid::Edge; ++k)
  {
    for (int j = 0; j < VoxelGrid::Edge; ++j)
    {
      for (int i = 0; i < VoxelGrid::Edge; ++i)
      {
        visit(place++, leafPlace(i, j, k));
      }
    }
  }
}

void put(float* values, std::size_t voxel, double value)
{
  values[voxel] = static_cast<float>(value);
}
void put(float* values, std::size_t voxel, const openvdb::Vec3f& value)
{
  for (std::size_t c = 0; c < 3; ++c)
  {
    values[3 * voxel + c] = value[static_cast<int>(c)];
  }
}

/// What OpenVDB itself writes of a grid, and says in other ways when it is read.
bool isOwnKey(const std::string& key)
{
  return key == "class" || key == "name" || key == "value_type" || key == "vector_type" ||
    key.rfind("file_", 0) == 0 || key.rfind("is_", 0) == 0;
}

void takeMetadata(const openvdb::MetaMap& from, VoxelMetadata& to)
{
  for (auto entry = from.beginMeta(); entry != from.endMeta(); ++entry)
  {
    if (isOwnKey(entry->first))
    {
      continue;
    }
    const openvdb::Metadata& value = *entry->second;
    if (const auto* const number = dynamic_cast<const openvdb::DoubleMetadata*>(&value))
    {
      to.numbers[entry->first] = number->value();
    }
    else
    {
      to.texts[entry->first] = value.str();
    }
  }
}

/// The bytes of a file that make it one of a single grid.
std::string streamOfGrid(const std::string& path, const VDBHeader& header, const VDBEntry& entry)
{
  std::ifstream file(path, std::ios::binary);
  const std::int32_t one = 1;
  const std::int64_t rest = entry.end - entry.begin;
  std::string bytes(static_cast<std::size_t>(header.gridCount + 4 + rest), '\0');
  file.read(bytes.data(), header.gridCount);
  bytes.replace(
    static_cast<std::size_t>(header.gridCount), 4, reinterpret_cast<const char*>(&one), sizeof one);
  file.seekg(entry.begin);
  file.read(bytes.data() + header.gridCount + 4, rest);
  if (!file)
  {
    throw VDBError(path + ": cannot be read");
  }
  return bytes;
}

bool isReadable(const VDBEntry& entry)
{
  return !entry.instance &&
    (entry.type == openvdb::FloatGrid::gridType() ||
      entry.type == openvdb::DoubleGrid::gridType() ||
      entry.type == openvdb::Vec3SGrid::gridType());
}

const VDBEntry& chooseGrid(
  const std::string& path, const VDBHeader& header, const std::string& name)
{
  const VDBEntry* chosen = nullptr;
  std::string names;
  for (const VDBEntry& entry : header.grids)
  {
    names += (names.empty() ? "" : ", ") + ("'" + entry.name + "'") + " (" + entry.type + ")";
    const bool meant = name.empty() ? isReadable(entry) && (!chosen || entry.name == "density")
                                    : entry.name == name && !chosen;
    chosen = meant && !(chosen && chosen->name == "density") ? &entry : chosen;
  }
  if (!chosen)
  {
    throw VDBError(path + ": has no grid " + (name.empty() ? "of floats" : "'" + name + "'") +
      "; it has " + (names.empty() ? "none" : names));
  }
  if (!isReadable(*chosen))
  {
    throw VDBError(path + ": the grid '" + chosen->name + "' is " +
      (chosen->instance ? "an instance of another grid" : "of type " + chosen->type) +
      "; only grids of floats, doubles and float vectors are read");
  }
  return *chosen;
}

/// What the metadata says of the size, before the tree is walked.
void checkDeclared(const std::string& subject, const openvdb::GridBase& grid, double maximumVoxels)
{
  const auto declared =
    grid.getMetadata<openvdb::Int64Metadata>(openvdb::GridBase::META_FILE_VOXEL_COUNT);
  if (declared && static_cast<double>(declared->value()) > maximumVoxels)
  {
    throw VDBError(subject + " declares " + std::to_string(declared->value()) +
      " active voxels, more than the " + std::to_string(static_cast<long long>(maximumVoxels)) +
      " allowed; raise MaximumVoxels, or resample it to larger voxels");
  }
  const auto low = grid.getMetadata<openvdb::Vec3IMetadata>(openvdb::GridBase::META_FILE_BBOX_MIN);
  const auto high = grid.getMetadata<openvdb::Vec3IMetadata>(openvdb::GridBase::META_FILE_BBOX_MAX);
  const bool empty = declared && declared->value() == 0; // whose box is inverted by convention
  for (int c = 0; low && high && !empty && c < 3; ++c)
  {
    if (low->value()[c] > high->value()[c])
    {
      throw VDBError(subject +
        " declares a bounding box that ends before it begins; the file is damaged, get it again");
    }
  }
}

std::array<double, 16> matrixOf(
  const std::string& subject, const openvdb::math::Transform& transform)
{
  if (!transform.isLinear())
  {
    throw VDBError(
      subject + " has a frustum transform, whose voxels are no boxes; resample it to a linear one");
  }
  const openvdb::math::Mat4d matrix = transform.baseMap()->getAffineMap()->getMat4();
  std::array<double, 16> m{};
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      m[static_cast<std::size_t>(4 * row + column)] = matrix[column][row];
    }
  }
  const double volume = std::abs(matrix.getMat3().det());
  if (!(volume > 0) || !std::isfinite(volume))
  {
    throw VDBError(subject + " has a transform without volume; save it with a voxel size above 0");
  }
  return m;
}

/// Active voxels, those of tiles included, as bricks of 512.
template <class Tree>
double brickVoxels(const Tree& tree)
{
  double voxels = static_cast<double>(tree.leafCount()) * Leaf;
  auto tile = tree.cbeginValueOn();
  tile.setMaxDepth(Tree::ValueOnCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile)
  {
    voxels += static_cast<double>(tile.getVoxelCount());
  }
  return voxels;
}

template <class Tree>
void takeLeaves(const Tree& tree, VoxelGrid& to)
{
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf)
  {
    if (leaf->isEmpty())
    {
      continue;
    }
    const openvdb::Coord origin = leaf->origin();
    to.bricks.push_back({ origin[0], origin[1], origin[2] });
    const std::size_t first = to.values.size();
    to.values.resize(first + to.floatsPerBrick(), 0.0F);
    forEachVoxel(
      [&](std::size_t voxel, std::size_t place)
      {
        const auto at = static_cast<openvdb::Index>(place);
        if (leaf->isValueOn(at))
        {
          put(to.values.data() + first, voxel, leaf->getValue(at));
        }
      });
  }
}

/// Active tiles, as bricks of one value.
template <class Tree>
void takeTiles(const Tree& tree, VoxelGrid& to)
{
  auto tile = tree.cbeginValueOn();
  tile.setMaxDepth(Tree::ValueOnCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile)
  {
    openvdb::CoordBBox box;
    tile.getBoundingBox(box);
    const openvdb::Coord first = box.min();
    const openvdb::Coord size = box.dim();
    for (int k = 0; k < size[2]; k += VoxelGrid::Edge)
    {
      for (int j = 0; j < size[1]; j += VoxelGrid::Edge)
      {
        for (int i = 0; i < size[0]; i += VoxelGrid::Edge)
        {
          to.bricks.push_back({ first[0] + i, first[1] + j, first[2] + k });
          const std::size_t values = to.values.size();
          to.values.resize(values + to.floatsPerBrick());
          for (std::size_t voxel = 0; voxel < Leaf; ++voxel)
          {
            put(to.values.data() + values, voxel, tile.getValue());
          }
        }
      }
    }
  }
}

template <class Grid>
void makeFog(const std::string& subject, Grid& grid, std::vector<std::string>& warnings)
{
  if constexpr (std::is_floating_point_v<typename Grid::ValueType>)
  {
    if (grid.getGridClass() == openvdb::GRID_LEVEL_SET)
    {
      if (!(grid.background() > 0))
      {
        throw VDBError(subject + " is a level set without a band about its surface; rebuild it");
      }
      openvdb::tools::sdfToFogVolume(grid);
      warnings.push_back(subject +
        " is a level set; made fog of it, 1 inside and falling to 0 in the band about its surface");
    }
  }
}

template <class Grid>
void takeGrid(
  const std::string& subject, openvdb::GridBase& base, double maximumVoxels, VDBReadResult& result)
{
  auto& grid = static_cast<Grid&>(base);
  makeFog(subject, grid, result.warnings);
  const double voxels = brickVoxels(grid.tree());
  if (voxels > maximumVoxels)
  {
    throw VDBError(subject + " has " + std::to_string(static_cast<long long>(voxels)) +
      " voxels in its bricks, more than the " +
      std::to_string(static_cast<long long>(maximumVoxels)) +
      " allowed; raise MaximumVoxels, or resample it to larger voxels");
  }
  takeLeaves(grid.tree(), result.grid);
  takeTiles(grid.tree(), result.grid);
  for (float& value : result.grid.values)
  {
    if (!std::isfinite(value))
    {
      throw VDBError(subject + " has a voxel that is no finite number; the file is damaged");
    }
  }
  if (result.grid.bricks.empty())
  {
    result.warnings.push_back(subject + " has no active voxel");
  }
}

/// The one grid of a stream. Reading past its end throws.
openvdb::GridBase::Ptr parse(std::string& bytes, VoxelMetadata& metadata)
{
  ByteBuffer buffer(bytes);
  std::istream stream(&buffer);
  stream.exceptions(std::ios::eofbit | std::ios::failbit | std::ios::badbit);
  openvdb::io::Stream parsed(stream, false);
  if (const auto file = parsed.getMetadata())
  {
    takeMetadata(*file, metadata);
  }
  const auto grids = parsed.getGrids();
  return grids && !grids->empty() ? grids->front() : openvdb::GridBase::Ptr();
}

/// The grid of a file, as bricks. @throw VDBError, or what OpenVDB throws of damaged files
void readGrid(const std::string& path, const std::string& subject, const VDBHeader& header,
  const VDBEntry& entry, double maximumVoxels, VDBReadResult& result)
{
  std::string bytes = streamOfGrid(path, header, entry);
  checkVDBStructure(path, bytes);
  const openvdb::GridBase::Ptr grid = parse(bytes, result.grid.metadata);
  if (!grid || grid->type() != entry.type)
  {
    throw VDBError(subject + " is not what the file's header says; get the file again");
  }
  checkDeclared(subject, *grid, maximumVoxels);
  takeMetadata(*grid, result.grid.metadata);
  result.grid.name = entry.name;
  result.grid.components = entry.type == openvdb::Vec3SGrid::gridType() ? 3 : 1;
  result.grid.indexToWorld = matrixOf(subject, grid->transform());
  if (result.grid.components == 3)
  {
    takeGrid<openvdb::Vec3SGrid>(subject, *grid, maximumVoxels, result);
  }
  else if (entry.type == openvdb::FloatGrid::gridType())
  {
    takeGrid<openvdb::FloatGrid>(subject, *grid, maximumVoxels, result);
  }
  else
  {
    takeGrid<openvdb::DoubleGrid>(subject, *grid, maximumVoxels, result);
  }
}
}

VDBReadResult readVDB(const std::string& path, const std::string& name, double maximumVoxels)
{
  openvdb::initialize();
  const VDBHeader header = readVDBHeader(path);
  const VDBEntry& entry = chooseGrid(path, header, name);
  const std::string subject = path + ": the grid '" + entry.name + "'";
  VDBReadResult result;
  try
  {
    readGrid(path, subject, header, entry, maximumVoxels, result);
  }
  catch (const VDBError&)
  {
    throw;
  }
  catch (const std::exception& error)
  {
    throw VDBError(subject + " is damaged (" + error.what() + "); get the file again");
  }
  return result;
}
}
