// SPDX-License-Identifier: BSD-3-Clause
#include "FitDensity.h"

#include "FitModel.h"
#include "GaussianStart.h"
#include "RemainingErrorOf.h"

#include <ceres/jet.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <random>
#include <sstream>

namespace nephoscope
{
namespace
{
using Jet = ceres::Jet<double, GaussianParts>;
using Terms = std::vector<GaussianTerm>;
using Rays = std::vector<DensityRay>;

constexpr const char* PartNames[] = { "a", "x", "y", "z", "m00", "m01", "m02", "m11", "m12",
  "m22" };
constexpr double Quick = 1e-3; ///< share of the cost by which a step of the search has to lower it
constexpr double Thorough = 1e-6;

double uniform(std::mt19937_64& random, double least, double most)
{
  return least + (most - least) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

/// A coordinate by its share of the points, so that all levels count alike, close ones and far.
double between(const std::vector<double>& points, double share)
{
  const double at = share * static_cast<double>(points.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(at), points.size() - 1);
  const std::size_t above = std::min(below + 1, points.size() - 1);
  return points[below] + (at - static_cast<double>(below)) * (points[above] - points[below]);
}

/// Rays through random places in random directions; of a column all from there on upwards.
Rays raysThrough(const DensityGrid& density, int count, std::uint64_t seed)
{
  std::mt19937_64 random(seed);
  const bool column = !density.varies(0) && !density.varies(1);
  Rays rays;
  while (static_cast<int>(rays.size()) < count)
  {
    DensityRay ray{ {}, {}, 0, std::numeric_limits<double>::infinity() };
    double square = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      ray.origin[axis] = between(density.coordinates(axis), uniform(random, 0, 1));
      ray.direction[axis] = density.varies(axis) ? uniform(random, -1, 1) : 0;
      square += ray.direction[axis] * ray.direction[axis];
    }
    if (!(square > 0.01) || square > 1)
    {
      continue; // directions of a ball are even, those of a cube are not
    }
    for (double& d : ray.direction)
    {
      d = column ? std::abs(d) / std::sqrt(square) : d / std::sqrt(square);
    }
    ray.from = column || rays.size() % 2 == 0 ? 0 : -ray.to;
    rays.push_back(ray);
  }
  return rays;
}

/// The sum of several terms along a ray, per unit of depth; a case's input is the ray's number.
class SumModel
{
public:
  SumModel(std::shared_ptr<const Rays> rays, std::vector<int> parts, double unit)
    : AllRays(std::move(rays))
    , Parts(std::move(parts))
    , Unit(unit)
  {
  }

  double operator()(
    int terms, const double* input, const double* parameters, double* gradient) const
  {
    const DensityRay& ray = (*this->AllRays)[static_cast<std::size_t>(input[0])];
    const auto width = static_cast<int>(this->Parts.size());
    double sum = 0;
    for (int i = 0; i < terms; ++i)
    {
      double term[GaussianParts] = {};
      for (int k = 0; k < width; ++k)
      {
        term[this->Parts[k]] = parameters[i * width + k];
      }
      const double depth = gaussianLineIntegral(term, ray);
      sum += depth / this->Unit;
      if (gradient)
      {
        this->derive(term, ray, depth, gradient + static_cast<std::ptrdiff_t>(i) * width);
      }
    }
    return sum;
  }

private:
  void derive(const double* term, const DensityRay& ray, double depth, double* gradient) const
  {
    Jet jets[GaussianParts];
    for (int k = 0; k < GaussianParts; ++k)
    {
      jets[k] = Jet(term[k], k);
    }
    // What a ray sees nothing of does not depend on how it is shaped.
    const bool seen = depth > 1e-16 * this->Unit || term[GaussianAmplitude] == 0;
    const Jet value = seen ? gaussianLineIntegral(jets, ray) : Jet(0.0);
    for (std::size_t k = 0; k < this->Parts.size(); ++k)
    {
      gradient[k] = value.v[this->Parts[k]] / this->Unit;
    }
  }

  std::shared_ptr<const Rays> AllRays;
  std::vector<int> Parts;
  double Unit;
};

double worstRms(const RemainingError& a, const RemainingError& b)
{
  return std::max(a.rms, b.rms);
}

/// The search.
class Reduction
{
public:
  Reduction(
    const DensityGrid& density, const DensityFitSettings& settings, const FitProgress& progress);
  std::vector<Fit> run();

private:
  void addCases();
  void setBounds();
  FitProblem problemOf(const Terms& terms, double improvement) const;
  Terms fitted(const Terms& terms, double improvement) const;
  GaussianTerm fittedAlone(const GaussianTerm& start, const Terms& others) const;
  double errorOf(const Terms& terms) const;
  void tryStart(Terms start, Terms& best, double& error) const;
  bool addOne(Terms& terms, double& error) const;
  double settle(Terms& terms) const;
  bool leaveOneOut(Terms& terms) const;
  DensityGrid sampled(const Terms& terms) const;
  std::vector<Fit> report(const Terms& terms) const;

