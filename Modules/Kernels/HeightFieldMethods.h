// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file HeightFieldMethods.h
 * @brief The four methods of HeightFieldScattering.h, for its make() alone.
 */
#ifndef HeightFieldMethods_h
#define HeightFieldMethods_h

#include "HeightFieldScattering.h"
#include "HeightFieldSweep.h"

namespace nephoscope
{
/**
 * Every part of a ray by quadrature.
 *
 * Segments are found by looking at 64 places per shortest wave, and at the height of every peak of HeightField::inside between
 * them; ends are to 1e-12 of r. Each segment is cut at the kinks of F, at distances that grow fourfold from its near end (light
 * fades from there) and, as finely, towards both ends, where g can have a vertical tangent.
 */
class HeightFieldExact : public HeightFieldScattering
{
public:
  using HeightFieldScattering::HeightFieldScattering;

protected:
  void run(const CloudSlice& slice) override;

private:
  void shineRay(const CloudSlice& slice, std::uint32_t ray);
  void segment(
    const CloudSlice& slice, const HeightFieldRay& at, std::uint32_t ray, double in, double out);
};

/// Midpoints of equal steps along each ray.
class HeightFieldMarch : public HeightFieldScattering
{
public:
  using HeightFieldScattering::HeightFieldScattering;

protected:
  void run(const CloudSlice& slice) override;

private:
  void shineRay(const CloudSlice& slice, std::uint32_t ray);
};

/**
 * Max 1986 section 4 on the samples of a HeightFieldSweep.
 *
 *     I = K int sexp(-delta (y - y1)) sexp(-rhoA g) dy,   sexp(x) = (1 + x / 2)^2
 *     K = rhoB gamma exp(-rhoA (H - beta y1)),   M_ij = sum y^i min(max(g, 0), 2 / rhoA)^j (y_l - y_(l-1))
 *
 * with y = r. rR is limited to rL + 2 / delta where delta > 0, in I alone. Ends take the nearest sample's value.
 */
class HeightFieldSexp
  : public HeightFieldScattering
  , private HeightFieldSweep::Listener
{
public:
  using HeightFieldScattering::HeightFieldScattering;

protected:
  void run(const CloudSlice& slice) override;

private:
  void sampled(const SampleBlock& block) override;
  bool chord(std::uint32_t ray, const SweepPlace& in, const SweepPlace& out) override;
  std::size_t nearest(double r, const SweepPlace& place) const;

  HeightFieldSweep Sweep;
  std::vector<double> Places;
  std::vector<double> Tops;                ///< clamped
  std::vector<std::array<double, 6>> Sums; ///< M01, M11, M21, M02, M12, M22
};

/**
 * Moments of G = exp(-rhoA g), tabled once a slice.
 *
 * On a piece [p, q] of a segment with middle m and half width w, t = (r - m) / w,
 *
 *     I = rhoB gamma exp(rhoA zeta(m) - rhoB gamma (m - rL)) int G exp(-x t) dr,   x = delta w
 *
 * and exp(-x t) is the cubic in t that is closest to it in the mean square (Legendre), so that only int G r^i dr, i = 0 to 3, are
 * needed: differences of running sums. Unlike Max's, g is not expanded, so that nothing limits it. The first piece has x = pieceDepth / 2; the
 * next ones grow as the light fades, exp(depth / 4). The running sums are about each block's own origin, in its length, which keeps
 * 2e-7 in float where sums about the eye lose all digits at 20 km; whole blocks have running sums of their own, so that a
 * long piece costs no more. What lies between a segment's ends and the next samples is integrated directly (LinearSteps), as
 * are segments in cloud so dense that a sample's spacing is a large optical depth.
 *
 * Cost: that of the sweep, some 20 operations a sample for the tables; of a segment at most 14 pieces before OpaqueViewDepth.
 */
class HeightFieldMoments
  : public HeightFieldScattering
  , private HeightFieldSweep::Listener
{
public:
  using HeightFieldScattering::HeightFieldScattering;

protected:
  void run(const CloudSlice& slice) override;

private:
  static constexpr int Orders = 4;
  struct Table
  {
    double moment[Orders][SampleBlock::Steps +
      1]; ///< int G u^i dr from the block's start, u = (r - start) / (block's length)
    double before
      [Orders]; ///< int G v^i dr from the first block's start to here, v = (r - first start) / Unit
  };
  struct Stretch;

  void sampled(const SampleBlock& block) override;
  void joinTables();
  bool chord(std::uint32_t ray, const SweepPlace& in, const SweepPlace& out) override;
  double light(const HeightFieldRay& ray, const SweepPlace& in, const SweepPlace& out) const;
  double direct(const Stretch& stretch, double to, bool isDense) const;
  double table(const Stretch& stretch, int toBlock, int toStep) const;
  SweepPlace sampleBefore(double r, const Stretch& stretch, const SweepPlace& last) const;

  HeightFieldSweep Sweep;
  std::vector<Table> Tables;
  double First = 0;
  double Unit = 1;
  bool Tall = false; ///< g is too large for its exponential
};
}
#endif
