// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file CloudPanorama.h
 * @brief The clouds of a height field all round and up to the zenith, as one point sees them: what water mirrors.
 *
 * Water of height w mirrors to an eye E what the point E' = (E_x, E_y, 2 w - E_z) sees through it. The light J and the transmittance T
 * of the rays from E' are worked out by HeightFieldScattering's Moments, slice by slice, for directions a `Spacing` apart in azimuth and
 * elevation, and looked up as finely as they are blurred. Calm water shows them where they are; a ray that a wave has mirrored
 * is taken for that from E' to where it meets the cloud plane.
 *
 * Cost: 0.3 million rays, see HeightFieldScattering.h; 3.3 MB. The same bits for any number of threads.
 */
#ifndef CloudPanorama_h
#define CloudPanorama_h

#include "GridPyramid.h"
#include "HeightFieldScattering.h"
#include "Vector3.h"

namespace nephoscope
{
class CloudPanorama
{
public:
  /// Radians: 0.3 degrees, which is finer than what waves too small for any pixel blur.
  static constexpr double Spacing = 0.0052359877559829887;

  struct Light
  {
    double light;         ///< J
    double transmittance; ///< T
  };

  CloudPanorama() = default;
  /// @param far horizontal distance where clouds end, m
  CloudPanorama(const HeightField& field, double planeHeight, const ScatteringDensities& densities,
    const Vector3& eye, double far);

  bool empty() const { return this->Lights.empty(); }

  /// What is seen at the end of a ray, above the horizon, from somewhere below the cloud plane.
  /// @param blur standard deviation of its direction, radians
  Light at(const Vector3& from, const Vector3& direction, double blur) const;

private:
  Vector3 Eye{};
  double PlaneHeight = 0;
  GridPyramid Lights;
  GridPyramid Transmittances;
};
}
#endif
