// SPDX-License-Identifier: BSD-3-Clause
// Light scattered once in height-field clouds, by the methods of HeightFieldScattering on one thread: 12 slices of a level picture
// from below, as many rays each as the picture has rows. Figures: error, the median of |J / J_exact - 1| over the rays whose
// optical depth is 0.1 to 20; error95, its 95th percentile.
#include "Benchmark.h"
#include "HeightFieldTesting.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace performance
{
namespace
{
constexpr int Slices = 12;

class ScatteringJob : public Job
{
public:
  ScatteringJob(const Situation& situation, std::string method, const ScatteringSettings& settings)
    : Field(testing::referenceShape())
    , Method(std::move(method))
    , Scattering(HeightFieldScattering::make(this->Method, this->Field, 300, {}, settings))
    , Lights(Slices)
  {
    const int rows = situation.pixels[1];
    for (int y = 0; y < rows; ++y)
    {
      this->Slopes.push_back(0.06 + 0.6 * y / rows);
    }
  }

  void run() override { this->shine(*this->Scattering, this->Lights); }

  Figures figures() override
  {
    std::vector<SliceLight> truth(Slices);
    this->shine(*HeightFieldScattering::make("Exact", this->Field, 300, {}), truth);
    std::vector<double> errors;
    const ScatteringDensities densities;
    for (int s = 0; s < Slices; ++s)
    {
      for (std::size_t i = 0; i < this->Slopes.size(); ++i)
      {
        const RayLight& exact = truth[s].rays[i];
        const double depth = -std::log(exact.transmittance) * densities.view / densities.behind;
        if (depth > 0.1 && depth < 20)
        {
          // Of Exact its own estimate.
          errors.push_back(this->Method == "Exact"
              ? exact.error / exact.light
              : std::abs(this->Lights[s].rays[i].light / exact.light - 1));
        }
      }
    }
    std::sort(errors.begin(), errors.end());
    const std::size_t n = errors.size();
    return n > 0 ? Figures{ { "error", errors[n / 2] }, { "error95", errors[n * 95 / 100] } }
                 : Figures{};
  }

private:
  void shine(HeightFieldScattering& scattering, std::vector<SliceLight>& lights) const
  {
    for (int s = 0; s < Slices; ++s)
    {
      const double turn = -0.3 + 0.6 * s / Slices;
      const CloudSlice slice{ 0, 0, 0, std::sin(turn), std::cos(turn), 6000 };
      scattering.shine(slice, this->Slopes, lights[s]);
    }
  }

  HeightField Field;
  std::string Method;
  std::unique_ptr<HeightFieldScattering> Scattering;
  std::vector<double> Slopes;
  std::vector<SliceLight> Lights;
};

Registration method(
  const std::string& name, const Settings& text, bool ours, const ScatteringSettings& settings)
{
  return Registration({ name, "scattering", text, ours, false, 0,
    [name, settings](const Situation& s)
    { return std::make_unique<ScatteringJob>(s, name, settings); } });
}

ScatteringSettings sampled(double samplesPerWave)
{
  ScatteringSettings settings;
  settings.samplesPerWave = samplesPerWave;
  return settings;
}

ScatteringSettings marched(double step)
{
  ScatteringSettings settings;
  settings.step = step;
  return settings;
}

const Registration moments = method("Moments", { { "samples a wave", "12" } }, true, sampled(12));
const Registration fewer = method("Moments", { { "samples a wave", "8" } }, true, sampled(8));
const Registration more = method("Moments", { { "samples a wave", "24" } }, true, sampled(24));
const Registration exact = method("Exact", {}, true, {});
const Registration sexp = method("Sexp1986", { { "samples a wave", "12" } }, false, sampled(12));
const Registration march20 = method("March", { { "step", "20 m" } }, false, marched(20));
const Registration march5 = method("March", { { "step", "5 m" } }, false, marched(5));
const Registration march1 = method("March", { { "step", "1 m" } }, false, marched(1));
}
}
}
