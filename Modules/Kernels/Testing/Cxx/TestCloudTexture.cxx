// SPDX-License-Identifier: BSD-3-Clause
#include "CloudTexture.h"
#include "Sine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

using nephoscope::CloudTexture;
using nephoscope::CloudTextureParameters;

namespace
{
constexpr double Pi = 3.14159265358979323846;

/// The product of Gardner's equation 3 without k, term by term as printed.
double gardner(const CloudTextureParameters& p, double x, double y, double z)
{
  double frequency = 2 * Pi / p.wavelength;
  double amplitude = 1;
  double sumX = 0;
  double sumY = 0;
  for (int i = 0; i < p.octaves; ++i)
  {
    const double px = Pi / 2 * std::sin(0.5 * frequency * y) + Pi * std::sin(frequency * z / 2);
    const double py = Pi / 2 * std::sin(0.5 * frequency * x) + Pi * std::sin(frequency * z / 2);
    sumX += amplitude * std::sin(frequency * x + px) + p.offset;
    sumY += amplitude * std::sin(frequency * y + py) + p.offset;
    frequency *= 2;
    amplitude *= p.amplitudeRatio;
  }
  return sumX * sumY;
}

CloudTextureParameters published()
{
  CloudTextureParameters p;
  p.turned = false;
  return p;
}

/// Uniform in a cube of 40 wavelengths.
class Places
{
public:
  explicit Places(double wavelength)
    : Uniform(-20 * wavelength, 20 * wavelength)
  {
  }
  const double* next()
  {
    for (double& x : this->X)
    {
      x = this->Uniform(this->Random);
    }
    return this->X;
  }

private:
  std::mt19937 Random{ 11 };
  std::uniform_real_distribution<double> Uniform;
  double X[3];
};
}

TEST(Sine, AgreesWithTheLibraryWithinItsStatedError)
{
  std::mt19937 random(1);
  for (double range : { 1.0, 10.0, 1e3, 1e6, 1e9 })
  {
    std::uniform_real_distribution<double> uniform(-range, range);
    for (int n = 0; n < 20000; ++n)
    {
      const double x = uniform(random);
      EXPECT_NEAR(nephoscope::sine(x), std::sin(x), 1e-11 + std::abs(x) * 2.3e-16) << x;
    }
  }
}

TEST(CloudTexture, IsGardnersFormulaWhenNotTurned)
{
  const CloudTexture texture(published());
  Places places(texture.parameters().wavelength);
  double k = 0;
  for (int n = 0; n < 1000; ++n)
  {
    const double* x = places.next();
    const double expected = gardner(texture.parameters(), x[0], x[1], x[2]);
    k = n == 0 ? texture.value(x) / expected : k;
    EXPECT_NEAR(texture.value(x), k * expected, 1e-9);
  }
}

TEST(CloudTexture, ReachesOneAndNoMoreAsPublished)
{
  // An independent search: 300,000 random places, then uphill from the best by random steps.
  for (int octaves : { 1, 4, 7 })
  {
    CloudTextureParameters p = published();
    p.octaves = octaves;
    const CloudTexture texture(p);
    Places places(p.wavelength);
    std::vector<std::array<double, 4>> found;
    for (int n = 0; n < 300000; ++n)
    {
      const double* x = places.next();
      found.push_back({ texture.value(x), x[0], x[1], x[2] });
    }
    std::partial_sort(found.begin(), found.begin() + 20, found.end(), std::greater<>());
    std::mt19937 random(2);
    std::normal_distribution<double> normal;
    double maximum = 0;
    for (int start = 0; start < 20; ++start)
    {
      std::array<double, 4> best = found[start];
      for (int n = 0; n < 2000; ++n)
      {
        const double step = p.wavelength * std::pow(0.5, 4 + n / 100);
        double x[3];
        for (int c = 0; c < 3; ++c)
        {
          x[c] = best[c + 1] + step * normal(random);
        }
        if (texture.value(x) > best[0])
        {
          best = { texture.value(x), x[0], x[1], x[2] };
        }
      }
      maximum = std::max(maximum, best[0]);
    }
    EXPECT_NEAR(maximum, 1, 0.02) << octaves;
  }
}

