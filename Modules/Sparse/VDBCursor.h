// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file VDBCursor.h
 * @brief What an OpenVDB file is made of: numbers, texts and metadata, of which none reaches past the end.
 */
#ifndef VDBCursor_h
#define VDBCursor_h

#include "VoxelGrid.h"

#include <cstdint>
#include <istream>

namespace nephoscope
{
/// Reads little-endian values and knows how many bytes are left.
class VDBCursor
{
public:
  VDBCursor(const std::string& path, std::istream& stream)
    : Path(path)
    , Stream(stream)
  {
    this->Stream.seekg(0, std::ios::end);
    this->Size = this->Stream.tellg();
    this->Stream.seekg(0);
  }

  const std::string& path() const { return this->Path; }
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

  /// @param bytes to pass over, >= 0
  void skip(std::int64_t bytes)
  {
    if (bytes < 0 || bytes > this->Size - this->at())
    {
      this->fail();
    }
    this->seek(this->at() + bytes);
  }

  template <class T>
  T number()
  {
    T value{};
    this->read(&value, sizeof value);
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
    this->read(words.data(), length);
    return words;
  }

  void read(void* to, std::size_t bytes)
  {
    this->Stream.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes));
    if (!this->Stream)
    {
      this->fail();
    }
  }

  [[noreturn]] void fail()
  {
    throw VDBError(this->Path + ": is cut short or damaged; its bytes are not all that it " +
      "declares; get the file again");
  }

private:
  std::string Path;
  std::istream& Stream;
  std::int64_t Size = 0;
};

/// Where an entry of metadata stands.
struct VDBMetadataEntry
{
  std::string name;
  std::string type;
  std::int64_t typeAt = 0; ///< the type's first letter
  std::int64_t begin = 0;  ///< the value's first byte
  std::uint32_t size = 0;  ///< bytes
};

std::vector<VDBMetadataEntry> readVDBMetadata(VDBCursor& cursor);

/// From a file's beginning to the number of its grids; the file's metadata. @throw VDBError if it is none, or of another version
std::vector<VDBMetadataEntry> readVDBPrelude(VDBCursor& cursor);
}
#endif
