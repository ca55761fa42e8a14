// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file LogChart.h
 * @brief Points on two logarithmic axes, each with its name beside it: speed against accuracy, time against size.
 *
 * Names are placed so that none overlaps a point or another name; where there is no room beside the point, a thin line
 * leads to it. What is ours is blue and filled, what is a peer's is hollow.
 */
#ifndef LogChart_h
#define LogChart_h

#include <string>
#include <vector>

namespace nephoscope
{
namespace charts
{
struct ChartPoint
{
  double x = 0; ///< > 0
  double y = 0; ///< > 0
  std::string name;
  std::string detail; ///< settings, in small type below the name
  bool ours = false;
  std::string mark = {}; ///< why it is marked by a ring, beside its name; empty if it is not
};

/// Points joined in order, named at the last.
struct ChartCurve
{
  std::vector<ChartPoint> points;
};

/// How numbers at ticks are written.
enum class Unit
{
  Seconds, ///< 10 ms, 1 s
  Count,   ///< 10^6
  Error    ///< 10^-6
};

struct LogChart
{
  std::string title;
  std::string subtitle;
  std::string xLabel;
  std::string yLabel;
  Unit xUnit = Unit::Seconds;
  Unit yUnit = Unit::Error;
  std::vector<ChartPoint> points;
  std::vector<ChartCurve> curves;
  bool pareto = false;      ///< draw the front of points of which none is better in both
  bool linearGuide = false; ///< a dashed line of slope 1 through the first curve's first point
};

/// A chart that no method was measured for.
struct NamedChart
{
  std::string name; ///< of the files
  LogChart chart;
};

/// The points that no other one is at least as good as in x and y and better in one, by x.
std::vector<ChartPoint> paretoFront(const std::vector<ChartPoint>& points);

/// The chart as an SVG document. Points whose coordinates are not positive numbers are left out.
std::string drawChart(const LogChart& chart);
}
}
#endif
