// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file HeightField.h
 * @brief Clouds between two height functions over a cloud plane (Max 1986 section 2).
 *
 *     F(x, y) = a + b x + c y + d x^2 + e x y + f y^2 + sum_i A_i w_i(p_i x + q_i y + r_i)
 *     t = (|F| + c)^2
 *     g = sign(F) sqrt(t - c^2)            height of the top above the cloud plane, m
 *     h = -D g / sqrt(t + c^2)             height of the bottom, m, > -D
 *
 * with w_i the sine, its absolute value (rounded billows with creases) or the square root of that (fuller ones). There is cloud
 * where F > 0, where h < g; both meet the plane with vertical tangents if c > 0. Below F = 0 both change sign, so that g < h, and
 * g, h and F are continuous there. Max 1986 prints h without D, which is right for D = 1 m only. The sum of sines with amplitudes
 * is Max 1994 eq. 2, which is printed without them.
 *
 * Kinks: g and h at F = 0, where their gradients are infinite; F of an absolute value or a root where its argument is a multiple
 * of pi. At a kink the gradient is given as 0.
 *
 * All lengths in metres. Finite parameters give finite values and gradients.
 * @sa HeightFieldScattering.h, TestHeightField.cxx
 */
#ifndef HeightField_h
#define HeightField_h

#include <array>
#include <cmath>
#include <vector>

namespace nephoscope
{
enum class WaveShape
{
  Sine,     ///< sin
  Absolute, ///< |sin|
  Root      ///< sqrt |sin|
};

/// A long-crested wave A w(p x + q y + r).
struct HeightWave
{
  double amplitude = 0; ///< m
  double p = 0;         ///< along x, rad/m
  double q = 0;         ///< along y, rad/m
  double r = 0;         ///< phase, rad
  WaveShape shape = WaveShape::Sine;
};

/// Means of |sin| and sqrt |sin|: 2 / pi and Gamma(3/4)^2 (2 / pi)^1.5.
inline constexpr double MeanAbsolute = 0.6366197723675814;
inline constexpr double MeanRoot = 0.7627597635018132;
inline constexpr double meanOf(WaveShape shape)
{
  return shape == WaveShape::Sine ? 0 : shape == WaveShape::Absolute ? MeanAbsolute : MeanRoot;
}

/// Of a wave's longest period, rad/m: an absolute value has two in one of its sine.
inline double waveNumber(const HeightWave& wave)
{
  return (wave.shape == WaveShape::Sine ? 1 : 2) * std::hypot(wave.p, wave.q);
}

/**
 * What is left of a wave about its mean where it is seen in pixels.
 *
 * All of it if it is 4 pixels long, nothing below 1.2 pixels, a smooth step in the wave number between: about half of what pixels can just not show
 * (2 pixels). Fading sooner would cost more than it saves, for clouds' edges are where F crosses 0, which a smoother F moves.
 * @param x wave number times a pixel's width
 */
inline double waveLeft(double x)
{
  constexpr double All = 1.5707963267948966; // 2 pi / 4
  constexpr double None = 5.235987755982989; // 2 pi / 1.2
  const double t = (x - All) / (None - All);
  const double u = t > 0 ? (t < 1 ? t : 1.0) : 0.0;
  return 1 - u * u * (3 - 2 * u);
}

/// What a HeightField is made of.
struct HeightFieldShape
{
  std::array<double, 6> polynomial{}; ///< of 1, x, y, x^2, x y, y^2; m, 1, 1, 1/m, 1/m, 1/m
  std::vector<HeightWave> waves;
  double c = 20; ///< roundness of the clouds' edges, m, >= 0; 0 is a sharp edge over a flat bottom
  double depth = 60; ///< D, how far the bottoms reach below the plane, m, > 0
};

/// A value and its gradient.
struct HeightGradient
{
  double value; ///< m
  double x;     ///< d/dx, 1
  double y;     ///< d/dy, 1
};

class HeightField
{
public:
  /// A shape that is out of range or not finite is brought to range: c below 0 becomes 0, D below 1 um becomes 1 um.
  explicit HeightField(HeightFieldShape shape);