  const DensityGrid& Density;
  DensityFitSettings Settings;
  double Enough; ///< the tolerance, less what the last steps may change
  const FitProgress& Progress;
  GaussianStart Start;
  std::vector<int> Parts; ///< that are free
  GaussianTerm Lower{};
  GaussianTerm Upper{};
  std::shared_ptr<const Rays> AllRays;
  double Unit = 0; ///< rms depth of the training rays
  std::vector<FitCase> Training;
  std::vector<FitCase> HeldOut;
};

Reduction::Reduction(
  const DensityGrid& density, const DensityFitSettings& settings, const FitProgress& progress)
  : Density(density)
  , Settings(settings)
  , Enough((1 - Quick) * settings.tolerance)
  , Progress(progress)
  , Start(density)
{
  this->addCases();
  this->setBounds();
}

void Reduction::addCases()
{
  const bool column = !this->Density.varies(0) && !this->Density.varies(1);
  const int count = column ? 400 : 4000;
  Rays rays = raysThrough(this->Density, count, 1985);
  const Rays others = raysThrough(this->Density, count, 2002);
  rays.insert(rays.end(), others.begin(), others.end());
  std::vector<double> depths;
  for (const DensityRay& ray : rays)
  {
    depths.push_back(this->Density.lineIntegral(ray));
  }
  const double squares =
    std::inner_product(depths.begin(), depths.begin() + count, depths.begin(), 0.0);
  this->Unit = std::sqrt(squares / count);
  if (!(this->Unit > 0))
  {
    throw FitError("density: it is 0 everywhere; there is nothing to put Gaussians to");
  }
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    std::vector<FitCase>& cases = static_cast<int>(i) < count ? this->Training : this->HeldOut;
    cases.push_back({ { static_cast<double>(i) }, depths[i] / this->Unit });
  }
  this->AllRays = std::make_shared<const Rays>(std::move(rays));
}

/// Centres near the grid, widths from a quarter of the closest points' distance to twice the extent.
void Reduction::setBounds()
{
  this->Parts = { GaussianAmplitude };
  double narrowest[3] = {};
  double extent[3] = {};
  for (int axis = 0; axis < 3; ++axis)
  {
    extent[axis] = this->Density.high(axis) - this->Density.low(axis);
    narrowest[axis] = extent[axis] / 4;
    const std::vector<double>& points = this->Density.coordinates(axis);
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
    {
      narrowest[axis] = std::min(narrowest[axis], (points[i + 1] - points[i]) / 4);
    }
    this->Lower[GaussianX + axis] = this->Density.low(axis) - extent[axis] / 2;
    this->Upper[GaussianX + axis] = this->Density.high(axis) + extent[axis] / 2;
    if (this->Density.varies(axis))
    {
      this->Parts.push_back(GaussianX + axis);
    }
  }
  const double densest =
    *std::max_element(this->Density.values().begin(), this->Density.values().end());
  this->Upper[GaussianAmplitude] = 10 * densest;
  int part = GaussianM00;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = row; column < 3; ++column, ++part)
    {
      if (this->Density.varies(row) && this->Density.varies(column))
      {
        this->Parts.push_back(part);
        this->Upper[part] = 1 / narrowest[column];
        this->Lower[part] = row == column ? 0.5 / extent[column] : -this->Upper[part];
      }
    }
  }
}

FitProblem Reduction::problemOf(const Terms& terms, double improvement) const
{
  FitProblem problem;
  problem.name = "density";
  problem.training = this->Training;
  problem.heldOut = this->HeldOut;
  problem.improvement = improvement;
  for (std::size_t i = 0; i < terms.size(); ++i)
  {
    for (const int part : this->Parts)
    {
      const double start = std::clamp(terms[i][part], this->Lower[part], this->Upper[part]);
      problem.parameters.push_back({ std::string(PartNames[part]) + " " + std::to_string(i + 1),
        start, this->Lower[part], this->Upper[part] });
    }
  }
  const SumModel model(this->AllRays, this->Parts, this->Unit);
  problem.model = [model, count = static_cast<int>(terms.size())](
                    const double* input, const double* parameters, double* gradient)
  { return model(count, input, parameters, gradient); };
  return problem;
}

