// SPDX-License-Identifier: BSD-3-Clause
#include "VoxelTree.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
constexpr int Edge = VoxelTree::Edge;
constexpr float MostDensity = 1e20F;                  // so that sums stay finite
constexpr double GaussPoint = 0.57735026918962576451; // of two points, in half widths

int floorDivide(int a, int b)
{
  return a >= 0 ? a / b : -((-a + b - 1) / b);
}

bool isFog(float value)
{
  return value > 0 && std::isfinite(value);
}

/// Blocks that the bricks of cells can lie in: those of the voxels and the ones below.
void blockRange(
  const std::vector<std::array<int, 3>>& origins, std::array<int, 3>& low, std::array<int, 3>& high)
{
  for (const auto& origin : origins)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      low[c] = std::min(low[c], floorDivide(floorDivide(origin[c], Edge) - 1, Edge));
      high[c] = std::max(high[c], floorDivide(floorDivide(origin[c], Edge), Edge));
    }
  }
}
}

double VoxelTree::numberOfBlocks(const std::vector<Key>& origins)
{
  constexpr int Most = std::numeric_limits<int>::max();
  Key low{ Most, Most, Most };
  Key high{ -Most, -Most, -Most };
  blockRange(origins, low, high);
  double number = origins.empty() ? 0 : 1;
  for (std::size_t c = 0; c < 3; ++c)
  {
    number *= 1.0 + high[c] - static_cast<double>(low[c]);
  }
  return number;
}

VoxelTree::VoxelTree(const std::vector<Key>& origins, const float* values)
{
  this->makeBricks(origins, values);
  if (this->Origins.empty())
  {
    return;
  }
  this->makeTable();
  this->fill(origins, values);
}

/// The bricks of cells that have a corner which is not 0: a brick of voxels' own, and those below that share its first layer.
void VoxelTree::makeBricks(const std::vector<Key>& origins, const float* values)
{
  for (std::size_t b = 0; b < origins.size(); ++b)
  {
    unsigned needed = 0; // a bit for each of the eight
    for (int v = 0; v < 512; ++v)
    {
      if (isFog(values[b * 512 + static_cast<std::size_t>(v)]))
      {
        const unsigned first[3] = { v % 8 == 0, v / 8 % 8 == 0, v / 64 == 0 };
        for (unsigned n = 0; n < 8; ++n)
        {
          const bool reaches =
            (first[0] >= (n & 1)) && (first[1] >= (n >> 1 & 1)) && (first[2] >= (n >> 2));
          needed |= static_cast<unsigned>(reaches) << n;
        }
      }
    }
    for (int n = 0; n < 8; ++n)
    {
      if (needed >> n & 1)
      {
        const Key& o = origins[b];
        this->Origins.push_back({ floorDivide(o[0], Edge) - (n & 1),
          floorDivide(o[1], Edge) - (n >> 1 & 1), floorDivide(o[2], Edge) - (n >> 2) });
      }
    }
  }
  std::sort(this->Origins.begin(), this->Origins.end());
  this->Origins.erase(std::unique(this->Origins.begin(), this->Origins.end()), this->Origins.end());
}

void VoxelTree::makeTable()
{
  const auto blockOf = [](const Key& brick)
  {
    return Key{ floorDivide(brick[0], Edge), floorDivide(brick[1], Edge),
      floorDivide(brick[2], Edge) };
  };
  this->Low = blockOf(this->Origins.front());
  Key high = this->Low;
  for (const Key& brick : this->Origins)
  {
    const Key block = blockOf(brick);
    for (std::size_t c = 0; c < 3; ++c)
    {
      this->Low[c] = std::min(this->Low[c], block[c]);
      high[c] = std::max(high[c], block[c]);
    }
  }
  for (std::size_t c = 0; c < 3; ++c)
  {
    this->Count[c] = high[c] - this->Low[c] + 1;
  }
  this->Blocks.assign(
    static_cast<std::size_t>(this->Count[0]) * this->Count[1] * this->Count[2], None);
  for (std::size_t b = 0; b < this->Origins.size(); ++b)
  {
    const Key& brick = this->Origins[b];
    const Key block = blockOf(brick);
    std::int32_t& found =
      this->Blocks[(static_cast<std::size_t>(block[2] - this->Low[2]) * this->Count[1] +
                     (block[1] - this->Low[1])) *
          this->Count[0] +
        (block[0] - this->Low[0])];
    if (found == None)
    {
      found = static_cast<std::int32_t>(this->Bricks.size() / 512);
      this->Bricks.resize(this->Bricks.size() + 512, None);
    }
    this->Bricks[static_cast<std::size_t>(found) * 512 +
      static_cast<std::size_t>(
        ((brick[2] - block[2] * Edge) * Edge + (brick[1] - block[1] * Edge)) * Edge +
        (brick[0] - block[0] * Edge))] = static_cast<std::int32_t>(b);
  }
}

