// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file HeightFieldSamples.h
 * @brief F and dF/dr of a height field at equally spaced places along a slice, block by block from the eye outwards.
 *
 * Waves are sampled by turning their phases, cos(a + b) and sin(a + b): no sine is called but at the start and where the spacing
 * changes other than twofold. A wave that pixels cannot show (CloudSlice::growth) costs nothing; what is left of a fading one is
 * linear within a block, which is off by less than 1 % of its amplitude.
 * @sa HeightFieldSweep.h
 */
#ifndef HeightFieldSamples_h
#define HeightFieldSamples_h

#include "HeightFieldScattering.h"

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
  double slope(double x) const { return this->b + x * (2 * this->c + x * 3 * this->d); }
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

/// A wave along the slice, amplitude w(angle + speed r).
struct SampledWave
{
  double amplitude;
  double speed;
  WaveShape shape;
  double waveNumber;  ///< waveLeft()'s argument is this times r
  double startCosine; ///< of the next block's first argument
  double startSine;
  double turned;                         ///< the spacing of the turns below; 0 for none
  double cosine[SampleBlock::Steps + 1]; ///< of j speed spacing
  double sine[SampleBlock::Steps + 1];
};

class HeightFieldSamples
{
public:
  /// Begin a slice; the first block is to start at `first`, each next one where the last ends.
  void begin(const HeightField& field, const CloudSlice& slice, double first);
  /// The next block.
  void sample(double start, double spacing, SampleBlock& block);

private:
  double Polynomial[3] = {}; ///< with the waves' means
  double TwoC = 0;
  std::vector<SampledWave> Waves;
};
}
#endif
