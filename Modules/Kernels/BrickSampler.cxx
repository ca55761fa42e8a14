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
  std::vector<std::array<double, 4>> Value;    ///< [quantity]
};

double linearMass(const std::array<Vector3, 4>& p, const std::array<double, 4>& values)
{
  const double volume = std::abs(determinant(p[1] - p[0], p[2] - p[0], p[3] - p[0])) / 6;
  return volume * (values[0] + values[1] + values[2] + values[3]) / 4;
}

BrickSampler::BrickSampler(
  const VoxelFrame& frame, const std::array<int, 3>& samples, int quantities)
  : Frame(frame)
  , Samples(samples)
  , Quantities(quantities)
{
  for (int c = 0; c < 3; ++c)
  {
    this->Count[c] = Edge * samples[c];
    this->Step[c] = frame.spacing[c] / samples[c];
  }
  this->Values.resize(static_cast<std::size_t>(this->Count[0]) * this->Count[1] * this->Count[2] *
    (static_cast<std::size_t>(quantities) + 1));
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
  field.Value.resize(static_cast<std::size_t>(this->Quantities));
  for (int q = 0; q < this->Quantities; ++q)
  {
    for (int n = 0; n < 4; ++n)
    {
      double sum = 0;
      for (int v = 0; v < 4; ++v)
      {
        sum += values[4 * q + v] * field.Weight[v][n];
      }
      field.Value[static_cast<std::size_t>(q)][n] = sum;
    }
  }
  for (int z = box[2][0]; z <= box[2][1]; ++z)
  {
    for (int y = box[1][0]; y <= box[1][1]; ++y)
    {
      this->fillRow(field, y, z, box[0]);
    }
  }
}

void BrickSampler::fillRow(const Linear& field, int y, int z, const int box[2])
{
  double low = box[0];
  double high = box[1];
  for (const auto& w : field.Weight)
  {
    const double at0 = w[0] + w[2] * y + w[3] * z + OnFace;
    if (w[1] > 0)
    {
      low = std::max(low, -at0 / w[1]);
    }
    else if (w[1] < 0)
    {
      high = std::min(high, -at0 / w[1]);
    }
    else if (at0 < 0)
    {
      return;
    }
  }
  const std::size_t stride = static_cast<std::size_t>(this->Quantities) + 1;
  const int last = static_cast<int>(std::floor(high));
  for (int x = static_cast<int>(std::ceil(low)); x <= last; ++x)
  {
    float* const value = this->Values.data() +
      ((static_cast<std::size_t>(z) * this->Count[1] + y) * this->Count[0] + x) * stride;
    for (std::size_t q = 0; q + 1 < stride; ++q)
    {
      const auto& v = field.Value[q];
      value[q] = static_cast<float>(v[0] + v[1] * x + v[2] * y + v[3] * z);
    }
    value[stride - 1] = 1;
  }
}

void BrickSampler::average(int quantity, bool amongMet, float* means, int stride) const
{
  const std::size_t width = static_cast<std::size_t>(this->Quantities) + 1;
  std::array<double, Volume> sums{};
  std::array<double, Volume> met{};
  const float* value = this->Values.data();
  for (int z = 0; z < this->Count[2]; ++z)
  {
    for (int y = 0; y < this->Count[1]; ++y)
    {
      const int row = (z / this->Samples[2] * Edge + y / this->Samples[1]) * Edge;
      for (int x = 0; x < this->Count[0]; ++x, value += width)
      {
        const auto voxel = static_cast<std::size_t>(row + x / this->Samples[0]);
        sums[voxel] += value[quantity];
        met[voxel] += value[width - 1];
      }
    }
  }
  const double all = this->Samples[0] * this->Samples[1] * this->Samples[2];
  for (std::size_t voxel = 0; voxel < Volume; ++voxel)
  {
    const double number = amongMet ? std::max(met[voxel], 1.0) : all;
    means[voxel * static_cast<std::size_t>(stride)] = static_cast<float>(sums[voxel] / number);
  }
}
}
