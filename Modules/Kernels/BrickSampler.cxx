// SPDX-License-Identifier: BSD-3-Clause
#include "BrickSampler.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace nephoscope
{
namespace
{
/// How far outside a face, in barycentric coordinates, a sample still counts as on it: rounding of coordinates.
constexpr double OnFace = 1e-9;

double determinant(const Vector3& a, const Vector3& b, const Vector3& c)
{
  return dot(a, cross(b, c));
}
}

/// Barycentric coordinates and values as functions of the sample's index: constant + slopes . (x, y, z).
struct BrickSampler::Linear
{
  std::array<std::array<double, 4>, 4> Weight; ///< [corner]: constant, slopes
  std::array<double, 4> Root;                  ///< [corner]: -1 / slope along x
  int Corner[3];                               ///< the sample that the values count from
  float Value[4][Many];                        ///< [at that sample, slopes][lane]
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
    field.Root[v] = slope[0] != 0 ? -1 / slope[0] : 0;
  }
  this->setValues(field, box, values);
  for (int z = box[2][0]; z <= box[2][1]; ++z)
  {
    for (int y = box[1][0]; y <= box[1][1]; ++y)
    {
      if (this->lanes() == Few)
      {
        this->fillRow<Few>(field, y, z, box[0]);
      }
      else
      {
        this->fillRow<Many>(field, y, z, box[0]);
      }
    }
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

template <int Lanes>
void BrickSampler::fillRow(const Linear& field, int y, int z, const int box[2])
{
  double low = box[0];
  double high = box[1];
  for (std::size_t v = 0; v < 4; ++v)
  {
    const auto& w = field.Weight[v];
    const double at0 = w[0] + w[2] * y + w[3] * z + OnFace;
    if (w[1] > 0)
    {
      low = std::max(low, at0 * field.Root[v]);
    }
    else if (w[1] < 0)
    {
      high = std::min(high, at0 * field.Root[v]);
    }
    else if (at0 < 0)
    {
      return;
    }
  }
  if (!(low <= high))
  {
    return;
  }
  // Neither is negative: what is cut off is rounded down.
  const int last = static_cast<int>(high);
  int first = static_cast<int>(low);
  first += first < low ? 1 : 0;
  float start[Lanes];
  const auto fromX = static_cast<float>(first - field.Corner[0]);
  const auto fromY = static_cast<float>(y - field.Corner[1]);
  const auto fromZ = static_cast<float>(z - field.Corner[2]);
  const auto& v = field.Value;
  for (int lane = 0; lane < Lanes; ++lane)
  {
    start[lane] = v[0][lane] + v[1][lane] * fromX + v[2][lane] * fromY + v[3][lane] * fromZ;
  }
  float* sample = this->Values.data() +
    ((static_cast<std::size_t>(z) * this->Count[1] + y) * this->Count[0] + first) * Lanes;
  for (int x = 0; x <= last - first; ++x, sample += Lanes)
  {
    for (int lane = 0; lane < Lanes; ++lane)
    {
      sample[lane] = start[lane] + v[1][lane] * static_cast<float>(x);
    }
  }
}

/// The samples of a layer of a voxel, 256 at most, are added in single precision, and the layers in double.
template <int Lanes>
void BrickSampler::averageLanes(float* means) const
{
  const double all = this->Samples[0] * this->Samples[1] * this->Samples[2];
  for (int voxel = 0; voxel < Volume; ++voxel)
  {
    const int x = voxel % Edge * this->Samples[0];
    const int y = voxel / Edge % Edge * this->Samples[1];
    const int z = voxel / (Edge * Edge) * this->Samples[2];
    double sums[Lanes] = {};
    for (int layer = 0; layer < this->Samples[2]; ++layer)
    {
      float sum[Lanes] = {};
      for (int row = 0; row < this->Samples[1]; ++row)
      {
        const float* sample = this->Values.data() +
          (static_cast<std::size_t>((z + layer) * this->Count[1] + y + row) * this->Count[0] + x) *
            Lanes;
        for (int n = 0; n < this->Samples[0]; ++n, sample += Lanes)
        {
          for (int lane = 0; lane < Lanes; ++lane)
          {
            sum[lane] += sample[lane];
          }
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

void BrickSampler::average(float* means) const
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
