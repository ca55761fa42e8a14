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
  double x = 0;     ///< pixels from the left
  double y = 0;     ///< pixels from below
  double depth = 0; ///< along the viewing axis, scene units; not in front of the eye where <= 0
};

/**
 * @brief A pinhole or a parallel camera over an image of width x height pixels.
 *
 * The view angle is vertical, as vtkCamera's; pixels are square.
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

  Ray ray(double x, double y) const
  {
    const double u = (x - this->HalfWidth) * this->Pixel;
    const double v = (y - this->HalfHeight) * this->Pixel;
    const Vector3 across = u * this->Right + v * this->Up;
    return this->Parallel ? Ray{ this->Eye + across, this->Forward }
                          : Ray{ this->Eye, normalized(this->Forward + across) };
  }

  Projected project(const Vector3& point) const
  {
    const Vector3 d = point - this->Eye;
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
  const Vector3& eye() const { return this->Eye; }
  const Vector3& forward() const { return this->Forward; } ///< unit viewing axis
  const Vector3& right() const { return this->Right; }     ///< unit, along rows
  const Vector3& up() const { return this->Up; }           ///< unit, along columns
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
  double HalfWidth;
  double HalfHeight;
  int Width;
  int Height;
  bool Parallel = false;
};
}
#endif
