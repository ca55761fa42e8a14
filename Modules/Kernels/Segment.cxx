// SPDX-License-Identifier: BSD-3-Clause
#include "Segment.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nephoscope
{
double transmittedMean(double x)
{
  return x > 1e-5 ? -std::expm1(-x) / x : 1 - x * (0.5 - x / 6);
}

double placeOf(double part, double skew)
{
  const double b = 1 - skew;
  const double root = b + std::sqrt(std::max(b * b + 4 * skew * part, 0.0)); // may be rounded below
  return root > 0 ? std::min(2 * part / root, 1.0) : 0;
}

namespace
{
bool usable(const Segment& s)
{
  // Written so that a NaN anywhere fails.
  return s.farEnd >= s.nearEnd && s.farEnd >= 0 && std::isfinite(s.nearEnd) &&
    s.opticalDepth[0] >= 0 && s.opticalDepth[1] >= 0 && s.opticalDepth[2] >= 0 &&
    std::isfinite(s.radiance[0] + s.radiance[1] + s.radiance[2]) && std::abs(s.skew) <= 1;
}

/// The light so far, in double so that many thin segments add up.
struct Accumulator
{
  double radiance[3] = { 0, 0, 0 };
  double transmittance[3] = { 1, 1, 1 };
  double depth = std::numeric_limits<double>::infinity();

  double mean() const { return (transmittance[0] + transmittance[1] + transmittance[2]) / 3; }
  bool done() const { return transmittance[0] + transmittance[1] + transmittance[2] == 0; }

  void add(double near, double far, double skew, const double (&tau)[3], const double (&light)[3])
  {
    const double before = this->mean();
    const double red = std::exp(-tau[0]);
    for (int c = 0; c < 3; ++c)
    {
      this->radiance[c] += this->transmittance[c] * light[c];
      this->transmittance[c] *= tau[c] == tau[0] ? red : std::exp(-tau[c]); // mostly grey
    }
    if (before > 0.5 && this->mean() <= 0.5)
    {
      // exp(-part tau_mean) = 1 / (2 before); at once where it is opaque.
      const double needed = std::log(2 * before);
      const double have = this->mean() > 0 ? std::log(before) - std::log(this->mean())
                                           : std::min({ tau[0], tau[1], tau[2] });
      const double part = std::isfinite(have) && have > 0 ? needed / have : 0;
      this->depth = near + placeOf(part, skew) * (far - near);
    }
  }
};

void addWhole(Accumulator& light, const Segment& s)
{
  light.add(s.nearEnd, s.farEnd, s.skew,
    { s.opticalDepth[0], s.opticalDepth[1], s.opticalDepth[2] },
    { s.radiance[0], s.radiance[1], s.radiance[2] });
}

/// Infinite optical depth over a length is no medium that could be mixed; this much hides everything just as well.
constexpr double Densest = 1e30;

/// The part of a segment's optical depth that lies between two distances.
double share(const Segment& s, double near, double far)
{
  const double length = s.farEnd - s.nearEnd;
  const double a = (near - s.nearEnd) / length;
  const double b = (far - s.nearEnd) / length;
  return (b - a) * (1 + s.skew * (a + b - 1));
}

/// The stretch [near, far] that all active segments share, as one medium.
template <class Iterator>
void addMixture(Accumulator& light, Iterator begin, Iterator end, double near, double far)
{
  double tau[3] = { 0, 0, 0 };
  double emitted[3] = { 0, 0, 0 };
  double rise = 0; // of the extinction along the stretch, as skew is, times the optical depth
  for (Iterator s = begin; s != end; ++s)
  {
    const double part = share(**s, near, far);
    const double piece = (far - near) / ((*s)->farEnd - (*s)->nearEnd);
    for (int c = 0; c < 3; ++c)
    {
      const double whole = std::min<double>((*s)->opticalDepth[c], Densest);
      tau[c] += whole * part;
      rise += whole * piece * piece * (*s)->skew;
      emitted[c] += (*s)->radiance[c] * part / transmittedMean(whole);
    }
  }
  for (int c = 0; c < 3; ++c)
  {
    emitted[c] *= transmittedMean(tau[c]);
  }
  const double depth = tau[0] + tau[1] + tau[2];
  light.add(near, far, depth > 0 ? rise / depth : 0, tau, emitted);
}

/// The segments that cover the present stretch; on the stack up to 64.
class ActiveSegments
{
public:
  void push(const Segment* s)
  {
    if (this->Count < this->Few.size())
    {
      this->Few[this->Count++] = s;
      return;
    }
    if (this->Many.empty())
    {
      this->Many.assign(this->Few.begin(), this->Few.end());
    }
    this->Many.push_back(s);
    ++this->Count;
  }
  void removeEndedBy(double distance)
  {
    const Segment** last = std::remove_if(
      this->begin(), this->end(), [distance](const Segment* s) { return s->farEnd <= distance; });
    this->Count = static_cast<std::size_t>(last - this->begin());
    if (!this->Many.empty())
    {
      this->Many.resize(this->Count);
      if (this->Count <= this->Few.size())
      {
        std::copy(this->Many.begin(), this->Many.end(), this->Few.begin());
        this->Many.clear();
      }
    }
  }
  double nextEnd() const
  {
    double end = std::numeric_limits<double>::infinity();
    const Segment* const* const first = this->Many.empty() ? this->Few.data() : this->Many.data();
    for (std::size_t i = 0; i < this->Count; ++i)
    {
      end = std::min(end, first[i]->farEnd);
    }
    return end;
  }
  std::size_t size() const { return this->Count; }
  const Segment** begin() { return this->Many.empty() ? this->Few.data() : this->Many.data(); }
  const Segment** end() { return this->begin() + this->Count; }

private:
  std::array<const Segment*, 64> Few;
  std::vector<const Segment*> Many;
  std::size_t Count = 0;
};
}

PixelLight composite(Segment* begin, Segment* end)
{
  end = std::remove_if(begin, end, [](const Segment& s) { return !usable(s); });
  std::stable_sort(
    begin, end, [](const Segment& a, const Segment& b) { return a.nearEnd < b.nearEnd; });

  Accumulator light;
  ActiveSegments active;
  double position = 0;
  const Segment* next = begin;
  while ((next != end || active.size() > 0) && !light.done())
  {
    const double start = next != end ? std::max(next->nearEnd, 0.0) : active.nextEnd();
    // Up to where the next one starts, the active ones go on; each end on the way is a border.
    while (active.size() > 0 && position < start)
    {
      const double border = std::min(start, active.nextEnd());
      addMixture(light, active.begin(), active.end(), position, border);
      position = border;
      active.removeEndedBy(border);
    }
    if (next == end)
    {
      continue;
    }
    position = start;
    const bool alone = active.size() == 0 && next->nearEnd >= 0 &&
      (next + 1 == end || next[1].nearEnd >= next->farEnd);
    if (alone || next->nearEnd == next->farEnd)
    {
      addWhole(light, *next); // exact, whatever the law inside the segment
    }
    else if (next->farEnd > start)
    {
      active.push(next);
    }
    ++next;
  }

  PixelLight result;
  for (int c = 0; c < 3; ++c)
  {
    result.radiance[c] = static_cast<float>(light.radiance[c]);
    result.transmittance[c] = static_cast<float>(light.transmittance[c]);
  }
  result.depth = light.depth;
  return result;
}

PixelLight composite(std::vector<Segment>& segments)
{
  return composite(segments.data(), segments.data() + segments.size());
}
}
