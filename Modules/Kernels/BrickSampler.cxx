// SPDX-License-Identifier: BSD-3-Clause
#include "BrickSampler.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

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
  std::array<std::array<double, 4>, MostQuantities> Value;
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
    field.Root[v] = slope[0] != 0 ? -1 / slope[0] : 0;
  }
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
  const std::size_t plane = this->Values.size() / (static_cast<std::size_t>(this->Quantities) + 1);
  float* row =
    this->Values.data() + (static_cast<std::size_t>(z) * this->Count[1] + y) * this->Count[0];
  for (int q = 0; q < this->Quantities; ++q, row += plane)
  {
    const auto& v = field.Value[static_cast<std::size_t>(q)];
    const double at0 = v[0] + v[2] * y + v[3] * z;
    for (int x = first; x <= last; ++x)
    {
      row[x] = static_cast<float>(at0 + v[1] * x);
    }
  }
  for (int x = first; x <= last; ++x)
  {
    row[x] = 1;
  }
}

/// Of each voxel's samples. Whole rows are added before they are cut into voxels.
std::array<double, BrickSampler::Volume> BrickSampler::sums(int plane) const
{
  std::array<double, Volume> made{};
  std::array<double, Edge * MostSamples> row{};
  const std::size_t size = this->Values.size() / (static_cast<std::size_t>(this->Quantities) + 1);
  const float* const values = this->Values.data() + static_cast<std::size_t>(plane) * size;
  double* sum = made.data();
  for (int voxelRow = 0; voxelRow < Edge * Edge; ++voxelRow)
  {
    row.fill(0);
    const int rows = this->Samples[1] * this->Samples[2];
    for (int r = 0; r < rows; ++r)
    {
      const int y = voxelRow % Edge * this->Samples[1] + r % this->Samples[1];
      const int z = voxelRow / Edge * this->Samples[2] + r / this->Samples[1];
      const float* const from = values + (z * this->Count[1] + y) * this->Count[0];
      for (int x = 0; x < this->Count[0]; ++x)
      {
        row[static_cast<std::size_t>(x)] += static_cast<double>(from[x]);
      }
    }
    const double* sample = row.data();
    for (int voxel = 0; voxel < Edge; ++voxel, ++sum, sample += this->Samples[0])
    {
      *sum = std::accumulate(sample, sample + this->Samples[0], 0.0);
    }
  }
  return made;
}

void BrickSampler::average(int quantity, bool amongMet, float* means, int stride) const
{
  const std::array<double, Volume> values = this->sums(quantity);
  std::array<double, Volume> numbers{};
  if (amongMet)
  {
    numbers = this->sums(this->Quantities);
  }
  const double all = this->Samples[0] * this->Samples[1] * this->Samples[2];
  for (std::size_t voxel = 0; voxel < Volume; ++voxel)
  {
    const double number = amongMet ? std::max(numbers[voxel], 1.0) : all;
    means[voxel * static_cast<std::size_t>(stride)] = static_cast<float>(values[voxel] / number);
  }
}
}
