// SPDX-License-Identifier: BSD-3-Clause
#include "Calibration.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nephoscope
{
namespace
{
/// The element of a name, or an error that lists the names that there are.
template <class Named>
const Named& named(
  const std::vector<Named>& all, std::string_view name, const std::string& place, const char* kind)
{
  std::string known;
  for (const Named& one : all)
  {
    if (one.name == name)
    {
      return one;
    }
    known += (known.empty() ? "" : ", ") + one.name;
  }
  throw std::out_of_range(place + " has no " + kind + " '" + std::string(name) + "'; it has " +
    (known.empty() ? "none" : known));
}

std::string wrongParameter(const FittedParameter& p)
{
  if (p.name.empty())
  {
    return "a parameter without a name";
  }
  for (const double number : { p.value, p.standardError, p.lower, p.upper })
  {
    if (!std::isfinite(number))
    {
      return p.name + " has a number that is not finite";
    }
  }
  if (p.value < p.lower || p.value > p.upper)
  {
    return p.name + " = " + std::to_string(p.value) + " is not between its bounds " +
      std::to_string(p.lower) + " and " + std::to_string(p.upper);
  }
  return p.standardError < 0 ? p.name + " has a negative standard error" : "";
}

bool sound(const RemainingError& error)
{
  const bool finite = std::isfinite(error.bias) && std::isfinite(error.rms) &&
    std::isfinite(error.median) && std::isfinite(error.p95) && std::isfinite(error.max);
  return finite && error.cases >= 0 && error.rms >= 0;
}

std::string wrongFit(const Fit& fit)
{
  for (const FittedParameter& parameter : fit.parameters)
  {
    std::string wrong = wrongParameter(parameter);
    if (!wrong.empty())
    {
      return wrong;
    }
  }
  const std::size_t n = fit.parameters.size();
  const bool finite = std::all_of(
    fit.covariance.begin(), fit.covariance.end(), [](double v) { return std::isfinite(v); });
  if (fit.covariance.size() != n * n || !finite)
  {
    return "the covariance is not " + std::to_string(n) + " x " + std::to_string(n) +
      " finite numbers";
  }
  return sound(fit.training) && sound(fit.heldOut) ? "" : "an error that is no number";
}
}

double Fit::value(std::string_view parameter) const
{
  return named(this->parameters, parameter, "the fit '" + this->name + "'", "parameter").value;
}

const Fit& Calibration::fit(std::string_view name) const
{
  return named(this->fits, name, "the calibration '" + this->what + "'", "fit");
}

std::string whatIsWrong(const Calibration& calibration)
{
  if (calibration.what.empty())
  {
    return "the calibration has no name";
  }
  for (const Fit& fit : calibration.fits)
  {
    const std::string wrong = fit.name.empty() ? "it has no name" : wrongFit(fit);
    if (!wrong.empty())
    {
      return "fit '" + fit.name + "': " + wrong;
    }
  }
  return "";
}
}
