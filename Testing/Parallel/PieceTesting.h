// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file PieceTesting.h
 * @brief Surfaces as sets of triangles that can be compared to the bit, whatever their numbers and their order.
 */
#ifndef PieceTesting_h
#define PieceTesting_h

#include "CloudArrays.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

/// What is compared of a corner: place, normal and, where it has them, texture coordinates.
using Corner = std::array<double, 9>;
using Triangle = std::array<Corner, 3>;

inline Corner cornerOf(vtkPolyData* surface, vtkIdType point)
{
  Corner corner{};
  surface->GetPoint(point, corner.data());
  surface->GetPointData()->GetNormals()->GetTuple(point, corner.data() + 3);
  if (vtkDataArray* const texture =
        surface->GetPointData()->GetArray(nephoscope::arrays::TextureCoordinates))
  {
    texture->GetTuple(point, corner.data() + 6);
  }
  return corner;
}

/// Adds the triangles of a surface, each with its least corner first, in its own sense of rotation.
inline void addTriangles(vtkPolyData* surface, std::vector<Triangle>& triangles)
{
  for (vtkIdType cell = 0; cell < surface->GetNumberOfPolys(); ++cell)
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    surface->GetPolys()->GetCellAtId(cell, size, ids);
    Triangle triangle{ cornerOf(surface, ids[0]), cornerOf(surface, ids[1]),
      cornerOf(surface, ids[2]) };
    std::rotate(
      triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    triangles.push_back(triangle);
  }
}

/// The sorted triangles of all pieces that `update(piece, pieces)` makes of a filter's output.
template <class Update>
std::vector<Triangle> trianglesInPieces(int pieces, Update&& update)
{
  std::vector<Triangle> triangles;
  for (int piece = 0; piece < pieces; ++piece)
  {
    addTriangles(update(piece, pieces), triangles);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}
#endif
