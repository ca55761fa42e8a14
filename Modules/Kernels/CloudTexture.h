// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file CloudTexture.h
 * @brief Gardner's transparency texture in three dimensions: opacity from a position.
 *
 * A "poor man's Fourier series", the product of two short sums of sines that shift each other's phases:
 *
 *     T  = k (sum_i C_i sin(F_i x + PX_i) + n T0) (sum_i C_i sin(F_i y + PY_i) + n T0)        Gardner 1985 eq. 3
 *     F_{i+1} = 2 F_i,  C_{i+1} = 0.707 C_i,  C_1 = 1                                              eq. 4 and 5
 *     PX_i = pi/2 sin(F_i y / 2) + pi sin(F_i z / 2)                                               eq. 6 and 7
 *     PY_i = pi/2 sin(F_i x / 2) + pi sin(F_i z / 2)                                               eq. 6 and 7
 *     opacity = 1 - TR = clamp((T - T1) / D, 0, 1)                                                 eq. 9
 *
 * x, y, z in metres, F_1 = 2 pi / wavelength in rad/m. Max 1994 eq. 3 is the same with z = 0, F_1 = 2 and d = n T0.
 *
 * Deviation, on by default (`turned`): each term has its own frame, x_i = R_i x + s_i with a rotation R_i and a shift
 * drawn from `seed`. As printed, all terms share the axes and the frequencies are commensurable, so that the pattern
 * repeats after two wavelengths and shows rows along the axes; on a globe these are plain to see. With turned terms it
 * never repeats and has no direction of its own. `turned = false` is the published formula.
 *
 * k makes the largest value 1. With turned terms the phases of the terms are independent, each term of both sums can
 * reach 1 at once (eq. 6 and 7 at z = 0 have such a point), and the least upper bound is (sum C_i + n T0)^2 exactly.
 * Unturned, the maximum over the period is searched for (131072 points of a lattice, the best 1024 refined),
 * to 2 %.
 *
 * Sampling limit: the gradient of a term's argument is at most F_i sqrt(1 + pi^2/16 + pi^2/4) = 2.02 F_i. A term is
 * whole where its wavelength is at least 8 footprints, gone at 4 (its shortest wave then spans two samples), smooth
 * between. Without its terms T is k (n T0)^2, which is
 * within 0.003 of its mean.
 *
 * Cross-fade of two textures (`blended`): each of the two sums of eq. 3 is blended, not their product,
 *
 *     S = n T0 + (w (S_1 - n T0) + (1 - w) (S_2 - n T0)) / sqrt(w^2 + (1 - w)^2)              w = 0 .. 1
 *
 * The weights sum to one, the root of the sum of their squares restores the variance. A blended sum of sines is distributed
 * like one of them, so T is like either texture half-way too; blending T itself would change its skewness, and with it the
 * mean opacity by 5 %, in scattered puffs by 14 %.
 *
 * What the parameters look like: `octaves` adds finer wisps (4 soft, 7 crisp); `offset` fills: 0.1 gives scattered
 * puffs, 0.5 a nearly closed sheet; `threshold` clears what lies below it; `range` is the softness of the edges, small
 * for cumulus, large for cirrus; `rimThreshold` above `threshold` frays the outline.
 *
 * @sa vtkCloudTexture, TestCloudTexture.cxx
 */
#ifndef CloudTexture_h
#define CloudTexture_h

#include <array>
#include <cstdint>

namespace nephoscope
{
struct CloudTextureParameters
{
  static constexpr int MaximumOctaves = 8;

  double wavelength = 1.5e6;              ///< of the first term, m, > 0
  int octaves = 7;                        ///< n, 1 to MaximumOctaves
  double amplitudeRatio = 0.707106781187; ///< C_{i+1} / C_i, 0 to 1
  double offset = 0.22;                   ///< T0, >= 0; raises the mean, lowers the contrast
  double threshold = 0.03;                ///< T1, all below is clear
  double rimThreshold = 0.03;             ///< T2, takes T1's place towards the rim (eq. 11)
  double range = 0.25;                    ///< D, > 0, from clear to opaque
  bool turned = true;                     ///< each term in its own frame
  std::uint32_t seed = 1;                 ///< of the frames
};

class CloudTexture
{
public:
  /// Parameters out of range are brought to the nearest that is in range; NaN gives the default.
  explicit CloudTexture(const CloudTextureParameters& parameters = {});

  /**
   * @brief T at a position; at most 1.
   * @param x position, m; where it is not finite or beyond 1e9 wavelengths of the finest term, the mean of T
   * @param footprint distance between samples, m, <= 0 for none: all terms
   * Cost: about 0.1 us; thread-safe.
   */
  double value(const double x[3], double footprint = 0) const;

  /**
   * @brief T where the texture at one position is cross-faded with that at another, far away in texture space.
   * @param weight of the first, 0 to 1; at 1 and 0 the result is value() of the first and of the second, to the bit
   */
  double blended(
    const double first[3], const double second[3], double weight, double footprint = 0) const;

  /**
   * @brief Opacity at a position, 0 to 1 (eq. 9 and 11).
   * @param rim 1 in the middle of a body, 0 at its rim: the g of eq. 11, which moves the threshold from T1 to T2
   */
  double opacity(const double x[3], double footprint = 0, double rim = 1) const;

  /// How many terms are not gone where a sample is this wide, which is how many value() may have to work out.
  int termsAt(double footprint) const;

  /// Opacity where T is known.
  double opacityOf(double value, double rim = 1) const;

  const CloudTextureParameters& parameters() const { return this->Parameters; }

private:
  static constexpr int N = CloudTextureParameters::MaximumOctaves;
  using Terms = std::array<double, N>;

  /// The two sums of eq. 3.
  struct Sums
  {
    double x;
    double y;
  };

  void setFrames();
  bool isNear(const double x[3]) const;
  Terms weightsFor(double footprint) const;
  Sums sums(const double x[3], const Terms& weights) const;
  template <int Count>
  Sums sumsOf(const double x[3], const Terms& weights) const;
  double unscaled(const double x[3], const Terms& weights) const;
  double searchMaximum() const;

  CloudTextureParameters Parameters;
  // Per term: the frame, scaled by F_i, and its shift; F_i; C_i. Unused terms are zero.
  std::array<std::array<Terms, 3>, 3> Axes{};
  std::array<Terms, 3> Shifts{};
  Terms Frequencies{};
  Terms Amplitudes{};
  double Constant = 0; // n T0
  double K = 1;
  double Reach = 0; // largest |x| that is evaluated, m
};
}
#endif
