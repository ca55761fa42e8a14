// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file LatticeRanges.h
 * @brief The least and greatest of each 64 values along the rows of a lattice: what a contour need not read.
 *
 * Words of points whose range does not enclose the contour value are inside or outside as a whole. A word with a value that is not
 * finite has the range from -infinity to infinity. Memory: two values for 64.
 */
#ifndef LatticeRanges_h
#define LatticeRanges_h

#include "TetrahedralContour.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace nephoscope
{
template <class T>
class LatticeRanges
{
public:
  LatticeRanges(const LatticeShape& shape, const T* values)
    : Words(shape.words())
    , Least(static_cast<std::size_t>(shape.rows() * shape.words()))
    , Greatest(Least.size())
  {
    vtkSMPTools::For(0, shape.rows(),
      [this, &shape, values](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType row = begin; row < end; ++row)
        {
          for (Index w = 0; w < this->Words; ++w)
          {
            const Index count = std::min<Index>(shape.n[0] - 64 * w, 64);
            this->FindRange(values + row * shape.n[0] + 64 * w, count, row * this->Words + w);
          }
        }
      });
    this->Finite = std::find(this->Greatest.begin(), this->Greatest.end(),
                     std::numeric_limits<T>::infinity()) == this->Greatest.end();
  }

  const T* least(Index row) const { return this->Least.data() + row * this->Words; }
  const T* greatest(Index row) const { return this->Greatest.data() + row * this->Words; }
  bool allFinite() const { return this->Finite; }

private:
  void FindRange(const T* values, Index count, Index word)
  {
    // Four of each so that the operations overlap. x * 0 is NaN for what is not finite.
    T low[4];
    T high[4];
    T zero[4] = { 0, 0, 0, 0 };
    std::fill_n(low, 4, values[0]);
    std::fill_n(high, 4, values[0]);
    const auto take = [&](int lane, T x)
    {
      low[lane] = x < low[lane] ? x : low[lane];
      high[lane] = x > high[lane] ? x : high[lane];
      zero[lane] += x * T(0);
    };
    Index n = 0;
    for (; n + 4 <= count; n += 4)
    {
      for (int lane = 0; lane < 4; ++lane)
      {
        take(lane, values[n + lane]);
      }
    }
    for (; n < count; ++n)
    {
      take(0, values[n]);
    }
    const bool finite = zero[0] + zero[1] + zero[2] + zero[3] == 0;
    constexpr T Infinity = std::numeric_limits<T>::infinity();
    this->Least[word] = finite ? *std::min_element(low, low + 4) : -Infinity;
    this->Greatest[word] = finite ? *std::max_element(high, high + 4) : Infinity;
  }

  Index Words;
  std::vector<T> Least;
  std::vector<T> Greatest;
  bool Finite = true;
};
}
#endif