std::int32_t VoxelTree::find(const Key& brick) const
{
  Key block{};
  for (std::size_t c = 0; c < 3; ++c)
  {
    block[c] = floorDivide(brick[c], Edge);
    if (block[c] < this->Low[c] || block[c] >= this->Low[c] + this->Count[c])
    {
      return None;
    }
  }
  const std::int32_t found =
    this->Blocks[(static_cast<std::size_t>(block[2] - this->Low[2]) * this->Count[1] +
                   (block[1] - this->Low[1])) *
        this->Count[0] +
      (block[0] - this->Low[0])];
  return found == None
    ? None
    : this->Bricks[static_cast<std::size_t>(found) * 512 +
        static_cast<std::size_t>(
          ((brick[2] - block[2] * Edge) * Edge + (brick[1] - block[1] * Edge)) * Edge +
          (brick[0] - block[0] * Edge))];
}

void VoxelTree::fill(const std::vector<Key>& origins, const float* values)
{
  this->Values.assign(this->Origins.size() * CornersOfBrick, Corner{ 0, 0 });
  for (std::size_t b = 0; b < origins.size(); ++b)
  {
    for (int n = 0; n < 8; ++n)
    {
      const int down[3] = { n & 1, n >> 1 & 1, n >> 2 };
      const std::int32_t brick = this->find({ floorDivide(origins[b][0], Edge) - down[0],
        floorDivide(origins[b][1], Edge) - down[1], floorDivide(origins[b][2], Edge) - down[2] });
      if (brick == None)
      {
        continue;
      }
      Corner* const corners =
        this->Values.data() + static_cast<std::size_t>(brick) * CornersOfBrick;
      for (int z = 0; z < (down[2] ? 1 : Edge); ++z)
      {
        for (int y = 0; y < (down[1] ? 1 : Edge); ++y)
        {
          for (int x = 0; x < (down[0] ? 1 : Edge); ++x)
          {
            const float value =
              values[b * 512 + static_cast<std::size_t>((z * Edge + y) * Edge + x)];
            corners[((z + Edge * down[2]) * Corners + y + Edge * down[1]) * Corners + x +
              Edge * down[0]]
              .density = isFog(value) ? std::min(value, MostDensity) : 0.0F;
          }
        }
      }
    }
  }
}

/// Shorten a stretch of a ray to the table's box. Returns whether anything is left.
bool VoxelTree::clip(const Vector3& origin, const Vector3& direction, double& t0, double& t1) const
{
  constexpr double BlockSize = Edge * Edge;
  for (int c = 0; c < 3; ++c)
  {
    const auto axis = static_cast<std::size_t>(c);
    if (!std::isfinite(origin[c]) || !std::isfinite(direction[c]))
    {
      return false;
    }
    const double low = this->Low[axis] * BlockSize - origin[c];
    const double high = low + this->Count[axis] * BlockSize;
    if (direction[c] != 0)
    {
      const double a = low / direction[c];
      const double b = high / direction[c];
      t0 = std::max(t0, std::min(a, b));
      t1 = std::min(t1, std::max(a, b));
    }
    else if (!(low <= 0 && high >= 0))
    {
      return false;
    }
  }
  return t0 < t1;
}

