// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file DeepTile.h
 * @brief The deep pixels of a rectangle of the image: where bodies put their segments.
 */
#ifndef DeepTile_h
#define DeepTile_h

#include "Segment.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephoscope
{
struct PixelRequest;
struct PixelRun;

/// A rectangle of pixels of the image, [x0, x0 + width) x [y0, y0 + height).
struct TileExtent
{
  int x0 = 0;
  int y0 = 0;
  int width = 0;
  int height = 0;
};

/**
 * @brief A grey piece of a medium: a Segment in half the space, whose radiance is source (1 - exp(-tau)).
 *
 * Extinction is linear along it, as Segment::skew says.
 */
struct MediumPiece
{
  double nearEnd;     ///< distance along the ray, scene units
  float length;       ///< > 0
  float opticalDepth; ///< > 0
  float skew;         ///< -1 to 1
  std::uint32_t pixelAndSource;
};

/**
 * @brief Collects segments in any order and composites them pixel by pixel.
 *
 * One thread fills one tile. Memory is that of the tile's segments (52 bytes each, pieces of media 24; both twice) and is
 * kept for the next tile. What lies behind an opaque surface that was added before is not kept.
 *
 * Pieces of one source need no order between two surfaces, since their light is source (1 - exp(-sum tau)) however they
 * come; so a pixel of them and of surfaces is not sorted, only its Depth is searched for. In all other pixels they
 * are segments like others.
 *
 * Where nothing but one medium of one source and opaque surfaces is there, and no Depth is asked for, no piece has to be kept:
 * optical depths are summed as they come (startSum). That is several times as fast.
 */
class DeepTile
{
public:
  /// Empty the tile and move it.
  void reset(const TileExtent& extent);

  const TileExtent& extent() const { return this->Extent; }

  /// Add a segment to a pixel, in image coordinates; the pixel has to lie in the tile.
  void add(int x, int y, const Segment& segment)
  {
    const std::uint32_t pixel = this->index(x, y);
    double& hidden = this->OpaqueAt[pixel];
    if (segment.nearEnd > hidden)
    {
      return;
    }
    if (segment.opticalDepth[0] == Opaque && segment.opticalDepth[1] == Opaque &&
      segment.opticalDepth[2] == Opaque)
    {
      hidden = segment.nearEnd;
    }
    else
    {
      this->OnlyOpaque = false;
    }
    this->Segments.push_back(segment);
    this->Pixels.push_back(pixel);
  }

  /// A source function for addPiece, the same number for the same one. At most 4096 in a tile.
  std::uint32_t addSource(const RGB& source);

  /// Add a piece of a medium that is known to end before what is opaque.
  void addPiece(
    int x, int y, std::uint32_t source, double near, float length, float opticalDepth, float skew)
  {
    if (this->NumberOfPieces == this->Pieces.size())
    {
      this->Pieces.resize(2 * this->NumberOfPieces + 1024);
    }
    MediumPiece& piece =
      this->Pieces[this->NumberOfPieces++]; // in place: a copy would wait for its parts
    piece.nearEnd = near;
    piece.length = length;
    piece.opticalDepth = opticalDepth;
    piece.skew = skew;
    piece.pixelAndSource = this->index(x, y) | source << PixelBits;
  }

  /// Whether PixelLight::depth is wanted, here and in the tiles to come; it is unless said. Else it is infinity.
  void setDepthWanted(bool wanted) { this->DepthWanted = wanted; }

  /// Who adds from now on is the last to do so, until reset.
  void setLast() { this->Last = true; }

  /// For the last to add, who has one medium of one source: whether its optical depths are to be summed, not added as pieces.
  bool startSum(std::uint32_t source);
  bool isSum() const { return this->Summing; }

  /// Of the rays of a row from a pixel on, the sums of startSum, dimensionless. Rows are longer than the tile is wide, so that whole
  /// groups of up to RowPadding + 1 rays may be worked on from any pixel; what lies beyond the width is not looked at.
  double* opticalDepths(int x, int y)
  {
    return this->OpticalDepths.data() +
      static_cast<std::ptrdiff_t>(y - this->Extent.y0) * this->rowLength() + (x - this->Extent.x0);
  }
  int rowLength() const { return this->Extent.width + RowPadding; }
  static constexpr int RowPadding = 3;
  void countSummed(std::size_t pieces) { this->NumberOfSummed += pieces; }

  /// No segment beyond this distance along the pixel's ray can be seen (infinity if nothing opaque is known yet).
  double opaqueAt(int x, int y) const { return this->OpaqueAt[this->index(x, y)]; }

  /// Something opaque that is not this tile's to draw stands there: what lies beyond is not kept.
  void hideBeyond(int x, int y, double distance)
  {
    double& hidden = this->OpaqueAt[this->index(x, y)];
    hidden = distance < hidden ? distance : hidden;
  }

  /// Forget what was added, but not what it hides: someone else draws it.
  void keepLimitsOnly();

  /// Append what was added, kept or summed, as bytes for a tile of the same extent in another process of the same machine type;
  /// nothing is appended if nothing was added.
  void pack(std::vector<char>& bytes) const;
  /// Add what a tile packed, of the pixels that are wanted; of all if `wanted` is empty. Sums are of one source in all tiles that are put
  /// together, and what else is there is opaque and was known to the tiles that summed.
  void addPacked(const char* bytes, std::size_t size, const std::vector<bool>& wanted = {});

  /// Append the run of each pixel to which anything was added, not summed. Its ends are drawn in by 1e-7 of the segment that ends there, so
  /// that segments that meet do not overlap by rounding.
  void runs(std::vector<PixelRun>& runs);
  /// What was asked about the runs of what a tile packed, worked out in this empty one: in the order of the requests a depth for each that is
  /// not for the whole; of the others what addPacked takes.
  void answer(const char* bytes, std::size_t size, const std::vector<PixelRequest>& requests,
    std::vector<double>& depths, std::vector<char>& packed);

  /// Those that were added, kept or summed.
  std::size_t numberOfSegments() const
  {
    return this->Segments.size() + this->NumberOfPieces + this->NumberOfSummed;
  }

  /// Composite every pixel; light[(y - y0) * width + (x - x0)] on return.
  void composite(std::vector<PixelLight>& light);

private:
  std::uint32_t index(int x, int y) const
  {
    return static_cast<std::uint32_t>(
      (y - this->Extent.y0) * this->Extent.width + (x - this->Extent.x0));
  }

  static constexpr int PixelBits = 20;
  static constexpr std::uint32_t PixelMask = (1U << PixelBits) - 1;

  /// What was added to one pixel.
  struct Contents
  {
    Segment* begin;
    Segment* end;
    MediumPiece* first;
    MediumPiece* last;
  };

  void sortByPixels();
  Contents sorted(std::size_t pixel);
  void beginSum(std::uint32_t source);
  void addSums(const char* bytes, std::size_t summed, std::uint32_t source);
  PixelLight compositeAny(Segment* begin, Segment* end, MediumPiece* first, MediumPiece* last);
  PixelLight compositeLayers(Segment* begin, Segment* end, MediumPiece* first, MediumPiece* last);
  void putBehindSum(PixelLight& light, double opticalDepth) const;
  double depthInLayers(double depth, MediumPiece* first, MediumPiece* last) const;
  void addToLayers(const MediumPiece* first, const MediumPiece* last);
  void splitAmongLayers(const MediumPiece& piece);
  void makeLayers(const Segment* begin, const Segment* end);

  /// The medium between two surfaces.
  struct Layer
  {
    double end; ///< the surface's distance
    double opticalDepth;
    double nearEnd;
    double farEnd;
  };

  TileExtent Extent;
  std::vector<Segment> Segments;
  std::vector<std::uint32_t> Pixels; ///< of the segments
  std::vector<MediumPiece> Pieces;   ///< and room for more
  std::size_t NumberOfPieces = 0;
  std::vector<RGB> Sources;
  std::vector<double> OpaqueAt;
  bool DepthWanted = true;
  bool Last = false;
  bool OnlyOpaque = true;
  bool Summing = false;
  std::uint32_t SumSource = 0;
  std::vector<double> OpticalDepths; ///< row by row, padded
  std::size_t NumberOfSummed = 0;
  // Scratch of composite.
  std::vector<Segment> Sorted;
  std::vector<MediumPiece> SortedPieces;
  std::vector<std::size_t> Starts;
  std::vector<std::size_t> PieceStarts;
  std::vector<Segment> Pixel;
  std::vector<Layer> Layers;
};
}
#endif