TEST(CloudTexture, TurnedTermsKeepTheLeastUpperBound)
{
  // With one term the bound is reached; with two, whose phases are independent, it is approached.
  for (int octaves : { 1, 2, 7 })
  {
    CloudTextureParameters p;
    p.octaves = octaves;
    const CloudTexture texture(p);
    Places places(p.wavelength);
    double maximum = 0;
    for (int n = 0; n < 1000000; ++n)
    {
      maximum = std::max(maximum, texture.value(places.next()));
    }
    EXPECT_LE(maximum, 1);
    EXPECT_GT(maximum, octaves == 1 ? 0.9999 : octaves == 2 ? 0.98 : 0.7);
  }
}

TEST(CloudTexture, HasTheMeanOfItsConstantTerm)
{
  // The sums' sines average to zero and are nearly uncorrelated when turned: the mean is nearly k (n T0)^2.
  CloudTextureParameters p;
  const CloudTexture texture(p);
  Places places(p.wavelength * 100);
  double sum = 0;
  const int samples = 400000;
  for (int n = 0; n < samples; ++n)
  {
    sum += texture.value(places.next());
  }
  const double far[3] = { 1e300, 0, 0 };
  EXPECT_NEAR(sum / samples, texture.value(far), 0.003);
  EXPECT_GT(texture.value(far), 0.05);
}

TEST(CloudTexture, HasNoDirectionOfItsOwnWhenTurned)
{
  // Mean square differences over a tenth of a wavelength along 13 directions agree; as published they do not.
  CloudTextureParameters p;
  const CloudTexture turned(p);
  const CloudTexture plain(published());
  double extremes[2][2] = { { 1e9, 0 }, { 1e9, 0 } };
  for (int d = 1; d < 14; ++d)
  {
    const int digit[3] = { d % 3, d / 3 % 3, d / 9 };
    const double e[3] = { digit[0] - 1.0, digit[1] - 1.0, digit[2] - 1.0 };
    const double length = std::sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]);
    Places places(p.wavelength);
    double sums[2] = { 0, 0 };
    for (int n = 0; length > 0 && n < 40000; ++n)
    {
      const double* x = places.next();
      double y[3];
      for (int c = 0; c < 3; ++c)
      {
        y[c] = x[c] + 0.1 * p.wavelength * e[c] / length;
      }
      sums[0] += std::pow(turned.value(x) - turned.value(y), 2);
      sums[1] += std::pow(plain.value(x) - plain.value(y), 2);
    }
    for (int which = 0; length > 0 && which < 2; ++which)
    {
      extremes[which][0] = std::min(extremes[which][0], sums[which]);
      extremes[which][1] = std::max(extremes[which][1], sums[which]);
    }
  }
  const double turnedRatio = extremes[0][1] / extremes[0][0];
  EXPECT_LT(turnedRatio, 1.35);
  EXPECT_GT(extremes[1][1] / extremes[1][0], turnedRatio);
}

TEST(CloudTexture, FadesTermsAtTheSamplingLimit)
{
  CloudTextureParameters p;
  p.octaves = 3;
  const CloudTexture texture(p);
  const double x[3] = { 1.1e6, 2.3e5, -7e5 };
  const double finest = p.wavelength / 4;
  EXPECT_EQ(texture.value(x, finest / 8), texture.value(x));
  EXPECT_NE(texture.value(x, finest / 6), texture.value(x));
  // Gone at four footprints a wave: what is left is the series with one term less, scaled by the two series' k.
  CloudTextureParameters less = p;
  less.octaves = 2;
  less.offset = p.offset * 3 / 2;
  const double sums[2] = { 1 + std::sqrt(0.5) + 0.66, 1.5 + std::sqrt(0.5) + 0.66 };
  EXPECT_NEAR(texture.value(x, finest / 4),
    CloudTexture(less).value(x) * std::pow(sums[0] / sums[1], 2), 1e-9);
  const double far[3] = { std::nan(""), 0, 0 };
  EXPECT_NEAR(texture.value(x, p.wavelength), texture.value(far), 1e-15);
  // Continuous in the footprint.
  for (double f = finest / 10; f < p.wavelength; f *= 1.001)
  {
    EXPECT_NEAR(texture.value(x, f), texture.value(x, f * 1.001), 0.005);
  }
}

