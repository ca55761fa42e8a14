// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file TetrahedronMesh.h
 * @brief Tetrahedra in no order, and the segments that one adds to a deep tile.
 *
 * @sa TetrahedronScan.h, CellColumns.h, vtkCloudVolumeMapper
 */
#ifndef TetrahedronMesh_h
#define TetrahedronMesh_h

#include "TetrahedronScan.h"
#include "Vector3.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephoscope
{
/// What does not depend on the camera.
struct TetrahedronMesh
{
  std::vector<Vector3> points;
  std::vector<float> extinction; ///< of points, per scene unit, usableExtinction or NaN
  std::vector<RGB> color;        ///< of points, linear RGB; empty if the cloud has one colour
  std::vector<std::array<std::uint32_t, 4>> tetrahedra; ///< points, ascending

  /// Add a tetrahedron of four points in any order, unless it is empty or has a NaN.
  void add(std::array<std::uint32_t, 4> corners);
};

/// One tetrahedron as a camera sees it. Make one for each thread and turn it to one after another.
class MeshRays
{
public:
  MeshRays(const TetrahedronMesh& mesh, const RaySpace& space, int width, int height);

  void look(std::size_t tetrahedron);
  PixelBox box() const;
  void emit(DeepTile& tile, const TileRays& rays, std::uint32_t source) const;

private:
  const TetrahedronMesh& Mesh;
  TetrahedronScan Scan;
  std::size_t Tetrahedron = 0;
  RayCorner Corners[4];
};
}
#endif
