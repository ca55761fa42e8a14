// SPDX-License-Identifier: BSD-3-Clause
// A haze of optical depth 1 before an opaque wall of radiance 1: the wall arrives attenuated by exp(-1).
#include "Segment.h"

#include <cmath>
#include <cstdio>

int main()
{
  const nephoscope::RGB wall{ nephoscope::Opaque, nephoscope::Opaque, nephoscope::Opaque };
  nephoscope::Segment segments[] = { { 5, 5, wall, { 1, 1, 1 } },
    { 1, 2, { 1, 1, 1 }, { 0, 0, 0 } } };
  const float arrived = nephoscope::composite(segments, segments + 2).radiance[0];
  std::printf("%.7f of the wall arrives\n", arrived);
  return std::abs(arrived - std::exp(-1.0)) < 1e-6 ? 0 : 1;
}
