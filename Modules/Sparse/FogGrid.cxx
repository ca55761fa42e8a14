// SPDX-License-Identifier: BSD-3-Clause
#include "FogGrid.h"

#include "MemoryFile.h"

#include <openvdb/io/Archive.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Prune.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <map>
#include <mutex>
#include <numeric>
#include <sstream>
#include <thread>

namespace nephoscope
{
class FogGrid::Leaves
{
public:
  virtual ~Leaves() = default;
  virtual void put(std::size_t place, const std::array<int, 3>& origin, const float* values) = 0;
  virtual std::size_t bricks() const = 0;
  virtual std::size_t voxels() const = 0;
  virtual void multiply(double factor) = 0;
  /// The grid, to which the leaves go.
  virtual openvdb::GridBase::Ptr grid(double tolerance) = 0;
};

namespace
{
constexpr int Edge = VoxelGrid::Edge;

float valueAt(const float* brick, int voxel, float)
{
  return brick[voxel];
}
openvdb::Vec3f valueAt(const float* brick, int voxel, const openvdb::Vec3f&)
{
  constexpr int Volume = VoxelGrid::Volume;
  return { brick[voxel], brick[Volume + voxel], brick[2 * Volume + voxel] };
}

template <class Grid>
class LeavesOf : public FogGrid::Leaves
{
public:
  explicit LeavesOf(std::size_t places)
    : Places(places)
  {
  }

  void put(std::size_t place, const std::array<int, 3>& origin, const float* values) override
  {
    auto leaf = std::make_unique<Leaf>(
      openvdb::PartialCreate(), openvdb::Coord(origin[0], origin[1], origin[2]));
    leaf->allocate();
    Value* to = leaf->buffer().data();
    typename Leaf::NodeMaskType mask;
    for (int i = 0; i < Edge; ++i) // z fastest, a word of the mask for each x
    {
      std::uint64_t word = 0;
      for (int jk = 0; jk < Edge * Edge; ++jk)
      {
        const Value value = valueAt(values, (jk % Edge * Edge + jk / Edge) * Edge + i, Value());
        word |= static_cast<std::uint64_t>(value != openvdb::zeroVal<Value>()) << jk;
        *to++ = value;
      }
      mask.template getWord<std::uint64_t>(static_cast<openvdb::Index>(i)) = word;
    }
    leaf->setValueMask(mask);
    if (!mask.isOff())
    {
      this->Places[place] = std::move(leaf);
    }
  }

  std::size_t bricks() const override
  {
    return this->count([](const Leaf&) { return 1; });
  }
  std::size_t voxels() const override
  {
    return this->count([](const Leaf& leaf) { return leaf.onVoxelCount(); });
  }

  void multiply(double factor) override
  {
    vtkSMPTools::For(0, static_cast<vtkIdType>(this->Places.size()),
      [this, factor](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType place = begin; place < end; ++place)
        {
          Leaf* const leaf = this->Places[static_cast<std::size_t>(place)].get();
          for (std::size_t v = 0; leaf && v < VoxelGrid::Volume; ++v)
          {
            Value& value = leaf->buffer().data()[v];
            value = Value(value * factor);
          }
        }
      });
  }

  openvdb::GridBase::Ptr grid(double tolerance) override
  {
    const auto made = Grid::create(openvdb::zeroVal<Value>());
    for (std::unique_ptr<Leaf>& leaf : this->Places)
    {
      if (leaf)
      {
        made->tree().addLeaf(leaf.release());
      }
    }
    openvdb::tools::prune(made->tree(), Value(static_cast<float>(tolerance)));
    return made;
  }

private:
  using Value = typename Grid::ValueType;
  using Leaf = typename Grid::TreeType::LeafNodeType;

  template <class Count>
  std::size_t count(Count&& of) const
  {
    std::size_t all = 0;
    for (const std::unique_ptr<Leaf>& leaf : this->Places)
    {
      all += leaf ? static_cast<std::size_t>(of(*leaf)) : 0;
    }
    return all;
  }

