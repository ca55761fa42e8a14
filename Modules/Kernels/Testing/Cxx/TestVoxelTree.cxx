// SPDX-License-Identifier: BSD-3-Clause
// Sparse voxels along rays, against a dense field that is marched in tiny steps.
#include "VoxelTree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace nephoscope;

namespace
{
constexpr double Infinity = std::numeric_limits<double>::infinity();

/// A dense box of voxels of unequal sides, and the same as bricks.
struct Dense
{
  std::array<int, 3> low{ -13, 5, -4 };
  std::array<int, 3> size{ 29, 14, 40 };
  std::vector<float> values;

  template <class Function>
  explicit Dense(const Function& f)
  {
    for (int z = 0; z < size[2]; ++z)
    {
      for (int y = 0; y < size[1]; ++y)
      {
        for (int x = 0; x < size[0]; ++x)
        {
          values.push_back(static_cast<float>(f(low[0] + x, low[1] + y, low[2] + z)));
        }
      }
    }
  }

  double at(int x, int y, int z) const
  {
    const int i[3] = { x - low[0], y - low[1], z - low[2] };
    for (std::size_t c = 0; c < 3; ++c)
    {
      if (i[c] < 0 || i[c] >= size[c])
      {
        return 0;
      }
    }
    return values[static_cast<std::size_t>((i[2] * size[1] + i[1]) * size[0] + i[0])];
  }

  double at(const Vector3& p) const
  {
    double sum = 0;
    const int i[3] = { static_cast<int>(std::floor(p[0])), static_cast<int>(std::floor(p[1])),
      static_cast<int>(std::floor(p[2])) };
    for (int n = 0; n < 8; ++n)
    {
      double weight = 1;
      int corner[3];
      for (int c = 0; c < 3; ++c)
      {
        const double u = p[c] - i[c];
        weight *= n >> c & 1 ? u : 1 - u;
        corner[c] = i[c] + (n >> c & 1);
      }
      sum += weight * at(corner[0], corner[1], corner[2]);
    }
    return sum;
  }

  /// The integral of the density by the midpoint rule.
  double depth(const Vector3& o, const Vector3& d, double t0, double t1, int steps = 20000) const
  {
    double sum = 0;
    const double h = (t1 - t0) / steps;
    for (int n = 0; n < steps; ++n)
    {
      sum += h * at(o + (t0 + (n + 0.5) * h) * d);
    }
    return sum;
  }

  VoxelTree tree() const
  {
    std::vector<std::array<int, 3>> origins;
    std::vector<float> bricks;
    for (int z = -8; z < 40; z += 8)
    {
      for (int y = 0; y < 24; y += 8)
      {
        for (int x = -16; x < 24; x += 8)
        {
          origins.push_back({ x, y, z });
          for (int v = 0; v < 512; ++v)
          {
            bricks.push_back(static_cast<float>(at(x + v % 8, y + v / 8 % 8, z + v / 64)));
          }
        }
      }
    }
    return VoxelTree(origins, bricks.data());
  }
};

/// Two balls of fog with nothing between, and one voxel alone.
double balls(int x, int y, int z)
{
  const double a = std::hypot((x + 4) / 7.0, (y - 12) / 5.0, (z - 5) / 6.0);
  const double b = std::hypot((x - 9) / 5.0, (y - 10) / 4.0, (z - 27) / 7.0);
  return std::max(0.0, 1 - a) + std::max(0.0, 1 - b) + (x == -8 && y == 8 && z == 32 ? 1 : 0);
}

void sweepAll(VoxelTree& tree, const Vector3& sun)
{
  tree.setSun(sun);
  for (std::size_t place = 0; place < tree.numberOfBricks(); ++place)
  {
    tree.sweep(place);
  }
}
}

