// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file PixelRuns.h
 * @brief Pixels to which several processes contribute, put together from what each has composited of its own.
 *
 * Of its segments in a pixel (DeepTile::runs) a part of the scene tells the stretch of the ray that they lie on and what they amount to: a
 * run. Where the runs of a pixel follow one another, they are composited as segments are, front to back, and that is exact:
 *
 *     L = L_1 + T_1 (L_2 + T_2 (L_3 + ...))        T = T_1 T_2 T_3 ...
 *
 * Where two runs overlap, segments have to be mixed, and all segments of the pixel are asked for. The depth at which the mean
 * transmittance falls to 1/2 is known from the run itself if nothing is before it; else the part is asked where that is behind
 * what lets a known part of the light through.
 *
 * @sa DeepTile::answer
 */
#ifndef PixelRuns_h
#define PixelRuns_h

#include "Segment.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephoscope
{
/// What the segments of one part of the scene amount to in one pixel.
struct PixelRun
{
  double nearEnd = 0;      ///< of all its segments, distance along the ray, scene units
  double farEnd = 0;       ///< >= nearEnd
  PixelLight light;        ///< of them alone
  std::uint32_t pixel = 0; ///< in the tile, row by row
  std::uint32_t part = 0;  ///< of the scene
};

/// What a part is asked about one pixel.
struct PixelRequest
{
  std::uint32_t pixel = 0;
  std::uint32_t whole = 0; ///< 1: for all segments; 0: for the depth, behind
  RGB before{ 1, 1, 1 };   ///< what lets this through, nearer than its run
};

class PixelRuns
{
public:
  void reset(std::size_t pixels);

  /// Runs of equal nearEnd keep the order in which they are added.
  void add(const PixelRun& run);

  /**
   * Composite the pixels.
   * @param depthWanted else PixelLight::depth is infinity
   * @param[out] light of all pixels; nothing yet in those whose runs overlap, and the far end of the run as the depth that is asked for
   * @param[in,out] requests one list for each part, to which is appended
   * @return the number of pixels whose runs overlap
   * Cost: O(runs), sorted as they were added.
   */
  std::size_t merge(bool depthWanted, std::vector<PixelLight>& light,
    std::vector<std::vector<PixelRequest>>& requests) const;

private:
  static constexpr std::uint32_t None = 0xffffffff;
  struct Link
  {
    PixelRun run;
    std::uint32_t next; ///< of the same pixel, no nearer; None after the last
  };

  bool overlap(std::uint32_t first) const;
  PixelLight inOrder(
    std::uint32_t first, bool depthWanted, std::vector<std::vector<PixelRequest>>& requests) const;

  std::vector<std::uint32_t> First; ///< the nearest of each pixel
  std::vector<Link> Links;
};
}
#endif
