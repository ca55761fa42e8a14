// SPDX-License-Identifier: BSD-3-Clause
#include "HeightFieldShadow.h"

#include "Exponential.h"
#include "HeightFieldSamples.h"
#include "WideLoops.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace
{
constexpr std::size_t Steps = SampleBlock::Steps;

/// The shares of a block's samples but the last, which is the next one's first.
NEPHOSCOPE_WIDE void let(
  const SampleBlock& block, const HeightFieldShape& shape, double extinction, float* shares)
{
  const double c2 = shape.c * shape.c;
  for (std::size_t j = 0; j < Steps; ++j)
  {
    const double u = std::abs(block.f[j]) + shape.c;
    // g - h = g (1 + D / sqrt(u^2 + c^2))
    const double root = std::sqrt(u * u + c2);
    const double thickness = block.top[j] * (1 + shape.depth / (root > 1e-300 ? root : 1e-300));
    const double share = exponential(-extinction * (thickness > 0 ? thickness : 0.0));
    shares[j] = static_cast<float>(share);
  }
}
}

struct HeightFieldShadow::Scratch
{
  HeightFieldSamples samples;
  SampleBlock block;
  float shares[Steps];
};

HeightFieldShadow::HeightFieldShadow(const HeightField& field, double extinction)
  : Field(field)
  , Extinction(extinction)
  , Work(std::make_unique<Scratch>())
{
}

HeightFieldShadow::~HeightFieldShadow() = default;

void HeightFieldShadow::row(double x, double y, double spacing, std::size_t count, float* shares)
{
  CloudSlice line;
  line.x = x;
  line.y = y;
  line.ux = 1;
  line.uy = 0;
  this->Work->samples.begin(this->Field, line, 0);
  for (std::size_t first = 0; first < count; first += Steps)
  {
    this->Work->samples.sample(static_cast<double>(first) * spacing, spacing, this->Work->block);
    let(this->Work->block, this->Field.shape(), this->Extinction, this->Work->shares);
    std::copy_n(this->Work->shares, std::min(Steps, count - first), shares + first);
  }
}
}
