// SPDX-License-Identifier: BSD-3-Clause
#include "TetrahedronMesh.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
void TetrahedronMesh::add(std::array<std::uint32_t, 4> corners)
{
  bool some = false;
  bool known = true;
  for (const std::uint32_t p : corners)
  {
    const Vector3& x = this->points[p];
    some = some || this->extinction[p] > 0;
    known = known && this->extinction[p] >= 0 && std::isfinite(x[0] + x[1] + x[2]);
  }
  if (some && known)
  {
    std::sort(corners.begin(), corners.end());
    this->tetrahedra.push_back(corners);
  }
}

MeshRays::MeshRays(const TetrahedronMesh& mesh, const RaySpace& space, int width, int height)
  : Mesh(mesh)
  , Scan(space, width, height)
{
}

void MeshRays::look(std::size_t tetrahedron)
{
  this->Tetrahedron = tetrahedron;
  for (std::size_t v = 0; v < 4; ++v)
  {
    this->Corners[v] = this->Scan.corner(this->Mesh.points[this->Mesh.tetrahedra[tetrahedron][v]]);
  }
}

PixelBox MeshRays::box() const
{
  const RayCorner* const corners[4] = { &this->Corners[0], &this->Corners[1], &this->Corners[2],
    &this->Corners[3] };
  return this->Scan.bounds(corners).pixels(this->Scan.image());
}

void MeshRays::emit(DeepTile& tile, const TileRays& rays, std::uint32_t source) const
{
  const RayCorner* const corners[4] = { &this->Corners[0], &this->Corners[1], &this->Corners[2],
    &this->Corners[3] };
  float extinction[4];
  const RGB* color[4];
  for (std::size_t v = 0; v < 4; ++v)
  {
    const std::uint32_t point = this->Mesh.tetrahedra[this->Tetrahedron][v];
    extinction[v] = this->Mesh.extinction[point];
    color[v] = this->Mesh.color.empty() ? nullptr : &this->Mesh.color[point];
  }
  if (this->Scan.isParallel())
  {
    this->Scan.emit<true>(tile, rays, source, corners, extinction, color);
  }
  else
  {
    this->Scan.emit<false>(tile, rays, source, corners, extinction, color);
  }
}
}
