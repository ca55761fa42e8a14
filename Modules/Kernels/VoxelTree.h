// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file VoxelTree.h
 * @brief Sparse fog between voxels' centres: bricks found along rays, light that it scatters once.
 *
 * The density is trilinear between the voxels' centres, which have whole coordinates in index space. A cell is the box between eight
 * of them; bricks of 8 x 8 x 8 cells keep their 9 x 9 x 9 corners, so that none needs its neighbours, and exist only where a corner is
 * not 0. Blocks of 8 x 8 x 8 bricks stand in a table over the bounding box. A ray steps through blocks, through the bricks of those
 * that are there, through the cells of those that are there (Amanatides and Woo 1987, at three levels); the rest is skipped.
 *
 * Along a ray the density in a cell is a cubic, whose integral Gauss's rule with two points gives exactly: optical depths are exact.
 * Light that is scattered once, per unit of albedo, phase function and sunlight, is
 *
 *     J = integral of sigma(t) exp(-tau(t)) exp(-tau_sun(t)) dt        sigma = scale density
 *
 * each cell in closed form with an even sigma and a tau_sun that is linear through the Gauss points (second order, and half of the
 * light comes back from what is opaque). The cells of a brick are sampled first and lit together, in vectors and single precision.
 *
 * tau_sun is known at the corners, and trilinear between them. There it is found from the sun's side on: from a corner through its own
 * brick by the trapezoidal rule over the planes of corners across the sun's main axis, then from the next brick that is not empty, where
 * the ray enters it, bilinear on the face. Corners of a plane go the same way, shifted, which makes vectors of them. Bricks of one wave
 * do not need each other and may be swept at once; the result does not depend on how. sunDepthExact is the exact counterpart.
 *
 * Rays: points origin + t direction in index space, t in scene units. Parameters that are not finite give nothing; densities above 1e20
 * count as that. Memory: 5.8 kB a brick. Cost: some 10 ns a cell; a sweep some 10 us a brick.
 * @sa vtkCloudVoxelVolume, TestVoxelTree.cxx
 */
#ifndef VoxelTree_h
#define VoxelTree_h

