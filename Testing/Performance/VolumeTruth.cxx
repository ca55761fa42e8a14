// SPDX-License-Identifier: BSD-3-Clause
#include "VolumeTruth.h"

#include "ShellCase.h"
#include "TetrahedralSplit.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkStructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace nephoscope
{
namespace performance
{
namespace
{
/// A corner of a tetrahedron: where it is, where it is seen, and its density.
struct Corner
{
  Vector3 at;
  Projected seen;
  double value;
};

/// Part of a ray, with the density at its ends.
struct Interval
{
  double from, to;
  double fromValue, toValue;
};

/// Barycentric coordinate of each corner as a linear function: offset + dot(slope, x). False if there is no volume.
struct Barycentric
{
  Vector3 slope[4];
  double offset[4];

  explicit Barycentric(const std::array<const Corner*, 4>& c)
  {
    for (int n = 0; n < 4; ++n)
    {
      const Vector3& a = c[(n + 1) % 4]->at;
      const Vector3 normal = cross(c[(n + 2) % 4]->at - a, c[(n + 3) % 4]->at - a);
      const double height = dot(normal, c[n]->at - a);
      this->HasVolume = this->HasVolume && height != 0;
      this->slope[n] = (1 / height) * normal;
      this->offset[n] = -dot(this->slope[n], a);
    }
  }
  bool HasVolume = true;
};

/// The part of a ray in a tetrahedron: every barycentric coordinate is >= 0 there. Empty if to <= from.
Interval meet(const Ray& ray, const std::array<const Corner*, 4>& corners, const Barycentric& b)
{
  Interval part{ 0, 1e300, 0, 0 };
  double value = 0;
  double slope = 0;
  for (int n = 0; n < 4; ++n)
  {
    const double at0 = b.offset[n] + dot(b.slope[n], ray.origin);
    const double rate = dot(b.slope[n], ray.direction);
    value += corners[n]->value * at0;
    slope += corners[n]->value * rate;
    if (rate > 0)
    {
      part.from = std::max(part.from, -at0 / rate);
    }
    else if (rate < 0)
    {
      part.to = std::min(part.to, -at0 / rate);
    }
    else if (at0 < 0)
    {
      part.to = -1;
    }
  }
  part.fromValue = value + slope * part.from;
  part.toValue = value + slope * part.to;
  return part;
}

/// The light that leaves an interval's near end, of a source and an extinction linear in the cloud fraction c.
double lightOf(const Interval& part)
{
  constexpr double At[5] = { 0.046910077030668, 0.230765344947158, 0.5, 0.769234655052842,
    0.953089922969332 };
  constexpr double Weight[5] = { 0.118463442528095, 0.239314335249683, 0.284444444444444,
    0.239314335249683, 0.118463442528095 };
  const double length = shell::Extinction * (part.to - part.from);
  const double rise = part.toValue - part.fromValue;
  double light = 0;
  for (const double start : { 0.0, 0.5 })
  {
    for (int n = 0; n < 5; ++n)
    {
      const double x = start + 0.5 * At[n];
      const double c = part.fromValue + rise * x;
      const double depth = length * x * (part.fromValue + c) / 2;
      light += 0.5 * Weight[n] * length * c * shell::sourceOf(c) * std::exp(-depth);
    }
  }
  return light;
}

/// Every stride-th pixel, from the middle of the first stride; each with its ray's intervals.
class PixelLattice
{
public:
  PixelLattice(const Situation& s, int step)
    : View(shell::view(s))
    , Stride(step)
    , Count{ (s.pixels[0] - step / 2 + step - 1) / step,
      (s.pixels[1] - step / 2 + step - 1) / step }
    , Intervals(static_cast<std::size_t>(this->Count[0]) * this->Count[1])
  {
  }

  void add(const std::array<const Corner*, 4>& corners)
  {
    int low[2];
    int high[2];
    for (int axis = 0; axis < 2; ++axis)
    {
      const auto along = [axis](const Corner* c) { return axis == 0 ? c->seen.x : c->seen.y; };
      const auto ends =
        std::minmax({ along(corners[0]), along(corners[1]), along(corners[2]), along(corners[3]) });
      low[axis] = std::max(0, static_cast<int>(std::floor(this->indexOf(ends.first))));
      high[axis] =
        std::min(this->Count[axis] - 1, static_cast<int>(std::ceil(this->indexOf(ends.second))));
    }
    if (low[0] > high[0] || low[1] > high[1])
    {
      return;
    }
    const Barycentric b(corners);
    for (int y = low[1]; b.HasVolume && y <= high[1]; ++y)
    {
      for (int x = low[0]; x <= high[0]; ++x)
      {
        const Interval part =
          meet(this->View.ray(this->pixel(x) + 0.5, this->pixel(y) + 0.5), corners, b);
        if (part.to > part.from)
        {
          this->Intervals[static_cast<std::size_t>(y) * this->Count[0] + x].push_back(part);
        }
      }
    }
  }

  std::vector<TruePixel> pixels()
  {
    std::vector<TruePixel> result;
    for (std::size_t n = 0; n < this->Intervals.size(); ++n)
    {
      auto& parts = this->Intervals[n];
      std::sort(parts.begin(), parts.end(),
        [](const Interval& a, const Interval& b) { return a.from < b.from; });
      double depth = 0;
      double light = 0;
      for (const Interval& part : parts)
      {
        light += std::exp(-depth) * lightOf(part);
        depth += shell::Extinction * (part.to - part.from) * (part.fromValue + part.toValue) / 2;
      }
      const auto columns = static_cast<std::size_t>(this->Count[0]);
      result.push_back({ this->pixel(static_cast<int>(n % columns)),
        this->pixel(static_cast<int>(n / columns)), std::exp(-depth), light });
    }
    return result;
  }

private:
  int pixel(int index) const { return this->Stride / 2 + index * this->Stride; }
  double indexOf(double pixels) const
  {
    const int first = this->pixel(0);
    return (pixels - 0.5 - first) / this->Stride;
  }

  Camera View;
  int Stride;
  std::array<int, 2> Count;
  std::vector<std::vector<Interval>> Intervals;
};

std::vector<Corner> corners(const Situation& situation)
{
  const Camera view = shell::view(situation);
  const auto grid = shell::structuredGrid(situation);
  vtkDataArray* const values = grid->GetPointData()->GetScalars();
  std::vector<Corner> all(static_cast<std::size_t>(grid->GetNumberOfPoints()));
  for (std::size_t p = 0; p < all.size(); ++p)
  {
    grid->GetPoint(static_cast<vtkIdType>(p), all[p].at.v);
    all[p].seen = view.project(all[p].at);
    all[p].value = values->GetComponent(static_cast<vtkIdType>(p), 0);
  }
  return all;
}
}

std::vector<TruePixel> volumeTruth(const Situation& situation, int stride)
{
  PixelLattice lattice(situation, stride);
  const std::vector<Corner> all = corners(situation);
  const std::size_t nx = situation.points[0];
  const std::size_t ny = situation.points[1];
  for (int k = 0; k + 1 < situation.points[2]; ++k)
  {
    for (int j = 0; j + 1 < situation.points[1]; ++j)
    {
      for (int i = 0; i + 1 < situation.points[0]; ++i)
      {
        for (const TetrahedronVertices& t : TetrahedralSplit[splitParity(i, j, k)])
        {
          std::array<const Corner*, 4> c{};
          for (int n = 0; n < 4; ++n)
          {
            c[n] = &all[i + (t[n] & 1) + nx * (j + (t[n] >> 1 & 1) + ny * (k + (t[n] >> 2)))];
          }
          if (c[0]->value > 0 || c[1]->value > 0 || c[2]->value > 0 || c[3]->value > 0)
          {
            lattice.add(c);
          }
        }
      }
    }
  }
  return lattice.pixels();
}

Figures volumeFigures(const Situation& situation, double TruePixel::*quantity,
  const std::function<double(int x, int y)>& drawnAt)
{
  const int stride =
    std::max(1, static_cast<int>(std::sqrt(situation.pixels[0] * (situation.pixels[1] / 12288.0))));
  const double clear = quantity == &TruePixel::transmittance ? 1 : 0;
  double sum = 0;
  double largest = 0;
  double compared = 0;
  double drawnEffect = 0;
  double trueEffect = 0;
  for (const TruePixel& truth : volumeTruth(situation, stride))
  {
    const double drawn = drawnAt(truth.x, truth.y);
    if (truth.transmittance < 1 || drawn != clear)
    {
      const double error = std::abs(drawn - truth.*quantity);
      sum += error * error;
      largest = std::max(largest, error);
      drawnEffect += std::abs(drawn - clear);
      trueEffect += std::abs(truth.*quantity - clear);
      ++compared;
    }
  }
  const double shown = trueEffect > 0 ? drawnEffect / trueEffect : 1;
  if (!(shown > 0.5 && shown < 2))
  {
    char words[80];
    std::snprintf(
      words, sizeof words, "its picture shows %.2g times the cloud that there is", shown);
    throw std::runtime_error(words);
  }
  return { { "error", compared > 0 ? std::sqrt(sum / compared) : 0 }, { "largestError", largest },
    { "pixelsCompared", compared }, { "shown", shown } };
}
}
}
