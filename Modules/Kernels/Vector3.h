// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Vector3.h
 * @brief The few operations on three numbers that the kernels share.
 */
#ifndef Vector3_h
#define Vector3_h

#include <cmath>

namespace nephoscope
{
struct Vector3
{
  double v[3];
  double operator[](int i) const { return this->v[i]; }
  double& operator[](int i) { return this->v[i]; }
};

inline Vector3 operator+(const Vector3& a, const Vector3& b)
{
  return { a[0] + b[0], a[1] + b[1], a[2] + b[2] };
}
inline Vector3 operator-(const Vector3& a, const Vector3& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}
inline Vector3 operator*(double s, const Vector3& a)
{
  return { s * a[0], s * a[1], s * a[2] };
}
inline double dot(const Vector3& a, const Vector3& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector3 cross(const Vector3& a, const Vector3& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}
inline double length(const Vector3& a)
{
  return std::sqrt(dot(a, a));
}
/// a / |a|; the zero vector stays zero.
inline Vector3 normalized(const Vector3& a)
{
  const double l = length(a);
  return l > 0 ? (1 / l) * a : a;
}
}
#endif
