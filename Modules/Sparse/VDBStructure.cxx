// SPDX-License-Identifier: BSD-3-Clause
#include "VDBStructure.h"

#include "VDBCursor.h"

#include <algorithm>
#include <bitset>
#include <map>
#include <set>

namespace nephoscope
{
namespace
{
enum Compression : std::uint32_t
{
  Zip = 1,
  ActiveValues = 2,
  Blosc = 4
};

using Mask = std::vector<std::uint8_t>;

std::int64_t bitsOf(const Mask& mask)
{
  std::int64_t bits = 0;
  for (const std::uint8_t byte : mask)
  {
    bits += static_cast<std::int64_t>(std::bitset<8>(byte).count());
  }
  return bits;
}

/// Walks a grid from its compression flags to its last block.
class Walk
{
public:
  Walk(VDBCursor& cursor, std::int64_t valueBytes, std::int64_t storedBytes)
    : Cursor(cursor)
    , ValueBytes(valueBytes)
    , StoredBytes(storedBytes)
  {
  }

  void tree(std::uint32_t compression)
  {
    this->Flags = compression;
    this->Cursor.skip(4 + this->ValueBytes); // number of buffers, background
    const auto tiles = this->Cursor.number<std::uint32_t>();
    const auto children = this->Cursor.number<std::uint32_t>();
    for (std::uint32_t tile = 0; tile < tiles; ++tile)
    {
      this->rootPlace();
      this->Cursor.skip(this->ValueBytes + 1);
    }
    std::int64_t leaves = 0;
    for (std::uint32_t child = 0; child < children; ++child)
    {
      this->rootPlace();
      for (std::int64_t node = this->node(1 << 15); node > 0; --node)
      {
        const std::int64_t below = this->node(1 << 12);
        this->Cursor.skip(LeafMask * below);
        leaves += below;
      }
    }
    for (; leaves > 0; --leaves)
    {
      const Mask mask = this->mask(LeafMask);
      this->values(mask);
    }
  }

private:
  static constexpr std::int64_t LeafMask = VoxelGrid::Volume / 8; // bytes

  /// Each place of the root has one node or tile.
  void rootPlace()
  {
    std::array<std::int32_t, 3> place{};
    this->Cursor.read(place.data(), sizeof place);
    if (!this->Places.insert(place).second)
    {
      this->Cursor.fail();
    }
  }

  Mask mask(std::int64_t bytes)
  {
    Mask mask(static_cast<std::size_t>(bytes));
    this->Cursor.read(mask.data(), mask.size());
    return mask;
  }

  /// An inner node; returns how many nodes are below it.
  std::int64_t node(std::int64_t places)
  {
    const Mask children = this->mask(places / 8);
    const Mask active = this->mask(places / 8);
    for (std::size_t n = 0; n < children.size(); ++n)
    {
      if ((children[n] & active[n]) != 0)
      {
        this->Cursor.fail();
      }
    }
    this->values(active);
    return bitsOf(children);
  }

  /// The values of a node: a byte that says how, up to two inactive values, a mask that selects among these, the others.
  void values(const Mask& active)
  {
    const auto how = this->Cursor.number<std::int8_t>();
    constexpr int OneInactive = 2;
    constexpr int Selected = 3;
    constexpr int SelectedOne = 4;
    constexpr int SelectedTwo = 5;
    constexpr int All = 6;
    const int inactive =
      how == SelectedTwo ? 2 : static_cast<int>(how == OneInactive || how == SelectedOne);
    const auto maskBytes = static_cast<std::int64_t>(active.size());
    this->Cursor.skip(inactive * this->ValueBytes);
    this->Cursor.skip(how >= Selected && how <= SelectedTwo ? maskBytes : 0);
    const bool activeAlone = (this->Flags & ActiveValues) != 0 && how != All;
    this->block(activeAlone ? bitsOf(active) : 8 * maskBytes);
  }

  void block(std::int64_t count)
  {
    const std::int64_t bytes = count * this->StoredBytes;
    if ((this->Flags & (Zip | Blosc)) == 0)
    {
      this->Cursor.skip(bytes);
      return;
    }
    if (count == 0 && this->StoredBytes != this->ValueBytes)
    {
      return; // no half floats, no block
    }
    const auto length = this->Cursor.number<std::int64_t>();
    if (length <= 0)
    {
      if (length != -bytes) // not compressed
      {
        this->Cursor.fail();
      }
      this->Cursor.skip(bytes);
      return;
    }
    if ((this->Flags & Blosc) != 0)
    {
      this->bloscHeader(length, bytes);
    }
    this->Cursor.skip(length);
  }

