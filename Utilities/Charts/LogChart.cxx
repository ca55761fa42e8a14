// SPDX-License-Identifier: BSD-3-Clause
#include "LogChart.h"

#include "SvgDrawing.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace nephoscope
{
namespace charts
{
namespace
{
constexpr double Width = 1000;
constexpr double Height = 640;
constexpr Box Page{ 95, 84, 970, 560 };
constexpr double NameColumn = 320; ///< where curves are named, right of the plot
constexpr double Disc = 6;
constexpr double NameSize = 14;
constexpr double DetailSize = 12;
const std::string OursColor = "#0b5fa5";
const std::string PeerColor = "#6b6b6b";
const std::string GridColor = "#dddddd";
const std::string FrontColor = "#e08214";
const std::string MarkColor = "#b2182b";

bool drawable(const ChartPoint& p)
{
  return p.x > 0 && p.y > 0 && std::isfinite(p.x) && std::isfinite(p.y);
}

std::string decadeLabel(int exponent)
{
  return exponent == 0 ? "1"
    : exponent == 1    ? "10"
    : exponent == -1   ? "0.1"
                       : "10^" + std::to_string(exponent);
}

/// digit * 10^exponent.
std::string tickLabel(int digit, int exponent, Unit unit)
{
  if (unit == Unit::Seconds && exponent >= -6 && exponent <= 4)
  {
    const int prefix = exponent >= 0 ? 0 : exponent >= -3 ? 1 : 2;
    const int zeros = exponent + 3 * prefix;
    const char* const names[] = { " s", " ms", " µs" };
    return std::to_string(digit) + std::string(static_cast<std::size_t>(zeros), '0') +
      names[prefix];
  }
  if (digit != 1 && exponent >= -1 && exponent <= 0)
  {
    return (exponent == 0 ? "" : "0.") + std::to_string(digit);
  }
  return digit == 1 ? decadeLabel(exponent) : std::to_string(digit) + "×" + decadeLabel(exponent);
}

/// One logarithmic axis that holds all values with some room about them, at least a decade.
struct Axis
{
  double first = 0; ///< logarithm at the low end
  double last = 1;
  double low; ///< pixel of the low end
  double high;

  Axis(const std::vector<double>& values, double lowPixel, double highPixel)
    : low(lowPixel)
    , high(highPixel)
  {
    if (!values.empty())
    {
      const auto ends = std::minmax_element(values.begin(), values.end());
      this->first = std::log10(*ends.first);
      this->last = std::log10(*ends.second);
      const double room =
        std::max({ 0.2, (1 - this->last + this->first) / 2, 0.12 * (this->last - this->first) });
      this->first -= room;
      this->last += room;
    }
  }
  double pixel(double value) const
  {
    return this->low +
      (std::log10(value) - this->first) / (this->last - this->first) * (this->high - this->low);
  }
  bool holds(double value) const
  {
    const double logarithm = std::log10(value);
    return logarithm >= this->first - 1e-9 && logarithm <= this->last + 1e-9;
  }
  /// Where there are few decades, 2 and 5 are named, too.
  bool isNamed(int digit) const
  {
    return digit == 1 || (this->last - this->first < 2.5 && (digit == 2 || digit == 5));
  }
};

/// The drawing under way: its axes, what is taken, and the picture.
class Artist
{
public:
  explicit Artist(const LogChart& chart)
    : C(chart)
    , Plot{ Page.left, Page.top, Page.right - (chart.curves.empty() ? 0 : NameColumn), Page.bottom }
    , X(this->values(&ChartPoint::x), this->Plot.left, this->Plot.right)
    , Y(this->values(&ChartPoint::y), this->Plot.bottom, this->Plot.top)
    , D(Width, Height)
  {
  }

  std::string draw()
  {
    this->frame();
    this->axis(this->X, true);
    this->axis(this->Y, false);
    if (this->C.linearGuide)
    {
      this->guide();
    }
    if (this->C.pareto)
    {
      this->front();
    }
    for (const ChartCurve& curve : this->C.curves)
    {
      this->curve(curve);
    }
    for (const ChartPoint& p : this->C.points)
    {
      this->disc(p);
    }
    if (this->C.curves.empty())
    {
      this->namesBeside();
    }
    else
    {
      this->namesInColumn();
    }
    return this->D.svg();
  }

private:
  std::vector<double> values(double ChartPoint::*member) const
  {
    std::vector<double> all;
    const auto add = [&](const std::vector<ChartPoint>& points)
    {
      for (const ChartPoint& p : points)
      {
        if (drawable(p))
        {
          all.push_back(p.*member);
        }
      }
    };
    add(this->C.points);
    for (const ChartCurve& curve : this->C.curves)
    {
      add(curve.points);
    }
    return all;
  }

  void frame()
  {
    TextStyle title{ 20, "#111111", Anchor::Start, true, false };
    this->D.text(this->Plot.left, 34, this->C.title, title);
    TextStyle subtitle{ 13, "#555555", Anchor::Start, false, false };
    this->D.text(this->Plot.left, 58, this->C.subtitle, subtitle);
    TextStyle label{ 15, "#222222", Anchor::Middle, false, false };
    this->D.text((this->Plot.left + this->Plot.right) / 2, Height - 22, this->C.xLabel, label);
    label.upward = true;
    this->D.text(26, (this->Plot.top + this->Plot.bottom) / 2, this->C.yLabel, label);
  }

  void axis(const Axis& axis, bool across)
  {
    const Unit unit = across ? this->C.xUnit : this->C.yUnit;
    for (int decade = static_cast<int>(std::floor(axis.first)); decade <= axis.last; ++decade)
    {
      for (int digit = 1; digit < 10; ++digit)
      {
        const double value = digit * std::pow(10, decade);
        if (axis.holds(value))
        {
          const std::string label = axis.isNamed(digit) ? tickLabel(digit, decade, unit) : "";
          this->tick(axis.pixel(value), across, label);
        }
      }
    }
    this->D.line(this->Plot.left, this->Plot.bottom, across ? this->Plot.right : this->Plot.left,
      across ? this->Plot.bottom : this->Plot.top, "#222222", 1.5);
  }

  void tick(double at, bool across, const std::string& label)
  {
    const TextStyle style{ 13, "#222222", across ? Anchor::Middle : Anchor::End, false, false };
    const double reach = label.empty() ? 4 : 7;
    if (across)
    {
      this->D.line(at, this->Plot.bottom, at, this->Plot.bottom + reach, "#888888", 1);
    }
    else
    {
      this->D.line(this->Plot.left - reach, at, this->Plot.left, at, "#888888", 1);
    }
    if (label.empty())
    {
      return;
    }
    if (across)
    {
      this->D.line(at, this->Plot.top, at, this->Plot.bottom, GridColor, 1);
      this->D.text(at, this->Plot.bottom + 24, label, style);
    }
    else
    {
      this->D.line(this->Plot.left, at, this->Plot.right, at, GridColor, 1);
      this->D.text(this->Plot.left - 12, at + 5, label, style);
    }
  }

  std::pair<double, double> place(const ChartPoint& p) const
  {
    return { this->X.pixel(p.x), this->Y.pixel(p.y) };
  }

  void disc(const ChartPoint& p)
  {
    if (!drawable(p))
    {
      return;
    }
    const auto at = this->place(p);
    if (!p.mark.empty())
    {
      this->D.disc(at.first, at.second, Disc + 4, MarkColor, false);
    }
    this->D.disc(at.first, at.second, Disc, p.ours ? OursColor : PeerColor, p.ours);
    const double r = Disc + (p.mark.empty() ? 2 : 6);
    this->Taken.push_back({ at.first - r, at.second - r, at.first + r, at.second + r });
    this->Waiting.push_back(p);
  }

  /// Names shall not cross this line.
  void keepOff(const std::vector<std::pair<double, double>>& path)
  {
    constexpr int Pieces = 64;
    for (std::size_t end = 1; end < path.size(); ++end)
    {
      const auto& from = path[end - 1];
      for (int n = 1; n < Pieces; ++n)
      {
        const double part = n / static_cast<double>(Pieces);
        const double x = from.first + part * (path[end].first - from.first);
        const double y = from.second + part * (path[end].second - from.second);
        this->Taken.push_back({ x - 3, y - 3, x + 3, y + 3 });
      }
    }
  }

  void curve(const ChartCurve& curve)
  {
    std::vector<std::pair<double, double>> path;
    std::vector<ChartPoint> points;
    std::copy_if(curve.points.begin(), curve.points.end(), std::back_inserter(points), drawable);
    for (const ChartPoint& p : points)
    {
      path.push_back(this->place(p));
    }
    this->keepOff(path);
    if (points.empty())
    {
      return;
    }
    this->D.polyline(path, points[0].ours ? OursColor : PeerColor, 2, "");
    for (std::size_t n = 0; n < points.size(); ++n)
    {
      this->disc(points[n]);
      if (n + 1 < points.size())
      {
        this->Waiting.pop_back(); // only the last is named
      }
    }
  }

  void front()
  {
    std::vector<ChartPoint> usable;
    std::copy_if(
      this->C.points.begin(), this->C.points.end(), std::back_inserter(usable), drawable);
    const std::vector<ChartPoint> best = paretoFront(usable);
    if (best.empty())
    {
      return;
    }
    // A stair: what is on its far side is beaten by a corner.
    std::vector<std::pair<double, double>> path{ { this->place(best[0]).first, this->Plot.top } };
    for (const ChartPoint& p : best)
    {
      const auto at = this->place(p);
      const double before = path.back().second;
      path.push_back({ at.first, before });
      path.push_back(at);
    }
    path.push_back({ this->Plot.right, path.back().second });
    this->keepOff(path);
    this->D.polyline(path, FrontColor, 2, "6 4");
    this->D.text(this->Plot.right - 4, this->Plot.top - 8,
      "- - -  best known: no method is both faster and more exact",
      { 12, FrontColor, Anchor::End, false, false });
  }

  void guide()
  {
    const auto curve = std::find_if(this->C.curves.begin(), this->C.curves.end(),
      [](const ChartCurve& c) { return !c.points.empty() && drawable(c.points[0]); });
    if (curve == this->C.curves.end())
    {
      return;
    }
    const ChartPoint& from = curve->points.front();
    const double end =
      std::min(std::pow(10, this->X.last), from.x * std::pow(10, this->Y.last) / from.y);
    const std::vector<std::pair<double, double>> path = { this->place(from),
      { this->X.pixel(end), this->Y.pixel(from.y * end / from.x) } };
    this->keepOff(path);
    this->D.polyline(path, FrontColor, 1.5, "3 4");
    this->D.text(this->Plot.right - 4, this->Plot.top - 8, "· · ·  in proportion",
      { 12, FrontColor, Anchor::End, false, false });
  }

  /// Where a name could stand: near before far, right before left before above and below.
  Box boxAt(const ChartPoint& p, double dx, double dy, double width, double height) const
  {
    const auto at = this->place(p);
    const double x = at.first + dx - (dx < 0 ? width : dx == 0 ? width / 2 : 0);
    const double y = at.second + dy - height / 2;
    return { x, y, x + width, y + height };
  }

  bool isFree(const Box& box) const
  {
    const Box page{ this->Plot.left + 2, this->Plot.top, Width - 6, this->Plot.bottom - 2 };
    return page.holds(box) &&
      std::none_of(this->Taken.begin(), this->Taken.end(),
        [&box](const Box& other) { return other.overlaps(box); });
  }

  Box freeBox(const ChartPoint& p, double width, double height) const
  {
    for (double far = 12; far < 320; far += 14)
    {
      const double up = height / 2 + far;
      for (const auto& d : { std::pair<double, double>{ 12, 0 }, { -12, 0 }, { 0, -up }, { 0, up },
             { far, -up / 2 }, { far, up / 2 }, { -far, -up / 2 }, { -far, up / 2 }, { far, -up },
             { far, up }, { -far, -up }, { -far, up }, { far, -2 * up }, { far, 2 * up },
             { -far, -2 * up }, { -far, 2 * up } })
      {
        const Box box = this->boxAt(p, d.first, d.second, width, height);
        if (this->isFree(box))
        {
          return box;
        }
      }
    }
    return this->boxAt(p, 12, 0, width, height);
  }

  void namesBeside()
  {
    for (const ChartPoint& p : this->Waiting)
    {
      const double width = 4 +
        std::max({ SvgDrawing::widthOf(p.name, NameSize, p.ours),
          SvgDrawing::widthOf(p.detail, DetailSize, false),
          SvgDrawing::widthOf(p.mark, DetailSize, true) });
      const double height = NameSize + 4 + (p.detail.empty() ? 0 : DetailSize + 4) +
        (p.mark.empty() ? 0 : DetailSize + 4);
      const Box box = this->freeBox(p, width, height);
      const auto at = this->place(p);
      this->leader(
        at, std::clamp(at.first, box.left, box.right), std::clamp(at.second, box.top, box.bottom));
      this->name(p, box.left + 2, box.top + NameSize);
      this->Taken.push_back(box);
    }
  }

  /// Right of the plot, each as near to its curve's end as the others let it.
  void namesInColumn()
  {
    constexpr double Gap = NameSize + DetailSize + 10;
    std::stable_sort(this->Waiting.begin(), this->Waiting.end(),
      [](const ChartPoint& a, const ChartPoint& b) { return a.y > b.y; });
    std::vector<double> heights;
    for (const ChartPoint& p : this->Waiting)
    {
      const double wanted = this->place(p).second;
      heights.push_back(heights.empty() ? wanted : std::max(wanted, heights.back() + Gap));
    }
    double lowest = this->Plot.bottom - Gap / 2;
    for (std::size_t n = heights.size(); n-- > 0; lowest -= Gap)
    {
      heights[n] = std::min(heights[n], lowest);
      lowest = heights[n];
    }
    for (std::size_t n = 0; n < heights.size(); ++n)
    {
      const ChartPoint& p = this->Waiting[n];
      this->leader(this->place(p), this->Plot.right + 14, heights[n]);
      this->name(p, this->Plot.right + 18, heights[n] + (p.detail.empty() ? 5 : -2));
    }
  }

  /// A thin line from a point to its name, unless that is beside it.
  void leader(const std::pair<double, double>& at, double x, double y)
  {
    const double apart = std::hypot(x - at.first, y - at.second);
    if (apart > 16)
    {
      const double part = (Disc + 1) / apart;
      this->D.line(
        at.first + part * (x - at.first), at.second + part * (y - at.second), x, y, "#aaaaaa", 1);
    }
  }

  void name(const ChartPoint& p, double x, double baseline)
  {
    const std::string color = p.ours ? OursColor : PeerColor;
    this->D.text(x, baseline, p.name, { NameSize, color, Anchor::Start, p.ours, false });
    if (!p.detail.empty())
    {
      this->D.text(
        x, baseline + DetailSize + 3, p.detail, { DetailSize, color, Anchor::Start, false, false });
    }
    if (!p.mark.empty())
    {
      const double below = DetailSize + 3;
      this->D.text(x, baseline + (p.detail.empty() ? below : 2 * below), p.mark,
        { DetailSize, MarkColor, Anchor::Start, true, false });
    }
  }

  const LogChart& C;
  Box Plot;
  Axis X;
  Axis Y;
  SvgDrawing D;
  std::vector<Box> Taken;
  std::vector<ChartPoint> Waiting;
};
}

std::vector<ChartPoint> paretoFront(const std::vector<ChartPoint>& points)
{
  std::vector<ChartPoint> front = points;
  front.erase(std::remove_if(front.begin(), front.end(),
                [&points](const ChartPoint& p)
                {
                  return std::any_of(points.begin(), points.end(),
                    [&p](const ChartPoint& q)
                    { return q.x <= p.x && q.y <= p.y && (q.x < p.x || q.y < p.y); });
                }),
    front.end());
  std::sort(
    front.begin(), front.end(), [](const ChartPoint& a, const ChartPoint& b) { return a.x < b.x; });
  return front;
}

std::string drawChart(const LogChart& chart)
{
  return Artist(chart).draw();
}
}
}
