// SPDX-License-Identifier: BSD-3-Clause
#include "FitSubjects.h"

#include "FitHeightField.h"
#include "FitPhase.h"
#include "FitSlab.h"
#include "FitTransmittance.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace nephoscope
{
namespace
{
std::string subjectNames()
{
  std::string names;
  for (const FitSubject& subject : fitSubjects())
  {
    names += (names.empty() ? "" : ", ") + subject.name;
  }
  return names;
}

void checkRange(const FitRange& range)
{
  std::ostringstream text;
  text << range.from << ":" << range.to;
  if (!std::isfinite(range.from) || !std::isfinite(range.to) || !(range.from < range.to))
  {
    throw FitError("the range " + text.str() + " is empty; give two numbers in ascending order");
  }
  if (range.from < 0)
  {
    throw FitError("the range " + text.str() + " is negative; it has to begin at 0 or later");
  }
}
}

const std::vector<FitSubject>& fitSubjects()
{
  static const std::vector<FitSubject> subjects{
    { "transmittance", "powers of a clipped line and clipped polynomials, to exp(-x)",
      "optical depths of the polynomials; default 0 to each of 1, 2, 3, 4", fitTransmittance,
      fitTransmittanceToDepths },
    { "phase", "phase functions in closed form, to Mie's of water droplets",
      "effective radii in um, of 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50; default all", fitPhase },
    { "slab", "effective density and albedo of single scattering, to reflectances of slabs",
      "optical depths, of 0.5, 1, 2, 4, 8, 16, 32; default all", fitSlab },
    { "heightfield",
      "factors on the densities of height-field clouds whose exponentials are replaced",
      "factors on Max's densities, of 0.25, 0.5, 1, 2, 4; default 1, and all", fitHeightField },
  };
  return subjects;
}

Calibration runFit(const std::string& subject, const std::optional<FitRange>& range,
  const FitProgress& progress, const std::vector<double>& depths)
{
  const std::vector<FitSubject>& all = fitSubjects();
  const auto found = std::find_if(
    all.begin(), all.end(), [&subject](const FitSubject& one) { return one.name == subject; });
  if (found == all.end())
  {
    throw FitError("there is no fit '" + subject + "'; there are " + subjectNames());
  }
  std::ostringstream command;
  command.precision(17);
  command << "nephoscope fit " << subject;
  if (range)
  {
    checkRange(*range);
    command << " --range " << range->from << ":" << range->to;
  }
  if (depths.empty())
  {
    return { subject, command.str(), found->run(range, progress) };
  }
  if (!found->runForDepths)
  {
    throw FitError("the fit '" + subject + "' takes no optical depths of a scene or a data file");
  }
  return { subject, command.str(), found->runForDepths(depths, range, progress) };
}

std::vector<Fit> solveAll(const std::vector<FitProblem>& problems, const FitProgress& progress)
{
  std::vector<Fit> fits;
  for (const FitProblem& problem : problems)
  {
    fits.push_back(solve(problem));
    if (progress && !progress(static_cast<double>(fits.size()) / problems.size()))
    {
      break;
    }
  }
  return fits;
}
}
