// SPDX-License-Identifier: BSD-3-Clause
// One pixel by hand: haze from 0 to 10, a translucent cloud surface inside it at 4, an opaque wall behind at 8.
//
// What arrives from the wall is exp(-(0.8 of the haze) - surface): the order in which segments are given does not matter.
#include "Segment.h"

#include <cmath>
#include <cstdio>

int main()
{
  using nephoscope::Opaque;
  nephoscope::Segment pixel[] = {
    { 8, 8, { Opaque, Opaque, Opaque }, { 1, 1, 1 } }, // wall
    { 0, 10, { 0.5f, 0.5f, 0.5f }, { 0, 0, 0 } },      // haze, black
    { 4, 4, { 0.25f, 0.25f, 0.25f }, { 0, 0, 0 } },    // surface, black
  };
  const nephoscope::PixelLight light = nephoscope::composite(pixel, pixel + 3);
  const double expected = std::exp(-(0.8 * 0.5 + 0.25));
  std::printf("radiance %.6f, by hand %.6f\n", light.radiance[0], expected);
  return std::abs(light.radiance[0] - expected) < 1e-6 ? 0 : 1;
}