  /// Blosc goes by lengths of its own.
  void bloscHeader(std::int64_t length, std::int64_t bytes)
  {
    const std::int64_t at = this->Cursor.at();
    this->Cursor.skip(4);
    const auto whole = this->Cursor.number<std::uint32_t>();
    this->Cursor.skip(4);
    const auto compressed = this->Cursor.number<std::uint32_t>();
    if (length < 16 || whole != bytes || compressed != length)
    {
      this->Cursor.fail();
    }
    this->Cursor.seek(at);
  }

  VDBCursor& Cursor;
  std::int64_t ValueBytes;
  std::int64_t StoredBytes; ///< the same, or of half floats
  std::uint32_t Flags = 0;
  std::set<std::array<std::int32_t, 3>> Places;
};

/// Rename the types whose values OpenVDB would not read by the length that is declared.
void renameOddTypes(std::string& bytes, const std::vector<VDBMetadataEntry>& metadata)
{
  static const std::map<std::string, std::uint32_t> sizes{ { "bool", 1 }, { "int32", 4 },
    { "int64", 8 }, { "float", 4 }, { "double", 8 }, { "vec2i", 8 }, { "vec2s", 8 },
    { "vec2d", 16 }, { "vec3i", 12 }, { "vec3s", 12 }, { "vec3d", 24 }, { "vec4i", 16 },
    { "vec4s", 16 }, { "vec4d", 32 }, { "mat4s", 64 }, { "mat4d", 128 } };
  for (const VDBMetadataEntry& entry : metadata)
  {
    const auto size = sizes.find(entry.type);
    const bool known =
      entry.type == "string" || (size != sizes.end() && size->second == entry.size);
    if (!known && !entry.type.empty())
    {
      bytes[static_cast<std::size_t>(entry.typeAt)] = '?';
    }
  }
}

/// The grid's own metadata say whether its floats are halves.
bool savedAsHalf(
  VDBCursor& cursor, const std::string& bytes, const std::vector<VDBMetadataEntry>& metadata)
{
  bool half = false;
  for (const VDBMetadataEntry& entry : metadata)
  {
    if (entry.name == "is_saved_as_half_float")
    {
      if (entry.type != "bool" || entry.size != 1)
      {
        cursor.fail();
      }
      half = bytes[static_cast<std::size_t>(entry.begin)] != 0;
    }
  }
  return half;
}

void skipTransform(VDBCursor& cursor)
{
  constexpr std::int64_t Vector = 3 * 8;
  static const std::map<std::string, std::int64_t> sizes{ { "AffineMap", 16 * 8 },
    { "UnitaryMap", 16 * 8 }, { "ScaleMap", 5 * Vector }, { "UniformScaleMap", 5 * Vector },
    { "TranslationMap", Vector }, { "ScaleTranslateMap", 6 * Vector },
    { "UniformScaleTranslateMap", 6 * Vector } };
  const std::string type = cursor.text();
  if (type == "NonlinearFrustumMap")
  {
    throw VDBError(cursor.path() +
      ": has a frustum transform, whose voxels are no boxes; resample it to a linear one");
  }
  const auto size = sizes.find(type);
  if (size == sizes.end())
  {
    cursor.fail();
  }
  cursor.skip(size->second);
}

/// @return bytes of a value in memory, and as a half float
std::pair<std::int64_t, std::int64_t> valueBytes(VDBCursor& cursor, const std::string& type)
{
  static const std::map<std::string, std::pair<std::int64_t, std::int64_t>> bytes{
    { "Tree_float_5_4_3", { 4, 2 } }, { "Tree_double_5_4_3", { 8, 2 } },
    { "Tree_vec3s_5_4_3", { 12, 6 } }
  };
  const auto found = bytes.find(type.substr(0, type.find("_HalfFloat")));
  if (found == bytes.end())
  {
    cursor.fail();
  }
  return found->second;
}
}

void checkVDBStructure(const std::string& path, std::string& bytes)
{
  ByteBuffer buffer(bytes);
  std::istream stream(&buffer);
  VDBCursor cursor(path, stream);
  renameOddTypes(bytes, readVDBPrelude(cursor));
  cursor.skip(4); // number of grids
  cursor.text();  // its name
  const auto [whole, half] = valueBytes(cursor, cursor.text());
  cursor.text(); // whose instance it is
  cursor.skip(3 * 8);
  const auto compression = cursor.number<std::uint32_t>();
  const std::vector<VDBMetadataEntry> metadata = readVDBMetadata(cursor);
  const bool asHalf = savedAsHalf(cursor, bytes, metadata);
  renameOddTypes(bytes, metadata);
  skipTransform(cursor);
  Walk(cursor, whole, asHalf ? half : whole).tree(compression);
}
}