TEST(VoxelTree, DepthsAreThoseOfTheDenseField)
{
  const Dense dense(balls);
  const VoxelTree tree = dense.tree();
  EXPECT_LT(tree.numberOfBricks(), 60U); // of 90
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int n = 0; n < 60; ++n)
  {
    const Vector3 from{ 30 * u(random), 10 + 20 * u(random), 15 + 40 * u(random) };
    const Vector3 to{ 8 * u(random), 10 + 4 * u(random), 15 + 16 * u(random) };
    const Vector3 direction = normalized(to - from);
    // From within the fog too: half of the origins lie in the box.
    EXPECT_NEAR(tree.depth(from, direction, 0, 100), dense.depth(from, direction, 0, 100), 2e-4);
    EXPECT_NEAR(tree.depth(to, direction, 3, 11), dense.depth(to, direction, 3, 11), 2e-4);
  }
}

TEST(VoxelTree, RaysAlongFacesEdgesAndAxes)
{
  const Dense dense(balls);
  const VoxelTree tree = dense.tree();
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double sign : { -1.0, 1.0 })
    {
      Vector3 direction{ 0, 0, 0 };
      direction[axis] = sign;
      // On a brick's edge, on its face, on a cell's edge, and where only the last voxel of the next brick is fog.
      for (const Vector3& through :
        { Vector3{ 0, 8, 0 }, Vector3{ 0, 12.5, 8 }, Vector3{ 8, 16, 24 }, Vector3{ -8, 8, 32 },
          Vector3{ -4, 12, 5 }, Vector3{ 9.5, 8, 27 } })
      {
        const Vector3 from = through - 50.0 * direction;
        EXPECT_NEAR(tree.depth(from, direction, 0, 100), dense.depth(from, direction, 0, 100), 2e-4)
          << axis << ' ' << sign << ' ' << through[0];
      }
    }
  }
  for (const Vector3& diagonal : { Vector3{ 1, 1, 1 }, Vector3{ -1, 1, 0 }, Vector3{ 0, -1, 1 } })
  {
    const Vector3 direction = normalized(diagonal);
    const Vector3 from = Vector3{ 0, 8, 8 } - 40.0 * direction;
    EXPECT_NEAR(tree.depth(from, direction, 0, 100), dense.depth(from, direction, 0, 100), 2e-4);
  }
}

TEST(VoxelTree, ASingleVoxelIsATent)
{
  // Its trilinear hat along an axis has area 1; seen off by half a voxel, half of that.
  for (const std::array<int, 3>& at : { std::array<int, 3>{ 0, 0, 0 },
         std::array<int, 3>{ -1, -8, 7 }, std::array<int, 3>{ 64, -64, 63 } })
  {
    const auto low = [](int i) { return static_cast<int>(std::floor(i / 8.0)) * 8; };
    const std::array<int, 3> origin{ low(at[0]), low(at[1]), low(at[2]) };
    std::vector<float> values(512, 0.0F);
    values[static_cast<std::size_t>(
      ((at[2] - origin[2]) * 8 + at[1] - origin[1]) * 8 + at[0] - origin[0])] = 3;
    const VoxelTree tree({ origin }, values.data());
    for (int axis = 0; axis < 3; ++axis)
    {
      Vector3 direction{ 0, 0, 0 };
      direction[axis] = 1;
      const Vector3 middle{ 1.0 * at[0], 1.0 * at[1], 1.0 * at[2] };
      Vector3 beside = middle;
      beside[(axis + 1) % 3] += 0.5;
      EXPECT_NEAR(tree.depth(middle - 9.0 * direction, direction, 0, 20), 3, 1e-6);
      EXPECT_NEAR(tree.depth(beside - 9.0 * direction, direction, 0, 20), 1.5, 1e-6);
    }
  }
}