Terms Reduction::fitted(const Terms& terms, double improvement) const
{
  const std::vector<double> numbers = bestParameters(this->problemOf(terms, improvement));
  Terms better(terms.size());
  auto number = numbers.begin();
  for (GaussianTerm& term : better)
  {
    for (const int part : this->Parts)
    {
      term[part] = *number++;
    }
  }
  return better;
}

/// One term to what the others leave.
GaussianTerm Reduction::fittedAlone(const GaussianTerm& start, const Terms& others) const
{
  FitProblem problem = this->problemOf({ start }, Quick);
  for (FitCase& one : problem.training)
  {
    const DensityRay& ray = (*this->AllRays)[static_cast<std::size_t>(one.input[0])];
    for (const GaussianTerm& other : others)
    {
      one.target -= gaussianLineIntegral(other.data(), ray) / this->Unit;
    }
  }
  const std::vector<double> numbers = bestParameters(problem);
  GaussianTerm term{};
  for (std::size_t k = 0; k < this->Parts.size(); ++k)
  {
    term[this->Parts[k]] = numbers[k];
  }
  return term;
}

/// Relative rms error of line integrals, of the worse set of rays.
double Reduction::errorOf(const Terms& terms) const
{
  const FitProblem problem = this->problemOf(terms, Quick);
  std::vector<double> numbers;
  for (const FitParameter& p : problem.parameters)
  {
    numbers.push_back(p.start);
  }
  return worstRms(remainingError(problem, problem.training, numbers),
    remainingError(problem, problem.heldOut, numbers));
}

/// Fits to the end. @return the error, which may be a little more for the rays held out
double Reduction::settle(Terms& terms) const
{
  terms = this->fitted(terms, Thorough);
  return this->errorOf(terms);
}

/// Tries to do with one term less. @return whether that went
bool Reduction::leaveOneOut(Terms& terms) const
{
  std::vector<std::size_t> order(terms.size());
  std::iota(order.begin(), order.end(), 0);
  const auto mass = [&terms](std::size_t i) { return gaussianMass(terms[i].data()); };
  std::stable_sort(order.begin(), order.end(),
    [&mass](std::size_t a, std::size_t b) { return mass(a) < mass(b); });
  for (const std::size_t out : order)
  {
    Terms others = terms;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(out));
    if (others.empty())
    {
      return false;
    }
    others = this->fitted(others, Quick);
    if (this->errorOf(others) <= this->Settings.tolerance && this->settle(others) <= this->Enough)
    {
      terms = others;
      return true;
    }
  }
  return false;
}

/// Fits a start, and keeps it if its error is less.
void Reduction::tryStart(Terms start, Terms& best, double& error) const
{
  start = this->fitted(start, Quick);
  start.erase(std::remove_if(start.begin(), start.end(),
                [](const GaussianTerm& term) { return !(term[GaussianAmplitude] > 0); }),
    start.end());
  const double its = start.empty() ? 1 : this->errorOf(start);
  if (its < (1 - Quick) * error)
  {
    best = start;
    error = its;
  }
}

/**
 * One term more: where it does most, of ever narrower widths; if none lowers the error by a tenth, also the term with most of the
 * residual split along each axis, and, until one lowers it by a hundredth, the next.
 */
bool Reduction::addOne(Terms& terms, double& error) const
{
  const double before = error;
  const Terms old = terms;
  for (const double widest : { 0.25, 0.125, 0.0625 })
  {
    const GaussianTerm start = this->Start.best(old, widest);
    if (error > 0.9 * before && start[GaussianAmplitude] > 0)
    {
      Terms more = old;
      more.push_back(start);
      this->tryStart(more, terms, error);
      more.back() = this->fittedAlone(start, old);
      this->tryStart(more, terms, error);
    }
  }
  const std::vector<std::size_t> order = this->Start.worstFirst(old);
  for (std::size_t i = 0; i < order.size() && error > (i == 0 ? 0.9 : 0.99) * before; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      if (this->Density.varies(axis))
      {
        this->tryStart(splitTerm(old, order[i], axis), terms, error);
      }
    }
  }
  return error < before;
}

std::vector<Fit> Reduction::run()
{
  Terms terms;
  double error = 1; // of nothing
  bool wanted = true;
  while (error > this->Enough && wanted && static_cast<int>(terms.size()) < this->Settings.terms &&
    this->addOne(terms, error))
  {
    error = error <= this->Settings.tolerance ? this->settle(terms) : error;
    wanted = !this->Progress || this->Progress(0.5 * terms.size() / this->Settings.terms);
  }
  if (error > this->Enough)
  {
    std::ostringstream text;
    text << "density: the tolerance " << this->Settings.tolerance << " is not met; " << terms.size()
         << (terms.size() == 1 ? " Gaussian reaches " : " Gaussians reach ") << error
         << (static_cast<int>(terms.size()) == this->Settings.terms
                ? ". Allow more of them, or a larger tolerance"
                : ", and one more does not help. Allow a larger tolerance");
    throw FitError(text.str());
  }
  while (wanted && this->leaveOneOut(terms))
  {
    wanted = !this->Progress || this->Progress(0.75);
  }
  return this->report(terms);
}