TEST(CloudTexture, OpacityIsEquations9And11)
{
  CloudTextureParameters p;
  p.threshold = 0.1;
  p.rimThreshold = 0.4;
  p.range = 0.2;
  const CloudTexture texture(p);
  Places places(p.wavelength);
  int clear = 0;
  int between = 0;
  for (int n = 0; n < 2000; ++n)
  {
    const double* x = places.next();
    const double t = texture.value(x);
    for (double g : { 1.0, 0.25, 0.0 })
    {
      const double expected = std::min(std::max((t - 0.1 - (0.4 - 0.1) * (1 - g)) / 0.2, 0.0), 1.0);
      EXPECT_NEAR(texture.opacity(x, 0, g), expected, 1e-12);
    }
    clear += texture.opacity(x) == 0;
    between += texture.opacity(x) > 0 && texture.opacity(x) < 1;
  }
  EXPECT_GT(clear, 200);
  EXPECT_GT(between, 200);
}

TEST(CloudTexture, ParametersOutOfRangeAreBroughtIn)
{
  CloudTextureParameters p;
  p.wavelength = std::nan("");
  p.octaves = 99;
  p.amplitudeRatio = -1;
  p.offset = -1;
  p.range = 0;
  const CloudTexture texture(p);
  EXPECT_EQ(texture.parameters().octaves, CloudTextureParameters::MaximumOctaves);
  EXPECT_EQ(texture.parameters().wavelength, CloudTextureParameters().wavelength);
  for (double x : { 0.0, -3e7, 1e20, std::nan(""), double(INFINITY) })
  {
    const double at[3] = { x, 1, x };
    EXPECT_TRUE(texture.opacity(at, 1e5) >= 0 && texture.opacity(at, 1e5) <= 1) << x;
  }
}

TEST(CloudTexture, SeedsGiveDifferentPatterns)
{
  CloudTextureParameters p;
  const CloudTexture one(p);
  p.seed = 2;
  const CloudTexture two(p);
  const double x[3] = { 1e6, 2e6, 3e6 };
  EXPECT_NE(one.value(x), two.value(x));
  EXPECT_EQ(one.value(x), CloudTexture().value(x));
}

TEST(CloudTexture, BlendAtItsEndsIsOneTexture)
{
  const CloudTexture texture;
  Places places(texture.parameters().wavelength);
  const double nowhere[3] = { std::nan(""), 0, 0 };
  for (int n = 0; n < 200; ++n)
  {
    const std::array<double, 3> first = { places.next()[0], places.next()[1], places.next()[2] };
    const double* const second = places.next();
    for (const double footprint : { 0.0, 3e4 })
    {
      EXPECT_EQ(texture.blended(first.data(), second, 1, footprint),
        texture.value(first.data(), footprint));
      EXPECT_EQ(
        texture.blended(first.data(), second, 0, footprint), texture.value(second, footprint));
      EXPECT_NEAR(texture.blended(first.data(), second, 0.3, footprint),
        texture.blended(second, first.data(), 0.7, footprint), 1e-14);
      EXPECT_EQ(texture.blended(first.data(), nowhere, 0.3, footprint),
        texture.value(first.data(), footprint));
    }
  }
}

TEST(CloudTexture, CrossFadeKeepsMeanOpacityAndContrast)
{
  // Of 100000 places, so that the mean opacity is known to about 0.3 %; the last is the most skewed: scattered puffs.
  for (const double offset : { 0.5, 0.22, 0.1 })
  {
    CloudTextureParameters p;
    p.offset = offset;
    const CloudTexture texture(p);
    std::vector<std::array<double, 6>> pairs(100000);
    Places places(p.wavelength);
    for (auto& pair : pairs)
    {
      std::copy_n(places.next(), 3, pair.begin());
      std::transform(pair.begin(), pair.begin() + 3, pair.begin() + 3,
        [&p](double x) { return x + 53 * p.wavelength; });
    }
    const auto measured = [&](double weight)
    {
      double sum = 0;
      double squares = 0;
      double opacity = 0;
      for (const auto& pair : pairs)
      {
        const double t = texture.blended(pair.data(), pair.data() + 3, weight);
        sum += t;
        squares += t * t;
        opacity += texture.opacityOf(t);
      }
      const auto n = static_cast<double>(pairs.size());
      return std::array<double, 2>{ opacity / n, std::sqrt(squares / n - sum * sum / n / n) };
    };
    const auto [opacity, contrast] = measured(1);
    for (const double weight : { 0.9, 0.75, 0.5, 0.25, 0.0 })
    {
      const auto now = measured(weight);
      EXPECT_NEAR(now[0], opacity, 0.02 * opacity) << offset << ' ' << weight;
      EXPECT_NEAR(now[1], contrast, 0.04 * contrast) << offset << ' ' << weight;
    }
  }
}
