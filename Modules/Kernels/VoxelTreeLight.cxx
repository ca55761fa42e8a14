// SPDX-License-Identifier: BSD-3-Clause
// Light that rays gather in the bricks of a VoxelTree.
#include "VoxelTree.h"

#include "Exponential.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
constexpr int Edge = VoxelTree::Edge;
constexpr float GaussPoint = 0.577350269F; // of two points, in half widths
constexpr float Opaque = 1e6F;             // an optical depth; more is as much

/// Where a ray is sampled in a brick, two points a cell: as arrays, for loops over them to become vector instructions.
struct Samples
{
  static constexpr int Most = 24; ///< cells: 3 * 8 - 2, and whole vectors

  int cells = 0;
  float half[Most];       ///< of a cell's length, in lengths of index space
  float row[2 * Most][4]; ///< VoxelTree::rowAt
  float x[2 * Most];      ///< between the row's ends

  float density(int n) const
  {
    return this->row[n][0] + this->x[n] * (this->row[n][2] - this->row[n][0]);
  }
  float sunDepth(int n) const
  {
    return this->row[n][1] + this->x[n] * (this->row[n][3] - this->row[n][1]);
  }
};

/// What a ray meets in the cells of a brick.
struct MetCells
{
  int number = 0;             ///< whole vectors
  float depth[Samples::Most]; ///< integrals of the density over lengths of index space
  float sun[Samples::Most];   ///< integral of the density toward the sun, midway
  float slope[Samples::Most]; ///< half of its difference along the cell

  explicit MetCells(const Samples& samples)
  {
    for (; this->number < samples.cells; ++this->number)
    {
      const int n = this->number;
      this->depth[n] = samples.half[n] * (samples.density(2 * n) + samples.density(2 * n + 1));
      const float a = samples.sunDepth(2 * n);
      const float b = samples.sunDepth(2 * n + 1);
      this->sun[n] = 0.5F * (a + b);
      this->slope[n] = (b - a) * (0.5F / GaussPoint);
    }
    for (; this->number % 4 != 0; ++this->number)
    {
      this->depth[this->number] = this->sun[this->number] = this->slope[this->number] = 0;
    }
  }
};

/// Light of each cell before it is attenuated on the way to the brick's face: an even sigma, and a sun's depth that is linear.
void lightOfCells(MetCells& cells, float scale, float perLength, float* light)
{
  for (int n = 0; n < cells.number; ++n)
  {
    const float depth = std::min(cells.depth[n] * perLength, Opaque);
    const float middle = cells.sun[n] * scale;
    const float slope = cells.slope[n] * scale;
    const float near = std::min(std::max(middle - slope, 0.0F), Opaque);
    const float far = std::min(std::max(middle + slope, 0.0F), Opaque);
    const float fade = depth + far - near;
    const float first = exponentialFloat(-near);
    const float last = exponentialFloat(-(far + depth));
    const bool flat = std::abs(fade) < 1e-2F;
    const float divided = (first - last) / (flat ? 1.0F : fade);
    const float series = first * (1 - fade * (0.5F - fade / 6));
    light[n] = depth * (flat ? series : divided);
    cells.depth[n] = depth;
  }
}
}

/// Steps through a brick's cells in lengths of index space from where the ray enters it; in single precision, as these are few.
struct VoxelTree::BrickRay
{
  float place[3]; ///< of the entry, from the brick's first corner
  float along[3]; ///< of length 1
  float inverse[3];
  float next[3]; ///< distance of the next plane of each axis
  int at[3];
  int sign[3];