#include "Vector3.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace nephoscope
{
/// What a stretch of a ray adds up to.
struct VoxelLight
{
  double transmittance = 1;
  double light = 0; ///< J of the stretch, attenuated within it
};

class VoxelTree
{
public:
  static constexpr int Edge = 8;

  VoxelTree() = default;
  /**
   * @param origins index of each brick's first voxel, multiples of 8, each once; @param values 512 a brick, x fastest. Negative ones
   * and those that are not finite count as 0.
   * Precondition: numberOfBlocks(origins) <= MostBlocks.
   */
  VoxelTree(const std::vector<std::array<int, 3>>& origins, const float* values);

  /// The table's size that bricks ask for; they may lie too far apart.
  static double numberOfBlocks(const std::vector<std::array<int, 3>>& origins);
  static constexpr double MostBlocks = 1 << 24;

  std::size_t numberOfBricks() const { return this->Origins.size(); }

  /// Calls visit(brick, t0, t1) for each brick that a ray meets between two distances, in order, until it returns false.
  template <class Visit>
  void walk(const Vector3& origin, const Vector3& direction, double t0, double t1,
    const Visit& visit) const;

  /// The integral of the density in a brick between two distances.
  double depthInBrick(
    std::size_t brick, const Vector3& origin, const Vector3& direction, double t0, double t1) const;

  /// The integral of the density between two distances.
  double depth(const Vector3& origin, const Vector3& direction, double t0, double t1) const;

  /// Go on with a stretch of light through a brick. @param scale extinction per density
  void shine(std::size_t brick, const Vector3& origin, const Vector3& direction, double t0,
    double t1, double scale, VoxelLight& light) const;

  /// Forget the sun's depths; direction toward the sun in index space, per scene unit.
  void setSun(const Vector3& towardSun);
  /// Bricks that wait for no other of theirs; waves in order.
  std::size_t numberOfWaves() const { return this->Waves.empty() ? 0 : this->Waves.size() - 1; }
  std::size_t waveBegin(std::size_t wave) const { return this->Waves[wave]; }
  /// Find the sun's depths of the brick at a place in the waves' order. From several threads at once for those of one wave.
  void sweep(std::size_t place);

  /// Integral of the density toward the sun, as the sweep left it, trilinear; index space. 0 where there is no brick.
  double sunDepth(const Vector3& point) const;
  double sunDepthExact(const Vector3& point) const;

private:
  static constexpr int Corners = Edge + 1;
  static constexpr std::size_t CornersOfBrick = Corners * Corners * Corners;
  static constexpr std::int32_t None = -1;
  using Key = std::array<int, 3>;

  /// At a corner of cells.
  struct Corner
  {
    float density;
    float sunDepth;
  };

  /// Steps of a ray through equal boxes; plane n of an axis lies at n times the size.
  struct Steps
  {
    int at[3];
    double next[3]; ///< distance of the next plane of each axis
    int sign[3];
    double size;
    const Vector3& origin;
    Vector3 inverse;

    Steps(const Vector3& from, const Vector3& direction, double t, double boxSize, const int low[3],
      int count);
    int nearest() const
    {
      const int first = this->next[0] <= this->next[1] ? 0 : 1;
      return this->next[first] <= this->next[2] ? first : 2;
    }
    void step(int axis)
    {
      this->at[axis] += this->sign[axis];
      this->next[axis] = this->plane(axis);
    }
    double plane(int axis) const
    {
      return ((this->at[axis] + (this->sign[axis] > 0)) * this->size - this->origin[axis]) *
        this->inverse[axis];
    }
  };

  /// Calls visit(first corner, index of the cell, t0, t1) for each cell of a brick.
  template <class Visit>
  void walkCells(std::size_t brick, const Vector3& origin, const Vector3& direction, double t0,
    double t1, const Visit& visit) const;

  template <class Visit>
  bool walkBlock(std::int32_t block, const int low[3], const Vector3& origin,
    const Vector3& direction, double t0, double t1, const Visit& visit) const;
  bool clip(const Vector3& origin, const Vector3& direction, double& t0, double& t1) const;
  void makeBricks(const std::vector<Key>& origins, const float* values);
  void makeTable();
  void fill(const std::vector<Key>& origins, const float* values);
  std::int32_t find(const Key& brick) const;
  struct BrickRay;
  struct SunSweep;
  /// Trilinear in the cell whose first corner this is.
  static Corner at(const Corner* corner, float x, float y, float z);
  /// Bilinear along y and z: density and sun's depth of a cell's first side, then of its other; one vector.
  static void rowAt(const Corner* corner, float y, float z, float* row);
  double sunDepthOn(std::size_t brick, const Vector3& point) const;
  float sunDepthBeyond(std::size_t brick, std::ptrdiff_t corner, double t0) const;

  std::vector<Key> Origins;         ///< of the bricks of cells, in bricks, sorted
  std::vector<Corner> Values;       ///< [brick][z][y][x]
  Key Low{};                        ///< first block
  Key Count{};                      ///< of blocks
  std::vector<std::int32_t> Blocks; ///< [z][y][x]: place in Bricks / 512, or None
  std::vector<std::int32_t> Bricks; ///< [block][z][y][x]: brick, or None
  Vector3 TowardSun{ 0, 0, 0 };
  int SunAxis = 0;                  ///< along which it is most
  std::vector<std::uint32_t> Order; ///< of bricks by waves
  std::vector<std::size_t> Waves;   ///< their begins, and the end
};

inline void VoxelTree::rowAt(const Corner* corner, float y, float z, float* row)
{
  constexpr int Size = 4;
  const float w[4] = { (1 - y) * (1 - z), y * (1 - z), (1 - y) * z, y * z };
  float from[4][Size];
  std::memcpy(from[0], corner, sizeof from[0]);
  std::memcpy(from[1], corner + Corners, sizeof from[1]);
  std::memcpy(from[2], corner + Corners * Corners, sizeof from[2]);
  std::memcpy(from[3], corner + Corners * Corners + Corners, sizeof from[3]);
  for (int n = 0; n < Size; ++n)
  {
    row[n] = w[0] * from[0][n] + w[1] * from[1][n] + w[2] * from[2][n] + w[3] * from[3][n];
  }
}

inline VoxelTree::Corner VoxelTree::at(const Corner* corner, float x, float y, float z)
{
  float row[4];
  rowAt(corner, y, z, row);
  return { row[0] + x * (row[2] - row[0]), row[1] + x * (row[3] - row[1]) };
}

template <class Visit>
bool VoxelTree::walkBlock(std::int32_t block, const int low[3], const Vector3& origin,
  const Vector3& direction, double t0, double t1, const Visit& visit) const
{
  Steps brick(origin, direction, t0, Edge, low, Edge);
  for (double t = t0; t < t1;)
  {
    const int axis = brick.nearest();
    const double end = brick.next[axis] < t1 ? brick.next[axis] : t1;
    const auto place = static_cast<std::size_t>(
      ((brick.at[2] - low[2]) * Edge + (brick.at[1] - low[1])) * Edge + (brick.at[0] - low[0]));
    const std::int32_t number =
      this->Bricks[static_cast<std::size_t>(block) * Edge * Edge * Edge + place];
    if (number != None && t < end && !visit(static_cast<std::size_t>(number), t, end))
    {
      return false;
    }
    brick.step(axis);
    if (static_cast<unsigned>(brick.at[axis] - low[axis]) >= Edge)
    {
      break;
    }
    t = end > t ? end : t;
  }
  return true;
}

template <class Visit>
void VoxelTree::walk(
  const Vector3& origin, const Vector3& direction, double t0, double t1, const Visit& visit) const
{
  if (this->Blocks.empty() || !this->clip(origin, direction, t0, t1))
  {
    return;
  }
  const int* const first = this->Low.data();
  const int* const count = this->Count.data();
  constexpr double BlockSize = Edge * Edge;
  Steps block(origin, direction, t0, BlockSize, first, 0);
  for (int c = 0; c < 3; ++c)
  {
    const int last = first[c] + count[c] - 1;
    const int inside = block.at[c] < first[c] ? first[c] : block.at[c];
    block.at[c] = inside > last ? last : inside;
    block.next[c] = direction[c] != 0 ? block.plane(c) : block.next[c];
  }
  for (double t = t0; t < t1;)
  {
    const int axis = block.nearest();
    const double end = block.next[axis] < t1 ? block.next[axis] : t1;
    const int at[3] = { block.at[0] - first[0], block.at[1] - first[1], block.at[2] - first[2] };
    const std::int32_t found =
      this->Blocks[(static_cast<std::size_t>(at[2]) * count[1] + at[1]) * count[0] + at[0]];
    const int low[3] = { block.at[0] * Edge, block.at[1] * Edge, block.at[2] * Edge };
    if (found != None && t < end && !this->walkBlock(found, low, origin, direction, t, end, visit))
    {
      return;
    }
    block.step(axis);
    if (static_cast<unsigned>(block.at[axis] - first[axis]) >= static_cast<unsigned>(count[axis]))
    {
      return;
    }
    t = end > t ? end : t;
  }
}
}
#endif
