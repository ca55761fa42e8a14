// SPDX-License-Identifier: BSD-3-Clause
// What a deep tile holds as bytes, to be put together with what the same tile holds elsewhere.
#include "DeepTile.h"

#include <cstring>

namespace nephoscope
{
namespace
{
struct Header
{
  std::uint64_t segments;
  std::uint64_t pieces;
  std::uint64_t sources;
  std::uint64_t sums; ///< rays with summed optical depths; 0 without a sum
  std::uint64_t summed;
  std::uint64_t sumSource;
};

template <class T>
void put(std::vector<char>& bytes, const T* items, std::size_t n)
{
  const auto* const from = reinterpret_cast<const char*>(items);
  bytes.insert(bytes.end(), from, from + n * sizeof(T));
}

/// Copies the next items out of a message, which are not aligned there.
class Reader
{
public:
  explicit Reader(const char* bytes)
    : Next(bytes)
  {
  }
  template <class T>
  T get()
  {
    T item;
    std::memcpy(&item, this->Next, sizeof(T));
    this->Next += sizeof(T);
    return item;
  }

private:
  const char* Next;
};
}

void DeepTile::keepLimitsOnly()
{
  this->Segments.clear();
  this->Pixels.clear();
  this->NumberOfPieces = 0;
}

void DeepTile::pack(std::vector<char>& bytes) const
{
  if (this->numberOfSegments() == 0)
  {
    return;
  }
  const std::size_t sums = this->Summing ? this->OpaqueAt.size() : 0;
  const Header header{ this->Segments.size(), this->NumberOfPieces, this->Sources.size(), sums,
    this->NumberOfSummed, this->SumSource };
  put(bytes, &header, 1);
  put(bytes, this->Sources.data(), this->Sources.size());
  put(bytes, this->Pixels.data(), this->Pixels.size());
  put(bytes, this->Segments.data(), this->Segments.size());
  put(bytes, this->Pieces.data(), this->NumberOfPieces);
  for (int y = 0; y < (sums > 0 ? this->Extent.height : 0); ++y)
  {
    put(bytes, this->OpticalDepths.data() + static_cast<std::ptrdiff_t>(y) * this->rowLength(),
      this->Extent.width);
  }
}

void DeepTile::addPacked(const std::vector<char>& bytes)
{
  if (bytes.empty())
  {
    return;
  }
  Reader message(bytes.data());
  const auto header = message.get<Header>();
  std::vector<std::uint32_t> sources;
  for (std::uint64_t n = 0; n < header.sources; ++n)
  {
    sources.push_back(this->addSource(message.get<RGB>()));
  }
  std::vector<std::uint32_t> pixels;
  for (std::uint64_t n = 0; n < header.segments; ++n)
  {
    pixels.push_back(message.get<std::uint32_t>());
  }
  const int width = this->Extent.width;
  for (const std::uint32_t pixel : pixels)
  {
    const auto at = static_cast<int>(pixel);
    this->add(this->Extent.x0 + at % width, this->Extent.y0 + at / width, message.get<Segment>());
  }
  for (std::uint64_t n = 0; n < header.pieces; ++n)
  {
    const auto piece = message.get<MediumPiece>();
    const auto at = static_cast<int>(piece.pixelAndSource & PixelMask);
    this->addPiece(this->Extent.x0 + at % width, this->Extent.y0 + at / width,
      sources[piece.pixelAndSource >> PixelBits], piece.nearEnd, piece.length, piece.opticalDepth,
      piece.skew);
  }
  if (header.sums > 0)
  {
    this->beginSum(sources[header.sumSource]);
    this->NumberOfSummed += header.summed;
    for (int y = this->Extent.y0; y < this->Extent.y0 + this->Extent.height; ++y)
    {
      double* const row = this->opticalDepths(this->Extent.x0, y);
      for (int x = 0; x < width; ++x)
      {
        row[x] += message.get<double>();
      }
    }
  }
}
}