  BrickRay(const Key& key, const Vector3& entry, const Vector3& direction, double inverseLength)
  {
    for (int c = 0; c < 3; ++c)
    {
      const double from = entry[c] - 1.0 * Edge * key[static_cast<std::size_t>(c)];
      this->place[c] = static_cast<float>(std::min(std::max(from, 0.0), 1.0 * Edge));
      this->along[c] = static_cast<float>(direction[c] * inverseLength);
      // Less does not leave a cell within a brick.
      const bool moves = std::abs(this->along[c]) > 1e-6F;
      this->inverse[c] = moves ? 1 / this->along[c] : 0;
      this->sign[c] = this->along[c] < 0 ? -1 : 1;
      const int box = static_cast<int>(this->place[c]);
      const bool below = this->sign[c] < 0 && static_cast<float>(box) == this->place[c];
      this->at[c] = std::min(std::max(box - (below ? 1 : 0), 0), Edge - 1);
      this->next[c] = moves ? this->plane(c) : std::numeric_limits<float>::infinity();
    }
  }

  float plane(int axis) const
  {
    return (static_cast<float>(this->at[axis] + (this->sign[axis] > 0)) - this->place[axis]) *
      this->inverse[axis];
  }

  int nearest() const
  {
    const int first = this->next[0] <= this->next[1] ? 0 : 1;
    return this->next[first] <= this->next[2] ? first : 2;
  }

  /// Returns whether it still is in the brick.
  bool step(int axis)
  {
    this->at[axis] += this->sign[axis];
    this->next[axis] = this->plane(axis);
    return static_cast<unsigned>(this->at[axis]) < static_cast<unsigned>(Edge);
  }

  const Corner* corner(const Corner* corners) const
  {
    return corners + (this->at[2] * Corners + this->at[1]) * Corners + this->at[0];
  }

  void sample(const Corner* corner, float t, float* row, float* x) const
  {
    float from[3];
    for (int c = 0; c < 3; ++c)
    {
      from[c] = this->place[c] + this->along[c] * t - static_cast<float>(this->at[c]);
    }
    *x = from[0];
    VoxelTree::rowAt(corner, from[1], from[2], row);
  }

  /// Two points of each cell up to a distance.
  void sampleCells(const Corner* corners, float end, Samples& samples)
  {
    for (float t = 0; t < end;)
    {
      const int axis = this->nearest();
      const float far = std::min(this->next[axis], end);
      if (far > t)
      {
        const Corner* const corner = this->corner(corners);
        const float half = 0.5F * (far - t);
        const int n = 2 * samples.cells;
        this->sample(corner, t + half * (1 - GaussPoint), samples.row[n], &samples.x[n]);
        this->sample(corner, t + half * (1 + GaussPoint), samples.row[n + 1], &samples.x[n + 1]);
        samples.half[samples.cells++] = half;
        t = far;
      }
      if (!this->step(axis))
      {
        return;
      }
    }
  }
};

void VoxelTree::shine(std::size_t brick, const Vector3& origin, const Vector3& direction, double t0,
  double t1, double scale, VoxelLight& light) const
{
  const double unit = length(direction);
  if (!(unit > 0 && std::isfinite(unit)))
  {
    return;
  }
  BrickRay ray(this->Origins[brick], origin + t0 * direction, direction, 1 / unit);
  const Corner* const corners = this->Values.data() + brick * CornersOfBrick;
  Samples samples;
  ray.sampleCells(corners, static_cast<float>((t1 - t0) * unit), samples);
  MetCells cells(samples);
  const int number = cells.number;
  float shining[Samples::Most];
  const auto most = [](double x) { return static_cast<float>(std::min(x, 1e15)); };
  lightOfCells(cells, most(scale), most(scale / unit), shining);
  float before[Samples::Most];
  float sum = 0;
  for (int n = 0; n < number; ++n)
  {
    before[n] = sum;
    sum += cells.depth[n];
  }
  for (int n = 0; n < number; ++n)
  {
    shining[n] *= exponentialFloat(-before[n]);
  }
  double gathered = 0;
  for (int n = 0; n < number; ++n)
  {
    gathered += static_cast<double>(shining[n]);
  }
  light.light += light.transmittance * gathered;
  light.transmittance *= exponential(-static_cast<double>(sum));
}
}
