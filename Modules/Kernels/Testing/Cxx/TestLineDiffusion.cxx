// SPDX-License-Identifier: BSD-3-Clause
#include "LineDiffusion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using nephoscope::DiffusionLine;

namespace
{
DiffusionLine randomLine(int n, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.1, 2);
  DiffusionLine line(n);
  for (int i = 0; i < n; ++i)
  {
    line.value[i] = uniform(random);
    line.capacity[i] = uniform(random);
    line.conductance[i] = uniform(random);
  }
  return line;
}

double content(const DiffusionLine& line)
{
  double sum = 0;
  for (int i = 0; i < line.size(); ++i)
  {
    sum += std::isnan(line.value[i]) ? 0 : line.value[i] * line.capacity[i];
  }
  return sum;
}
}

TEST(DiffusionLine, SolvesItsEquation)
{
  // Put into the equation, the result leaves no residual.
  for (bool ring : { false, true })
  {
    const int n = 17;
    const double s = 3.5;
    const DiffusionLine before = randomLine(n, 1);
    DiffusionLine after = before;
    after.diffuse(s, ring);
    for (int i = 0; i < n; ++i)
    {
      const bool hasNext = i + 1 < n || ring;
      const bool hasPrevious = i > 0 || ring;
      const int next = (i + 1) % n;
      const int previous = (i + n - 1) % n;
      double flow = 0;
      flow += hasNext ? before.conductance[i] * (after.value[next] - after.value[i]) : 0;
      flow -=
        hasPrevious ? before.conductance[previous] * (after.value[i] - after.value[previous]) : 0;
      EXPECT_NEAR(before.capacity[i] * (after.value[i] - before.value[i]), s * flow, 1e-12);
    }
  }
}

TEST(DiffusionLine, ConservesAndStaysInRangeForAnyStep)
{
  for (bool ring : { false, true })
  {
    for (double s : { 0.0, 1e-6, 1.0, 1e3, 1e9 })
    {
      const DiffusionLine before = randomLine(31, 2);
      DiffusionLine after = before;
      after.diffuse(s, ring);
      // Strong coupling costs digits: the sum is a small difference in the ring's correction.
      EXPECT_NEAR(content(after), content(before), 1e-13 * (1 + s) * content(before));
      const auto range = std::minmax_element(before.value.begin(), before.value.end());
      for (double v : after.value)
      {
        EXPECT_GE(v, *range.first - 1e-13 * (1 + s));
        EXPECT_LE(v, *range.second + 1e-13 * (1 + s));
      }
    }
  }
}

TEST(DiffusionLine, MissingValuesSeparate)
{
  // With two gaps in a ring the parts smooth by themselves.
  DiffusionLine line = randomLine(20, 3);
  line.value[5] = NAN;
  line.value[19] = NAN;
  DiffusionLine part(5);
  for (int i = 0; i < 5; ++i)
  {
    part.value[i] = line.value[i];
    part.capacity[i] = line.capacity[i];
    part.conductance[i] = line.conductance[i];
  }
  part.diffuse(2, false);
  line.diffuse(2, true);
  EXPECT_TRUE(std::isnan(line.value[5]) && std::isnan(line.value[19]));
  for (int i = 0; i < 5; ++i)
  {
    EXPECT_NEAR(line.value[i], part.value[i], 1e-14);
  }
}
