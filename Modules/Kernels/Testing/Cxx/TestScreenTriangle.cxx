// SPDX-License-Identifier: BSD-3-Clause
#include "RayTriangle.h"
#include "ScreenTriangle.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

using nephoscope::Camera;
using nephoscope::PixelRectangle;
using nephoscope::ScreenPoint;
using nephoscope::ScreenProjection;
using nephoscope::ScreenTriangle;
using nephoscope::Vector3;

namespace
{
constexpr int Width = 61;
constexpr int Height = 43;

/// How many triangles own each pixel; clockwise ones are turned.
class Coverage
{
public:
  explicit Coverage(const Camera& camera)
    : Projection(camera)
    , Counts(static_cast<std::size_t>(Width) * Height, 0)
  {
  }
  void add(const Vector3& a, const Vector3& b, const Vector3& c)
  {
    const ScreenTriangle whole{ { this->Projection.snap(a), this->Projection.snap(b),
      this->Projection.snap(c) } };
    bool far = false;
    for (const ScreenPoint& p : whole.p)
    {
      ASSERT_NE(p.x, ScreenPoint::None);
      far = far || p.x == ScreenPoint::Far;
    }
    if (!far)
    {
      this->add(whole);
      return;
    }
    ++this->Clipped;
    const ScreenProjection::Fan fan = this->Projection.clip(a, b, c);
    for (int i = 0; i < fan.count; ++i)
    {
      this->add(fan.triangle[i]);
    }
  }
  int at(int x, int y) const { return this->Counts[y * Width + x]; }
  int numberOfClipped() const { return this->Clipped; }

private:
  void add(ScreenTriangle shape)
  {
    if (shape.area() < 0)
    {
      std::swap(shape.p[1], shape.p[2]);
    }
    if (shape.area() != 0)
    {
      shape.forEachPixel(this->Projection.picture(),
        [this](int x, int y) { ++this->Counts[static_cast<std::size_t>(y) * Width + x]; });
    }
  }
  ScreenProjection Projection;
  std::vector<int> Counts;
  int Clipped = 0;
};

/// A jittered triangulation of [0, 1] x [0, 1] mapped to a plane; corners given by origin and two edges.
void addSheet(Coverage& coverage, const Vector3& origin, const Vector3& u, const Vector3& v,
  int cells, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> jitter(-0.3, 0.3);
  const int columns = cells + 1;
  std::vector<Vector3> points;
  for (int j = 0; j <= cells; ++j)
  {
    for (int i = 0; i <= cells; ++i)
    {
      const double s = (i + (i > 0 && i < cells ? jitter(random) : 0)) / cells;
      const double t = (j + (j > 0 && j < cells ? jitter(random) : 0)) / cells;
      points.push_back(origin + s * u + t * v);
    }
  }
  for (int j = 0; j < cells; ++j)
  {
    for (int i = 0; i < cells; ++i)
    {
      const Vector3& a = points[j * columns + i];
      const Vector3& b = points[j * columns + i + 1];
      const Vector3& c = points[(j + 1) * columns + i + 1];
      const Vector3& d = points[(j + 1) * columns + i];
      if (random() % 2)
      {
        coverage.add(a, b, c);
        coverage.add(c, d, a);
      }
      else
      {
        coverage.add(b, c, d);
        coverage.add(d, a, b);
      }
    }
  }
}

/// A parallel camera whose pixels are scene units: (x, y, 0) is at pixel coordinates (x, y).
Camera pixelCamera()
{
  return Camera::parallel({ 0.5 * Width, 0.5 * Height, 10 }, { 0.5 * Width, 0.5 * Height, 0 },
    { 0, 1, 0 }, 0.5 * Height, Width, Height);
}
}

TEST(ScreenTriangle, EveryPixelOfATriangulationBelongsToOneTriangle)
{
  for (unsigned seed = 0; seed < 20; ++seed)
  {
    Coverage coverage(pixelCamera());
    addSheet(coverage, { -3, -2, 0 }, { Width + 6.0, 0, 0 }, { 0, Height + 4.0, 0 },
      3 + static_cast<int>(seed), seed);
    for (int y = 0; y < Height; ++y)
    {
      for (int x = 0; x < Width; ++x)
      {
        ASSERT_EQ(coverage.at(x, y), 1) << x << ' ' << y << " seed " << seed;
      }
    }
  }
}

TEST(ScreenTriangle, PixelCentresOnEdgesAndCornersBelongToOneTriangle)
{
  // All corners are pixel centres, so that all edges of the lattice run through pixel centres.
  Coverage coverage(pixelCamera());
  for (int y = 0; y < 40; y += 4)
  {
    for (int x = 0; x < 60; x += 4)
    {
      const Vector3 a{ x + 0.5, y + 0.5, 0 };
      const Vector3 b{ x + 4.5, y + 0.5, 0 };
      const Vector3 c{ x + 4.5, y + 4.5, 0 };
      const Vector3 d{ x + 0.5, y + 4.5, 0 };
      coverage.add(a, b, c);
      coverage.add(a, c, d);
    }
  }
  for (int y = 1; y < 40; ++y)
  {
    for (int x = 1; x < 60; ++x)
    {
      ASSERT_EQ(coverage.at(x, y), 1) << x << ' ' << y;
    }
  }
}