  std::vector<std::unique_ptr<Leaf>> Places;
};

std::unique_ptr<FogGrid::Leaves> leavesFor(int components, std::size_t places)
{
  if (components == 1)
  {
    return std::make_unique<LeavesOf<openvdb::FloatGrid>>(places);
  }
  return std::make_unique<LeavesOf<openvdb::Vec3SGrid>>(places);
}

void putMetadata(const VoxelMetadata& from, openvdb::MetaMap& to)
{
  for (const auto& [key, text] : from.texts)
  {
    to.insertMeta(key, openvdb::StringMetadata(text));
  }
  for (const auto& [key, number] : from.numbers)
  {
    to.insertMeta(key, openvdb::DoubleMetadata(number));
  }
}

/// OpenVDB's matrices stand left of row vectors: the transpose of ours.
openvdb::math::Transform::Ptr transformOf(const std::array<double, 16>& m)
{
  openvdb::math::Mat4d matrix;
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      matrix[column][row] = m[static_cast<std::size_t>(4 * row + column)];
    }
  }
  // A map of scales and a translation alone is written as such, which more programs understand.
  return openvdb::math::Transform::createLinearTransform(matrix);
}

openvdb::GridBase::Ptr gridOf(FogGrid& from, bool half)
{
  openvdb::GridBase::Ptr grid = from.leaves().grid(from.tolerance);
  grid->setTransform(transformOf(from.indexToWorld));
  grid->setName(from.name());
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  grid->setVectorType(
    from.components() == 1 ? openvdb::VEC_INVARIANT : openvdb::VEC_CONTRAVARIANT_RELATIVE);
  grid->setSaveFloatAsHalf(half);
  putMetadata(from.metadata, *grid);
  return grid;
}

/// A grid as it will stand in the file, but for where.
struct Part
{
  openvdb::io::GridDescriptor descriptor;
  std::unique_ptr<MemoryFile> bytes;
  bool made = false;
};

/// That progress said stop.
struct Stopped
{
};

/// Writes grids to one file, of which OpenVDB's own File does not notice that the disk is full.
class Saver : public openvdb::io::Archive
{
public:
  Saver(const std::string& path, std::vector<FogGrid>& grids, bool half, VoxelProgress progress)
    : Path(path)
    , Stream(path, std::ios::binary)
    , Grids(grids)
    , Half(half)
    , Progress(std::move(progress))
    , Parts(grids.size())
  {
    for (const FogGrid& grid : grids)
    {
      this->Expected +=
        static_cast<double>(grid.bricks() * VoxelGrid::Volume) * grid.components() * (half ? 2 : 4);
    }
  }

  void save(const VoxelMetadata& about)
  {
    this->writePrelude(about);
    std::vector<std::size_t> order(this->Parts.size());
    std::iota(order.begin(), order.end(), std::size_t{ 0 });
    const auto size = [this](std::size_t g)
    { return this->Grids[g].bricks() * static_cast<std::size_t>(this->Grids[g].components()); };
    std::stable_sort(order.begin(), order.end(),
      [&size](std::size_t a, std::size_t b) { return size(a) > size(b); });
    std::atomic<std::size_t> next{ 0 };
    forEachGrid(order.size(),
      [this, &order, &next](std::size_t)
      {
        const std::size_t g = order[next++];
        this->make(g);
        this->appendWhatIsMade(g);
      });
    this->Stream.close();
    this->check();
  }

private:
  void check()
  {
    if (!this->Stream)
    {
      throw VDBError(this->Path + ": cannot be written; is the disk full?");
    }
  }

  /// The beginning of a file of no grids, and how many there will be.
  void writePrelude(const VoxelMetadata& about)
  {
    openvdb::MetaMap metadata;
    putMetadata(about, metadata);
    std::ostringstream none(std::ios::binary);
    this->Archive::write(none, openvdb::GridCPtrVec(), true, metadata);
    const auto count = static_cast<std::int32_t>(this->Parts.size());
    std::string bytes = none.str();
    bytes.resize(bytes.size() - sizeof count);
    this->Stream << bytes;
    this->Stream.write(reinterpret_cast<const char*>(&count), sizeof count);
    this->check();
  }

  /// Of several grids of one name all but the first get a number.
  std::string uniqueName(std::size_t g) const
  {
    const std::string& name = this->Grids[g].name();
    const auto before =
      std::count_if(this->Grids.begin(), this->Grids.begin() + static_cast<std::ptrdiff_t>(g),
        [&name](const FogGrid& other) { return other.name() == name; });
    return before == 0 && !name.empty()
      ? name
      : openvdb::io::GridDescriptor::addSuffix(name, static_cast<int>(before));
  }

