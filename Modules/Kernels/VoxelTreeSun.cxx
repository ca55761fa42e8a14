// SPDX-License-Identifier: BSD-3-Clause
// The sun's depths at the corners of a VoxelTree's bricks, one brick after the other from the sun's side on.
#include "VoxelTree.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
constexpr int Edge = VoxelTree::Edge;
constexpr int Corners = Edge + 1;
constexpr double OnFace =
  1e-9; // how far outside a brick a place still counts as on its face, cells
constexpr double Upright = 1e-4;   // slope below which the sun's way keeps to its line of corners
constexpr float MostDepth = 1e20F; // so that sums stay finite

/// A shift by part of a cell: whole cells and the rest.
struct Shift
{
  explicit Shift(double by)
    : whole(static_cast<int>(by + OnFace))
    , rest(static_cast<float>(std::max(by - this->whole, 0.0)))
  {
  }
  int whole;
  float rest;
};

bool isWithin(int place, double by)
{
  return place + by <= Edge + OnFace;
}
}

void VoxelTree::setSun(const Vector3& towardSun)
{
  this->TowardSun = towardSun;
  this->SunAxis = 0;
  for (int c = 1; c < 3; ++c)
  {
    this->SunAxis = std::abs(towardSun[c]) > std::abs(towardSun[this->SunAxis]) ? c : this->SunAxis;
  }
  const auto level = [this, &towardSun](std::uint32_t brick)
  {
    long long sum = 0;
    for (int c = 0; c < 3; ++c)
    {
      sum += (towardSun[c] < 0 ? -1 : 1) *
        static_cast<long long>(this->Origins[brick][static_cast<std::size_t>(c)]);
    }
    return sum;
  };
  this->Order.resize(this->Origins.size());
  for (std::size_t b = 0; b < this->Order.size(); ++b)
  {
    this->Order[b] = static_cast<std::uint32_t>(b);
  }
  std::sort(this->Order.begin(), this->Order.end(),
    [&level](std::uint32_t a, std::uint32_t b)
    {
      const long long la = level(a);
      const long long lb = level(b);
      return la != lb ? la > lb : a < b;
    });
  this->Waves.clear();
  for (std::size_t b = 0; b < this->Order.size(); ++b)
  {
    if (b == 0 || level(this->Order[b]) != level(this->Order[b - 1]))
    {
      this->Waves.push_back(b);
    }
  }
  this->Waves.push_back(this->Order.size());
}

/// The sun's depth that a brick has at a point on its face.
double VoxelTree::sunDepthOn(std::size_t brick, const Vector3& point) const
{
  const Key& key = this->Origins[brick];
  const Corner* corner = this->Values.data() + brick * CornersOfBrick;
  float place[3];
  for (int c = 0; c < 3; ++c)
  {
    const double x =
      std::min(std::max(point[c] - key[static_cast<std::size_t>(c)] * Edge, 0.0), 1.0 * Edge);
    const int at = std::min(static_cast<int>(x), Edge - 1);
    place[c] = static_cast<float>(x - at);
    corner += at * (c == 0 ? 1 : c == 1 ? Corners : Corners * Corners);
  }
  return static_cast<double>(this->at(corner, place[0], place[1], place[2]).sunDepth);
}

/// Where a corner's way enters the first brick beyond a distance that is not empty: the sun's depth there.
float VoxelTree::sunDepthBeyond(std::size_t brick, std::ptrdiff_t corner, double t0) const
{
  const Key& key = this->Origins[brick];
  const std::ptrdiff_t at[3] = { corner % Corners, corner / Corners % Corners,
    corner / (Corners * Corners) };
  Vector3 point{};
  for (int c = 0; c < 3; ++c)
  {
    point[c] = 1.0 * Edge * key[static_cast<std::size_t>(c)] + static_cast<double>(at[c]);
  }
  double depth = 0;
  this->walk(point, this->TowardSun, t0, std::numeric_limits<double>::infinity(),
    [&](std::size_t other, double near, double)
    {
      if (other == brick)
      {
        return true;
      }
      depth = this->sunDepthOn(other, point + near * this->TowardSun);
      return false;
    });
  return static_cast<float>(depth);
}

