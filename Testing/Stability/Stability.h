// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Stability.h
 * @brief Situations where methods like these are known to fail, each with the naive result, ours and the defined answer.
 *
 * A situation joins by registering itself once, at namespace scope of its source file:
 *
 *     const StabilityRegistration seam({ "contour", "the seam", "no open edge", [] { return outcome; } });
 *
 * The same register is run as tests and printed as a table.
 */
#ifndef Stability_h
#define Stability_h

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace nephoscope
{
namespace stability
{
/// What came out, in words with figures.
struct Outcome
{
  std::string naive;
  std::string ours;
  bool holds = false; ///< whether ours is the defined answer
};

struct StabilityCase
{
  /// "advection", "contour", "volume", "voxels", "optics", "fit", "height field", "haze", "choice"
  std::string group;
  std::string situation; ///< what is hard
  std::string defined;   ///< the answer that is asked for
  std::function<Outcome()> run;
};

/// The register, in order of registration.
const std::vector<StabilityCase>& cases();

struct StabilityRegistration
{
  explicit StabilityRegistration(StabilityCase stabilityCase);
};

/// Runs all and prints them as one table. Returns how many do not hold.
int printTable(std::ostream& out);

/// "name 1.2e-05" for a figure.
std::string figure(const std::string& name, double value);
}
}
#endif
