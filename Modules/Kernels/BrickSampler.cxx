// SPDX-License-Identifier: BSD-3-Clause
#include "BrickSampler.h"

#include "WideLoops.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace nephoscope
{
namespace
{
/// How far outside a face, in barycentric coordinates, a sample still counts as on it: rounding of coordinates.
constexpr double OnFace = 1e-9;

/// The quantities of a sample as one vector.
template <int Lanes>
struct SampleOf;
template <>
struct SampleOf<4>
{
  using Vector = float __attribute__((vector_size(16)));
};
template <>
struct SampleOf<8>
{
  using Vector = float __attribute__((vector_size(32)));
};

double determinant(const Vector3& a, const Vector3& b, const Vector3& c)
{
  return dot(a, cross(b, c));
}
}

/// Barycentric coordinates and values as functions of the sample's index: constant + slopes . (x, y, z).
struct BrickSampler::Linear
{
  struct Plane
  {
    double constant;
    double slope[3];
    double root; ///< -1 / slope along x
  };
  std::array<std::array<double, 4>, 4> Weight; ///< [corner]: constant, slopes
  std::array<Plane, 4>
    Planes;             ///< the same: those entered along x, those left, those parallel to it
  int Entered;          ///< planes
  int Left;             ///< planes, those entered included
  int Corner[3];        ///< the sample that the values count from
  float Value[4][Many]; ///< [at that sample, slopes][lane]

  void sortPlanes()
  {
    int n = 0;
    const auto take = [this, &n](int sign)
    {
      for (const auto& w : this->Weight)
      {
        if ((w[1] > 0) - (w[1] < 0) == sign)
        {
          this->Planes[static_cast<std::size_t>(n++)] = { w[0], { w[1], w[2], w[3] },
            sign != 0 ? -1 / w[1] : 0 };
        }
      }
      return n;
    };
    this->Entered = take(1);
    this->Left = take(-1);
    take(0);
  }
};

double linearMass(const std::array<Vector3, 4>& p, const std::array<double, 4>& values)
{
  const double volume = std::abs(determinant(p[1] - p[0], p[2] - p[0], p[3] - p[0])) / 6;
  return volume * (values[0] + values[1] + values[2] + values[3]) / 4;
}

BrickSampler::BrickSampler(
  const VoxelFrame& frame, const std::array<int, 3>& samples, int quantities, int amongMet)
  : Frame(frame)
  , Samples(samples)
  , Quantities(quantities)
  , AmongMet(amongMet)
{
  for (int c = 0; c < 3; ++c)
  {
    this->Count[c] = Edge * samples[c];
    this->Step[c] = frame.spacing[c] / samples[c];
  }
  this->Values.resize(static_cast<std::size_t>(this->Count[0]) * this->Count[1] * this->Count[2] *
    static_cast<std::size_t>(this->lanes()));
}

void BrickSampler::begin(const std::array<int, 3>& firstVoxel)
{
  std::fill(this->Values.begin(), this->Values.end(), 0.0F);
  for (int c = 0; c < 3; ++c)
  {
    this->First[c] =
      this->Frame.origin[c] + (firstVoxel[c] - 0.5) * this->Frame.spacing[c] + 0.5 * this->Step[c];
  }
}

void BrickSampler::add(const std::array<Vector3, 4>& corners, const double* values)
{
  // In units of samples, so that sample (x, y, z) is at (x, y, z).
  Vector3 p[4];
  int box[3][2];
  for (int c = 0; c < 3; ++c)
  {
    for (int v = 0; v < 4; ++v)
    {
      p[v][c] = (corners[v][c] - this->First[c]) / this->Step[c];
    }
    const auto ends = std::minmax({ p[0][c], p[1][c], p[2][c], p[3][c] });
    const double low = std::ceil(std::max(ends.first - 1e-6, 0.0));
    const double high = std::floor(std::min(ends.second + 1e-6, this->Count[c] - 1.0));
    if (!(low <= high))
    {
      return;
    }
    box[c][0] = static_cast<int>(low);
    box[c][1] = static_cast<int>(high);
  }
  const double volume = determinant(p[1] - p[0], p[2] - p[0], p[3] - p[0]);
  if (!(std::abs(volume) > 1e-12))
  {
    return;
  }
  Linear field;
  for (int v = 0; v < 4; ++v)
  {
    // 0 at the other three corners, 1 at this one.
    const Vector3& base = p[(v + 1) % 4];
    const Vector3 normal = cross(p[(v + 2) % 4] - base, p[(v + 3) % 4] - base);
    const double height = dot(normal, p[v] - base);
    const Vector3 slope = (1 / height) * normal;
    field.Weight[v] = { -dot(slope, base), slope[0], slope[1], slope[2] };
  }
  field.sortPlanes();
  this->setValues(field, box, values);
  if (this->lanes() == Few)
  {
    this->fillFew(field, box);
  }
  else
  {
    this->fillMany(field, box);
  }
}

/// In single precision: counted from a corner of the box, the values' rounding is that of those in the tetrahedron.
void BrickSampler::setValues(Linear& field, const int box[3][2], const double* values) const
{
  for (int c = 0; c < 3; ++c)
  {
    field.Corner[c] = box[c][0];
  }
  for (int q = 0; q < this->Quantities; ++q)
  {
    double sums[4] = { 0, 0, 0, 0 };
    for (std::size_t v = 0; v < 4; ++v)
    {
      const auto& w = field.Weight[v];
      const double at = w[0] + w[1] * box[0][0] + w[2] * box[1][0] + w[3] * box[2][0];
      const double value = values[4 * static_cast<std::size_t>(q) + v];
      sums[0] += value * at;
      sums[1] += value * w[1];
      sums[2] += value * w[2];
      sums[3] += value * w[3];
    }
    for (int n = 0; n < 4; ++n)
    {
      field.Value[n][q] = static_cast<float>(sums[n]);
    }
  }
  for (int lane = this->Quantities; lane < Many; ++lane)
  {
    for (int n = 0; n < 4; ++n)
    {
      field.Value[n][lane] = n == 0 && lane == this->Quantities ? 1.0F : 0.0F;
    }
  }
}

/// Four rows at a time: where they are in the tetrahedron, from `from` to `to` along x, or nowhere if these are in no order.
template <int Lanes>
inline __attribute__((always_inline)) void BrickSampler::fill(
  const Linear& field, const int box[3][2])
{
  constexpr int Block = 4;
  using Rows = double __attribute__((vector_size(8 * Block)));
  constexpr Rows Zero{};
  constexpr Rows Below{ 0, 1, 2, 3 };
  for (int z = box[2][0]; z <= box[2][1]; ++z)
  {
    for (int y = box[1][0]; y <= box[1][1]; y += Block)
    {
      Rows from = Zero + box[0][0];
      Rows to = Zero + box[0][1];
      for (int p = 0; p < 4; ++p)
      {
        const auto& plane = field.Planes[static_cast<std::size_t>(p)];
        const Rows at = plane.constant + plane.slope[1] * (y + Below) + plane.slope[2] * z + OnFace;
        if (p < field.Entered)
        {
          const Rows x = at * plane.root;
          from = x > from ? x : from;
        }
        else if (p < field.Left)
        {
          const Rows x = at * plane.root;
          to = x < to ? x : to;
        }
        else
        {
          to = at < 0 ? Zero - 1 : to;
        }
      }
      for (int n = 0; n < Block && y + n <= box[1][1]; ++n)
      {
        if (from[n] <= to[n])
        {
          this->fillRow<Lanes>(field, y + n, z, from[n], to[n]);
        }
      }
    }
  }
}

template <int Lanes>
inline __attribute__((always_inline)) void BrickSampler::fillRow(
  const Linear& field, int y, int z, double low, double high)
{
  // Neither is negative: what is cut off is rounded down.
  const int last = static_cast<int>(high);
  int first = static_cast<int>(low);
  first += first < low ? 1 : 0;
  using Sample = typename SampleOf<Lanes>::Vector;
  Sample base;
  Sample slope;
  Sample slopeY;
  Sample slopeZ;
  std::memcpy(&base, field.Value[0], sizeof base);
  std::memcpy(&slope, field.Value[1], sizeof slope);
  std::memcpy(&slopeY, field.Value[2], sizeof slopeY);
  std::memcpy(&slopeZ, field.Value[3], sizeof slopeZ);
  const Sample start = base + slope * static_cast<float>(first - field.Corner[0]) +
    slopeY * static_cast<float>(y - field.Corner[1]) +
    slopeZ * static_cast<float>(z - field.Corner[2]);
  float* to = this->Values.data() +
    ((static_cast<std::size_t>(z) * this->Count[1] + y) * this->Count[0] + first) * Lanes;
  for (int x = 0; x <= last - first; ++x, to += Lanes)
  {
    const Sample sample = start + slope * static_cast<float>(x);
    std::memcpy(to, &sample, sizeof sample);
  }
}

NEPHOSCOPE_WIDE void BrickSampler::fillFew(const Linear& field, const int box[3][2])
{
  this->fill<Few>(field, box);
}

NEPHOSCOPE_WIDE void BrickSampler::fillMany(const Linear& field, const int box[3][2])
{
  this->fill<Many>(field, box);
}

/// The samples of a layer of a voxel, 256 at most, are added in single precision, and the layers in double.
template <int Lanes>
inline __attribute__((always_inline)) void BrickSampler::averageLanes(float* means) const
{
  const double all = this->Samples[0] * this->Samples[1] * this->Samples[2];
  for (int voxel = 0; voxel < Volume; ++voxel)
  {
    const int x = voxel % Edge * this->Samples[0];
    const int y = voxel / Edge % Edge * this->Samples[1];
    const int z = voxel / (Edge * Edge) * this->Samples[2];
    using Sample = typename SampleOf<Lanes>::Vector;
    double sums[Lanes] = {};
    for (int layer = 0; layer < this->Samples[2]; ++layer)
    {
      Sample sum{};
      for (int row = 0; row < this->Samples[1]; ++row)
      {
        const float* from = this->Values.data() +
          (static_cast<std::size_t>((z + layer) * this->Count[1] + y + row) * this->Count[0] + x) *
            Lanes;
        for (int n = 0; n < this->Samples[0]; ++n, from += Lanes)
        {
          Sample sample;
          std::memcpy(&sample, from, sizeof sample);
          sum += sample;
        }
      }
      for (int lane = 0; lane < Lanes; ++lane)
      {
        sums[lane] += static_cast<double>(sum[lane]);
      }
    }
    const double met = std::max(sums[this->Quantities], 1.0);
    for (int q = 0; q < this->Quantities; ++q)
    {
      const double number = q < this->Quantities - this->AmongMet ? all : met;
      means[q * Volume + voxel] = static_cast<float>(sums[q] / number);
    }
  }
}

NEPHOSCOPE_WIDE void BrickSampler::average(float* means) const
{
  if (this->lanes() == Few)
  {
    this->averageLanes<Few>(means);
  }
  else
  {
    this->averageLanes<Many>(means);
  }
}
}