/**
 * A brick seen from the sun: axis 2 is the one along which the sun's way is most, all three grow toward the sun. Corners of a plane go the
 * same way to the planes further up, so that one shift and one pair of weights serves them all; loops over axis 0 are vectors.
 */
struct VoxelTree::SunSweep
{
  static constexpr int Vector = 12; ///< corners along axis 0, in whole vectors
  static constexpr int Wide = 24;   ///< and as many shifted by a brick
  using Plane = float[Corners + 1][Wide];

  int axes[3];
  double slope[3] = { 0, 0, 1 }; ///< along the axes from plane to plane of axis 2
  float step;                    ///< from plane to plane, scene units
  std::ptrdiff_t stride[3];
  std::ptrdiff_t first = 0; ///< the corner farthest from the sun
  Plane density[Corners] = {};
  float sum[Corners][Corners]
           [Vector] = {}; ///< of the densities on the planes that are met in the brick
  float last[Corners][Corners][Vector] = {}; ///< the last of them
  Plane face[2] = {}; ///< density and sun's depth that the next brick has on a face

  explicit SunSweep(const VoxelTree& tree);
  Corner* at(Corner* corners, int u, int v, int w) const
  {
    return corners + this->first + u * this->stride[0] + v * this->stride[1] + w * this->stride[2];
  }
  void addPlanes(Corner* corners);
  void addPlane(int n);
  void readFace(Corner* next, int axis);

  /// Calls visit(u, v, w, distance in steps, density and sun's depth on the face) for the corners whose way leaves across a face.
  template <class Visit>
  void leaveAcross(int axis, const Visit& visit) const;
  /// The sun's depth of a corner whose way leaves after so many steps. @param entry what it meets there
  float depth(int u, int v, int w, double steps, const Corner& entry) const;
};

VoxelTree::SunSweep::SunSweep(const VoxelTree& tree)
  : axes{ (tree.SunAxis + 1) % 3, (tree.SunAxis + 2) % 3, tree.SunAxis }
  , step(static_cast<float>(1 / std::abs(tree.TowardSun[tree.SunAxis])))
{
  constexpr std::ptrdiff_t Strides[3] = { 1, Corners, Corners * Corners };
  for (int c = 0; c < 3; ++c)
  {
    const bool flipped = tree.TowardSun[this->axes[c]] < 0;
    this->stride[c] = (flipped ? -1 : 1) * Strides[this->axes[c]];
    this->first += flipped ? Edge * Strides[this->axes[c]] : 0;
  }
  for (int c = 0; c < 2; ++c)
  {
    const double along = std::abs(tree.TowardSun[this->axes[c]] / tree.TowardSun[tree.SunAxis]);
    this->slope[c] = along < Upright ? 0 : along;
  }
}

void VoxelTree::SunSweep::addPlanes(Corner* corners)
{
  for (int w = 0; w < Corners; ++w)
  {
    for (int v = 0; v < Corners; ++v)
    {
      for (int u = 0; u < Corners; ++u)
      {
        this->density[w][v][u] = this->at(corners, u, v, w)->density;
        this->last[w][v][u] = this->density[w][v][u];
        this->sum[w][v][u] = 0.5F * this->density[w][v][u];
      }
    }
  }
  for (int n = 1; n < Corners; ++n)
  {
    this->addPlane(n);
  }
}

/// The density n planes nearer to the sun, for the corners from which the way there keeps within the brick.
void VoxelTree::SunSweep::addPlane(int n)
{
  const Shift right(n * this->slope[0]);
  const Shift up(n * this->slope[1]);
  float within[Vector];
  for (int u = 0; u < Vector; ++u)
  {
    within[u] = isWithin(u, n * this->slope[0]) ? 1.0F : 0.0F;
  }
  for (int w = 0; w + n < Corners; ++w)
  {
    for (int v = 0; v < Corners && isWithin(v, n * this->slope[1]); ++v)
    {
      const float* const low = this->density[w + n][v + up.whole] + right.whole;
      const float* const high = low + Wide;
      float* const sums = this->sum[w][v];
      float* const lasts = this->last[w][v];
      for (int u = 0; u < Vector; ++u)
      {
        const float a = low[u] + right.rest * (low[u + 1] - low[u]);
        const float b = high[u] + right.rest * (high[u + 1] - high[u]);
        const float value = a + up.rest * (b - a);
        sums[u] += within[u] * value;
        lasts[u] += within[u] * (value - lasts[u]);
      }
    }
  }
}

