// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file LineDiffusion.h
 * @brief One implicit step of diffusion along a line of cells: smoothing that conserves, stays in range and is always stable.
 *
 *     A_i (f'_i - f_i) = s [ c_i (f'_{i+1} - f'_i) - c_{i-1} (f'_i - f'_{i-1}) ]
 *
 * A  capacity, an area; c_i conductance between i and i + 1, a width over a distance; s the step, a length squared.
 * Sum of A f is conserved; f' lies between the least and the largest f. On a uniform line (A = c d^2) a wave exp(i kappa x)
 * is multiplied by 1 / (1 + s (4 / d^2) sin^2(kappa d / 2)).
 *
 * Values that are NaN stay so, and nothing flows to or from them.
 *
 * Method: Thomas' algorithm; on a ring with the formula of Sherman and Morrison.
 * @sa vtkCloudSmooth, TestLineDiffusion.cxx
 */
#ifndef LineDiffusion_h
#define LineDiffusion_h

#include <vector>

namespace nephoscope
{
/// A line's numbers and the work space of the solver; kept between lines so that nothing is allocated.
struct DiffusionLine
{
  std::vector<double> value;    ///< f, then f'
  std::vector<double> capacity; ///< A, > 0
  std::vector<double>
    conductance; ///< c, >= 0; on a ring the last joins the last to the first, else it is not used

  explicit DiffusionLine(int size = 0);
  int size() const { return static_cast<int>(this->value.size()); }

  /// @param step s, >= 0  @param ring whether the line closes; then its size is at least 3
  void diffuse(double step, bool ring);

private:
  void setSystem(double step, bool ring);
  void solve(std::vector<double>& unknown);

  std::vector<double> Diagonal;
  std::vector<double> Off; ///< between i and i + 1, negative or 0
  std::vector<double> Reduced;
  std::vector<double> Correction;
  std::vector<char> Missing;
};
}
#endif
