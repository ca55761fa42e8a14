// SPDX-License-Identifier: BSD-3-Clause
// Where cell-by-cell volume rendering is known to fail.
#include "TestPicture.h"

#include "vtkCloudCellVolume.h"
#include "vtkStructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <random>

namespace nephoscope
{
namespace stability
{
namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr const char* SameAsExact = "transmittance of the exact sum within 1e-5";

double waves(int i, int j, int k)
{
  return 0.5 + 0.5 * std::sin(1.3 * i + 0.4) * std::cos(0.9 * j - 0.2 * k);
}

Vector3 box(double a, double b, double c)
{
  return { 3 * a, 2 * b, c };
}

/// The box's points each moved by up to `reach` of a cell; the same for the same point.
std::function<Vector3(double, double, double)> shaken(double reach)
{
  return [reach](double a, double b, double c)
  {
    std::minstd_rand random(static_cast<unsigned>(1 + 997 * a + 89 * 997 * b + 7919 * 997 * c));
    random.discard(8);
    std::uniform_real_distribution<double> shift(-reach, reach);
    const Vector3 at = box(a, b, c);
    return Vector3{ at[0] + 0.6 * shift(random), at[1] + 0.5 * shift(random),
      at[2] + 0.33 * shift(random) };
  };
}

const View Aside{ { 7, -6, 4 }, { 1.5, 1, 0.5 }, 28, 0, 24, 16 };

const StabilityRegistration flat(
  { "volume", "cells without volume: two levels in one place", SameAsExact,
    []
    {
      const auto grid = makeGrid(
        { 6, 5, 4 },
        [](double a, double b, double c) { return box(a, b, c > 0.3 && c < 0.7 ? 1.0 / 3 : c); },
        waves);
      return compareWithExact(grid, Aside, Naive::Float);
    } });

const StabilityRegistration sliver({ "volume", "slivers: a layer 1e-7 thick", SameAsExact,
  []
  {
    const auto grid = makeGrid(
      { 6, 5, 4 },
      [](double a, double b, double c)
      { return box(a, b, c > 0.5 && c < 0.7 ? 1.0 / 3 + 1e-7 : c); },
      waves);
    return compareWithExact(grid, Aside, Naive::Float);
  } });

const StabilityRegistration nonPlanar({ "volume", "faces that are not planar", SameAsExact,
  []
  {
    const auto grid = makeGrid({ 6, 5, 4 }, shaken(0.3), [](int, int, int) { return 1.0; });
    return compareWithExact(grid, Aside, Naive::PlanarFaces);
  } });

const StabilityRegistration inverted({ "volume", "inverted cells: points shaken through each other",
  "each tetrahedron adds the length that it takes, within 1e-5",
  []
  {
    return compareWithExact(makeGrid({ 6, 5, 4 }, shaken(1.4), waves), Aside, Naive::PlanarFaces);
  } });

const StabilityRegistration folded(
  { "volume", "terrain whose levels fold over", "overlapping cells both add, within 1e-5",
    []
    {
      const auto grid = makeGrid(
        { 9, 5, 7 },
        [](double a, double b, double c)
        {
          const double fold = 0.35 * std::sin(2 * Pi * a) * std::sin(Pi * c);
          return Vector3{ 3 * a + fold, 2 * b, c + 0.9 * fold * std::cos(3 * Pi * c) };
        },
        waves);
      return compareWithExact(grid, Aside, Naive::PlanarFaces);
    } });

const StabilityRegistration eyeInCell({ "volume", "the eye inside a cell", SameAsExact,
  []
  {
    const View inside{ { 1.43, 0.87, 0.41 }, { 2.4, 1.3, 0.6 }, 70, 0, 24, 16 };
    return compareWithExact(makeGrid({ 6, 5, 4 }, box, waves), inside, Naive::NoNearPlane);
  } });

const StabilityRegistration eyeOnFace({ "volume", "the eye on a face", SameAsExact,
  []
  {
    const View onFace{ { 1.2, 0.77, 0.45 }, { 2.7, 1.1, 0.6 }, 70, 0, 24, 16 };
    return compareWithExact(makeGrid({ 6, 5, 4 }, box, waves), onFace, Naive::NoNearPlane);
  } });

const StabilityRegistration eyeOnVertex({ "volume", "the eye on a vertex", SameAsExact,
  []
  {
    const View onVertex{ { 1.2, 1, 1.0 / 3 }, { 2.7, 1.2, 0.5 }, 70, 0, 24, 16 };
    return compareWithExact(makeGrid({ 6, 5, 4 }, box, waves), onVertex, Naive::NoNearPlane);
  } });

/// Rays down the columns of a grid of unit cells seen from straight above, so far along x off the cells' corners.
Outcome fromAbove(double offset)
{
  const auto grid = makeGrid(
    { 9, 7, 4 },
    [](double a, double b, double c) {
      return Vector3{ 8 * a - 4, 6 * b - 3, 0.2 * c };
    },
    waves);
  // Pixels are one unit wide: the middle of each lies on a corner if the eye's place does.
  const View above{ { 0.5 + offset, 0.5, 5 }, { 0.5 + offset, 0.5, 0 }, 30, 3, 8, 6 };
  return compareWithExact(grid, above, Naive::Inclusive);
}

const StabilityRegistration alongEdges(
  { "volume", "rays along edges", SameAsExact, [] { return fromAbove(0); } });

const StabilityRegistration alongFaces(
  { "volume", "rays in faces", SameAsExact, [] { return fromAbove(0.5); } });

/// A uniform shell from radius 1 to 1.3, closed at the seam and with cells that end at the poles.
vtkSmartPointer<vtkStructuredGrid> shellWithPoles(double radius, bool floatPoints)
{
  return makeGrid(
    { 17, 9, 3 },
    [radius](double a, double b, double c)
    {
      const double longitude = a < 1 ? 2 * Pi * a : 0;
      const double latitude = Pi * (b - 0.5);
      const double r = radius * (1 + 0.3 * c);
      const double across = b == 0 || b == 1 ? 0 : r * std::cos(latitude);
      return Vector3{ across * std::cos(longitude), across * std::sin(longitude),
        r * std::sin(latitude) };
    },
    [radius](int, int, int) { return 1 / radius; }, floatPoints);
}

const StabilityRegistration poles(
  { "volume", "rays through both poles, along the axis", SameAsExact,
    []
    {
      const View overPole{ { 0, 0, 5 }, { 0, 0, 0 }, 30, 1.4, 15, 15 };
      return compareWithExact(shellWithPoles(1, false), overPole, Naive::Inclusive);
    } });

const StabilityRegistration seam({ "volume", "rays in the plane of the seam", SameAsExact,
  []
  {
    const View atSeam{ { 5, 0, 0 }, { 0, 0, 0 }, 30, 1.4, 15, 15 };
    return compareWithExact(shellWithPoles(1, false), atSeam, Naive::Inclusive);
  } });

const StabilityRegistration metres({ "volume", "metres of the Earth in float: layers 150 m thick",
  "transmittance of the exact sum of the float points within 1e-5",
  []
  {
    constexpr double Radius = 6371000;
    const auto grid = makeGrid(
      { 9, 7, 21 },
      [](double a, double b, double c)
      {
        const double longitude = 0.4 + 0.02 * a;
        const double latitude = 0.7 + 0.015 * b;
        const double r = Radius + 3000 * c;
        return Vector3{ r * std::cos(latitude) * std::cos(longitude),
          r * std::cos(latitude) * std::sin(longitude), r * std::sin(latitude) };
      },
      [](int i, int j, int k) { return 2e-4 * waves(i, j, k); }, true);
    const double up[3] = { std::cos(0.7075) * std::cos(0.41), std::cos(0.7075) * std::sin(0.41),
      std::sin(0.7075) };
    View view{ {}, {}, 40, 0, 24, 16 };
    for (int c = 0; c < 3; ++c)
    {
      view.target[c] = up[c] * Radius;
      view.eye[c] = up[c] * (Radius + 40000) + (c == 2 ? -90000 : 0);
    }
    return compareWithExact(grid, view, Naive::Float);
  } });

/// A bar of 2 x 2 x 2 points from a to b, seen along z.
vtkSmartPointer<vtkStructuredGrid> bar(const Vector3& a, const Vector3& b)
{
  const Vector3 along = b - a;
  const Vector3 across = 0.12 * normalized(cross({ 0, 0, 1 }, along));
  return makeGrid(
    { 2, 2, 2 },
    [=](double s, double t, double u) {
      return a + s * along + (2 * t - 1) * across + Vector3{ 0, 0, 0.04 * u };
    },
    [](int, int, int) { return 1e4; });
}

/// Three bars over the sides of a triangle; each rises from one corner, so that it passes the next corner above the bar that
/// starts there.
Bodies cyclicBars(const Vector3 (&corner)[3])
{
  Bodies bodies;
  for (int n = 0; n < 3; ++n)
  {
    const Vector3 side = corner[(n + 1) % 3] - corner[n];
    const auto grid = bar(corner[n] - 0.3 * side, corner[n] + 1.3 * side + Vector3{ 0, 0, 0.8 });
    bodies.push_back(bodyOf(grid, { n == 0 ? 1.0F : 0, n == 1 ? 1.0F : 0, n == 2 ? 1.0F : 0 }));
  }
  return bodies;
}

/// The fewest wrong crossings of any order in which bars are drawn whole. At crossing n bar n is before bar n + 1, the
/// third is not there.
int wrongInTheBestOrder(const std::vector<bool> (&covered)[3])
{
  int order[3] = { 0, 1, 2 };
  int best = 3;
  do
  {
    int wrong = 0;
    for (int n = 0; n < 3; ++n)
    {
      const auto seen = std::find_if(order, order + 3, [&](int bar) { return covered[bar][n]; });
      wrong += seen != order + 3 && *seen == n ? 0 : 1;
    }
    best = std::min(best, wrong);
  } while (std::next_permutation(order, order + 3));
  return best;
}

const StabilityRegistration cycle({ "volume",
  "a visibility cycle: three bars, each before the next", "at each crossing the nearer bar is seen",
  []
  {
    Vector3 corner[3];
    for (int n = 0; n < 3; ++n)
    {
      corner[n] = { std::cos(2 * Pi * n / 3), std::sin(2 * Pi * n / 3), 0 };
    }
    const auto bodies = cyclicBars(corner);
    const View above{ { 0, 0, 5 }, { 0, 0, 0 }, 30, 1.6, 96, 96 };
    const Picture together = draw(bodies, above);
    const Picture alone[3] = { draw({ bodies[0] }, above), draw({ bodies[1] }, above),
      draw({ bodies[2] }, above) };
    const Camera camera = above.camera();
    std::vector<bool> covered[3];
    int wrong = 0;
    for (int n = 0; n < 3; ++n)
    {
      const Projected seen = camera.project(corner[(n + 1) % 3]);
      const auto p = static_cast<std::size_t>(seen.y) * 96 + static_cast<std::size_t>(seen.x);
      for (int bar = 0; bar < 3; ++bar)
      {
        covered[bar].push_back(alone[bar].transmittance[p][0] < 0.001F);
      }
      wrong += covered[(n + 1) % 3][n] && together.radiance[p][n] > 0.999F ? 0 : 1;
    }
    return Outcome{ std::to_string(wrongInTheBestOrder(covered)) +
        " of 3 crossings wrong in the best order of bars",
      std::to_string(wrong) + " of 3 crossings wrong", wrong == 0 };
  } });

const StabilityRegistration strange({ "volume", "densities NaN, infinite, negative",
  "every pixel finite, transmittance in 0..1; NaN and negative are clear, infinite is opaque",
  []
  {
    const double odd[] = { std::numeric_limits<double>::quiet_NaN(),
      std::numeric_limits<double>::infinity(), -3, -std::numeric_limits<double>::infinity() };
    const auto grid = makeGrid({ 10, 5, 4 }, box,
      [&odd](int i, int j, int k)
      { return j == 2 && k == 2 && i % 2 == 1 ? odd[i / 2 % 4] : waves(i, j, k); });
    const View view = Aside;
    const Picture picture = draw({ bodyOf(grid) }, view);
    int bad = 0;
    int naiveBad = 0;
    for (std::size_t p = 0; p < picture.transmittance.size(); ++p)
    {
      const float t = picture.transmittance[p][0];
      const float l = picture.radiance[p][0];
      bad += t >= 0 && t <= 1 && l >= 0 && l <= 1 ? 0 : 1;
      const double naive = std::exp(-naiveOpticalDepth(grid, view.camera(),
        static_cast<int>(p) % view.width, static_cast<int>(p) / view.width, Naive::Inclusive));
      naiveBad += naive >= 0 && naive <= 1 ? 0 : 1;
    }
    return Outcome{ std::to_string(naiveBad) + " pixels not in 0..1",
      std::to_string(bad) + " pixels not in 0..1", bad == 0 && !picture.transmittance.empty() };
  } });

const StabilityRegistration onePixel({ "volume", "a picture of 1 x 1", SameAsExact,
  []
  {
    View view = Aside;
    view.width = 1;
    view.height = 1;
    view.angle = 2;
    return compareWithExact(makeGrid({ 6, 5, 4 }, box, waves), view, Naive::Float);
  } });

double peakMemory()
{
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
  {
    if (word == "VmHWM:")
    {
      double kilobytes = 0;
      status >> kilobytes;
      return 1024 * kilobytes;
    }
  }
  return 0;
}

const StabilityRegistration large({ "volume", "a picture of 8192 x 8192",
  "memory beyond the picture's own 28 bytes a pixel under 100 MB",
  []
  {
    View view = Aside;
    view.width = 8192;
    view.height = 8192;
    view.angle = 100;
    const auto grid = makeGrid({ 6, 5, 4 }, box, waves);
    std::ofstream("/proc/self/clear_refs") << "5";
    const double before = peakMemory();
    const double picture = 28.0 * 8192 * 8192;
    const long long segments = countSegments({ bodyOf(grid) }, view);
    const double more = (peakMemory() - before - picture) / 1e6;
    return Outcome{ figure("all segments at once", 44e-6 * static_cast<double>(segments)) +
        " MB more",
      figure("more", std::max(0.0, more)) + " MB", segments > 0 && more < 100 };
  } });
}
}
}
