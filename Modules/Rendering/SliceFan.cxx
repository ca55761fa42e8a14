// SPDX-License-Identifier: BSD-3-Clause
#include "SliceFan.h"

#include "Camera.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nephoscope
{
namespace
{
constexpr double Pi = 3.141592653589793;
constexpr double Steepest = 1e7;

double slopeOf(const Vector3& direction)
{
  const double across = std::hypot(direction[0], direction[1]);
  return std::abs(direction[2]) < Steepest * across ? direction[2] / across
                                                    : std::copysign(Steepest, direction[2]);
}

bool hasVerticalColumns(const Camera& camera)
{
  return !camera.isParallel() && camera.up()[2] > 1 - 1e-12;
}
}

SliceFan::SliceFan(const Camera& camera)
  : Width(camera.width())
  , Height(camera.height())
{
  if (hasVerticalColumns(camera))
  {
    this->perColumn(camera);
  }
  else if (camera.isParallel())
  {
    this->perPixel(camera);
  }
  else
  {
    this->byAzimuth(camera);
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
  const Vector3& ahead = camera.forward();
  const double across = std::hypot(ahead[0], ahead[1]);
  const double ux = across > 0 ? ahead[0] / across : 1;
  const double uy = across > 0 ? ahead[1] / across : 0;
  for (int y = 0; y < this->Height; ++y)
  {
    for (int x = 0; x < this->Width; ++x)
    {
      this->Slots.push_back(static_cast<std::uint32_t>(this->Slots.size()));
      this->Slices.push_back({ camera.ray(x + 0.5, y + 0.5).origin, ux, uy, this->Slices.size() });
    }
  }
  this->SliceOf = this->Slots;
  this->Slopes.assign(this->Slots.size(), slopeOf(ahead));
  this->Slices.push_back({ camera.eye(), ux, uy, this->Slots.size() });
}

void SliceFan::byAzimuth(const Camera& camera)
{
  // Azimuths are from the middle of the picture, so that only a picture with the zenith or the nadir in it has a seam.
  const Vector3& ahead = camera.forward();
  const Vector3& middle = std::abs(ahead[2]) < 0.999 ? ahead : camera.up();
  const double toward = std::atan2(middle[1], middle[0]);
  std::vector<double> azimuth;
  std::vector<double> slopes;
  double least = Pi;
  double greatest = -Pi;
  double widest = 0;
  for (int y = 0; y < this->Height; ++y)
  {
    for (int x = 0; x < this->Width; ++x)
    {
      const Vector3 d = camera.ray(x + 0.5, y + 0.5).direction;
      azimuth.push_back(std::remainder(std::atan2(d[1], d[0]) - toward, 2 * Pi));
      slopes.push_back(slopeOf(d));
      least = std::min(least, azimuth.back());
      greatest = std::max(greatest, azimuth.back());
      widest = std::max(widest, std::hypot(d[0], d[1]) / std::max(1e-9, dot(d, ahead)));
    }
  }
  const double spacing = 0.5 * camera.pixel() / widest;
  const auto slices = static_cast<std::uint32_t>(std::ceil((greatest - least) / spacing) + 1);
  for (std::uint32_t s = 0; s <= slices; ++s)
  {
    const double angle = toward + least + s * spacing;
    this->Slices.push_back({ camera.eye(), std::cos(angle), std::sin(angle), 0 });
  }
  for (const double angle : azimuth)
  {
    this->SliceOf.push_back(static_cast<std::uint32_t>(std::lround((angle - least) / spacing)));
  }
  this->fill(slopes);
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
  for (std::size_t s = 0; s < this->numberOfSlices(); ++s)
  {
    std::sort(pixels.begin() + static_cast<std::ptrdiff_t>(this->Slices[s].first),
      pixels.begin() + static_cast<std::ptrdiff_t>(this->Slices[s + 1].first),
      [&slopeOf](std::uint32_t a, std::uint32_t b) { return slopeOf[a] < slopeOf[b]; });
  }
  this->Slots.resize(pixels.size());
  for (const std::uint32_t pixel : pixels)
  {
    this->Slots[pixel] = static_cast<std::uint32_t>(this->Slopes.size());
    this->Slopes.push_back(slopeOf[pixel]);
  }
}
}