  void make(std::size_t g)
  {
    const openvdb::GridBase::Ptr grid = gridOf(this->Grids[g], this->Half);
    Part& part = this->Parts[g];
    part.descriptor =
      openvdb::io::GridDescriptor(this->uniqueName(g), grid->type(), grid->saveFloatAsHalf());
    part.bytes = std::make_unique<MemoryFile>([this](std::size_t bytes) { this->tell(bytes); });
    std::ostream stream(part.bytes.get());
    stream.exceptions(std::ios::badbit);
    auto settings = std::make_shared<openvdb::io::StreamMetadata>();
    openvdb::io::setStreamMetadataPtr(stream, settings, false);
    openvdb::io::setDataCompression(stream, this->compression());
    openvdb::io::setWriteGridStatsMetadata(stream, this->isGridStatsMetadataEnabled());
    this->writeGrid(part.descriptor, grid, stream, true);
  }

  /// One thread at a time appends to the file, in order; the others go on with the next grid.
  void appendWhatIsMade(std::size_t g)
  {
    std::unique_lock<std::mutex> lock(this->Order);
    this->Parts[g].made = true;
    if (this->Appending)
    {
      return;
    }
    this->Appending = true;
    for (; this->Appended < this->Parts.size() && this->Parts[this->Appended].made;
         ++this->Appended)
    {
      lock.unlock();
      this->append(this->Parts[this->Appended]);
      lock.lock();
    }
    this->Appending = false;
  }

  void append(Part& part)
  {
    const auto here = static_cast<std::int64_t>(this->Stream.tellp());
    openvdb::io::GridDescriptor& at = part.descriptor;
    const std::int64_t begin = at.getGridPos();
    at.setGridPos(begin + here);
    at.setBlockPos(at.getBlockPos() + here);
    at.setEndPos(at.getEndPos() + here);
    at.writeHeader(this->Stream);
    at.writeStreamPos(this->Stream);
    part.bytes->copyTo(this->Stream, static_cast<std::size_t>(begin));
    part.bytes.reset();
    this->check();
  }

  void tell(std::size_t bytes)
  {
    this->Told += bytes;
    if (std::this_thread::get_id() == this->Caller &&
      !this->Progress(std::min(static_cast<double>(this->Told) / this->Expected, 1.0)))
    {
      this->Stop = true;
    }
    if (this->Stop)
    {
      throw Stopped();
    }
  }

  std::string Path;
  std::ofstream Stream;
  std::vector<FogGrid>& Grids;
  bool Half;
  VoxelProgress Progress;
  std::vector<Part> Parts;
  double Expected = 1; ///< bytes
  std::atomic<std::size_t> Told{ 0 };
  std::atomic<bool> Stop{ false };
  std::thread::id Caller = std::this_thread::get_id();
  std::mutex Order;
  bool Appending = false;
  std::size_t Appended = 0; ///< parts
};
}

FogGrid::FogGrid(const std::string& name, int components, std::size_t places)
  : indexToWorld{ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 }
  , Name(name)
  , Components(components)
  , Sums(places, 0)
  , Made(leavesFor(components, places))
{
}

FogGrid::~FogGrid() = default;
FogGrid::FogGrid(FogGrid&& other) noexcept = default;
FogGrid& FogGrid::operator=(FogGrid&& other) noexcept = default;

void FogGrid::put(std::size_t place, const std::array<int, 3>& origin, const float* values)
{
  if (this->Components == 1)
  {
    this->Sums[place] = std::accumulate(values, values + VoxelGrid::Volume, 0.0);
  }
  this->Made->put(place, origin, values);
}

std::size_t FogGrid::bricks() const
{
  return this->Made->bricks();
}

std::size_t FogGrid::voxels() const
{
  return this->Made->voxels();
}

double FogGrid::sum() const
{
  return std::accumulate(this->Sums.begin(), this->Sums.end(), 0.0);
}

void FogGrid::multiply(double factor)
{
  this->Made->multiply(factor);
  for (double& sum : this->Sums)
  {
    sum *= factor;
  }
}

bool writeVDB(const std::string& path, std::vector<FogGrid>& grids, bool half,
  const VoxelMetadata& metadata, const VoxelProgress& progress)
{
  openvdb::initialize();
  try
  {
    Saver(path, grids, half, progress).save(metadata);
  }
  catch (const Stopped&)
  {
    return false;
  }
  catch (const openvdb::Exception& error)
  {
    throw VDBError(path + ": cannot be written: " + error.what());
  }
  return true;
}
}
