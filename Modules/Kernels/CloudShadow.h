// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file CloudShadow.h
 * @brief How much sunlight comes through a cloud plane: a map of transmittances at one height.
 *
 * Max 1986, section 6: a ray from a point towards the sun meets the mean cloud plane; what the cloud lets through there is
 * exp(-rho (g - h)), its vertical thickness's. The map holds that, whoever has worked it out. Above the
 * plane the sun shines undimmed; so it does for a sun that is not above the horizon, whose light has no business there.
 */
#ifndef CloudShadow_h
#define CloudShadow_h

#include "GridPyramid.h"
#include "Vector3.h"

#include <algorithm>

namespace nephoscope
{
struct CloudShadow
{
  GridPyramid transmittance; ///< 0 to 1; empty for no clouds
  double height = 0;         ///< z of the plane, scene units
  double beyond = 1;         ///< where the map has no value

  /// At a place of the plane, as a footprint sees it.
  double at(double x, double y, double footprint = 0) const
  {
    if (!this->transmittance.contains(x, y))
    {
      return this->beyond;
    }
    return std::clamp(this->transmittance.value(x, y, footprint), 0.0, 1.0);
  }

  /// Of the light that goes along a unit direction reversed: from the cloud plane to the point.
  double at(const Vector3& point, const Vector3& toward, double footprint = 0) const
  {
    const double rise = this->height - point[2];
    if (this->transmittance.empty() || !(rise > 0) || !(toward[2] > 0))
    {
      return 1;
    }
    const double way = rise / toward[2];
    return this->at(point[0] + way * toward[0], point[1] + way * toward[1], footprint);
  }
};
}
#endif
