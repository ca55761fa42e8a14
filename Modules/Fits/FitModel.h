// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file FitModel.h
 * @brief Makes a FitModel of a function: differentiated by itself if it is a template on the scalar, else by differences.
 * @sa FitProblem.h
 */
#ifndef FitModel_h
#define FitModel_h

#include "FitProblem.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nephoscope
{
/**
 * Exact derivatives.
 * @tparam Jet ceres::Jet<double, N>, N the number of parameters
 * @param kernel  T kernel(const double* input, const T* parameters) for T double and Jet
 */
template <class Jet, class Kernel>
FitModel differentiated(Kernel kernel)
{
  return [kernel](const double* input, const double* parameters, double* gradient) -> double
  {
    constexpr int N = Jet::DIMENSION;
    if (!gradient)
    {
      return kernel(input, parameters);
    }
    std::array<Jet, N> jets;
    for (int i = 0; i < N; ++i)
    {
      jets[i] = Jet(parameters[i], i);
    }
    const Jet value = kernel(input, jets.data());
    for (int i = 0; i < N; ++i)
    {
      gradient[i] = value.v[i];
    }
    return value.a;
  };
}

/**
 * Central differences with steps of 6e-6 of a parameter, the cube root of the rounding error: derivatives good to some 1e-10.
 * @param kernel  double kernel(const double* input, const double* parameters), smooth there
 */
template <class Kernel>
FitModel byDifferences(int count, Kernel kernel)
{
  return [count, kernel](const double* input, const double* parameters, double* gradient) -> double
  {
    std::vector<double> p(parameters, parameters + count);
    for (int i = 0; gradient && i < count; ++i)
    {
      const double step = 6e-6 * std::max(std::abs(parameters[i]), 1e-3);
      p[i] = parameters[i] + step;
      const double above = kernel(input, p.data());
      p[i] = parameters[i] - step;
      const double below = kernel(input, p.data());
      p[i] = parameters[i];
      gradient[i] = (above - below) / (2 * step);
    }
    return kernel(input, parameters);
  };
}
}
#endif
