// SPDX-License-Identifier: BSD-3-Clause
#include "SliceFan.h"

#include "Camera.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nephoscope
{
namespace
{
constexpr double Pi = 3.141592653589793;
constexpr double Steepest = 1e7;
/// Where slices are closer, rad, roughAngle would displace pixels by more than a twentieth of their distance.
constexpr double ClosestOfRough = 2e-4;

double slopeOf(double up, double across)
{
  return std::abs(up) < Steepest * across ? up / across : std::copysign(Steepest, up);
}

double slopeOf(const Vector3& direction)
{
  return slopeOf(direction[2], std::hypot(direction[0], direction[1]));
}

/// Azimuths of pixels, and the largest of their distances from the vertical axis at depth 1.
struct AzimuthRange
{
  double least = Pi;
  double greatest = -Pi;
  double widest = 0;

  void include(const AzimuthRange& other)
  {
    this->least = std::min(this->least, other.least);
    this->greatest = std::max(this->greatest, other.greatest);
    this->widest = std::max(this->widest, other.widest);
  }
};

/// Calls f(0) to f(count - 1), in parallel.
template <class F>
void forEach(std::size_t count, const F& f)
{
  vtkSMPTools::For(0, static_cast<vtkIdType>(count),
    [&f](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        f(static_cast<std::size_t>(i));
      }
    });
}

/// atan2 to 1e-5 (Abramowitz and Stegun 4.4.49), little of the distance of slices and a tenth of the C library's time.
double roughAngle(double y, double x)
{
  const double a = std::abs(x);
  const double b = std::abs(y);
  const double t = std::min(a, b) / std::max(std::max(a, b), 1e-300);
  const double t2 = t * t;
  double angle =
    t * (0.999866 + t2 * (-0.3302995 + t2 * (0.180141 + t2 * (-0.085133 + t2 * 0.0208351))));
  angle = b > a ? Pi / 2 - angle : angle;
  angle = x < 0 ? Pi - angle : angle;
  return y < 0 ? -angle : angle;
}

/// Azimuths and slopes of all pixels.
struct PixelAzimuths
{
  double
    toward; ///< azimuths are from this one, the middle of the picture: only one with the zenith or the nadir in it has a seam
  std::vector<double> azimuths;
  std::vector<double> slopes;
  AzimuthRange all;

  PixelAzimuths(const Camera& camera, bool rough)
    : azimuths(static_cast<std::size_t>(camera.width()) * static_cast<std::size_t>(camera.height()))
    , slopes(this->azimuths.size())
  {
    const Vector3& ahead = camera.forward();
    const Vector3& middle = std::abs(ahead[2]) < 0.999 ? ahead : camera.up();
    this->toward = std::atan2(middle[1], middle[0]);
    const double cosine = std::cos(this->toward);
    const double sine = std::sin(this->toward);
    const auto width = static_cast<std::size_t>(camera.width());
    std::vector<AzimuthRange> rows(static_cast<std::size_t>(camera.height()));
    forEach(rows.size(),
      [&](std::size_t y)
      {
        AzimuthRange& row = rows[y];
        for (std::size_t x = 0; x < width; ++x)
        {
          const Vector3 d =
            camera.ray(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5).direction;
          const double across = std::sqrt(d[0] * d[0] + d[1] * d[1]);
          const double left = d[1] * cosine - d[0] * sine;
          const double along = d[0] * cosine + d[1] * sine;
          const double angle = rough ? roughAngle(left, along) : std::atan2(left, along);
          this->azimuths[y * width + x] = angle;
          this->slopes[y * width + x] = slopeOf(d[2], across);
          row.include({ angle, angle, across / std::max(1e-9, dot(d, ahead)) });
        }
      });
    for (const AzimuthRange& row : rows)
    {
      this->all.include(row);
    }
  }
};

bool hasVerticalColumns(const Camera& camera)
{
  return !camera.isParallel() && camera.up()[2] > 1 - 1e-12;
}
}

SliceFan::SliceFan(const Camera& camera, double spacing)
  : Width(camera.width())
  , Height(camera.height())
{
  if (hasVerticalColumns(camera))
  {
    this->perColumn(camera);
  }
  else if (camera.isParallel() || !(spacing > 0) || !this->byAzimuth(camera, spacing))
  {
    this->perPixel(camera);
  }
}