TEST(VoxelTree, OnlyBricksWithFogAreVisitedInOrder)
{
  const Dense dense(balls);
  const VoxelTree tree = dense.tree();
  const Vector3 from{ -4, 12, -60 };
  const Vector3 direction{ 0, 0, 2 }; // two indices a scene unit
  double last = 0;
  int visited = 0;
  tree.walk(from, direction, 0, Infinity,
    [&](std::size_t, double near, double far)
    {
      EXPECT_GE(near, last);
      EXPECT_GT(far, near);
      EXPECT_GT(-60 + 2 * far, -8);
      last = far;
      ++visited;
      return true;
    });
  EXPECT_GE(visited, 1);
  EXPECT_LT(visited, 6); // of six in the column
  visited = 0;
  tree.walk(from, direction, 0, Infinity,
    [&visited](std::size_t, double, double)
    {
      ++visited;
      return false;
    });
  EXPECT_EQ(visited, 1);
}

TEST(VoxelTree, NothingAndNonsenseAreEmpty)
{
  const VoxelTree none;
  EXPECT_EQ(none.depth({ 0, 0, 0 }, { 1, 0, 0 }, 0, Infinity), 0);
  EXPECT_EQ(none.sunDepth({ 0, 0, 0 }), 0);
  std::vector<float> values(512, -1.0F);
  values[5] = std::nanf("");
  const VoxelTree negative({ { 0, 0, 0 } }, values.data());
  EXPECT_EQ(negative.numberOfBricks(), 0U);
  const VoxelTree tree = Dense(balls).tree();
  const double nan = std::nan("");
  EXPECT_EQ(tree.depth({ nan, 0, 0 }, { 1, 0, 0 }, 0, 100), 0);
  EXPECT_EQ(tree.depth({ 0, 0, 0 }, { nan, 0, 0 }, 0, 100), 0);
  EXPECT_EQ(tree.depth({ 0, 10, 5 }, { 0, 0, 1 }, 5, 5), 0);
  EXPECT_EQ(tree.depth({ 0, 10, 500 }, { 0, 0, 1 }, 0, Infinity), 0);
  EXPECT_GT(VoxelTree::numberOfBlocks({ { -1000000000, 0, 0 }, { 1000000000, 8, 1000000000 } }),
    VoxelTree::MostBlocks);
  EXPECT_LE(VoxelTree::numberOfBlocks({ { 0, 0, 0 }, { 4096, 0, 0 } }), VoxelTree::MostBlocks);
}

TEST(VoxelTree, TheSweepFindsTheSunsDepths)
{
  const Dense dense(balls);
  for (const Vector3& toward : { Vector3{ 0.3, 0.2, 1 }, Vector3{ 0, 0, 1 },
         Vector3{ -1, 0.4, -0.2 }, Vector3{ 1, 0, -1 }, Vector3{ 0, -1, 0 }, Vector3{ 1, -1, 1 },
         Vector3{ 2e-4, 5e-5, 1 }, Vector3{ -1, 1e-12, 5e-5 } })
  {
    VoxelTree tree = dense.tree();
    const Vector3 sun = normalized(toward);
    sweepAll(tree, sun);
    double worst = 0;
    double sum = 0;
    int points = 0;
    for (int z = -4; z < 36; z += 3)
    {
      for (int y = 5; y < 19; y += 2)
      {
        for (int x = -13; x < 16; x += 2)
        {
          const Vector3 point{ 1.0 * x, 1.0 * y, 1.0 * z };
          if (dense.at(point) > 0)
          {
            const double error = std::abs(tree.sunDepth(point) - tree.sunDepthExact(point));
            worst = std::max(worst, error);
            sum += error;
            ++points;
          }
        }
      }
    }
    // Of depths up to 7. Linear between corners once a brick: exact along an axis, and coarse only behind the voxel that stands alone.
    const bool along = std::abs(sun[0]) + std::abs(sun[1]) + std::abs(sun[2]) < 1.00001;
    EXPECT_LT(sum / points, along ? 1e-6 : 0.03);
    EXPECT_LT(worst, along ? 1e-5 : 0.4) << toward[0] << ' ' << toward[1] << ' ' << toward[2];
  }
}