  const HeightFieldShape& shape() const { return this->Shape; }

  double value(double x, double y) const; ///< F, m
  /// F as it is seen in pixels of this width, m: waveLeft() of every wave.
  double value(double x, double y, double pixel) const;
  HeightGradient gradient(double x, double y) const; ///< of F

  /// g of a value of F, m
  double top(double f) const
  {
    // t - c^2 without its cancellation.
    return std::copysign(std::sqrt(std::abs(f) * (std::abs(f) + 2 * this->Shape.c)), f);
  }
  /// h of a value of F, m
  double bottom(double f) const
  {
    const double u = std::abs(f) + this->Shape.c;
    const double root = std::sqrt(u * u + this->Shape.c * this->Shape.c);
    return root > 0 ? -this->Shape.depth * this->top(f) / root : 0;
  }
  HeightGradient top(const HeightGradient& f) const;    ///< g and its gradient
  HeightGradient bottom(const HeightGradient& f) const; ///< h and its gradient

  /// Above 0 inside the cloud, at and below 0 outside: without root or division, smooth but at zeta = 0.
  /// @param f F of the place, @param zeta its height over the cloud plane, m
  double inside(double f, double zeta) const
  {
    const double u = f + this->Shape.c;
    const double c2 = this->Shape.c * this->Shape.c;
    return (u < 0 ? -u : u) * u - c2 -
      zeta * zeta * (zeta < 0 ? (u * u + c2) * this->InverseDepthSquared : 1.0);
  }

  /// inside() and its derivative along a line, from those of F and zeta.
  double insideSlope(double f, double fSlope, double zeta, double zetaSlope, double& value) const
  {
    const double u = f + this->Shape.c;
    const double size = u < 0 ? -u : u;
    const double c2 = this->Shape.c * this->Shape.c;
    const double below = zeta < 0 ? this->InverseDepthSquared : 0.0;
    const double factor = zeta < 0 ? (u * u + c2) * below : 1.0;
    value = size * u - c2 - zeta * zeta * factor;
    return 2 * (size * fSlope - zeta * zetaSlope * factor - zeta * zeta * u * fSlope * below);
  }

  /// No F is larger; infinite if the polynomial has no maximum.
  double upperBound() const;
  /// Length of the shortest wave, m; infinite if there are none.
  double shortestWave() const;
  /// Distances t where (x, y) + t (ux, uy) crosses a kink of F, ascending, in (t0, t1). At most `most` of a wave.
  std::vector<double> kinks(
    double x, double y, double ux, double uy, double t0, double t1, int most = 100000) const;

private:
  HeightFieldShape Shape;
  double InverseDepthSquared;
};

/**
 * The waves made to repeat along (vx, vy): each wave vector gets the nearest component along it for which the wave has a whole
 * number of periods in it, so that the waves of HeightFieldShape are the same at (x, y) and (x + vx, y + vy).
 * Shapes of absolute value have a period of half a wave. (0, 0) changes nothing.
 */
HeightFieldShape repeating(HeightFieldShape shape, double vx, double vy);

/**
 * A moment of a closed cycle in which every rank of clouds moves to where the next one was.
 *
 * The waves travel by (vx, vy) frame / frames; the polynomial, which says where clouds are, stays. The phases of frame `frames`
 * have the bits of frame 0, whatever the vector, since the number of periods in it is rounded.
 * @param shape as made by repeating(shape, vx, vy); else ranks change form on the way
 * @param frame any integer, @param frames of the cycle, >= 1
 */
HeightFieldShape cycleFrame(
  HeightFieldShape shape, double vx, double vy, long long frame, long long frames);
}
#endif
