// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file LatticeGrid.h
 * @brief The structured data sets of VTK as lattices of points: how many, where, and whether the grid closes on itself.
 */
#ifndef LatticeGrid_h
#define LatticeGrid_h

#include "CurvilinearGradient.h"
#include "TetrahedralContour.h"
#include "Vector3.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkPoints.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace nephoscope
{
/// The points of a vtkStructuredGrid.
template <class T>
struct CurvilinearPoints
{
  using Real = T;
  const T* Data;
  std::array<int, 3> N;

  Vector3 operator()(int i, int j, int k) const { return this->row(j, k)(i); }

  /// The points that share (j, k).
  struct Row
  {
    const T* X;
    Vector3 operator()(Index i) const
    {
      const T* x = this->X + 3 * i;
      return { static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2]) };
    }
  };
  Row row(int j, int k) const
  {
    return { this->Data + 3 * this->N[0] * (j + Index(this->N[1]) * k) };
  }

  /// Where all six neighbours are. @param change of the field from one neighbour to the other, along i, j, k
  Vector3 gradientInside(int i, int j, int k, const std::array<double, 3>& change) const
  {
    const Row x = this->row(j, k);
    const Index toJ = this->N[0];
    const Index toK = toJ * this->N[1];
    return curvilinearGradient(
      { x(i + 1) - x(i - 1), x(i + toJ) - x(i - toJ), x(i + toK) - x(i - toK) }, change);
  }
};

/// The points of a vtkRectilinearGrid or vtkImageData: a product of three axes, turned and moved.
struct ProductPoints
{
  using Real = float;
  std::array<std::vector<double>, 3> Axis;
  std::array<Vector3, 3> Direction{ { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } };
  Vector3 Origin{ 0, 0, 0 };

  Vector3 operator()(int i, int j, int k) const { return this->row(j, k)(i); }

  struct Row
  {
    Vector3 Start;
    const double* Along;
    Vector3 Direction;
    Vector3 operator()(Index i) const { return this->Start + this->Along[i] * this->Direction; }
  };
  Row row(int j, int k) const
  {
    return { this->Origin + this->Axis[1][j] * this->Direction[1] +
        this->Axis[2][k] * this->Direction[2],
      this->Axis[0].data(), this->Direction[0] };
  }

  /// The same gradient as of a curvilinear grid: where the directions are orthonormal each axis has its own.
  Vector3 gradientInside(int i, int j, int k, const std::array<double, 3>& change) const
  {
    const double step[3] = { this->Axis[0][i + 1] - this->Axis[0][i - 1],
      this->Axis[1][j + 1] - this->Axis[1][j - 1], this->Axis[2][k + 1] - this->Axis[2][k - 1] };
    if (this->Orthonormal && step[0] != 0 && step[1] != 0 && step[2] != 0)
    {
      return (change[0] / step[0]) * this->Direction[0] +
        (change[1] / step[1]) * this->Direction[1] + (change[2] / step[2]) * this->Direction[2];
    }
    return curvilinearGradient(
      { step[0] * this->Direction[0], step[1] * this->Direction[1], step[2] * this->Direction[2] },
      change);
  }

  void FindOrthonormal()
  {
    const auto& d = this->Direction;
    const double error = std::abs(dot(d[0], d[1])) + std::abs(dot(d[1], d[2])) +
      std::abs(dot(d[2], d[0])) + std::abs(dot(d[0], d[0]) - 1) + std::abs(dot(d[1], d[1]) - 1) +
      std::abs(dot(d[2], d[2]) - 1);
    this->Orthonormal = error < 1e-12;
  }
  bool Orthonormal = true;
};

inline ProductPoints productPoints(vtkRectilinearGrid* grid)
{
  ProductPoints points;
  vtkDataArray* axes[3] = { grid->GetXCoordinates(), grid->GetYCoordinates(),
    grid->GetZCoordinates() };
  for (int c = 0; c < 3; ++c)
  {
    points.Axis[c].resize(axes[c]->GetNumberOfTuples());
    for (vtkIdType n = 0; n < axes[c]->GetNumberOfTuples(); ++n)
    {
      points.Axis[c][n] = axes[c]->GetComponent(n, 0);
    }
  }
  return points;
}

inline ProductPoints productPoints(vtkImageData* image)
{
  ProductPoints points;
  const int* extent = image->GetExtent();
  const double* spacing = image->GetSpacing();
  const double* origin = image->GetOrigin();
  for (std::size_t c = 0; c < 3; ++c)
  {
    points.Origin[static_cast<int>(c)] = origin[c];
    for (int row = 0; row < 3; ++row)
    {
      points.Direction[c][row] = image->GetDirectionMatrix()->GetElement(row, static_cast<int>(c));
    }
    for (int n = extent[2 * c]; n <= extent[2 * c + 1]; ++n)
    {
      points.Axis[c].push_back(n * spacing[c]);
    }
  }
  points.FindOrthonormal();
  return points;
}

/// The number of points along each axis and the parity of the first in the whole extent; zero for other data sets.
inline LatticeShape latticeShape(vtkDataSet* data)
{
  LatticeShape shape;
  int extent[6] = { 0, -1, 0, -1, 0, -1 };
  if (auto* structured = vtkStructuredGrid::SafeDownCast(data))
  {
    structured->GetExtent(extent);
  }
  else if (auto* rectilinear = vtkRectilinearGrid::SafeDownCast(data))
  {
    rectilinear->GetExtent(extent);
  }
  else if (auto* image = vtkImageData::SafeDownCast(data))
  {
    image->GetExtent(extent);
  }
  for (std::size_t c = 0; c < 3; ++c)
  {
    shape.n[c] = extent[2 * c + 1] - extent[2 * c] + 1;
  }
  shape.parity = (extent[0] + extent[2] + extent[4]) & 1;
  return shape;
}

/// Whether each row's last point lies on its first, to 1e-4 of the longest first step: a globe's seam.
template <class Points>
bool closesOnItself(const LatticeShape& shape, const Points& points)
{
  if (shape.n[0] < 4)
  {
    return false;
  }
  double step = 0;
  double gap = 0;
  for (int k = 0; k < shape.n[2]; ++k)
  {
    for (int j = 0; j < shape.n[1]; ++j)
    {
      const Vector3 first = points(0, j, k);
      step = std::max(step, length(points(1, j, k) - first));
      const double d = length(points(shape.n[0] - 1, j, k) - first);
      gap = d <= gap ? gap : d; // a NaN stays
    }
  }
  return gap <= 1e-4 * step && step > 0;
}
}
#endif
