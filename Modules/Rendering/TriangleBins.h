// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file TriangleBins.h
 * @brief The triangles of a mesh as a camera sees them, sorted into square bins of pixels.
 *
 *  1. Project and snap every point.
 *  2. Count, for each chunk of triangles, how many fall into each bin.
 *  3. Sum up where each chunk's share of each bin starts.
 *  4. Fill.
 * The chunks do not depend on the number of threads and a bin keeps the order of the mesh, so neither does the result.
 */
#ifndef TriangleBins_h
#define TriangleBins_h

#include "ScreenTriangle.h"
#include "TriangleMesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephoscope
{
class TriangleBins
{
public:
  static constexpr int Edge = 32; ///< of a bin, pixels

  /// A triangle on the screen, counter-clockwise, and its number in the mesh.
  struct Entry
  {
    ScreenTriangle shape;
    std::uint32_t triangle;
  };

  /// Sort the mesh's triangles; those that face away (clockwise on the screen) too if asked for.
  void build(const TriangleMesh& mesh, const Camera& camera, bool backFaces);

  /// Triangles that may be in the picture; one in several bins counts once.
  std::size_t numberOfTriangles() const { return this->Visible; }

  /// Call visit(entry, limits) for all that may have pixels in a rectangle; limits is the part to look at.
  template <class Visitor>
  void forEach(const PixelRectangle& rectangle, const Visitor& visit) const
  {
    for (int row = rectangle.y0 / Edge; row * Edge < rectangle.y1; ++row)
    {
      for (int column = rectangle.x0 / Edge; column * Edge < rectangle.x1; ++column)
      {
        const PixelRectangle limits{ std::max(rectangle.x0, column * Edge),
          std::min(rectangle.x1, (column + 1) * Edge), std::max(rectangle.y0, row * Edge),
          std::min(rectangle.y1, (row + 1) * Edge) };
        const std::size_t bin = static_cast<std::size_t>(row) * this->Columns + column;
        for (std::size_t e = this->Starts[bin]; e < this->Starts[bin + 1]; ++e)
        {
          visit(this->Entries[e], limits);
        }
      }
    }
  }

private:
  template <class Visitor>
  std::size_t forEachOfChunk(
    const TriangleMesh& mesh, std::size_t chunk, const Visitor& visit) const;
  template <class Visitor>
  bool forEachBin(ScreenTriangle shape, const Visitor& visit) const;
  void snapPoints(const TriangleMesh& mesh, const ScreenProjection& projection);
  void sumUp();

  const ScreenProjection* Projection = nullptr; // during build
  bool BackFaces = false;
  int Columns = 0;
  std::size_t Bins = 0;
  std::size_t Chunks = 0;
  std::size_t Visible = 0;
  std::vector<ScreenPoint> Snapped;
  std::vector<std::size_t> Offsets; // chunk by chunk, bin by bin
  std::vector<std::size_t> Starts;
  std::vector<Entry> Entries;
};
}
#endif