/// The next brick's side that is shared: rows along the higher of the other two axes; nothing if there is no such brick.
void VoxelTree::SunSweep::readFace(Corner* next, int axis)
{
  for (int q = 0; q < Corners; ++q)
  {
    for (int p = 0; p < Corners; ++p)
    {
      const Corner corner = axis == 0 ? *this->at(next, 0, p, q)
        : axis == 1                   ? *this->at(next, p, 0, q)
                                      : *this->at(next, p, q, 0);
      this->face[0][q][p] = corner.density;
      this->face[1][q][p] = corner.sunDepth;
    }
  }
}

template <class Visit>
void VoxelTree::SunSweep::leaveAcross(int axis, const Visit& visit) const
{
  const int rows = axis == 2 ? 1 : 2;
  const int columns = axis == 0 ? 1 : 0;
  for (int k = 0; k < Corners; ++k)
  {
    const double steps = (Edge - k) / this->slope[axis];
    const double along[2] = { steps * this->slope[columns], steps * this->slope[rows] };
    for (int q = 0; q < Corners && isWithin(q, along[1]); ++q)
    {
      const Shift up(along[1]);
      for (int p = 0; p < Corners && isWithin(p, along[0]); ++p)
      {
        const Shift right(along[0]);
        Corner entry{};
        float* const values[2] = { &entry.density, &entry.sunDepth };
        for (int n = 0; n < 2; ++n)
        {
          const float* const low = this->face[n][q + up.whole] + p + right.whole;
          const float* const high = low + Wide;
          const float a = low[0] + right.rest * (low[1] - low[0]);
          const float b = high[0] + right.rest * (high[1] - high[0]);
          *values[n] = a + up.rest * (b - a);
        }
        int at[3];
        at[axis] = k;
        at[columns] = p;
        at[rows] = q;
        visit(at[0], at[1], at[2], steps, entry);
      }
    }
  }
}

float VoxelTree::SunSweep::depth(int u, int v, int w, double steps, const Corner& entry) const
{
  const float last = this->last[w][v][u];
  const Shift way(steps + Upright); // as many whole steps as there were planes
  const float rest = std::max(static_cast<float>(steps - way.whole), 0.0F);
  const float planes = this->sum[w][v][u] - 0.5F * last;
  return this->step * (planes + 0.5F * rest * (last + entry.density)) + entry.sunDepth;
}

void VoxelTree::sweep(std::size_t place)
{
  const std::size_t brick = this->Order[place];
  const Key& key = this->Origins[brick];
  Corner* const corners = this->Values.data() + brick * CornersOfBrick;
  SunSweep sweep(*this);
  sweep.addPlanes(corners);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(sweep.slope[axis] > 0))
    {
      continue;
    }
    Key nextKey = key;
    nextKey[static_cast<std::size_t>(sweep.axes[axis])] += sweep.stride[axis] > 0 ? 1 : -1;
    const std::int32_t next = this->find(nextKey);
    if (next != None)
    {
      sweep.readFace(this->Values.data() + static_cast<std::size_t>(next) * CornersOfBrick, axis);
    }
    sweep.leaveAcross(axis,
      [&](int u, int v, int w, double steps, Corner entry)
      {
        Corner* const corner = sweep.at(corners, u, v, w);
        if (next == None)
        {
          entry = { 0,
            this->sunDepthBeyond(
              brick, corner - corners, steps * static_cast<double>(sweep.step)) };
        }
        corner->sunDepth = std::min(sweep.depth(u, v, w, steps, entry), MostDepth);
      });
  }
}
}
