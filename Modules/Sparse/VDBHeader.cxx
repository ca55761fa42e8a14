// SPDX-License-Identifier: BSD-3-Clause
#include "VDBHeader.h"

#include "VoxelGrid.h"

#include <fstream>

namespace nephoscope
{
namespace
{
constexpr std::int64_t Magic = 0x56444220;   // "VDB "
constexpr std::uint32_t OldestVersion = 218; // since then files have a UUID of 36 letters
constexpr std::uint32_t NewestVersion = 224;

/// Reads little-endian values and knows how many bytes are left.
class Cursor
{
public:
  explicit Cursor(const std::string& path)
    : Path(path)
    , Stream(path, std::ios::binary | std::ios::ate)
  {
    if (!this->Stream)
    {
      throw VDBError(path + ": cannot be opened; check its name");
    }
    this->Size = this->Stream.tellg();
    this->Stream.seekg(0);
  }

  std::int64_t at() { return this->Stream.tellg(); }
  std::int64_t size() const { return this->Size; }

  void seek(std::int64_t place)
  {
    if (place < 0 || place > this->Size)
    {
      this->fail();
    }
    this->Stream.seekg(place);
  }

  template <class T>
  T number()
  {
    T value{};
    this->Stream.read(reinterpret_cast<char*>(&value), sizeof value);
    if (!this->Stream)
    {
      this->fail();
    }
    return value;
  }

  std::string text()
  {
    const auto length = this->number<std::uint32_t>();
    if (length > 65536 || length > this->Size - this->at())
    {
      this->fail();
    }
    std::string words(length, '\0');
    this->Stream.read(words.data(), length);
    return words;
  }

  void skip(std::int64_t bytes) { this->seek(this->at() + bytes); }

  [[noreturn]] void fail()
  {
    throw VDBError(this->Path + ": is cut short or damaged; its " + std::to_string(this->Size) +
      " bytes are not all that it declares; get the file again");
  }

private:
  std::string Path;
  std::ifstream Stream;
  std::int64_t Size = 0;
};

void skipMetadata(Cursor& cursor)
{
  const auto count = cursor.number<std::int32_t>();
  for (std::int32_t i = 0; i < count; ++i)
  {
    cursor.text(); // name
    cursor.text(); // type
    cursor.skip(cursor.number<std::uint32_t>());
  }
}

void skipPrelude(Cursor& cursor, const std::string& path)
{
  if (cursor.size() < 8 || cursor.number<std::int64_t>() != Magic)
  {
    throw VDBError(path + ": is no OpenVDB file; its first bytes are not 'VDB'");
  }
  const auto version = cursor.number<std::uint32_t>();
  if (version < OldestVersion || version > NewestVersion)
  {
    throw VDBError(path + ": is of OpenVDB's file version " + std::to_string(version) +
      "; versions " + std::to_string(OldestVersion) + " to " + std::to_string(NewestVersion) +
      " are read, so save it with another release");
  }
  cursor.skip(8); // version of the library
  if (cursor.number<char>() == 0)
  {
    throw VDBError(
      path + ": is a stream without offsets; save it as a file with openvdb::io::File");
  }
  cursor.skip(version >= 220 && version < 222 ? 1 + 36 : 36);
  skipMetadata(cursor);
}

VDBEntry readEntry(Cursor& cursor)
{
  VDBEntry entry;
  entry.begin = cursor.at();
  entry.name = cursor.text();
  entry.name.resize(std::min(entry.name.find('\x1e'), entry.name.size()));
  entry.type = cursor.text();
  const std::string suffix = "_HalfFloat";
  const auto half = entry.type.rfind(suffix);
  entry.half = half != std::string::npos;
  entry.type.resize(entry.half ? half : entry.type.size());
  entry.instance = !cursor.text().empty();
  const auto data = cursor.number<std::int64_t>();
  const auto blocks = cursor.number<std::int64_t>();
  entry.end = cursor.number<std::int64_t>();
  if (data < cursor.at() || (!entry.instance && blocks < data) || entry.end < blocks ||
    entry.end > cursor.size())
  {
    cursor.fail();
  }
  return entry;
}
}

VDBHeader readVDBHeader(const std::string& path)
{
  Cursor cursor(path);
  skipPrelude(cursor, path);
  VDBHeader header;
  header.gridCount = cursor.at();
  const auto count = cursor.number<std::int32_t>();
  for (std::int32_t i = 0; i < count; ++i)
  {
    header.grids.push_back(readEntry(cursor));
    cursor.seek(header.grids.back().end);
  }
  return header;
}
}
