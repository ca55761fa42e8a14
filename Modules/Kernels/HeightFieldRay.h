// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file HeightFieldRay.h
 * @brief A ray of a slice against a height field: where it can meet the layer, and the light of a stretch of it.
 */
#ifndef HeightFieldRay_h
#define HeightFieldRay_h

#include "Exponential.h"
#include "HeightFieldScattering.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
/// A ray as functions of the horizontal distance r, with the extinctions along it.
struct HeightFieldRay
{
  HeightFieldRay(double eyeOverPlane, double slopeOfRay, const ScatteringDensities& densities)
    : eye(eyeOverPlane)
    , slope(slopeOfRay)
    , gamma(std::sqrt(1 + slopeOfRay * slopeOfRay))
    , sun(densities.sun)
    , view(densities.view * this->gamma)
  {
  }

  double zeta(double r) const { return this->eye + this->slope * r; }
  /// delta of Max 1986: how fast light fades along r, but for g's part.
  double delta() const { return this->view - this->sun * this->slope; }
  /// Optical depth from the sun to the eye by way of r, after nearEnd.
  double depth(double top, double r, double nearEnd) const
  {
    return this->sun * std::max(0.0, top - this->zeta(r)) + this->view * (r - nearEnd);
  }

  double eye;   ///< over the cloud plane, m
  double slope; ///< dz/dr
  double gamma; ///< length per r
  double sun;   ///< rhoA, 1/m
  double view;  ///< rhoB gamma, 1/m of r
};

/// A range of horizontal distance; empty if first >= second.
struct HeightFieldRange
{
  double first;
  double last;
};

/// Where rays between two slopes can be within a layer of heights over the plane, 0 <= r <= far.
inline HeightFieldRange layerRange(
  double eye, double low, double high, double least, double greatest, double far)
{
  if (eye < low)
  {
    return greatest > 0 ? HeightFieldRange{ (low - eye) / greatest,
      least > 0 ? std::min(far, (high - eye) / least) : far }
                        : HeightFieldRange{ 1, 0 };
  }
  if (eye > high)
  {
    return least < 0 ? HeightFieldRange{ (high - eye) / least,
      greatest < 0 ? std::min(far, (low - eye) / greatest) : far }
                     : HeightFieldRange{ 1, 0 };
  }
  double last = 0;
  last = std::max(
    last, least > 0 ? (high - eye) / least : (greatest < 0 ? (low - eye) / greatest : far));
  return { 0, std::min(far, last) };
}

/**
 * A chain of points along a ray, between which the optical depth from the sun to the eye is taken as linear in r:
 *     int view exp(-E) dr = view dr (exp(-E0) - exp(-E1)) / (E1 - E0)
 * Exact for planes, in clouds of any density; the error is of second order in the distance of the points.
 */
class LinearSteps
{
public:
  LinearSteps(const HeightFieldRay& ray, double nearEnd)
    : Ray(ray)
    , Near(nearEnd)
  {
  }

  void start(double r, double top)
  {
    this->R = r;
    this->Depth = this->Ray.depth(top, r, this->Near);
    this->Left = exponential(-this->Depth);
  }

  /// Light between the last point and r, whose cloud top is given.
  double to(double r, double top)
  {
    const double depth = this->Ray.depth(top, r, this->Near);
    const double left = exponential(-depth);
    const double x = depth - this->Depth;
    const double mean =
      std::abs(x) > 1e-4 ? (this->Left - left) / x : this->Left * (1 - x * (0.5 - x / 6));
    const double light = this->Ray.view * (r - this->R) * mean;
    this->R = r;
    this->Depth = depth;
    this->Left = left;
    return light;
  }

private:
  const HeightFieldRay& Ray;
  double Near;
  double R = 0;
  double Depth = 0;
  double Left = 1;
};
}
#endif
