// SPDX-License-Identifier: BSD-3-Clause
#include "VoxelTree.h"

#include "Exponential.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
constexpr int Edge = VoxelTree::Edge;
constexpr double ThinCell = 0.25; // optical depth up to which a cell is lit as one
constexpr double GaussPoint = 0.57735026918962576451; // of two points, in half widths

int floorDivide(int a, int b)
{
  return a >= 0 ? a / b : -((-a + b - 1) / b);
}

/// 1 - exp(-x) up to ThinCell, by Taylor's series: 3e-7 of it at most is left out.
double blockedByThin(double x)
{
  return x * (1 - x / 2 * (1 - x / 3 * (1 - x / 4 * (1 - x / 5))));
}

/// exp(-depth); in the dark, below 1e-6, nothing.
double sunThrough(double depth)
{
  return depth < 14 ? exponential(-depth) : 0;
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

void VoxelLight::add(const double tau[2], const double sun[2])
{
  const double both = tau[0] + tau[1];
  if (!(both > 0))
  {
    return;
  }
  if (both < ThinCell)
  {
    const double blocked = blockedByThin(both);
    const double depth = (tau[0] * sun[0] + tau[1] * sun[1]) / both;
    this->light += this->transmittance * blocked * sunThrough(depth);
    this->transmittance *= 1 - blocked;
    return;
  }
  // Sun's depths at both ends; the light is an integral of exponentials that does not fade away where a cell is opaque.
  const double slope = (sun[1] - sun[0]) / (2 * GaussPoint);
  const double middle = 0.5 * (sun[0] + sun[1]);
  const double near = std::max(middle - slope, 0.0);
  const double far = std::max(middle + slope, 0.0);
  const double fade = both + far - near;
  const double first = sunThrough(near);
  this->light += this->transmittance * both *
    (std::abs(fade) < 1e-4 ? first * (1 - 0.5 * fade) : (first - sunThrough(far + both)) / fade);
  this->transmittance *= exponential(-both);
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
              .density = isFog(value) ? value : 0.0F;
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

VoxelTree::Corner VoxelTree::at(const Corner* corner, float x, float y, float z) const
{
  // Four floats of a row: density and sun's depth of two corners. Along y and z they go together.
  const Corner* const rows[4] = { corner, corner + Corners, corner + Corners * Corners,
    corner + Corners * Corners + Corners };
  const float w[4] = { (1 - y) * (1 - z), y * (1 - z), (1 - y) * z, y * z };
  float sum[4] = { 0, 0, 0, 0 };
  for (int r = 0; r < 4; ++r)
  {
    sum[0] += w[r] * rows[r][0].density;
    sum[1] += w[r] * rows[r][0].sunDepth;
    sum[2] += w[r] * rows[r][1].density;
    sum[3] += w[r] * rows[r][1].sunDepth;
  }
  return { sum[0] + x * (sum[2] - sum[0]), sum[1] + x * (sum[3] - sum[1]) };
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

void VoxelTree::shine(std::size_t brick, const Vector3& origin, const Vector3& direction, double t0,
  double t1, double scale, VoxelLight& light) const
{
  this->walkCells(brick, origin, direction, t0, t1,
    [&](const Corner* corner, const int at[3], double near, double far)
    {
      const double half = 0.5 * (far - near);
      double tau[2];
      double sun[2];
      for (int n = 0; n < 2; ++n)
      {
        const double t = near + half * (n == 0 ? 1 - GaussPoint : 1 + GaussPoint);
        const Corner here =
          this->at(corner, static_cast<float>(origin[0] + direction[0] * t - at[0]),
            static_cast<float>(origin[1] + direction[1] * t - at[1]),
            static_cast<float>(origin[2] + direction[2] * t - at[2]));
        tau[n] = scale * half * static_cast<double>(here.density);
        sun[n] = scale * static_cast<double>(here.sunDepth);
      }
      light.add(tau, sun);
    });
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

/// From a corner of a brick toward the sun to a distance within it: the trapezoidal rule over the planes of corners across the sun's
/// main axis, on which the density is bilinear; what remains after the last plane exactly.
double VoxelTree::depthOverPlanes(std::size_t brick, const int corner[3], double exit) const
{
  constexpr int Stride[3] = { 1, Corners, Corners * Corners };
  const Vector3& sun = this->TowardSun;
  const int main = this->SunAxis;
  const int others[2] = { (main + 1) % 3, (main + 2) % 3 };
  const double step = 1 / std::abs(sun[main]);
  const int planes = static_cast<int>(exit / step + 1e-9);
  const Corner* const corners = this->Values.data() + brick * CornersOfBrick;
  const Corner* at = corners + corner[0] + corner[1] * Stride[1] + corner[2] * Stride[2];
  float sum = 0.5F * at->density;
  float last = at->density;
  const float slope[2] = { static_cast<float>(sun[others[0]] * step),
    static_cast<float>(sun[others[1]] * step) };
  for (int n = 1; n <= planes; ++n)
  {
    const int along = corner[main] + (sun[main] > 0 ? n : -n);
    const float u = static_cast<float>(corner[others[0]]) + static_cast<float>(n) * slope[0];
    const float v = static_cast<float>(corner[others[1]]) + static_cast<float>(n) * slope[1];
    const int i = std::min(std::max(static_cast<int>(u), 0), Edge - 1);
    const int j = std::min(std::max(static_cast<int>(v), 0), Edge - 1);
    const float x = u - static_cast<float>(i);
    const float y = v - static_cast<float>(j);
    at = corners + along * Stride[main] + i * Stride[others[0]] + j * Stride[others[1]];
    const Corner* const up = at + Stride[others[1]];
    const float low = at->density + x * (at[Stride[others[0]]].density - at->density);
    const float high = up->density + x * (up[Stride[others[0]]].density - up->density);
    last = low + y * (high - low);
    sum += last;
  }
  const double whole = step * static_cast<double>(sum - 0.5F * last);
  const double done = planes * step;
  if (exit - done < 1e-9 * step)
  {
    return whole;
  }
  const Key& key = this->Origins[brick];
  const Vector3 point{ 1.0 * key[0] * Edge + corner[0], 1.0 * key[1] * Edge + corner[1],
    1.0 * key[2] * Edge + corner[2] };
  return whole + this->depthInBrick(brick, point, sun, done, exit);
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

double VoxelTree::sunDepthFrom(std::size_t brick, const int corner[3]) const
{
  const Vector3& sun = this->TowardSun;
  const Key& key = this->Origins[brick];
  const Vector3 point{ 1.0 * key[0] * Edge + corner[0], 1.0 * key[1] * Edge + corner[1],
    1.0 * key[2] * Edge + corner[2] };
  double exit = std::numeric_limits<double>::infinity();
  int side = 0;
  for (int c = 0; c < 3; ++c)
  {
    const double t = sun[c] != 0 ? ((sun[c] > 0 ? Edge : 0) - corner[c]) / sun[c]
                                 : std::numeric_limits<double>::infinity();
    side = t < exit ? c : side;
    exit = std::min(exit, t);
  }
  double sum = exit > 0 ? this->depthOverPlanes(brick, corner, exit) : 0;
  Key next = key;
  next[static_cast<std::size_t>(side)] += sun[side] > 0 ? 1 : -1;
  const std::int32_t neighbour = this->find(next);
  if (neighbour != None)
  {
    return sum + this->sunDepthOn(static_cast<std::size_t>(neighbour), point + exit * sun);
  }
  this->walk(point, sun, std::max(exit, 0.0), std::numeric_limits<double>::infinity(),
    [&](std::size_t other, double near, double)
    {
      if (other == brick)
      {
        return true;
      }
      sum += this->sunDepthOn(other, point + near * sun);
      return false;
    });
  return sum;
}

void VoxelTree::sweep(std::size_t place)
{
  const std::size_t brick = this->Order[place];
  Corner* corner = this->Values.data() + brick * CornersOfBrick;
  for (int z = 0; z < Corners; ++z)
  {
    for (int y = 0; y < Corners; ++y)
    {
      for (int x = 0; x < Corners; ++x, ++corner)
      {
        const int at[3] = { x, y, z };
        corner->sunDepth = static_cast<float>(this->sunDepthFrom(brick, at));
      }
    }
  }
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
