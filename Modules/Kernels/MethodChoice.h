// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file MethodChoice.h
 * @brief Which of several methods for each part of a picture: the cheapest that are exact enough, or the most exact in a given time.
 *
 * Models, whose constants are fitted to measurements:
 *     seconds = sum_i c_i w_i,  c_i >= 0          w_i: work, such as rays, cells or steps
 *     error   = scale x^power                        x: how coarse a method is, such as the optical depth of a step
 * Error is relative radiance (RadianceError.h). `scale` is such that the model lies above 95 % of what was measured.
 *
 * Choice: one option of each part, so that the sum of the errors is at most the tolerance (errors of parts may add, and more than
 * add they cannot in first order) and the sum of the seconds is least; how the tolerance is split among the parts is thereby
 * chosen too. Exact, by the front of all choices that are not worse in both than another: fronts of parts are added one after
 * the other. A front longer than 2000 is thinned to that evenly over its errors' logarithm: a few per cent of the tolerance may stay unused.
 *
 * Work, errors and coefficients that are negative count as 0; what is not a number or overflows, as Endless, which no limit admits.
 * @sa vtkCloudModelSelector, fitMethodModels, TestMethodChoice.cxx
 */
#ifndef MethodChoice_h
#define MethodChoice_h

#include <stdexcept>
#include <string>
#include <vector>

namespace nephoscope
{
/// Seconds and errors from here on are as good as infinite; finite, so that sums stay numbers.
inline constexpr double Endless = 1e30;

/// What a model's value counts as: in [0, Endless].
double bounded(double value);

struct CostModel
{
  std::vector<double> coefficients; ///< seconds a unit of work
  /// @param work as many as there are coefficients; what is missing counts as 0
  double seconds(const std::vector<double>& work) const;
};

struct ErrorModel
{
  double scale = 0;
  double power = 0;
  double error(double coarseness) const;
};

/// A method with its settings, and what is expected of it.
struct MethodOption
{
  std::string name;
  double seconds = 0;
  double error = 0;
};

struct ChoicePart
{
  std::string name;
  std::vector<MethodOption> options; ///< one at least
};

struct MethodChoice
{
  std::vector<std::size_t> options; ///< of each part
  double seconds = 0;
  double error = 0;
};

struct ChoiceError : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// The choices of which no other is at least as good in both, from the fastest to the most exact. @throw ChoiceError for a part
/// without options
std::vector<MethodChoice> choiceFront(const std::vector<ChoicePart>& parts);

/// The cheapest with an error of at most `tolerance`. @throw ChoiceError: a tolerance that is not above 0, or what is reachable and
/// which part is in the way
MethodChoice cheapestChoice(const std::vector<ChoicePart>& parts, double tolerance);

/// The most exact in at most `seconds`, of those the fastest. @throw ChoiceError as above
MethodChoice mostExactChoice(const std::vector<ChoicePart>& parts, double seconds);
}
#endif
