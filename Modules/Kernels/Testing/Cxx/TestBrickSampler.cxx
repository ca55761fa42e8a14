// SPDX-License-Identifier: BSD-3-Clause
// Means over voxels of what is linear in tetrahedra.
#include "BrickSampler.h"
#include "TetrahedralSplit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

using namespace nephoscope;

namespace
{
const VoxelFrame Frame{ { 3, -2, 1 }, { 0.5, 0.25, 2 } };

/// A box as the five tetrahedra of a cell with the values of a function at its corners.
template <class Function>
void addBox(
  BrickSampler& sampler, const Vector3& low, const Vector3& high, int parity, Function&& f)
{
  for (const TetrahedronVertices& t : TetrahedralSplit[static_cast<std::size_t>(parity)])
  {
    std::array<Vector3, 4> corners;
    double values[4];
    for (std::size_t v = 0; v < 4; ++v)
    {
      const int n = t[v];
      corners[v] = { n & 1 ? high[0] : low[0], n & 2 ? high[1] : low[1], n & 4 ? high[2] : low[2] };
      values[v] = f(corners[v]);
    }
    sampler.add(corners, values);
  }
}

Vector3 centre(const std::array<int, 3>& first, int voxel)
{
  const int at[3] = { first[0] + voxel % 8, first[1] + voxel / 8 % 8, first[2] + voxel / 64 };
  Vector3 place;
  for (int c = 0; c < 3; ++c)
  {
    place[c] = Frame.origin[c] + at[c] * Frame.spacing[c];
  }
  return place;
}
}

TEST(BrickSampler, TheMeanOfALinearFieldIsItsValueInTheMiddle)
{
  const auto field = [](const Vector3& p) { return 2 + p[0] - 3 * p[1] + 0.25 * p[2]; };
  const std::array<int, 3> first{ -8, 16, 8 };
  for (const std::array<int, 3>& samples :
    { std::array<int, 3>{ 1, 1, 1 }, std::array<int, 3>{ 2, 3, 5 } })
  {
    BrickSampler sampler(Frame, samples, 1);
    sampler.begin(first);
    const Vector3 low = centre(first, 0);
    const Vector3 high = centre(first, 511);
    // Two cells that share a face on which samples lie, and reach beyond the brick.
    const double middle = centre(first, 4)[0];
    addBox(sampler, { low[0] - 1, low[1] - 1, low[2] - 3 }, { middle, high[1] + 1, high[2] + 4 }, 0,
      field);
    addBox(sampler, { middle, low[1] - 1, low[2] - 3 }, { high[0] + 1, high[1] + 1, high[2] + 4 },
      1, field);
    std::array<float, 512> means{};
    sampler.average(means.data());
    for (int v = 0; v < 512; ++v)
    {
      EXPECT_NEAR(means[static_cast<std::size_t>(v)], field(centre(first, v)), 1e-5);
    }
  }
}

TEST(BrickSampler, LinearMassIsTheIntegral)
{
  // x over the unit tetrahedron: 1/24; a constant: the volume, 1/6; whatever the orientation.
  const std::array<Vector3, 4> unit{ { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } };
  EXPECT_DOUBLE_EQ(linearMass(unit, { 0, 1, 0, 0 }), 1.0 / 24);
  EXPECT_DOUBLE_EQ(linearMass({ unit[0], unit[2], unit[1], unit[3] }, { 1, 1, 1, 1 }), 1.0 / 6);
}

TEST(BrickSampler, TheMassOfATetrahedronIsFoundAsSamplesGrow)
{
  const std::array<Vector3, 4> corners{ { { 3.1, -1.7, 2.2 }, { 6.3, -1.1, 3.1 },
    { 3.9, -0.4, 1.7 }, { 4.4, -1.2, 14.2 } } };
  const double values[4] = { 1, 3, 0.5, 2 };
  const double mass = linearMass(corners, { 1, 3, 0.5, 2 });
  double last = 1;
  for (const int n : { 1, 4, 12 })
  {
    BrickSampler sampler(Frame, { n, n, n }, 1);
    sampler.begin({ 0, 0, 0 });
    sampler.add(corners, values);
    std::array<float, 512> means{};
    sampler.average(means.data());
    const double sum = std::accumulate(means.begin(), means.end(), 0.0);
    const double error = std::abs(sum * 0.5 * 0.25 * 2 / mass - 1);
    EXPECT_LT(error, last);
    last = std::max(error, 1e-4);
  }
  EXPECT_LT(last, 2e-3);
}

