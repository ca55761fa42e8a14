// SPDX-License-Identifier: BSD-3-Clause
// Light shafts in haze under a cloud plane, by the methods of HazeShafts on one thread: a picture towards the sun from near the ground,
// an eighth of the pixels along each side. The first run makes the table of Moments, which serves all rays of a picture. Figures: error, the
// median of |G / G_exact - 1| over every seventh ray and all colours; error95, its 95th percentile. G_exact is Exact in parts below
// half a grid spacing.
#include "Benchmark.h"
#include "HazeShafts.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace performance
{
namespace
{
const Vector3 Eye{ 150, -220, 30 };
const Vector3 TowardSun{ -0.6, 0.9, 0.7 };
const Channels Extinction{ 1e-4, 1.5e-4, 3e-4 };
constexpr double Far = 9000;
constexpr double Spacing = 50;

/// Scattered clouds over 12.8 km x 9.6 km, between clear and nearly dark.
CloudShadow scatteredClouds()
{
  const GridFrame frame{ -6400, -4800, Spacing, Spacing, 257, 193 };
  std::vector<float> values;
  for (int j = 0; j < frame.ny; ++j)
  {
    for (int i = 0; i < frame.nx; ++i)
    {
      const double x = frame.x0 + i * frame.dx;
      const double y = frame.y0 + j * frame.dy;
      const double f = std::sin(x / 180 + 0.4 * std::sin(y / 300)) + std::sin(y / 220 + 1);
      values.push_back(static_cast<float>(std::exp(-3 * std::max(0.0, f))));
    }
  }
  return { GridPyramid(frame, std::move(values)), 1000 };
}

std::vector<Ray> raysOf(const Situation& situation)
{
  const int columns = std::max(2, situation.pixels[0] / 8);
  const int rows = std::max(2, situation.pixels[1] / 8);
  std::vector<Ray> rays;
  for (int y = 0; y < rows; ++y)
  {
    for (int x = 0; x < columns; ++x)
    {
      const double across = -1.2 + 1.2 * (x + 0.5) / columns;
      rays.push_back({ Eye, normalized(Vector3{ across, 1, 0.02 + 0.7 * y / rows }) });
    }
  }
  return rays;
}

struct HazeSettings
{
  HazeMethod method;
  int radials; ///< of Moments
  double step; ///< of March, m
};

class HazeJob : public Job
{
public:
  HazeJob(const Situation& situation, const HazeSettings& settings)
    : Clouds(scatteredClouds())
    , Haze(this->Clouds, TowardSun, Eye, Extinction)
    , Rays(raysOf(situation))
    , Use(settings)
    , Lights(this->Rays.size())
  {
  }

  void run() override
  {
    if (!this->Tabulated)
    {
      this->Haze.tabulate(this->Use.radials);
      this->Tabulated = true;
    }
    for (std::size_t i = 0; i < this->Rays.size(); ++i)
    {
      const Ray& ray = this->Rays[i];
      this->Lights[i] =
        this->Haze.glow(this->Use.method, ray, this->Haze.below(ray, 0, Far), this->Use.step);
    }
  }

  Figures figures() override
  {
    std::vector<double> errors;
    for (std::size_t i = 0; i < this->Rays.size(); i += 7)
    {
      const Channels truth = this->truthOf(this->Rays[i]);
      for (int c = 0; c < 3; ++c)
      {
        errors.push_back(std::abs(this->Lights[i][c] / truth[c] - 1));
      }
    }
    std::sort(errors.begin(), errors.end());
    const std::size_t n = errors.size();
    return { { "error", errors[n / 2] }, { "error95", errors[n * 95 / 100] } };
  }

private:
  Channels truthOf(const Ray& ray) const
  {
    const HazeShafts haze(this->Clouds, TowardSun, Eye, Extinction);
    const HazeShafts::Stretch whole = haze.below(ray, 0, Far);
    const int parts = 1 + static_cast<int>((whole.far - whole.near) / (Spacing / 2));
    const double length = (whole.far - whole.near) / parts;
    Channels light{};
    for (int part = 0; part < parts; ++part)
    {
      const double near = whole.near + part * length;
      const Channels glow = haze.glow(HazeMethod::Exact, ray, { near, near + length });
      for (int c = 0; c < 3; ++c)
      {
        light[c] += std::exp(-Extinction[c] * (near - whole.near)) * glow[c];
      }
    }
    return light;
  }

  CloudShadow Clouds;
  HazeShafts Haze;
  bool Tabulated = false;
  std::vector<Ray> Rays;
  HazeSettings Use;
  std::vector<Channels> Lights;
};

Registration method(
  const std::string& name, const Settings& text, bool ours, const HazeSettings& settings)
{
  return Registration({ name, "haze", text, ours, false, 0,
    [settings](const Situation& s) { return std::make_unique<HazeJob>(s, settings); } });
}

Registration moments(int radials)
{
  return method("Moments", { { "radials", std::to_string(radials) } }, true,
    { HazeMethod::Moments, radials, 0 });
}

Registration march(int step)
{
  return method("March", { { "step", std::to_string(step) + " m" } }, false,
    { HazeMethod::March, 0, static_cast<double>(step) });
}

const Registration coarse = moments(256);
const Registration middle = moments(512);
const Registration fine = moments(1024);
const Registration exact = method("Exact", {}, true, { HazeMethod::Exact, 0, 0 });
const Registration march100 = march(100);
const Registration march20 = march(20);
const Registration march5 = march(5);
}
}
}
