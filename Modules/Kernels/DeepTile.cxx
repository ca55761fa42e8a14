// SPDX-License-Identifier: BSD-3-Clause
#include "DeepTile.h"

#include "PixelRuns.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephoscope
{
namespace
{
constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Stable counting sort by pixel. starts[p] is where pixel p ends in `sorted` (and p + 1 starts) on return.
template <class T, class PixelOf>
void sortByPixel(const std::vector<T>& items, std::size_t n, std::size_t pixels,
  const PixelOf& pixelOf, std::vector<T>& sorted, std::vector<std::size_t>& starts)
{
  starts.assign(pixels + 1, 0);
  for (std::size_t i = 0; i < n; ++i)
  {
    ++starts[pixelOf(i) + 1];
  }
  for (std::size_t p = 0; p < pixels; ++p)
  {
    starts[p + 1] += starts[p];
  }
  if (sorted.size() < n)
  {
    sorted.resize(n);
  }
  for (std::size_t i = 0; i < n; ++i)
  {
    sorted[starts[pixelOf(i)]++] = items[i];
  }
}

/// Part of a piece's optical depth before x, which goes from 0 to 1 along it.
double shareBefore(const MediumPiece& piece, double x)
{
  return x <= 0 ? 0 : x >= 1 ? 1 : x * (1 + piece.skew * (x - 1));
}

/// Where a piece has let a part of its optical depth pass: x (1 + skew (x - 1)) = part.
double distanceIn(const MediumPiece& piece, double part)
{
  return piece.nearEnd + piece.length * placeOf(part, piece.skew);
}

/// The optical depth of pieces up to a distance.
double depthBefore(const MediumPiece* first, const MediumPiece* last, double distance)
{
  double sum = 0;
  for (const MediumPiece* p = first; p != last; ++p)
  {
    sum += p->opticalDepth * shareBefore(*p, (distance - p->nearEnd) / p->length);
  }
  return sum;
}

/// The distance in [near, far] at which the pieces' optical depths add up to a sum, if none overlaps another. Reorders them.
double distanceInOrder(MediumPiece* first, MediumPiece* last, double near, double far, double sum)
{
  // Narrowed down to one of 64 stretches, whose few pieces are sorted.
  constexpr int Stretches = 64;
  double depths[Stretches] = {};
  const double scale = far > near ? Stretches / (far - near) : 0;
  const auto stretch = [near, scale](const MediumPiece& p)
  { return std::min(static_cast<int>((p.nearEnd - near) * scale), Stretches - 1); };
  for (const MediumPiece* p = first; p != last; ++p)
  {
    depths[stretch(*p)] += p->opticalDepth;
  }
  int found = 0;
  while (found < Stretches - 1 && depths[found] < sum)
  {
    sum -= depths[found++];
  }
  last = std::partition(
    first, last, [found, &stretch](const MediumPiece& p) { return stretch(p) == found; });
  std::sort(
    first, last, [](const MediumPiece& a, const MediumPiece& b) { return a.nearEnd < b.nearEnd; });
  while (first + 1 < last && first->opticalDepth < sum)
  {
    sum -= first->opticalDepth;
    ++first;
  }
  return first < last ? distanceIn(*first, std::min(sum / first->opticalDepth, 1.0)) : far;
}

/// The distance in [near, far] at which the pieces' optical depths add up to a sum. Reorders them.
double distanceOf(MediumPiece* first, MediumPiece* last, double near, double far, double sum)
{
  const double distance = distanceInOrder(first, last, near, far, sum);
  if (std::abs(depthBefore(first, last, distance) - sum) <= 1e-5)
  {
    return distance;
  }
  for (int halving = 0; halving < 60; ++halving)
  {
    const double middle = 0.5 * (near + far);
    (depthBefore(first, last, middle) < sum ? near : far) = middle;
  }
  return far;
}

/// A run with one more segment; an end that is not a number does not count.
void extend(PixelRun& run, double near, double length)
{
  constexpr double Slack = 1e-7;
  const double slack = length < Infinity ? Slack * length : 0;
  run.nearEnd = std::min(run.nearEnd, near + slack);
  run.farEnd = std::max(run.farEnd, near + length - slack);
}

Segment segmentOf(const MediumPiece& piece, const RGB& source)
{
  const float tau = piece.opticalDepth;
  const auto light = static_cast<float>(-std::expm1(-static_cast<double>(tau)));
  return { piece.nearEnd, piece.nearEnd + piece.length, { tau, tau, tau },
    { light * source[0], light * source[1], light * source[2] }, piece.skew };
}
}

void DeepTile::reset(const TileExtent& extent)
{
  this->Extent = extent;
  this->Segments.clear();
  this->Pixels.clear();
  this->NumberOfPieces = 0;
  this->Sources.clear();
  this->Last = false;
  this->OnlyOpaque = true;
  this->Summing = false;
  this->NumberOfSummed = 0;
  this->OpaqueAt.assign(static_cast<std::size_t>(extent.width) * extent.height, Infinity);
}

std::uint32_t DeepTile::addSource(const RGB& source)
{
  const auto known = std::find(this->Sources.begin(), this->Sources.end(), source);
  const auto number = static_cast<std::uint32_t>(known - this->Sources.begin());
  if (known == this->Sources.end())
  {
    this->Sources.push_back(source);
  }
  return number;
}

bool DeepTile::startSum(std::uint32_t source)
{
  if (this->Last && !this->DepthWanted && this->OnlyOpaque && this->NumberOfPieces == 0)
  {
    this->beginSum(source);
  }
  return this->Summing;
}

/// Unless it has begun.
void DeepTile::beginSum(std::uint32_t source)
{
  if (!this->Summing)
  {
    this->Summing = true;
    this->SumSource = source;
    this->OpticalDepths.assign(
      static_cast<std::size_t>(this->rowLength()) * this->Extent.height, 0);
  }
}

/// What lies behind the medium whose optical depths were summed is opaque: no part of it is before the medium.
void DeepTile::putBehindSum(PixelLight& light, double opticalDepth) const
{
  const double through = std::exp(-opticalDepth);
  const double glow = -std::expm1(-opticalDepth);
  const RGB& source = this->Sources[this->SumSource];
  for (std::size_t c = 0; c < 3; ++c)
  {
    light.radiance[c] = static_cast<float>(glow * source[c] + through * light.radiance[c]);
    light.transmittance[c] = static_cast<float>(through * light.transmittance[c]);
  }
}

void DeepTile::makeLayers(const Segment* begin, const Segment* end)
{
  this->Layers.clear();
  for (const Segment* s = begin; s != end; ++s)
  {
    this->Layers.push_back({ s->nearEnd, 0, Infinity, -Infinity });
  }
  this->Layers.push_back({ Infinity, 0, Infinity, -Infinity });
}

void DeepTile::addToLayers(const MediumPiece* first, const MediumPiece* last)
{
  // Most lie before the nearest surface.
  Layer nearest = this->Layers.front();
  for (const MediumPiece* p = first; p != last; ++p)
  {
    const double far = p->nearEnd + p->length;
    if (far <= nearest.end)
    {
      nearest.nearEnd = std::min(nearest.nearEnd, p->nearEnd);
      nearest.farEnd = std::max(nearest.farEnd, far);
      nearest.opticalDepth += p->opticalDepth;
    }
    else
    {
      std::swap(nearest, this->Layers.front());
      this->splitAmongLayers(*p);
      std::swap(nearest, this->Layers.front());
    }
  }
  this->Layers.front() = nearest;
}

void DeepTile::splitAmongLayers(const MediumPiece& piece)
{
  const double far = piece.nearEnd + piece.length;
  Layer* layer = this->Layers.data();
  while (layer->end <= piece.nearEnd)
  {
    ++layer;
  }
  layer->nearEnd = std::min(layer->nearEnd, piece.nearEnd);
  double before = 0;
  for (; layer->end < far; ++layer)
  {
    const double share = shareBefore(piece, (layer->end - piece.nearEnd) / piece.length);
    layer->opticalDepth += piece.opticalDepth * (share - before);
    layer->farEnd = layer->end;
    layer[1].nearEnd = layer->end;
    before = share;
  }
  layer->opticalDepth += piece.opticalDepth * (1 - before);
  layer->farEnd = std::max(layer->farEnd, far);
}

/// Surfaces and the media between them, whose pieces all have one source.
PixelLight DeepTile::compositeLayers(
  Segment* begin, Segment* end, MediumPiece* first, MediumPiece* last)
{
  std::stable_sort(
    begin, end, [](const Segment& a, const Segment& b) { return a.nearEnd < b.nearEnd; });
  this->makeLayers(begin, end);
  this->addToLayers(first, last);
  const RGB& source = this->Sources[first->pixelAndSource >> PixelBits];
  this->Pixel.assign(begin, end); // before a layer that begins at a surface comes the surface
  for (const Layer& layer : this->Layers)
  {
    if (layer.opticalDepth > 0)
    {
      const auto length = static_cast<float>(layer.farEnd - layer.nearEnd);
      this->Pixel.push_back(
        segmentOf({ layer.nearEnd, length, static_cast<float>(layer.opticalDepth), 0, 0 }, source));
      this->Pixel.back().farEnd = layer.farEnd;
    }
  }
  PixelLight light = nephoscope::composite(this->Pixel);
  light.depth = this->depthInLayers(light.depth, first, last);
  return light;
}

/// The depth that was interpolated as if layers were uniform, from the pieces that they are of.
double DeepTile::depthInLayers(double depth, MediumPiece* first, MediumPiece* last) const
{
  double before = 0; // optical depth of the layers up to the one of the depth, and of that up to it
  double near = Infinity;
  double far = -Infinity;
  bool inside = false;
  for (const Layer& layer : this->Layers)
  {
    near = std::min(near, layer.nearEnd);
    far = std::max(far, layer.farEnd);
    const bool here = depth > layer.nearEnd && depth < layer.farEnd;
    const double part = (depth - layer.nearEnd) / (layer.farEnd - layer.nearEnd);
    before += inside ? 0 : layer.opticalDepth * (here ? part : 1);
    inside = inside || here;
  }
  return inside ? distanceOf(first, last, near, far, before) : depth;
}

PixelLight DeepTile::compositeAny(
  Segment* begin, Segment* end, MediumPiece* first, MediumPiece* last)
{
  if (first == last)
  {
    return nephoscope::composite(begin, end);
  }
  const std::uint32_t source = first->pixelAndSource >> PixelBits;
  if (std::all_of(begin, end, [](const Segment& s) { return s.nearEnd == s.farEnd; }) &&
    std::all_of(first, last,
      [source](const MediumPiece& p) { return p.pixelAndSource >> PixelBits == source; }))
  {
    return this->compositeLayers(begin, end, first, last);
  }
  this->Pixel.assign(begin, end);
  for (const MediumPiece* p = first; p != last; ++p)
  {
    this->Pixel.push_back(segmentOf(*p, this->Sources[p->pixelAndSource >> PixelBits]));
  }
  return nephoscope::composite(this->Pixel);
}

/// Stable, so that the order of arrival decides between equal distances.
void DeepTile::sortByPixels()
{
  const std::size_t pixels = this->OpaqueAt.size();
  sortByPixel(
    this->Segments, this->Segments.size(), pixels,
    [this](std::size_t i) { return this->Pixels[i]; }, this->Sorted, this->Starts);
  sortByPixel(
    this->Pieces, this->NumberOfPieces, pixels,
    [this](std::size_t i) { return this->Pieces[i].pixelAndSource & PixelMask; },
    this->SortedPieces, this->PieceStarts);
}

/// After sortByPixels.
DeepTile::Contents DeepTile::sorted(std::size_t pixel)
{
  Segment* const segments = this->Sorted.data();
  MediumPiece* const pieces = this->SortedPieces.data();
  return { segments + (pixel > 0 ? this->Starts[pixel - 1] : 0), segments + this->Starts[pixel],
    pieces + (pixel > 0 ? this->PieceStarts[pixel - 1] : 0), pieces + this->PieceStarts[pixel] };
}

void DeepTile::composite(std::vector<PixelLight>& light)
{
  this->sortByPixels();
  const std::size_t pixels = this->OpaqueAt.size();
  light.resize(pixels);
  for (std::size_t p = 0; p < pixels; ++p)
  {
    const Contents here = this->sorted(p);
    light[p] = this->compositeAny(here.begin, here.end, here.first, here.last);
    if (this->Summing)
    {
      const auto width = static_cast<std::size_t>(this->Extent.width);
      this->putBehindSum(light[p], this->OpticalDepths[p / width * this->rowLength() + p % width]);
    }
    if (!this->DepthWanted)
    {
      light[p].depth = Infinity;
    }
  }
}

void DeepTile::runs(std::vector<PixelRun>& runs)
{
  this->sortByPixels();
  for (std::size_t p = 0; p < this->OpaqueAt.size(); ++p)
  {
    const Contents here = this->sorted(p);
    if (here.begin == here.end && here.first == here.last)
    {
      continue;
    }
    PixelRun run{ Infinity, -Infinity, {}, static_cast<std::uint32_t>(p) };
    for (const Segment* s = here.begin; s != here.end; ++s)
    {
      extend(run, s->nearEnd, s->farEnd - s->nearEnd);
    }
    for (const MediumPiece* piece = here.first; piece != here.last; ++piece)
    {
      extend(run, piece->nearEnd, piece->length);
    }
    run.light = this->compositeAny(here.begin, here.end, here.first, here.last);
    runs.push_back(run);
  }
}
}