TEST(ScreenTriangle, AreaIsCountedOnceOnTheOutline)
{
  // Of a rectangle whose four sides run through pixel centres, two sides count: 20 x 10 pixels, not 21 x 11.
  Coverage coverage(pixelCamera());
  coverage.add({ 5.5, 5.5, 0 }, { 25.5, 5.5, 0 }, { 25.5, 15.5, 0 });
  coverage.add({ 25.5, 15.5, 0 }, { 5.5, 15.5, 0 }, { 5.5, 5.5, 0 });
  int sum = 0;
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      sum += coverage.at(x, y);
    }
  }
  EXPECT_EQ(sum, 200);
}

TEST(ScreenTriangle, SheetThroughTheEyePlaneHasNoCrack)
{
  // A plane under the eye that reaches from far behind to far before it, beyond the guard on all sides.
  const Camera camera =
    Camera::perspective({ 0, 0, 1 }, { 0.3, 1, 0.9 }, { 0, 0, 1 }, 70, Width, Height);
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    Coverage coverage(camera);
    addSheet(coverage, { -5000, -4000, 0 }, { 10000, 0, 0 }, { 0, 9000, 0 },
      2 + 2 * static_cast<int>(seed), seed);
    EXPECT_GT(coverage.numberOfClipped(), 0);
    for (int y = 0; y < Height; ++y)
    {
      for (int x = 0; x < Width; ++x)
      {
        const nephoscope::Ray ray = camera.ray(x + 0.5, y + 0.5);
        const double t = -ray.origin[2] / ray.direction[2];
        const Vector3 at = ray.origin + t * ray.direction;
        // Away from the outline by more than a pixel's worth.
        const bool below = ray.direction[2] < -0.01;
        if (below && std::abs(at[0]) < 4900 && at[1] > -3900 && at[1] < 4900)
        {
          ASSERT_EQ(coverage.at(x, y), 1) << x << ' ' << y << " seed " << seed;
        }
        else if (ray.direction[2] > 0.01)
        {
          ASSERT_EQ(coverage.at(x, y), 0) << x << ' ' << y << " seed " << seed;
        }
      }
    }
  }
}

TEST(ScreenTriangle, PointsWithoutAPlaceAreMarked)
{
  const ScreenProjection projection(
    Camera::perspective({ 0, 0, 0 }, { 0, 0, -1 }, { 0, 1, 0 }, 30, Width, Height));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(projection.snap({ nan, 0, -1 }).x, ScreenPoint::None);
  EXPECT_EQ(projection.snap({ 0, infinity, -1 }).x, ScreenPoint::None);
  EXPECT_EQ(projection.snap({ 0, 0, 1 }).x, ScreenPoint::Far);
  EXPECT_EQ(projection.snap({ 0, 0, 0 }).x, ScreenPoint::Far);
  EXPECT_EQ(projection.snap({ 1e9, 0, -1 }).x, ScreenPoint::Far);
  const ScreenPoint middle = projection.snap({ 0, 0, -3 });
  EXPECT_EQ(middle.x, Width * ScreenPoint::Steps / 2);
  EXPECT_EQ(middle.y, Height * ScreenPoint::Steps / 2);
  EXPECT_EQ(projection.clip({ 0, 0, 1 }, { 1, 0, 2 }, { 0, 1, 3 }).count, 0);
}

TEST(RayTriangle, WeightsAndDistanceAreThoseOfThePointAimedAt)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int i = 0; i < 1000; ++i)
  {
    const auto any = [&random, &number] {
      return Vector3{ number(random), number(random), number(random) };
    };
    const Vector3 a = any();
    const Vector3 b = any();
    const Vector3 c = any();
    const Vector3 eye = 5.0 * any();
    const double wb = 0.5 + 0.5 * number(random);
    const double wc = (1 - wb) * (0.5 + 0.5 * number(random));
    const Vector3 at = (1 - wb - wc) * a + wb * b + wc * c;
    const nephoscope::Ray ray{ eye, normalized(at - eye) };
    const Vector3 normal = cross(b - a, c - a);
    if (std::abs(dot(normal, ray.direction)) < 1e-2)
    {
      continue; // ill-conditioned
    }
    const nephoscope::TriangleHit hit = intersect(ray, a, b, c);
    EXPECT_NEAR(hit.b, wb, 1e-11);
    EXPECT_NEAR(hit.c, wc, 1e-11);
    EXPECT_NEAR(hit.distance, length(at - eye), 1e-11);
  }
}

TEST(RayTriangle, StaysInTheTriangleAndFinite)
{
  const Vector3 a{ 0, 0, 0 };
  const Vector3 b{ 1, 0, 0 };
  const Vector3 c{ 0, 1, 0 };
  // In its plane, past it, and a triangle without an area.
  const nephoscope::TriangleHit along = intersect({ { -1, 0.2, 0 }, { 1, 0, 0 } }, a, b, c);
  EXPECT_NEAR(along.distance, 1 + 1.0 / 3, 1e-12);
  const nephoscope::TriangleHit past = intersect({ { 3, 3, 1 }, { 0, 0, -1 } }, a, b, c);
  EXPECT_EQ(past.b + past.c, 1);
  const nephoscope::TriangleHit point = intersect({ { 0, 0, 2 }, { 0, 0, -1 } }, a, a, a);
  EXPECT_EQ(point.distance, 2);
}
