// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleBins.h"

#include "vtkSMPTools.h"

#include <atomic>
#include <utility>

namespace nephoscope
{
namespace
{
/// Memory of the counts: at most this many.
constexpr std::size_t MostCounts = std::size_t{ 1 } << 22;
constexpr std::size_t MostChunks = 64;
}

/// Calls visit(bin, shape) for each bin that the triangle may have pixels in; whether there was one.
template <class Visitor>
bool TriangleBins::forEachBin(ScreenTriangle shape, const Visitor& visit) const
{
  const std::int64_t area = shape.area();
  if (area == 0 || (area < 0 && !this->BackFaces))
  {
    return false;
  }
  if (area < 0)
  {
    std::swap(shape.p[1], shape.p[2]);
  }
  const PixelRectangle box = shape.box(this->Projection->picture());
  if (box.x0 >= box.x1 || box.y0 >= box.y1)
  {
    return false;
  }
  for (int row = box.y0 / Edge; row <= (box.y1 - 1) / Edge; ++row)
  {
    for (int column = box.x0 / Edge; column <= (box.x1 - 1) / Edge; ++column)
    {
      visit(static_cast<std::size_t>(row) * this->Columns + column, shape);
    }
  }
  return true;
}

/// Calls visit(bin, shape, triangle) for all triangles of a chunk; how many had a bin.
template <class Visitor>
std::size_t TriangleBins::forEachOfChunk(
  const TriangleMesh& mesh, std::size_t chunk, const Visitor& visit) const
{
  const std::size_t number = mesh.triangles.size();
  std::size_t visible = 0;
  for (std::size_t t = number * chunk / this->Chunks; t < number * (chunk + 1) / this->Chunks; ++t)
  {
    const TriangleMesh::Corners& c = mesh.triangles[t];
    const ScreenTriangle whole{ { this->Snapped[c[0]], this->Snapped[c[1]], this->Snapped[c[2]] } };
    bool none = false;
    bool far = false;
    for (const ScreenPoint& p : whole.p)
    {
      none = none || p.x == ScreenPoint::None;
      far = far || p.x == ScreenPoint::Far;
    }
    if (none)
    {
      continue;
    }
    const auto place = [&visit, t](std::size_t bin, const ScreenTriangle& shape)
    { visit(bin, shape, static_cast<std::uint32_t>(t)); };
    bool seen = false;
    if (far)
    {
      const ScreenProjection::Fan fan =
        this->Projection->clip(mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]]);
      for (int i = 0; i < fan.count; ++i)
      {
        seen = this->forEachBin(fan.triangle[i], place) || seen;
      }
    }
    else
    {
      seen = this->forEachBin(whole, place);
    }
    visible += seen ? 1 : 0;
  }
  return visible;
}

void TriangleBins::snapPoints(const TriangleMesh& mesh, const ScreenProjection& projection)
{
  this->Snapped.resize(mesh.points.size());
  vtkSMPTools::For(0, static_cast<vtkIdType>(mesh.points.size()),
    [this, &mesh, &projection](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        const auto p = static_cast<std::size_t>(i);
        this->Snapped[p] = projection.snap(mesh.points[p]);
      }
    });
}

/// Counts to offsets: bin after bin, within a bin chunk after chunk.
void TriangleBins::sumUp()
{
  this->Starts.assign(this->Bins + 1, 0);
  std::size_t sum = 0;
  for (std::size_t bin = 0; bin < this->Bins; ++bin)
  {
    this->Starts[bin] = sum;
    for (std::size_t chunk = 0; chunk < this->Chunks; ++chunk)
    {
      std::size_t& at = this->Offsets[chunk * this->Bins + bin];
      sum += std::exchange(at, sum);
    }
  }
  this->Starts[this->Bins] = sum;
}

void TriangleBins::build(const TriangleMesh& mesh, const Camera& camera, bool backFaces)
{
  const ScreenProjection projection(camera);
  this->Projection = &projection;
  this->BackFaces = backFaces;
  this->Columns = (camera.width() + Edge - 1) / Edge;
  this->Bins = static_cast<std::size_t>(this->Columns) * ((camera.height() + Edge - 1) / Edge);
  this->Chunks = std::clamp<std::size_t>(MostCounts / this->Bins, 1, MostChunks);
  this->snapPoints(mesh, projection);

  this->Offsets.assign(this->Chunks * this->Bins, 0);
  std::atomic<std::size_t> visible{ 0 };
  vtkSMPTools::For(0, static_cast<vtkIdType>(this->Chunks), 1,
    [this, &mesh, &visible](vtkIdType begin, vtkIdType end)
    {
      for (auto chunk = static_cast<std::size_t>(begin); chunk < static_cast<std::size_t>(end);
           ++chunk)
      {
        std::size_t* const counts = this->Offsets.data() + chunk * this->Bins;
        visible += this->forEachOfChunk(mesh, chunk,
          [counts](std::size_t bin, const ScreenTriangle&, std::uint32_t) { ++counts[bin]; });
      }
    });
  this->Visible = visible;
  this->sumUp();

  this->Entries.resize(this->Starts.back());
  vtkSMPTools::For(0, static_cast<vtkIdType>(this->Chunks), 1,
    [this, &mesh](vtkIdType begin, vtkIdType end)
    {
      for (auto chunk = static_cast<std::size_t>(begin); chunk < static_cast<std::size_t>(end);
           ++chunk)
      {
        std::size_t* const next = this->Offsets.data() + chunk * this->Bins;
        this->forEachOfChunk(mesh, chunk,
          [this, next](std::size_t bin, const ScreenTriangle& shape, std::uint32_t triangle) {
            this->Entries[next[bin]++] = { shape, triangle };
          });
      }
    });
  this->Projection = nullptr;
}
}
