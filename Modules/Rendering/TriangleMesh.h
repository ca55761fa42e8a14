// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file TriangleMesh.h
 * @brief The triangles of a vtkPolyData in the form that drawing needs, independent of the camera.
 */
#ifndef TriangleMesh_h
#define TriangleMesh_h

#include "Vector3.h"

#include <array>
#include <cstdint>
#include <vector>

class vtkPolyData;

namespace nephoscope
{
/// Corners and their attributes. An attribute that the data lack is empty. About 70 bytes a point.
struct TriangleMesh
{
  using Corners = std::array<std::uint32_t, 3>;

  std::vector<Vector3> points;               ///< scene units
  std::vector<Corners> triangles;            ///< polygons are fans
  std::vector<std::array<float, 3>> normals; ///< as given, any length
  std::vector<Vector3> texturePoints;        ///< TextureCoordinates, m
  std::vector<Vector3> otherTexturePoints;   ///< OtherTextureCoordinates, m; only with weights
  double textureWeight = 1;                  ///< of the first of two textures, from TextureWeights
  std::vector<float> opacities;              ///< Opacity, 0..1

  /// Take all from the data. Polygons with a corner that is no point are left out.
  void assign(vtkPolyData* data);
};
}
#endif
