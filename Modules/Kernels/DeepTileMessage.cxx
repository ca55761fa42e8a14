// SPDX-License-Identifier: BSD-3-Clause
// What a deep tile holds as bytes, to be put together with what the same tile holds elsewhere.
#include "DeepTile.h"

#include "PixelRuns.h"

#include <cmath>
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
  const char* next() const { return this->Next; }
  void skip(std::size_t bytes) { this->Next += bytes; }

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
  bytes.reserve(bytes.size() + sizeof(Header) + this->Sources.size() * sizeof(RGB) +
    this->Segments.size() * (sizeof(Segment) + sizeof(std::uint32_t)) +
    this->NumberOfPieces * sizeof(MediumPiece) + sums * sizeof(double));
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

void DeepTile::addPacked(const char* bytes, std::size_t size, const std::vector<bool>& wanted)
{
  if (size == 0)
  {
    return;
  }
  Reader message(bytes);
  const auto header = message.get<Header>();
  std::vector<std::uint32_t> sources;
  for (std::uint64_t n = 0; n < header.sources; ++n)
  {
    sources.push_back(this->addSource(message.get<RGB>()));
  }
  const auto isWanted = [&wanted](std::uint32_t pixel) { return wanted.empty() || wanted[pixel]; };
  const int width = this->Extent.width;
  Reader pixels = message;
  message.skip(header.segments * sizeof(std::uint32_t));
  for (std::uint64_t n = 0; n < header.segments; ++n)
  {
    const auto pixel = pixels.get<std::uint32_t>();
    const auto segment = message.get<Segment>();
    if (isWanted(pixel))
    {
      const auto at = static_cast<int>(pixel);
      this->add(this->Extent.x0 + at % width, this->Extent.y0 + at / width, segment);
    }
  }
  for (std::uint64_t n = 0; n < header.pieces; ++n)
  {
    const auto piece = message.get<MediumPiece>();
    const std::uint32_t pixel = piece.pixelAndSource & PixelMask;
    if (isWanted(pixel))
    {
      const auto at = static_cast<int>(pixel);
      this->addPiece(this->Extent.x0 + at % width, this->Extent.y0 + at / width,
        sources[piece.pixelAndSource >> PixelBits], piece.nearEnd, piece.length, piece.opticalDepth,
        piece.skew);
    }
  }
  if (header.sums > 0)
  {
    this->addSums(message.next(), header.summed, sources[header.sumSource]);
  }
}

void DeepTile::addSums(const char* bytes, std::size_t summed, std::uint32_t source)
{
  Reader message(bytes);
  this->beginSum(source);
  this->NumberOfSummed += summed;
  for (int y = this->Extent.y0; y < this->Extent.y0 + this->Extent.height; ++y)
  {
    double* const row = this->opticalDepths(this->Extent.x0, y);
    for (int x = 0; x < this->Extent.width; ++x)
    {
      row[x] += message.get<double>();
    }
  }
}

void DeepTile::answer(const char* bytes, std::size_t size,
  const std::vector<PixelRequest>& requests, std::vector<double>& depths, std::vector<char>& packed)
{
  std::vector<bool> whole(this->OpaqueAt.size(), false);
  std::vector<bool> deep(this->OpaqueAt.size(), false);
  for (const PixelRequest& request : requests)
  {
    (request.whole ? whole : deep)[request.pixel] = true;
  }
  this->addPacked(bytes, size, whole);
  this->pack(packed);
  this->keepLimitsOnly();
  this->addPacked(bytes, size, deep);
  for (const PixelRequest& request : requests)
  {
    if (!request.whole)
    {
      // What is nearer hides as much as a dark glass in front of the eye.
      const RGB& through = request.before;
      this->Segments.push_back({ 0, 0,
        { -std::log(through[0]), -std::log(through[1]), -std::log(through[2]) }, { 0, 0, 0 } });
      this->Pixels.push_back(request.pixel);
    }
  }
  std::vector<PixelLight> light;
  this->composite(light);
  for (const PixelRequest& request : requests)
  {
    if (!request.whole)
    {
      depths.push_back(light[request.pixel].depth);
    }
  }
}
}