TEST(BrickSampler, AMeanAmongThoseMetIsThatOfThePartThatIsThere)
{
  BrickSampler sampler(Frame, { 4, 4, 4 }, 2, 1);
  sampler.begin({ 0, 0, 0 });
  const Vector3 low = Frame.origin - 0.5 * Frame.spacing;
  // The lower quarter of the first voxel, of a constant 6 and of a density 8.
  for (const TetrahedronVertices& t : TetrahedralSplit[0])
  {
    std::array<Vector3, 4> corners;
    for (std::size_t v = 0; v < 4; ++v)
    {
      corners[v] = low + Vector3{ t[v] & 1 ? 0.5 : 0, t[v] & 2 ? 0.25 : 0, t[v] & 4 ? 0.5 : 0 };
    }
    const double values[8] = { 8, 8, 8, 8, 6, 6, 6, 6 };
    sampler.add(corners, values);
  }
  std::array<float, 1024> means{};
  sampler.average(means.data());
  EXPECT_NEAR(means[0], 2, 1e-6);
  EXPECT_NEAR(means[512], 6, 1e-6);
  EXPECT_EQ(means[1], 0);
  EXPECT_EQ(means[513], 0);
}

TEST(BrickSampler, AsManyQuantitiesAsThereCanBeDoNotMix)
{
  constexpr int Most = BrickSampler::MostQuantities;
  BrickSampler sampler(Frame, { 2, 1, 3 }, Most, 3);
  const std::array<int, 3> first{ 0, -8, 0 };
  sampler.begin(first);
  const Vector3 low = centre(first, 0) - 2.0 * Frame.spacing;
  const Vector3 high = centre(first, 511) + 2.0 * Frame.spacing;
  const auto field = [](int q, const Vector3& p)
  { return q + p[q % 3] - 0.5 * q * p[(q + 1) % 3]; };
  for (const TetrahedronVertices& t : TetrahedralSplit[1])
  {
    std::array<Vector3, 4> corners;
    double values[4 * Most];
    for (std::size_t v = 0; v < 4; ++v)
    {
      const int n = t[v];
      corners[v] = { n & 1 ? high[0] : low[0], n & 2 ? high[1] : low[1], n & 4 ? high[2] : low[2] };
      for (int q = 0; q < Most; ++q)
      {
        values[static_cast<std::size_t>(4 * q) + v] = field(q, corners[v]);
      }
    }
    sampler.add(corners, values);
  }
  std::vector<float> means(512 * Most);
  sampler.average(means.data());
  for (int n = 0; n < 512 * Most; ++n)
  {
    EXPECT_NEAR(means[static_cast<std::size_t>(n)], field(n / 512, centre(first, n % 512)), 1e-4);
  }
}

TEST(BrickSampler, WhatHasNoVolumeOrLiesElsewhereIsNothing)
{
  BrickSampler sampler(Frame, { 2, 2, 2 }, 1);
  sampler.begin({ 0, 0, 0 });
  const double values[4] = { 1, 1, 1, 1 };
  sampler.add({ { { 3, -2, 1 }, { 4, -2, 1 }, { 3.5, -1.8, 1 }, { 3.2, -1.9, 1 } } }, values);
  sampler.add({ { { 90, 90, 90 }, { 91, 90, 90 }, { 90, 91, 90 }, { 90, 90, 91 } } }, values);
  const double nan = std::nan("");
  sampler.add({ { { nan, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } }, values);
  std::array<float, 512> means{};
  sampler.average(means.data());
  for (const float mean : means)
  {
    EXPECT_EQ(mean, 0);
  }
}
