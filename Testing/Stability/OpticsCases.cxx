// SPDX-License-Identifier: BSD-3-Clause
// Where the arithmetic of extinction is known to fail.
#include "TestPicture.h"

#include "vtkCloudCellVolume.h"
#include "vtkStructuredGrid.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace stability
{
namespace
{
const StabilityRegistration transmittedMeanCase({ "optics",
  "(1 - exp(-x)) / x, x from 1e-12 to 1e6", "relative error below 1e-14",
  []
  {
    double naive = 0;
    double ours = 0;
    for (double x = 1e-12; x < 2e6; x *= 1.7)
    {
      const long double truth = -std::expm1(-static_cast<long double>(x)) / x;
      naive = std::max(naive, std::abs(static_cast<double>((1 - std::exp(-x)) / x / truth - 1)));
      ours = std::max(ours, std::abs(static_cast<double>(transmittedMean(x) / truth - 1)));
    }
    return Outcome{ figure("relative error", naive), figure("relative error", ours), ours < 1e-14 };
  } });

const StabilityRegistration depths({ "optics", "slabs of optical depth 1e-12 to 1e6",
  "radiance 1 - exp(-tau) to 1e-6 of itself",
  []
  {
    double naive = 0;
    double ours = 0;
    for (double depth = 1e-12; depth < 2e6; depth *= 10)
    {
      const auto grid = makeGrid(
        { 3, 4, 5 },
        [](double a, double b, double c) {
          return Vector3{ 2 * a - 1, 2 * b - 1, c };
        },
        [depth](int, int, int) { return depth; });
      const View above{ { 0.01, 0.02, 5 }, { 0.01, 0.02, 0 }, 30, 0.5, 3, 2 };
      const Picture picture = draw({ bodyOf(grid) }, above);
      // The density itself is a float.
      const double truth = -std::expm1(-static_cast<double>(static_cast<float>(depth)));
      for (const RGB& light : picture.radiance)
      {
        const double error = std::abs(light[0] / truth - 1);
        ours = std::isfinite(error) ? std::max(ours, error) : 1;
      }
      const float through = std::exp(-static_cast<float>(depth));
      naive = std::max(naive, std::abs((1 - through) / truth - 1));
    }
    return Outcome{ figure("relative error", naive), figure("relative error", ours), ours < 1e-6 };
  } });

const StabilityRegistration manyThin(
  { "optics", "a million thin segments on one ray", "transmittance of their sum within 1e-6",
    []
    {
      constexpr int Count = 1000000;
      const float each = 1e-6F;
      std::vector<Segment> segments(Count);
      float naive = 1;
      for (int n = 0; n < Count; ++n)
      {
        segments[n] = { 1.0 * n, n + 1.0, { each, each, each }, { 0, 0, 0 } };
        naive *= std::exp(-each);
      }
      const double truth = std::exp(-static_cast<double>(each) * Count);
      const double ours = composite(segments).transmittance[0];
      return Outcome{ figure("error", std::abs(naive - truth)),
        figure("error", std::abs(ours - truth)), std::abs(ours - truth) < 1e-6 };
    } });
}
}
}
