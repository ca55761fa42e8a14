// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file LatticeContour.h
 * @brief The passes over a structured grid: which points and cells count, how much there will be, and the writing of it.
 */
#ifndef LatticeContour_h
#define LatticeContour_h

#include "ContourOutput.h"
#include "LatticeGrid.h"
#include "LatticeRanges.h"
#include "LatticeSurface.h"
#include "TetrahedralContour.h"

#include "vtkDataSetAttributes.h"
#include "vtkSMPThreadLocal.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace nephoscope
{
/// The least T that is not below the value: x >= value as real numbers if and only if x >= this.
template <class T>
T threshold(double value)
{
  const double largest = std::numeric_limits<T>::max();
  if (value > largest)
  {
    return std::numeric_limits<T>::infinity();
  }
  const T near = static_cast<T>(std::max(value, -largest));
  return near < value ? std::nextafter(near, std::numeric_limits<T>::infinity()) : near;
}

inline bool isHidden(vtkUnsignedCharArray* ghosts, vtkIdType id, unsigned char flags)
{
  return ghosts && (ghosts->GetValue(id) & flags) != 0;
}

/// The surfaces of one lattice; its members are the passes, in order.
template <class Points, class T>
class LatticeContour
{
public:
  /// @param ranges of these values
  LatticeContour(vtkDataSet* input, const LatticeShape& shape, const Points& points,
    const T* values, const LatticeRanges<T>& ranges)
    : Input(input)
    , Shape(shape)
    , X(points)
    , Values(values)
    , Ranges(ranges)
  {
  }

  /// Notes unusable points and cells, if there are any.
  void FindUsable()
  {
    vtkUnsignedCharArray* pointGhosts = this->Input->GetPointGhostArray();
    vtkUnsignedCharArray* cellGhosts = this->Input->GetCellGhostArray();
    if (!pointGhosts && !cellGhosts && this->Ranges.allFinite())
    {
      return;
    }
    this->Usable = std::make_unique<LatticeBits>(this->Shape);
    this->Cells = std::make_unique<LatticeBits>(this->Shape);
    const auto& n = this->Shape.n;
    for (Index row = 0; row < this->Shape.rows(); ++row)
    {
      const Index firstCell = row % n[1] + Index(n[1] - 1) * (row / n[1]);
      const bool hasCells = row % n[1] < n[1] - 1 && row / n[1] < n[2] - 1;
      for (int i = 0; i < n[0]; ++i)
      {
        const Bits bit = Bits(1) << (i % 64);
        const Index id = row * n[0] + i;
        if (std::isfinite(this->Values[id]) &&
          !isHidden(pointGhosts, id, vtkDataSetAttributes::HIDDENPOINT))
        {
          this->Usable->row(row)[i / 64] |= bit;
        }
        if (hasCells && i < n[0] - 1 &&
          !isHidden(cellGhosts, firstCell * (n[0] - 1) + i,
            vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::DUPLICATECELL))
        {
          this->Cells->row(row)[i / 64] |= bit;
        }
      }
    }
    for (Index row = 0; row < this->Shape.rows(); ++row)
    {
      restrictToUsablePoints(this->Shape, *this->Usable, row, *this->Cells);
    }
  }

  /// The last point of each row is the first again: gradients are taken across the seam. Returns whether the surface can be
  /// connected there too.
  bool CloseSeam()
  {
    this->Ring = true;
    this->Shape.closed = this->Shape.n[0] % 2 == 1;
    return this->Shape.closed;
  }

  /// Whether every row ends with the value and the usability it starts with.
  bool SeamValuesAgree() const
  {
    const int last = this->Shape.n[0] - 1;
    for (Index row = 0; row < this->Shape.rows(); ++row)
    {
      const bool usable = !this->Usable || this->Usable->test(row, 0);
      const bool usableEnd = !this->Usable || this->Usable->test(row, last);
      const T* values = this->Values + row * this->Shape.n[0];
      if (usable != usableEnd || (usable && values[0] != values[last]))
      {
        return false;
      }
    }
    return true;
  }

  /// For all contour values: what is read is read once.
  void Count(const std::vector<double>& values)
  {
    this->LevelValues = values;
    std::vector<T> limits;
    for (double value : values)
    {
      this->Levels.push_back(std::make_unique<ContourLevel>(this->Shape, this->Cells.get()));
      limits.push_back(threshold<T>(value));
    }
    vtkSMPTools::For(0, this->Shape.rows(),
      [this, &limits](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType row = begin; row < end; ++row)
        {
          for (std::size_t l = 0; l < limits.size(); ++l)
          {
            this->Levels[l]->classify(row, this->Values + row * this->Shape.n[0], limits[l],
              this->Ranges.least(row), this->Ranges.greatest(row));
          }
        }
      });
    for (const auto& level : this->Levels)
    {
      vtkSMPTools::For(0, this->Shape.rows(),
        [&level](vtkIdType begin, vtkIdType end)
        {
          for (vtkIdType row = begin; row < end; ++row)
          {
            level->countRow(row);
          }
        });
      level->accumulate();
      this->Vertices += level->numberOfVertices();
      this->Triangles += level->numberOfTriangles();
    }
  }

  vtkIdType GetNumberOfVertices() const { return this->Vertices; }
  vtkIdType GetNumberOfTriangles() const { return this->Triangles; }

  void Generate(ContourOutput& out)
  {
    const bool flip = leftHanded(this->Shape, this->X);
    vtkIdType firstVertex = 0;
    vtkIdType firstTriangle = 0;
    for (std::size_t l = 0; l < this->Levels.size(); ++l)
    {
      this->GenerateVertices(out, *this->Levels[l], this->LevelValues[l], firstVertex);
      withIds(out,
        [this, l, flip, firstVertex, firstTriangle](auto* ids, auto* offsets) {
          this->GenerateTriangles(*this->Levels[l], flip, firstVertex, firstTriangle, ids, offsets);
        });
      firstVertex += this->Levels[l]->numberOfVertices();
      firstTriangle += this->Levels[l]->numberOfTriangles();
    }
  }

private:
  void GenerateVertices(
    ContourOutput& out, const ContourLevel& level, double value, vtkIdType first)
  {
    using Real = typename Points::Real;
    const LatticeField<Points, T> field{ this->Shape, this->X, this->Values, this->Usable.get(),
      this->Ring };
    const SurfaceVertices<Real> vertices{
      ArrayOf<Real>::Type::SafeDownCast(out.Points)->GetPointer(3 * first),
      out.Normals ? out.Normals->GetPointer(3 * first) : nullptr
    };
    T* values = nullptr;
    if (auto* array = ArrayOf<T>::Type::SafeDownCast(out.Field))
    {
      values = array->GetPointer(first);
    }
    // Bands of rows along j over all k: the gradients of a band's two levels stay in the processor's cache.
    const int band = this->Shape.n[1] >= 64 ? 8 : 2;
    const vtkIdType bands = (this->Shape.n[1] + band - 1) / band;
    vtkSMPThreadLocal<GradientRows> gradients;
    ArrayList& others = out.Others;
    vtkDataArray* slowValues = out.Field;
    vtkSMPTools::For(0, bands, 1,
      [this, &field, &level, &gradients, &vertices, &others, values, slowValues, value, first,
        band](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType b = begin; b < end; ++b)
        {
          const int j0 = static_cast<int>(b) * band;
          writeVertices(field, level, value, j0, std::min(j0 + band, this->Shape.n[1]),
            gradients.Local(), vertices,
            [&others, values, slowValues, value, first](Index id, Index from, Index to, double t)
            {
              others.InterpolateEdge(from, to, t, first + id);
              if (values)
              {
                values[id] = static_cast<T>(value);
              }
              else
              {
                slowValues->SetComponent(first + id, 0, value);
              }
            });
        }
      });
  }

  template <class Id>
  void GenerateTriangles(const ContourLevel& level, bool flip, vtkIdType firstVertex,
    vtkIdType firstTriangle, Id* ids, Id* offsets) const
  {
    vtkSMPTools::For(0, this->Shape.rows(),
      [&level, flip, firstVertex, firstTriangle, ids, offsets](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType row = begin; row < end; ++row)
        {
          vtkIdType triangle = firstTriangle + level.firstTriangle(row);
          const Id first = static_cast<Id>(firstVertex);
          level.template forEachTriangle<Id>(row,
            [flip, first, ids, offsets, &triangle](Id a, Id b, Id c)
            {
              offsets[triangle] = static_cast<Id>(3 * triangle);
              Id* corner = ids + 3 * triangle++;
              corner[0] = first + a;
              corner[1] = first + (flip ? c : b);
              corner[2] = first + (flip ? b : c);
            });
        }
      });
  }

  vtkDataSet* Input;
  LatticeShape Shape;
  const Points& X;
  const T* Values;
  const LatticeRanges<T>& Ranges;
  std::unique_ptr<LatticeBits> Usable; // points; null for all
  std::unique_ptr<LatticeBits> Cells;  // null for all
  std::vector<std::unique_ptr<ContourLevel>> Levels;
  std::vector<double> LevelValues;
  bool Ring = false;
  vtkIdType Vertices = 0;
  vtkIdType Triangles = 0;
};
}
#endif