VoxelTree::Steps::Steps(const Vector3& from, const Vector3& direction, double t, double boxSize,
  const int low[3], int count)
  : size(boxSize)
  , origin(from)
{
  for (int c = 0; c < 3; ++c)
  {
    const double d = direction[c];
    const double place = (from[c] + d * t) / boxSize;
    this->sign[c] = d < 0 ? -1 : 1;
    this->inverse[c] = d != 0 ? 1 / d : std::numeric_limits<double>::infinity();
    const double box = d < 0 ? std::ceil(place) - 1 : std::floor(place);
    this->at[c] = static_cast<int>(std::min(std::max(box, -1e9), 1e9));
    if (count > 0)
    {
      this->at[c] = std::min(std::max(this->at[c], low[c]), low[c] + count - 1);
    }
    // A ray along the boxes never meets a plane; 0 times infinity would be no number.
    if (d != 0)
    {
      this->next[c] = this->plane(c);
    }
    else
    {
      this->next[c] = std::numeric_limits<double>::infinity();
    }
  }
}

template <class Visit>
void VoxelTree::walkCells(std::size_t brick, const Vector3& origin, const Vector3& direction,
  double t0, double t1, const Visit& visit) const
{
  const Key& key = this->Origins[brick];
  const int low[3] = { key[0] * Edge, key[1] * Edge, key[2] * Edge };
  const Corner* const corners = this->Values.data() + brick * CornersOfBrick;
  Steps cell(origin, direction, t0, 1, low, Edge);
  for (double t = t0; t < t1;)
  {
    const int axis = cell.nearest();
    const double end = std::min(cell.next[axis], t1);
    if (end > t)
    {
      const Corner* const corner = corners +
        ((cell.at[2] - low[2]) * Corners + (cell.at[1] - low[1])) * Corners + (cell.at[0] - low[0]);
      visit(corner, cell.at, t, end);
      t = end;
    }
    cell.step(axis);
    if (static_cast<unsigned>(cell.at[axis] - low[axis]) >= Edge)
    {
      return;
    }
  }
}

double VoxelTree::depthInBrick(
  std::size_t brick, const Vector3& origin, const Vector3& direction, double t0, double t1) const
{
  double sum = 0;
  this->walkCells(brick, origin, direction, t0, t1,
    [&](const Corner* corner, const int at[3], double near, double far)
    {
      const double half = 0.5 * (far - near);
      for (const double g : { -GaussPoint, GaussPoint })
      {
        const double t = near + half * (1 + g);
        const auto density =
          this
            ->at(corner, static_cast<float>(origin[0] + direction[0] * t - at[0]),
              static_cast<float>(origin[1] + direction[1] * t - at[1]),
              static_cast<float>(origin[2] + direction[2] * t - at[2]))
            .density;
        sum += half * static_cast<double>(density);
      }
    });
  return sum;
}

double VoxelTree::depth(const Vector3& origin, const Vector3& direction, double t0, double t1) const
{
  double sum = 0;
  this->walk(origin, direction, t0, t1,
    [&](std::size_t brick, double near, double far)
    {
      sum += this->depthInBrick(brick, origin, direction, near, far);
      return true;
    });
  return sum;
}

double VoxelTree::sunDepth(const Vector3& point) const
{
  Key key{};
  float place[3];
  std::size_t offset = 0;
  for (int c = 0; c < 3; ++c)
  {
    const double cell = std::floor(point[c]);
    if (!(std::abs(cell) < 1e9))
    {
      return 0;
    }
    key[static_cast<std::size_t>(c)] = floorDivide(static_cast<int>(cell), Edge);
    const int at = static_cast<int>(cell) - key[static_cast<std::size_t>(c)] * Edge;
    place[c] = static_cast<float>(point[c] - cell);
    offset += static_cast<std::size_t>(at * (c == 0 ? 1 : c == 1 ? Corners : Corners * Corners));
  }
  const std::int32_t brick = this->Origins.empty() ? None : this->find(key);
  return brick == None
    ? 0
    : static_cast<double>(
        this
          ->at(this->Values.data() + static_cast<std::size_t>(brick) * CornersOfBrick + offset,
            place[0], place[1], place[2])
          .sunDepth);
}

double VoxelTree::sunDepthExact(const Vector3& point) const
{
  return this->depth(point, this->TowardSun, 0, std::numeric_limits<double>::infinity());
}
}
