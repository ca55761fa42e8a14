// SPDX-License-Identifier: BSD-3-Clause
#include "VDBHeader.h"

#include "VDBCursor.h"

#include <fstream>

namespace nephoscope
{
namespace
{
constexpr std::int64_t Magic = 0x56444220; // "VDB "
constexpr std::uint32_t OldestVersion =
  222; // of 2013: since then each grid says how it is compressed
constexpr std::uint32_t NewestVersion = 224;

VDBEntry readEntry(VDBCursor& cursor)
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

std::vector<VDBMetadataEntry> readVDBMetadata(VDBCursor& cursor)
{
  std::vector<VDBMetadataEntry> entries;
  const auto count = cursor.number<std::int32_t>();
  for (std::int32_t i = 0; i < count; ++i)
  {
    VDBMetadataEntry entry;
    entry.name = cursor.text();
    entry.typeAt = cursor.at() + 4;
    entry.type = cursor.text();
    entry.size = cursor.number<std::uint32_t>();
    entry.begin = cursor.at();
    cursor.skip(entry.size);
    entries.push_back(entry);
  }
  return entries;
}

std::vector<VDBMetadataEntry> readVDBPrelude(VDBCursor& cursor)
{
  const std::string& path = cursor.path();
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
  cursor.skip(36); // UUID
  return readVDBMetadata(cursor);
}

VDBHeader readVDBHeader(const std::string& path)
{
  std::ifstream stream(path, std::ios::binary);
  if (!stream)
  {
    throw VDBError(path + ": cannot be opened; check its name");
  }
  VDBCursor cursor(path, stream);
  readVDBPrelude(cursor);
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
