// SPDX-License-Identifier: BSD-3-Clause
#include "MethodChoice.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace nephoscope
{
namespace
{
constexpr std::size_t LongestFront = 2000;

std::string shortly(double value)
{
  std::ostringstream text;
  text.precision(3);
  text << value;
  return text.str();
}

/// Keeps what no other is at least as good as in both, by rising seconds.
void keepFront(std::vector<MethodChoice>& choices)
{
  std::stable_sort(choices.begin(), choices.end(),
    [](const MethodChoice& a, const MethodChoice& b)
    { return a.seconds < b.seconds || (a.seconds == b.seconds && a.error < b.error); });
  std::vector<MethodChoice> front;
  for (MethodChoice& choice : choices)
  {
    if (front.empty() || choice.error < front.back().error)
    {
      front.push_back(std::move(choice));
    }
  }
  choices = std::move(front);
}

/// The ends, and of each interval of the errors' logarithm the fastest.
void thin(std::vector<MethodChoice>& front)
{
  const auto place = [](const MethodChoice& choice)
  { return std::log(std::max(choice.error, 1e-12)); };
  const double width =
    std::max(1e-12, (place(front.front()) - place(front.back())) / (LongestFront - 2));
  std::vector<MethodChoice> kept;
  double last = 0;
  for (std::size_t i = 0; i < front.size(); ++i)
  {
    const double cell = std::floor(place(front[i]) / width);
    if (kept.empty() || cell != last || i + 1 == front.size())
    {
      kept.push_back(std::move(front[i]));
      last = cell;
    }
  }
  front = std::move(kept);
}

/// The part whose options are worst by a measure, even the best of them.
template <class Measure>
std::string hardest(const std::vector<ChoicePart>& parts, Measure measure)
{
  const ChoicePart* worst = nullptr;
  const MethodOption* itsBest = nullptr;
  for (const ChoicePart& part : parts)
  {
    const auto best = std::min_element(part.options.begin(), part.options.end(),
      [&measure](const MethodOption& a, const MethodOption& b) { return measure(a) < measure(b); });
    if (!itsBest || measure(*best) > measure(*itsBest))
    {
      worst = &part;
      itsBest = &*best;
    }
  }
  return worst ? worst->name + " by " + itsBest->name : "nothing";
}

void requirePositive(double limit, const std::string& name)
{
  if (!(limit > 0) || !std::isfinite(limit))
  {
    throw ChoiceError(name + " " + shortly(limit) + " is not a number above 0");
  }
}
}

double bounded(double value)
{
  return value < Endless ? std::max(value, 0.0) : Endless; // NaN is Endless
}

double CostModel::seconds(const std::vector<double>& work) const
{
  double sum = 0;
  for (std::size_t i = 0; i < this->coefficients.size() && i < work.size(); ++i)
  {
    const double amount = bounded(work[i]);
    // Endless work is never done, even if it costs nothing.
    sum += amount < Endless ? bounded(bounded(this->coefficients[i]) * amount) : Endless;
  }
  return bounded(sum);
}

double ErrorModel::error(double coarseness) const
{
  return this->scale > 0 ? bounded(this->scale * std::pow(bounded(coarseness), this->power)) : 0;
}

std::vector<MethodChoice> choiceFront(const std::vector<ChoicePart>& parts)
{
  std::vector<MethodChoice> front{ MethodChoice() };
  for (const ChoicePart& part : parts)
  {
    if (part.options.empty())
    {
      throw ChoiceError("there is no method for " + part.name);
    }
    std::vector<MethodChoice> next;
    for (const MethodChoice& choice : front)
    {
      for (std::size_t option = 0; option < part.options.size(); ++option)
      {
        MethodChoice longer = choice;
        longer.options.push_back(option);
        longer.seconds = bounded(choice.seconds + bounded(part.options[option].seconds));
        longer.error = bounded(choice.error + bounded(part.options[option].error));
        next.push_back(std::move(longer));
      }
    }
    keepFront(next);
    if (next.size() > LongestFront)
    {
      thin(next);
    }
    front = std::move(next);
  }
  return front;
}

MethodChoice cheapestChoice(const std::vector<ChoicePart>& parts, double tolerance)
{
  requirePositive(tolerance, "a tolerance of");
  const std::vector<MethodChoice> front = choiceFront(parts);
  for (const MethodChoice& choice : front)
  {
    if (choice.error <= tolerance)
    {
      return choice;
    }
  }
  throw ChoiceError("no methods reach a tolerance of " + shortly(tolerance) + "; " +
    shortly(front.back().error) + " can be reached, in " + shortly(front.back().seconds) +
    " s; the largest part of it is that of " +
    hardest(parts, [](const MethodOption& option) { return bounded(option.error); }));
}

MethodChoice mostExactChoice(const std::vector<ChoicePart>& parts, double seconds)
{
  requirePositive(seconds, "a time of");
  const std::vector<MethodChoice> front = choiceFront(parts);
  for (auto choice = front.rbegin(); choice != front.rend(); ++choice)
  {
    if (choice->seconds <= seconds)
    {
      return *choice;
    }
  }
  throw ChoiceError("no methods take " + shortly(seconds) + " s or less; the fastest take " +
    shortly(front.front().seconds) + " s, with an error of " + shortly(front.front().error) +
    "; most of it is for " +
    hardest(parts, [](const MethodOption& option) { return bounded(option.seconds); }));
}
}
