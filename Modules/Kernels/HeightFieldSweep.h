// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file HeightFieldSweep.h
 * @brief Samples of a height field along a slice, and where a fan of rays enters and leaves the cloud.
 *
 * Passes over the slice, block by block from the eye outwards:
 *  1. F and dF/dr at equally spaced samples, the waves by turning their phases (cos(a + b) and sin(a + b)), and from them the slopes
 *     under which the eye sees the cloud's top and bottom there;
 *  2. the rays, sorted by slope, that are inside at a sample are those between bottom and top: one range of indices. What leaves or
 *     joins the range between two samples is the rays that leave or enter the cloud there, so that the work is that of the samples
 *     plus that of the crossings (Max 1986 section 4 scans polygons for them). Rays inside at neither of the samples which meet
 *     the cloud plane between them are looked at too;
 *  3. a crossing is the root of HeightField::inside on the cubic through F and dF/dr of the two samples, whose error is that of
 *     Hermite interpolation, (2 pi / samplesPerWave)^4 / 384 of a wave's amplitude.
 */
#ifndef HeightFieldSweep_h
#define HeightFieldSweep_h

#include "HeightFieldRay.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace nephoscope
{
/// A cubic of x from 0 to 1 between two samples.
struct SampleCubic
{
  double a, b, c, d;
  double operator()(double x) const
  {
    return this->a + x * (this->b + x * (this->c + x * this->d));
  }
};

/// Samples start + j spacing, j = 0 to Steps; the last is the next block's first.
struct SampleBlock
{
  static constexpr int Steps = 64;
  double start;
  double spacing;
  double f[Steps + 1];     ///< F, m
  double slope[Steps + 1]; ///< dF/dr
  double top[Steps + 1];   ///< g, m

  double at(int j) const { return this->start + this->spacing * j; }

  /// F between samples j and j + 1.
  SampleCubic cubic(int j) const
  {
    const double d0 = this->slope[j] * this->spacing;
    const double d1 = this->slope[j + 1] * this->spacing;
    const double rise = this->f[j + 1] - this->f[j];
    return { this->f[j], d0, 3 * rise - 2 * d0 - d1, d0 + d1 - 2 * rise };
  }
  double between(int j, double x) const { return this->cubic(j)(x); }
};

/// A place on a slice: between samples `step` and step + 1 of a block.
struct SweepPlace
{
  double r;
  int block;
  int step;
};

class HeightFieldSweep
{
public:
  /// What the sweep tells of.
  class Listener
  {
  public:
    virtual ~Listener() = default;
    /// The newest block is complete.
    virtual void sampled(const SampleBlock& block) = 0;
    /// A ray was in the cloud between two places; false if nothing behind can be seen.
    virtual bool chord(std::uint32_t ray, const SweepPlace& in, const SweepPlace& out) = 0;
  };

  /// Sweep a slice with ascending slopes; resolution is how far off ends may be, m.
  void run(const HeightField& field, double planeHeight, const CloudSlice& slice,
    const std::vector<double>& slopes, double samplesPerWave, double resolution,
    Listener& listener);

  double eye() const { return this->Eye; } ///< over the cloud plane, m
  const SampleBlock& block(int b) const { return this->Blocks[static_cast<std::size_t>(b)]; }

private:
  /// A wave along the slice: amplitude w(angle + speed r), and the turns by speed times spacing.
  struct Phase
  {
    double amplitude;
    double speed;
    double angle;
    WaveShape shape;
    double cosine[SampleBlock::Steps + 1];
    double sine[SampleBlock::Steps + 1];
  };
  /// The rays inside the cloud at a sample, and how many are below the plane's slope there.
  struct Inside
  {
    std::uint32_t first;
    std::uint32_t last;
    std::uint32_t plane;
    bool holds(std::uint32_t ray) const { return ray >= this->first && ray < this->last; }
  };

  void prepare(const CloudSlice& slice);
  void turn(double spacing);
  void sample(double start, double spacing);
  void scan(Listener& listener);
  void step(int j, const Inside& before, const Inside& after, Listener& listener);
  Inside insideAt(double r, double top, double bottom);
  void enter(std::uint32_t ray, int j);
  void leave(std::uint32_t ray, int j, Listener& listener);
  void pierce(std::uint32_t ray, int j, Listener& listener);
  void closeAll(Listener& listener);
  bool isAhead(double r, double far);
  double crossing(std::uint32_t ray, int j, double from, double to) const;
  void end(std::uint32_t ray, const SweepPlace& out, Listener& listener);

  const HeightField* Field = nullptr;
  const std::vector<double>* Slopes = nullptr;
  double Eye = 0; ///< over the plane, as Low and High, between which clouds are
  double Low = 0;
  double High = 0;
  double Resolution = 0;
  double Polynomial[3] = {};
  std::vector<Phase> Phases;
  double Turned = 0; ///< the spacing of the turns
  std::vector<SampleBlock> Blocks;
  std::vector<SweepPlace> Entered; ///< of each ray; block -1 outside
  std::vector<char> Done;
  std::pair<std::uint32_t, std::uint32_t>
    Ahead; ///< rays outside this range have no cloud before them
  Inside Last{};
};
}
#endif
