// SPDX-License-Identifier: BSD-3-Clause
// Where choosing the cheapest method goes wrong. Naive is a loop that takes the least seconds among errors below the tolerance.
#include "Stability.h"

#include "MethodChoice.h"

#include <cmath>
#include <limits>

namespace nephoscope
{
namespace stability
{
namespace
{
std::string naiveChoice(const std::vector<MethodOption>& options, double tolerance)
{
  std::string chosen = "nothing";
  double least = std::numeric_limits<double>::infinity();
  for (const MethodOption& option : options)
  {
    if (!(option.error > tolerance) && !(option.seconds >= least))
    {
      chosen = option.name;
      least = option.seconds;
    }
  }
  return chosen;
}

std::string choice(const std::vector<MethodOption>& options, double tolerance)
{
  try
  {
    return options[cheapestChoice({ { "clouds", options } }, tolerance).options[0]].name;
  }
  catch (const ChoiceError& error)
  {
    return error.what();
  }
}

/// The method's cost without bounds.
double naiveSeconds(const CostModel& cost, const std::vector<double>& work)
{
  double sum = 0;
  for (std::size_t i = 0; i < work.size(); ++i)
  {
    sum += cost.coefficients[i] * work[i];
  }
  return sum;
}

Outcome chosen(const std::vector<MethodOption>& options, const std::string& right)
{
  const std::string ours = choice(options, 0.01);
  return { naiveChoice(options, 0.01), ours, ours.find(right) != std::string::npos };
}

const StabilityRegistration deep(
  { "choice", "steps that overflow at optical depth 1e6 and cost 0", "another method",
    []
    {
      const CostModel cost{ { 1e-6, 0 } };
      const double steps = 1e308 * 1e6;
      const double naive = naiveSeconds(cost, { 1e6, steps });
      const MethodOption exact{ "Exact", 100, 0 };
      return Outcome{ naiveChoice({ exact, { "March", naive, 1e-3 } }, 0.01),
        choice({ exact, { "March", cost.seconds({ 1e6, steps }), 1e-3 } }, 0.01),
        choice({ exact, { "March", cost.seconds({ 1e6, steps }), 1e-3 } }, 0.01) == "Exact" };
    } });

const StabilityRegistration negative({ "choice", "work of a negative density", "0 s",
  []
  {
    const CostModel cost{ { 1e-6, 2e-7 } };
    const double ours = cost.seconds({ 0, -1e9 });
    return Outcome{ figure("seconds", naiveSeconds(cost, { 0, -1e9 })), figure("seconds", ours),
      ours == 0 };
  } });

const StabilityRegistration notANumber(
  { "choice", "an error that is NaN", "another method", [] {
     return chosen({ { "Moments", 1, std::nan("") }, { "Exact", 100, 0 } }, "Exact");
   } });

const StabilityRegistration nothing({ "choice", "a part without methods", "an error that names it",
  [] { return chosen({}, "there is no method for clouds"); } });

const StabilityRegistration impossible(
  { "choice", "a tolerance that no method meets", "an error with what can be had",
    []
    {
      return chosen({ { "Moments", 1, 0.1 }, { "March", 9, 0.02 } }, "0.02 can be reached, in 9 s");
    } });
}
}
}
