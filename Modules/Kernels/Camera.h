// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Camera.h
 * @brief Pixels to rays and points to pixels.
 *
 * Image coordinates are pixels from the lower left corner: pixel (i, j) covers [i, i+1] x [j, j+1], its ray goes through
 * (i + 1/2, j + 1/2), row 0 is the lowest as in vtkImageData. Distances are along the unit direction of the ray.
 */
#ifndef Camera_h
#define Camera_h

#include "Vector3.h"

namespace nephoscope
{
/// A viewing ray: points origin + t direction, |direction| = 1, t >= 0.
struct Ray
{
  Vector3 origin;
  Vector3 direction;
};

/// A point as the camera sees it.
struct Projected
{
  double x = 0; ///< pixels from the left
  double y = 0; ///< pixels from below
  double depth =
    0; ///< along the viewing axis, scene units; not in front of the eye where <= 0; cylindrical: from the axis
};

/**
 * @brief A pinhole, a parallel or a cylindrical camera over an image of width x height pixels.
 *
 * The view angle of a pinhole is vertical, as vtkCamera's; pixels are square.
 *
 * A cylindrical picture (Max 1986, figure 11) lies on a cylinder about `up` through the eye: with a = pixel (x - width/2) the
 * azimuth to the right of the target and b the slope, height over distance from the axis, the ray goes along
 * cos a forward + sin a right + b up, b = (the target's slope) + pixel (y - height/2). A column of pixels is a plane through the
 * axis; straight lines across columns are curves, so that what is drawn by projecting its corners cannot be in it.
 */
class Camera
{
public:
  /**
   * Perspective camera.
   * @param eye position, @param target a point on the viewing axis, @param up roughly upward (a direction along the axis
   * is replaced by another), @param viewAngle vertical, degrees in (0, 180)
   */
  static Camera perspective(const Vector3& eye, const Vector3& target, const Vector3& up,
    double viewAngle, int width, int height);
  /// Parallel camera: rays start in the plane through `eye`; halfHeight is half the image's height in scene units.
  static Camera parallel(const Vector3& eye, const Vector3& target, const Vector3& up,
    double halfHeight, int width, int height);
  /// Cylindrical camera: the axis is `up`, angleAcross the picture's width, degrees in (0, 360].
  static Camera cylindrical(const Vector3& eye, const Vector3& target, const Vector3& up,
    double angleAcross, int width, int height);

  Ray ray(double x, double y) const
  {
    const double u = (x - this->HalfWidth) * this->Pixel;
    const double v = (y - this->HalfHeight) * this->Pixel;
    if (this->Cylindrical)
    {
      return { this->Eye,
        normalized(
          std::cos(u) * this->Forward + std::sin(u) * this->Right + (this->Slope + v) * this->Up) };
    }
    const Vector3 across = u * this->Right + v * this->Up;
    return this->Parallel ? Ray{ this->Eye + across, this->Forward }
                          : Ray{ this->Eye, normalized(this->Forward + across) };
  }

  Projected project(const Vector3& point) const
  {
    const Vector3 d = point - this->Eye;
    if (this->Cylindrical)
    {
      const double ahead = dot(d, this->Forward);
      const double aside = dot(d, this->Right);
      const double radius = std::hypot(ahead, aside);
      return { this->HalfWidth + std::atan2(aside, ahead) / this->Pixel,
        this->HalfHeight + (dot(d, this->Up) / radius - this->Slope) / this->Pixel, radius };
    }
    const double depth = dot(d, this->Forward);
    const double scale = 1 / (this->Pixel * (this->Parallel ? 1 : depth));
    return { this->HalfWidth + dot(d, this->Right) * scale,
      this->HalfHeight + dot(d, this->Up) * scale, depth };
  }

  /// Width of a pixel at a distance along the ray, scene units.
  double footprint(double distance) const
  {
    return this->Parallel ? this->Pixel : this->Pixel * distance;
  }

  int width() const { return this->Width; }
  int height() const { return this->Height; }
  bool isParallel() const { return this->Parallel; }
  bool isCylindrical() const { return this->Cylindrical; }
  const Vector3& eye() const { return this->Eye; }
  const Vector3& forward() const
  {
    return this->Forward;
  } ///< unit viewing axis, of a cylinder across its axis
  const Vector3& right() const { return this->Right; } ///< unit, along rows
  const Vector3& up() const { return this->Up; }       ///< unit, along columns
  double pixel() const
  {
    return this->Pixel;
  } ///< pixel width at depth 1, or everywhere if parallel

private:
  Camera(const Vector3& eye, const Vector3& target, const Vector3& up, int width, int height);

  Vector3 Eye;
  Vector3 Forward;
  Vector3 Right;
  Vector3 Up;
  double Pixel = 1;
  double Slope = 0; // of the target as seen from the eye; cylindrical only
  double HalfWidth;
  double HalfHeight;
  int Width;
  int Height;
  bool Parallel = false;
  bool Cylindrical = false;
};
}
#endif