TEST(VoxelTree, ASlabInTheSunHasItsClosedForm)
{
  // Constant density from z = 0 to 23 and far aside, sun and eye above: J = (1 - exp(-2 tau)) / 2.
  std::vector<std::array<int, 3>> origins;
  for (int z = 0; z < 24; z += 8)
  {
    for (int y = -24; y < 24; y += 8)
    {
      for (int x = -24; x < 24; x += 8)
      {
        origins.push_back({ x, y, z });
      }
    }
  }
  const std::vector<float> values(512 * origins.size(), 0.01F);
  VoxelTree tree(origins, values.data());
  sweepAll(tree, { 0, 0, 1 });
  for (const double scale : { 0.5, 5.0, 50.0, 500.0, 5e4, 1e6 })
  {
    VoxelLight light;
    const Vector3 from{ 0.3, 0.7, 100 };
    const Vector3 down{ 0, 0, -1 };
    tree.walk(from, down, 0, Infinity,
      [&](std::size_t brick, double near, double far)
      {
        tree.shine(brick, from, down, near, far, scale, light);
        return true;
      });
    const double depth = 0.01 * 24 * scale; // 23 and half a voxel's slope at either end
    EXPECT_NEAR(light.transmittance, std::exp(-depth), 1e-5);
    // Second order in a voxel's depth where the slope at the top is thin; a closed form where it is not.
    const double voxel = 0.01 * scale;
    const double most = voxel <= 0.5 ? voxel * voxel / 12 : 0;
    EXPECT_NEAR(light.light, (1 - std::exp(-2 * depth)) / 2, 1e-3 + most) << scale;
  }
}

TEST(VoxelTree, LightIsThatOfADenseMarch)
{
  const Dense dense(balls);
  for (const double unit : { 1.0, 1e-3, 1e4 }) // voxels of a scene unit
  {
    VoxelTree tree = dense.tree();
    sweepAll(tree, unit * normalized(Vector3{ 0.4, -0.3, 0.9 }));
    const double scale = 0.5 * unit;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> u(-1, 1);
    for (int n = 0; n < 12; ++n)
    {
      const Vector3 to{ 8 * u(random), 11 + 3 * u(random), 15 + 14 * u(random) };
      const Vector3 from = to + Vector3{ 20 * u(random), -40, 20 * u(random) };
      const Vector3 direction = unit * normalized(to - from);
      VoxelLight light;
      tree.walk(from, direction, 0, Infinity,
        [&](std::size_t brick, double near, double far)
        {
          tree.shine(brick, from, direction, near, far, scale, light);
          return true;
        });
      double marched = 0;
      double through = 1;
      const double h = 0.2 / unit;
      for (int step = 0; step < 400; ++step)
      {
        const Vector3 point = from + ((step + 0.5) * h) * direction;
        const double depth = scale * h * dense.at(point);
        if (depth > 0)
        {
          marched += through * -std::expm1(-depth) * std::exp(-scale * tree.sunDepthExact(point));
          through *= std::exp(-depth);
        }
      }
      EXPECT_NEAR(light.transmittance, through, 2e-3) << unit;
      EXPECT_NEAR(light.light, marched, 0.01) << unit;
    }
  }
}

TEST(VoxelTree, DensitiesBeyondAllBoundsStayFinite)
{
  const Dense dense([](int x, int y, int z) { return (x + y + z) % 3 == 0 ? 3e38 : 1e-38; });
  VoxelTree tree = dense.tree();
  sweepAll(tree, { 0.3, 1e-5, 0.9 });
  const Vector3 from{ 0.2, 11.3, -60 };
  const Vector3 direction{ 0.1, 0, 1 };
  for (const double scale : { 0.0, 1.0, 1e9, 1e300 })
  {
    VoxelLight light;
    tree.walk(from, direction, 0, Infinity,
      [&](std::size_t brick, double near, double far)
      {
        tree.shine(brick, from, direction, near, far, scale, light);
        return true;
      });
    EXPECT_EQ(light.transmittance > 0.5, scale == 0) << scale;
    EXPECT_TRUE(light.light >= 0 && light.light <= 1) << scale << ' ' << light.light;
  }
}
