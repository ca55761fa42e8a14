// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file HeightFieldSweep.h
 * @brief Samples of a height field along a slice, and where a fan of rays enters and leaves the cloud.
 *
 * Passes over the slice, block by block from the eye outwards:
 *  1. F and dF/dr at equally spaced samples (HeightFieldSamples.h), and from them the slopes under which the eye sees the cloud's
 *     top and bottom there;
 *  2. the rays, sorted by slope, that are inside at a sample are those between bottom and top: one range of indices. What leaves or
 *     joins the range between two samples is the rays that leave or enter the cloud there, so that the work is that of the samples
 *     plus that of the crossings (Max 1986 section 4 scans polygons for them);
 *  3. a ray that is inside at neither of two samples but meets the cloud plane in a cloud between them passes through that;
 *  4. a crossing is the root of HeightField::inside on the cubic through F and dF/dr of the two samples, whose error is that of
 *     Hermite interpolation, (2 pi / samplesPerWave)^4 / 384 of a wave's amplitude.
 */
#ifndef HeightFieldSweep_h
#define HeightFieldSweep_h

#include "HeightFieldRay.h"
#include "HeightFieldSamples.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace nephoscope
{
/// The slopes under which the eye sees the cloud's top, its bottom and the cloud plane at the samples of a block.
struct SampleBounds
{
  double top[SampleBlock::Steps + 1];
  double bottom[SampleBlock::Steps + 1];
  double plane[SampleBlock::Steps + 1];
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
  /// The rays inside the cloud at a sample, and how many are below the plane's slope there.
  struct Inside
  {
    std::uint32_t first;
    std::uint32_t last;
    std::uint32_t plane;
    bool holds(std::uint32_t ray) const { return ray >= this->first && ray < this->last; }
  };

  void scan(Listener& listener);
  void step(int j, const Inside& before, const Inside& after, Listener& listener);

  Inside insideAt(int j);
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
  HeightFieldSamples Samples;
  SampleBounds Bounds; ///< of the newest block
  std::vector<SampleBlock> Blocks;
  std::vector<SweepPlace> Entered; ///< of each ray; block -1 outside
  std::vector<char> Done;
  std::pair<std::uint32_t, std::uint32_t>
    Ahead; ///< rays outside this range have no cloud before them
  Inside Last{};
  bool IsLastKnown = false;
};
}
#endif
