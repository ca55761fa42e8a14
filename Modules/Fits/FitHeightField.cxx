// SPDX-License-Identifier: BSD-3-Clause
#include "FitHeightField.h"

#include "ClippedTransmittance.h"
#include "FitModel.h"
#include "GaussLegendre.h"
#include "HeightFieldScattering.h"

#include <ceres/jet.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <sstream>
#include <type_traits>

namespace nephoscope
{
namespace
{
constexpr double Factors[] = { 0.25, 0.5, 1, 2, 4 };
constexpr int Clouds = 6; // of training, and as many held out

/// A case's input: for each place of the quadrature along a ray these numbers, one after the other; last -1.
struct Place
{
  double weight; ///< T rhoB gamma dr, over the mean light; > 0
  double top;    ///< rhoA g
  double entry;  ///< rhoA zeta_L
  double view;   ///< b = rhoB gamma (r - rL)
  double climb;  ///< rhoA s (r - rL)
};

/// Sum over a ray's places of weight times what a form makes of one.
template <class T, class Form>
T sumPlaces(const double* input, const Form& form)
{
  T sum(0);
  for (; input[0] >= 0; input += 5)
  {
    sum += input[0] * form(Place{ input[0], input[1], input[2], input[3], input[4] });
  }
  return sum;
}

template <class T>
T quadratic(const T& depth)
{
  return clippedPower(2, T(1), depth, 1);
}

template <class T>
T product(const double* input, const T& sun, const T& view)
{
  return sumPlaces<T>(input,
    [&](const Place& p)
    { return quadratic(T(sun * (p.top - p.entry - p.climb))) * quadratic(T(view * p.view)); });
}

template <class T>
T printed(const double* input, const T& sun, const T& view)
{
  using std::exp;
  return sumPlaces<T>(input,
    [&](const Place& p)
    {
      return exp(T(sun * p.entry)) * quadratic(T(sun * p.top)) *
        quadratic(T(view * p.view - sun * p.climb));
    });
}

double uniform(std::mt19937_64& random, double least, double most)
{
  return least + (most - least) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

/// A hill and six waves of falling amplitude, as the study's clouds.
HeightField randomCloud(std::mt19937_64& random)
{
  HeightFieldShape shape;
  shape.polynomial = { uniform(random, 20, 40), 0, 0, -1e-6, 0, -2e-6 };
  for (const double amplitude : { 40.0, 30.0, 22.0, 16.0, 10.0, 8.0 })
  {
    const double number = uniform(random, 0.3, 0.6) / amplitude;
    const double angle = uniform(random, 0, 6.283185307179586);
    shape.waves.push_back({ amplitude, number * std::cos(angle), number * std::sin(angle),
      uniform(random, 0, 6.283185307179586) });
  }
  return HeightField(shape);
}

struct Ray
{
  CloudSlice slice;
  double planeHeight;
  double slope;
  ScatteringDensities densities;
};

/// The places of a segment, appended to a case's input. @param through transmittance of what lies in front
void addPlaces(const HeightField& field, const Ray& ray, const HeightFieldSegment& segment,
  double through, std::vector<double>& input)
{
  const double length = segment.farEnd - segment.nearEnd;
  const double gamma = std::sqrt(1 + ray.slope * ray.slope);
  const double entry = ray.densities.sun * (ray.slope * segment.nearEnd - ray.planeHeight);
  const int panels = 1 + static_cast<int>(length * ray.densities.view);
  for (const QuadraturePoint& r : gaussLegendrePanels(panels, 8, segment.nearEnd, segment.farEnd))
  {
    const double top = field.top(field.value(ray.slice.ux * r.x, ray.slice.uy * r.x));
    const double along = r.x - segment.nearEnd;
    const double numbers[] = { through * ray.densities.view * gamma * r.weight,
      ray.densities.sun * top, entry, ray.densities.view * gamma * along,
      ray.densities.sun * ray.slope * along };
    input.insert(input.end(), std::begin(numbers), std::end(numbers));
  }
}

/// Cases of rays, and of the depths of their segments.
struct Sample
{
  std::vector<FitCase> light;
  std::vector<FitCase> transmission;
};

/// The rays of one slice: its exact light, and what the forms need to imitate it.
void addSlice(const HeightField& field, Ray ray, Sample& sample)
{
  const std::vector<double> slopes = ray.planeHeight > 0
    ? std::vector<double>{ 0.08, 0.16, 0.25, 0.4 }
    : std::vector<double>{ -0.4, -0.25, -0.16, -0.08 };
  const auto exact = HeightFieldScattering::make("Exact", field, ray.planeHeight, ray.densities);
  SliceLight light;
  exact->shine(ray.slice, slopes, light);
  std::vector<std::vector<double>> inputs(slopes.size());
  std::vector<double> through(slopes.size(), 1.0);
  for (const HeightFieldSegment& segment : light.segments)
  {
    ray.slope = slopes[segment.ray];
    addPlaces(field, ray, segment, through[segment.ray], inputs[segment.ray]);
    through[segment.ray] *= std::exp(-segment.opticalDepth);
    sample.transmission.push_back({ { segment.opticalDepth }, std::exp(-segment.opticalDepth) });
  }
  for (std::size_t i = 0; i < slopes.size(); ++i)
  {
    if (!inputs[i].empty())
    {
      inputs[i].push_back(-1);
      sample.light.push_back({ inputs[i], light.rays[i].light });
    }
  }
}

/// Rays through random clouds, of each factor on the densities.
Sample rays(std::uint64_t seed, const std::vector<double>& factors)
{
  constexpr int Directions = 12;
  std::mt19937_64 random(seed);
  Sample sample;
  for (int cloud = 0; cloud < Clouds; ++cloud)
  {
    const HeightField field = randomCloud(random);
    for (int direction = 0; direction < Directions; ++direction)
    {
      const double angle = uniform(random, 0, 6.283185307179586);
      for (const double factor : factors)
      {
        Ray ray{};
        ray.slice.ux = std::cos(angle);
        ray.slice.uy = std::sin(angle);
        ray.slice.far = 6000;
        const ScatteringDensities max;
        ray.densities = { max.sun * factor, max.view * factor, max.behind * factor };
        ray.planeHeight = direction % 2 == 0 ? 300 : -300;
        addSlice(field, ray, sample);
      }
    }
  }
  return sample;
}

/// Light in units of the mean of the first.
void scaleLight(std::vector<FitCase>& training, std::vector<FitCase>& heldOut)
{
  double mean = 0;
  for (const FitCase& one : training)
  {
    mean += one.target / static_cast<double>(training.size());
  }
  for (std::vector<FitCase>* const cases : { &training, &heldOut })
  {
    for (FitCase& one : *cases)
    {
      one.target /= mean;
      for (std::size_t i = 0; i + 1 < one.input.size(); i += 5)
      {
        one.input[i] /= mean;
      }
    }
  }
}

/// Fits of both forms, without and with gain, and of the transmission.
void addProblems(const std::vector<double>& factors, std::vector<FitProblem>& problems)
{
  std::ostringstream densities;
  densities << ", densities " << factors.front();
  if (factors.size() > 1)
  {
    densities << " to " << factors.back();
  }
  Sample training = rays(1986, factors);
  Sample heldOut = rays(1994, factors);
  scaleLight(training.light, heldOut.light);
  FitProblem problem;
  problem.training = training.light;
  problem.heldOut = heldOut.light;
  const FitParameter sun{ "ma", 0.7, 0.01, 3 };
  const FitParameter view{ "mb", 0.7, 0.01, 3 };
  const auto add = [&](const std::string& name, const auto& form)
  {
    problem.name = name + densities.str();
    problem.parameters = { sun, view };
    problem.model = differentiated<ceres::Jet<double, 2>>(
      [form](const double* x, const auto* p) { return form(x, p[0], p[1]); });
    problems.push_back(problem);
    problem.name = name + " with gain" + densities.str();
    problem.parameters = { sun, view, { "gain", 1, 0.1, 3 } };
    problem.model = differentiated<ceres::Jet<double, 3>>(
      [form](const double* x, const auto* p) { return p[2] * form(x, p[0], p[1]); });
    problems.push_back(problem);
  };
  add("product", [](const double* x, const auto& a, const auto& b) { return product(x, a, b); });
  add("printed", [](const double* x, const auto& a, const auto& b) { return printed(x, a, b); });
  FitProblem transmission;
  transmission.name = "transmission" + densities.str();
  transmission.training = training.transmission;
  transmission.heldOut = heldOut.transmission;
  transmission.parameters = { { "mc", 0.7, 0.01, 3 } };
  transmission.model = differentiated<ceres::Jet<double, 1>>([](const double* x, const auto* p)
    { return quadratic(std::decay_t<decltype(*p)>(p[0] * x[0])); });
  problems.push_back(transmission);
}
}

std::vector<Fit> fitHeightField(const std::optional<FitRange>& range, const FitProgress& progress)
{
  std::vector<double> factors;
  for (const double factor : Factors)
  {
    if (!range || (factor >= range->from && factor <= range->to))
    {
      factors.push_back(factor);
    }
  }
  if (factors.empty())
  {
    throw FitError(
      "none of the factors 0.25, 0.5, 1, 2, 4 on the densities is in the range; widen it");
  }
  std::vector<FitProblem> problems;
  if (!range)
  {
    addProblems({ 1 }, problems);
  }
  addProblems(factors, problems);
  return solveAll(problems, progress);
}
}