void SliceFan::perColumn(const Camera& camera)
{
  const int last = this->Height - 1;
  for (int x = 0; x < this->Width; ++x)
  {
    const Vector3 low = camera.ray(x + 0.5, 0.5).direction;
    const Vector3 high = camera.ray(x + 0.5, last + 0.5).direction;
    const double across = std::hypot(low[0], low[1]);
    this->Slices.push_back({ camera.eye(), low[0] / across, low[1] / across, this->Slopes.size() });
    // Slopes of a column are equally spaced.
    const double from = slopeOf(low);
    const double step = last > 0 ? (slopeOf(high) - from) / last : 0;
    for (int y = 0; y <= last; ++y)
    {
      this->Slopes.push_back(from + step * y);
    }
  }
  this->Slices.push_back({ camera.eye(), 1, 0, this->Slopes.size() });
}

void SliceFan::perPixel(const Camera& camera)
{
  for (int y = 0; y < this->Height; ++y)
  {
    for (int x = 0; x < this->Width; ++x)
    {
      const Ray ray = camera.ray(x + 0.5, y + 0.5);
      const double across = std::hypot(ray.direction[0], ray.direction[1]);
      this->Slots.push_back(static_cast<std::uint32_t>(this->Slots.size()));
      this->Slices.push_back({ ray.origin, across > 0 ? ray.direction[0] / across : 1,
        across > 0 ? ray.direction[1] / across : 0, this->Slices.size() });
      this->Slopes.push_back(slopeOf(ray.direction));
    }
  }
  this->SliceOf = this->Slots;
  this->Slices.push_back({ camera.eye(), 1, 0, this->Slots.size() });
}

bool SliceFan::byAzimuth(const Camera& camera, double spacing)
{
  const PixelAzimuths pixels(camera, spacing * camera.pixel() > ClosestOfRough);
  const double angle = spacing * camera.pixel() / pixels.all.widest;
  const double count = std::ceil((pixels.all.greatest - pixels.all.least) / angle) + 1;
  if (!(count < static_cast<double>(pixels.azimuths.size())))
  {
    return false;
  }
  const auto slices = static_cast<std::uint32_t>(count);
  for (std::uint32_t s = 0; s <= slices; ++s)
  {
    const double azimuth = pixels.toward + pixels.all.least + s * angle;
    this->Slices.push_back({ camera.eye(), std::cos(azimuth), std::sin(azimuth), 0 });
  }
  this->SliceOf.resize(pixels.azimuths.size());
  forEach(this->SliceOf.size(),
    [&](std::size_t pixel)
    {
      this->SliceOf[pixel] = static_cast<std::uint32_t>(
        std::lround((pixels.azimuths[pixel] - pixels.all.least) / angle));
    });
  this->fill(pixels.slopes);
  return true;
}

/// Counting sort of the pixels by slice, then each slice by slope.
void SliceFan::fill(const std::vector<double>& slopeOf)
{
  std::vector<std::size_t> next(this->Slices.size() + 1, 0);
  for (const std::uint32_t slice : this->SliceOf)
  {
    ++next[slice + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (std::size_t s = 0; s < this->Slices.size(); ++s)
  {
    this->Slices[s].first = next[s];
  }
  std::vector<std::uint32_t> pixels(slopeOf.size());
  for (std::size_t pixel = 0; pixel < pixels.size(); ++pixel)
  {
    pixels[next[this->SliceOf[pixel]]++] = static_cast<std::uint32_t>(pixel);
  }
  this->Slots.resize(pixels.size());
  this->Slopes.resize(pixels.size());
  forEach(this->numberOfSlices(),
    [&](std::size_t s)
    {
      const auto begin = pixels.begin() + static_cast<std::ptrdiff_t>(this->Slices[s].first);
      const auto end = pixels.begin() + static_cast<std::ptrdiff_t>(this->Slices[s + 1].first);
      const auto isFlatter = [&slopeOf](std::uint32_t a, std::uint32_t b)
      { return slopeOf[a] < slopeOf[b]; };
      // An upright picture's rows are in order.
      if (!std::is_sorted(begin, end, isFlatter))
      {
        std::sort(begin, end, isFlatter);
      }
      for (std::size_t slot = this->Slices[s].first; slot < this->Slices[s + 1].first; ++slot)
      {
        this->Slots[pixels[slot]] = static_cast<std::uint32_t>(slot);
        this->Slopes[slot] = slopeOf[pixels[slot]];
      }
    });
}
}
