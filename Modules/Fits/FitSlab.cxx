// SPDX-License-Identifier: BSD-3-Clause
#include "FitSlab.h"

#include "FitModel.h"
#include "SlabReference.h"
#include "SlabReflectance.h"

#include <ceres/jet.h>

#include <array>
#include <sstream>

namespace nephoscope
{
namespace
{
/// Reflectance of one scattering; the case's input is depth and the sun's index.
FitModel singleScattering(double g)
{
  const std::array<SlabReflectance, 2> slabs{ SlabReflectance(g, SlabSuns[0]),
    SlabReflectance(g, SlabSuns[1]) };
  return differentiated<ceres::Jet<double, 2>>([slabs](const double* x, const auto* p)
    { return slabs[static_cast<std::size_t>(x[1])](p[1], p[0] * x[0]); });
}

FitProblem problemOf(const SlabMaterial& material, const std::optional<FitRange>& range)
{
  FitProblem problem;
  std::ostringstream name;
  name << "g " << material.g << ", albedo " << material.albedo;
  problem.name = name.str();
  problem.model = singleScattering(material.g);
  for (int i = 0; i < 7; ++i)
  {
    const double depth = SlabDepths[i];
    if (range && (depth < range->from || depth > range->to))
    {
      continue;
    }
    for (int sun = 0; sun < 2; ++sun)
    {
      (i % 2 == 0 ? problem.training : problem.heldOut)
        .push_back({ { depth, static_cast<double>(sun) }, material.reflectance[i][sun] });
    }
  }
  return problem;
}
}

std::vector<Fit> fitSlab(const std::optional<FitRange>& range, const FitProgress& progress)
{
  std::vector<FitProblem> problems;
  for (const SlabMaterial& material : SlabReference)
  {
    FitProblem problem = problemOf(material, range);
    problem.parameters = { { "density", 0.5, 1e-3, 10 }, { "albedo", 1, 0, 100 } };
    problems.push_back(problem);
    problem.name += ", at most 1";
    problem.parameters = { { "density", 0.5, 1e-3, 10 }, { "albedo", 0.9, 0, 1 } };
    problems.push_back(problem);
  }
  return solveAll(problems, progress);
}
}