/// What a sum is at the grid's points.
DensityGrid Reduction::sampled(const Terms& terms) const
{
  const DensityGrid& grid = this->Density;
  std::vector<double> values;
  for (const double z : grid.coordinates(2))
  {
    for (const double y : grid.coordinates(1))
    {
      for (const double x : grid.coordinates(0))
      {
        const double place[] = { x, y, z };
        values.push_back(0);
        for (const GaussianTerm& term : terms)
        {
          values.back() += gaussianDensity(term.data(), place);
        }
      }
    }
  }
  return { { grid.coordinates(0), grid.coordinates(1), grid.coordinates(2) }, values };
}

/// The errors of values, relative to the rms of the exact ones.
Fit comparison(
  const char* name, const std::vector<double>& values, const std::vector<double>& exact)
{
  const double squares = std::inner_product(exact.begin(), exact.end(), exact.begin(), 0.0);
  const double unit = std::sqrt(squares / static_cast<double>(exact.size()));
  FitProblem problem;
  problem.name = name;
  for (std::size_t i = 0; i < exact.size(); ++i)
  {
    problem.heldOut.push_back({ { values[i] / unit }, exact[i] / unit });
  }
  problem.model = [](const double* value, const double*, double*) { return *value; };
  Fit fit;
  fit.name = name;
  fit.residual = "relative";
  fit.heldOut = remainingError(problem, problem.heldOut, {});
  return fit;
}

/// A part of a fit: the parameters of one term, with their own covariance.
Fit termOf(const Fit& whole, std::size_t first, std::size_t width)
{
  Fit part;
  part.residual = whole.residual;
  const std::size_t n = whole.parameters.size();
  for (std::size_t i = 0; i < width; ++i)
  {
    part.parameters.push_back(whole.parameters[first + i]);
    std::string& name = part.parameters.back().name;
    name.erase(name.find(' '));
    for (std::size_t j = 0; j < width; ++j)
    {
      part.covariance.push_back(whole.covariance[(first + i) * n + first + j]);
    }
  }
  return part;
}

std::vector<Fit> Reduction::report(const Terms& terms) const
{
  Terms sorted = terms;
  std::stable_sort(sorted.begin(), sorted.end(),
    [](const GaussianTerm& a, const GaussianTerm& b)
    { return gaussianMass(a.data()) > gaussianMass(b.data()); });
  Fit whole = solve(this->problemOf(sorted, Thorough));
  whole.residual = "relative";
  std::vector<Fit> gaussians;
  for (std::size_t i = 0; i < sorted.size(); ++i)
  {
    gaussians.push_back(termOf(whole, i * this->Parts.size(), this->Parts.size()));
    gaussians.back().name = "Gaussian " + std::to_string(i + 1);
    sorted[i] = gaussianOf(gaussians.back());
  }
  whole.name = "sum";
  whole.parameters.clear();
  whole.covariance.clear();
  const DensityGrid fitted = this->sampled(sorted);
  std::vector<Fit> all{ whole, comparison("density", fitted.values(), this->Density.values()),
    comparison("mass", { fitted.mass() }, { this->Density.mass() }) };
  all.insert(all.end(), gaussians.begin(), gaussians.end());
  return all;
}
}

std::array<double, GaussianParts> gaussianOf(const Fit& fit)
{
  GaussianTerm term{};
  for (const FittedParameter& p : fit.parameters)
  {
    const auto* const name = std::find(std::begin(PartNames), std::end(PartNames), p.name);
    if (name != std::end(PartNames))
    {
      term[name - PartNames] = p.value;
    }
  }
  return term;
}

std::vector<Fit> fitDensity(
  const DensityGrid& density, const DensityFitSettings& settings, const FitProgress& progress)
{
  const std::string wrong = density.whatIsWrong();
  if (!wrong.empty())
  {
    throw FitError("density: " + wrong);
  }
  if (!density.varies(0) && !density.varies(1) && !density.varies(2))
  {
    throw FitError("density: it has but one point; give a column or a volume");
  }
  if (!(settings.tolerance > 0) || !std::isfinite(settings.tolerance))
  {
    throw FitError("density: the tolerance has to be above 0");
  }
  if (settings.terms < 1 || settings.terms > 100)
  {
    throw FitError("density: the number of Gaussians has to be 1 to 100");
  }
  return Reduction(density, settings, progress).run();
}
}
