// SPDX-License-Identifier: BSD-3-Clause
// Clouds for tests of scattering.
#ifndef HeightFieldTesting_h
#define HeightFieldTesting_h

#include "HeightFieldScattering.h"

namespace nephoscope
{
namespace testing
{
/// The cloud of the reference table: six waves over a shallow dome, c = 20 m, D = 60 m.
inline HeightFieldShape referenceShape()
{
  HeightFieldShape shape;
  // 30 - 1e-6 (x - 200)^2 - 2e-6 (y - 1800)^2
  shape.polynomial = { 30 - 0.04 - 6.48, 4e-4, 7.2e-3, -1e-6, 0, -2e-6 };
  shape.waves = { { 40, 0.006, 0.011, 0.3 }, { 30, -0.013, 0.007, 1.1 }, { 22, 0.017, 0.015, 2.5 },
    { 16, 0.004, -0.026, 4.0 }, { 10, 0.039, 0.011, 5.2 }, { 8, -0.021, 0.037, 0.9 } };
  shape.c = 20;
  shape.depth = 60;
  return shape;
}

/// A slab: F is the same everywhere, and with it g and h.
inline HeightFieldShape slabShape(double f)
{
  HeightFieldShape shape;
  shape.polynomial[0] = f;
  return shape;
}

/// The light of one ray.
inline RayLight lightOf(const std::string& method, const HeightFieldShape& shape, double plane,
  const ScatteringDensities& densities, const CloudSlice& slice, double slope,
  const ScatteringSettings& settings = {})
{
  SliceLight light;
  HeightFieldScattering::make(method, HeightField(shape), plane, densities, settings)
    ->shine(slice, { slope }, light);
  return light.rays[0];
}
}
}
#endif
