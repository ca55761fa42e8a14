// SPDX-License-Identifier: BSD-3-Clause
#include "FitPhase.h"

#include "FitModel.h"
#include "GaussLegendre.h"
#include "Mie.h"
#include "PhaseFunction.h"

#include <ceres/jet.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>
#include <type_traits>
#include <utility>

namespace nephoscope
{
namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr double Radii[] = { 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50 }; // um

struct Colour
{
  const char* name;
  double wavelength; ///< m
};
constexpr Colour Colours[] = { { "red", 650e-9 }, { "green", 550e-9 }, { "blue", 450e-9 } };

struct Form
{
  const char* name;
  std::vector<FitParameter> parameters;
  FitModel model; ///< 4 pi p of the cosine
  /// Another start: the constants with which it is nearly a simpler form that was fitted before; null if it is the simplest.
  std::vector<double> (*fromSimpler)(const std::vector<Fit>& before);
};

const std::vector<Form>& forms()
{
  static const std::vector<Form> all{
    { "Henyey-Greenstein", { { "g", 0.8, -0.9999, 0.9999 } },
      differentiated<ceres::Jet<double, 1>>(
        [](const double* mu, const auto* p) { return 4 * Pi * henyeyGreenstein(p[0], mu[0]); }),
      nullptr },
    { "Draine", { { "g", 0.7, -0.9999, 0.9999 }, { "alpha", 1, 0, 1000 } },
      differentiated<ceres::Jet<double, 2>>(
        [](const double* mu, const auto* p) { return 4 * Pi * draine(p[0], p[1], mu[0]); }),
      [](const std::vector<Fit>& before) {
        return std::vector<double>{ before[0].value("g"), 0.01 };
      } },
    { "double Henyey-Greenstein",
      { { "g1", 0.9, 0, 0.9999 }, { "g2", -0.2, -0.9999, 0.9 }, { "w", 0.2, 0, 1 } },
      differentiated<ceres::Jet<double, 3>>(
        [](const double* mu, const auto* p)
        {
          return 4 * Pi *
            ((1.0 - p[2]) * henyeyGreenstein(p[0], mu[0]) + p[2] * henyeyGreenstein(p[1], mu[0]));
        }),
      [](const std::vector<Fit>& before) {
        return std::vector<double>{ before[0].value("g"), -0.2, 0.01 };
      } },
    { "Henyey-Greenstein + Draine",
      { { "g1", 0.9, 0, 0.9999 }, { "g2", 0.4, -0.9999, 0.9 }, { "alpha", 10, 0, 1000 },
        { "w", 0.3, 0, 1 } },
      differentiated<ceres::Jet<double, 4>>(
        [](const double* mu, const auto* p)
        {
          return 4 * Pi *
            ((1.0 - p[3]) * henyeyGreenstein(p[0], mu[0]) + p[3] * draine(p[1], p[2], mu[0]));
        }),
      [](const std::vector<Fit>& before)
      {
        return std::vector<double>{ before[2].value("g1"), before[2].value("g2"), 0.01,
          before[2].value("w") };
      } },
  };
  return all;
}

/// Cosines of scattering angles with their weights: those of training, fine forward, then random directions that are held out.
std::vector<QuadraturePoint> directions(int heldOut)
{
  std::vector<QuadraturePoint> all;
  for (const QuadraturePoint& angle : gaussLegendrePanels(60, 3, 0, Pi))
  {
    all.push_back({ std::cos(angle.x), angle.weight * std::sin(angle.x) });
  }
  std::mt19937_64 random(1908);
  for (int i = 0; i < heldOut; ++i)
  {
    all.push_back({ 2 * (static_cast<double>(random() >> 11) * 0x1p-53) - 1, 1 });
  }
  return all;
}

/// Cases of one radius and colour, for whatever form.
FitProblem casesOf(double radius, const Colour& colour)
{
  constexpr int HeldOut = 200;
  const std::vector<QuadraturePoint> all = directions(HeldOut);
  std::vector<double> cosines;
  for (const QuadraturePoint& direction : all)
  {
    cosines.push_back(direction.x);
  }
  const MiePhase mie = miePhase({ radius * 1e-6, 0.1 }, colour.wavelength, cosines);
  FitProblem problem;
  problem.residual = Residual::Perceptual;
  std::ostringstream place;
  place << ", " << radius << " um, " << colour.name;
  problem.name = place.str();
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const bool training = i + HeldOut < all.size();
    (training ? problem.training : problem.heldOut)
      .push_back({ { cosines[i] }, 4 * Pi * mie.phase[i], all[i].weight });
  }
  return problem;
}

/// The better fit of those from both starts.
Fit fitForm(const Form& form, const FitProblem& cases, const std::vector<Fit>& before)
{
  FitProblem problem = cases;
  problem.name = form.name + cases.name;
  problem.parameters = form.parameters;
  problem.model = form.model;
  Fit best = solve(problem);
  if (form.fromSimpler)
  {
    const std::vector<double> start = form.fromSimpler(before);
    for (std::size_t i = 0; i < start.size(); ++i)
    {
      FitParameter& p = problem.parameters[i];
      p.start = std::clamp(start[i], p.lower, p.upper);
    }
    Fit other = solve(problem);
    const int iterations = best.iterations + other.iterations;
    if (other.training.rms < best.training.rms)
    {
      best = std::move(other);
    }
    best.iterations = iterations;
  }
  return best;
}

std::vector<double> radiiWithin(const std::optional<FitRange>& range)
{
  std::vector<double> radii;
  for (const double radius : Radii)
  {
    if (!range || (radius >= range->from && radius <= range->to))
    {
      radii.push_back(radius);
    }
  }
  if (radii.empty())
  {
    throw FitError("none of the effective radii 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50 um is in the "
                   "range; widen it");
  }
  return radii;
}
}

std::vector<Fit> fitPhase(const std::optional<FitRange>& range, const FitProgress& progress)
{
  const std::vector<double> radii = radiiWithin(range);
  const double total = static_cast<double>(radii.size() * std::size(Colours));
  std::vector<Fit> fits;
  int done = 0;
  for (const double radius : radii)
  {
    for (const Colour& colour : Colours)
    {
      const FitProblem cases = casesOf(radius, colour);
      std::vector<Fit> here;
      for (const Form& form : forms())
      {
        here.push_back(fitForm(form, cases, here));
      }
      fits.insert(fits.end(), here.begin(), here.end());
      if (progress && !progress(++done / total))
      {
        return fits;
      }
    }
  }
  return fits;
}
}
