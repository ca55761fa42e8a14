// SPDX-License-Identifier: BSD-3-Clause
// Where walking rays through sparse voxels is known to fail.
#include "TestPicture.h"

#include "CloudArrays.h"
#include "vtkCloudVoxelVolume.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephoscope
{
namespace stability
{
namespace
{
constexpr const char* ClosedForm = "the trapezoids' transmittance within 1e-5";
constexpr int Half = 16; // voxels from -16 to 15 along each axis

/// Depends on all three indices and is linear along z between the voxels.
double waves(int i, int j, int k)
{
  const bool inside = std::min({ i, j, k }) >= -Half && std::max({ i, j, k }) < Half;
  return inside ? 0.04 + 0.03 * std::sin(1.3 * i + 0.4) * std::cos(0.9 * j - 0.2 * k) : 0;
}

/// 4 x 4 x 4 bricks of voxels of size 1, the scene's units.
template <class Density>
vtkSmartPointer<vtkCloudVoxelVolume> voxels(const Density& density)
{
  vtkNew<vtkIntArray> origins;
  origins->SetName(arrays::VoxelOrigins);
  origins->SetNumberOfComponents(3);
  vtkNew<vtkFloatArray> values;
  values->SetName(arrays::VoxelBricks);
  values->SetNumberOfComponents(512);
  for (int b = 0; b < 64; ++b)
  {
    const int first[3] = { b % 4 * 8 - Half, b / 4 % 4 * 8 - Half, b / 16 * 8 - Half };
    origins->InsertNextTypedTuple(first);
    float brick[512];
    for (int v = 0; v < 512; ++v)
    {
      brick[v] =
        static_cast<float>(density(first[0] + v % 8, first[1] + v / 8 % 8, first[2] + v / 64));
    }
    values->InsertNextTypedTuple(brick);
  }
  vtkNew<vtkDoubleArray> matrix;
  matrix->SetName(arrays::VoxelToScene);
  for (int n = 0; n < 16; ++n)
  {
    matrix->InsertNextValue(n % 5 == 0 ? 1 : 0);
  }
  vtkNew<vtkPolyData> bricks;
  bricks->GetPointData()->AddArray(origins);
  bricks->GetPointData()->AddArray(values);
  bricks->GetFieldData()->AddArray(matrix);
  auto body = vtkSmartPointer<vtkCloudVoxelVolume>::New();
  body->SetInputData(bricks);
  body->SetTowardSun(0, 0, 1);
  body->SetSunColor(1, 1, 1);
  body->SetAmbient(0);
  return body;
}

/// Down a line of voxels, or midway between two along x, from a height on.
double depthBelow(double height, int i, int j, bool between)
{
  const auto at = [=](int k)
  { return between ? 0.5 * (waves(i, j, k) + waves(i + 1, j, k)) : waves(i, j, k); };
  double sum = 0;
  for (int k = -Half - 1; k < Half; ++k)
  {
    const double part = std::min(std::max(height - k, 0.0), 1.0);
    sum += part * (at(k) + 0.5 * part * (at(k + 1) - at(k)));
  }
  return sum;
}

/// Rays one unit apart straight down from a height on. Theirs adds what `naiveDepth` says of the true depths from there and in all.
template <class NaiveDepth>
Outcome fromAbove(double height, bool between, const NaiveDepth& naiveDepth)
{
  // Pixels are one unit wide: the middle of each lies on a voxel's centre, where edges of cells meet.
  const double x = between ? 0.5 : 0;
  const View view{ { x, 0.5, height }, { x, 0.5, height - 1 }, 30, 9, 17, 18 };
  const Camera camera = view.camera();
  const Picture picture = draw({ voxels(waves) }, view);
  double ours = picture.transmittance.empty() ? 1 : 0;
  double naive = 0;
  for (std::size_t p = 0; p < picture.transmittance.size(); ++p)
  {
    const int column = static_cast<int>(p) % view.width;
    const int row = static_cast<int>(p) / view.width;
    const Ray ray = camera.ray(column + 0.5, row + 0.5);
    const int i = static_cast<int>(std::floor(ray.origin[0] + 0.01));
    const int j = static_cast<int>(std::lround(ray.origin[1]));
    const double depth = depthBelow(height, i, j, between);
    const double truth = std::exp(-depth);
    const double whole = depthBelow(Half, i, j, between);
    const double error = std::abs(static_cast<double>(picture.transmittance[p][0]) - truth);
    ours = std::isfinite(error) ? std::max(ours, error) : 1;
    naive = std::max(naive, std::abs(std::exp(-naiveDepth(depth, whole)) - truth));
  }
  return Outcome{ figure("error", naive), figure("error", ours), ours <= 1e-5 };
}

const StabilityRegistration alongEdges(
  { "voxels", "rays along the edges of cells and bricks", ClosedForm,
    [] { return fromAbove(40, false, [](double depth, double) { return 4 * depth; }); } });

const StabilityRegistration alongFaces({ "voxels", "rays in the faces of cells and bricks",
  ClosedForm, [] { return fromAbove(40, true, [](double depth, double) { return 2 * depth; }); } });

double wholeColumn(double, double whole)
{
  return whole;
}

const StabilityRegistration eyeInCell({ "voxels", "the eye inside a cell", ClosedForm,
  [] { return fromAbove(3.3, false, wholeColumn); } });

const StabilityRegistration eyeOnFace({ "voxels", "the eye on the face of a brick", ClosedForm,
  [] { return fromAbove(8, true, wholeColumn); } });

const StabilityRegistration empty({ "voxels", "a tree in which every voxel is 0, negative or NaN",
  "nothing is there: transmittance 1, radiance 0",
  []
  {
    const double odd[] = { 0, -3, std::numeric_limits<double>::quiet_NaN() };
    const View aside{ { 70, -60, 40 }, { 0, 0, 0 }, 28, 0, 24, 16 };
    const Picture picture =
      draw({ voxels([&odd](int i, int j, int) { return odd[(i + j + 2 * Half) % 3]; }) }, aside);
    int wrong = picture.transmittance.empty() ? 1 : 0;
    for (std::size_t p = 0; p < picture.transmittance.size(); ++p)
    {
      wrong += picture.transmittance[p][0] == 1 && picture.radiance[p][0] == 0 ? 0 : 1;
    }
    // The middle of the bounds of nothing.
    const double middle =
      0.5 * (std::numeric_limits<double>::infinity() - std::numeric_limits<double>::infinity());
    return Outcome{ figure("a box about", middle), std::to_string(wrong) + " pixels wrong",
      wrong == 0 };
  } });

const StabilityRegistration opaque(
  { "voxels", "an optical depth of 1e6 a voxel, the sun behind the eye",
    "opaque, and half of the light comes back, as from (1 - exp(-2 tau)) / 2, within 0.01",
    []
    {
      const View above{ { 0.2, 0.3, 40 }, { 0.2, 0.3, 0 }, 30, 6, 8, 6 };
      const Picture picture = draw({ voxels([](int, int, int) { return 1e6; }) }, above);
      double ours = picture.radiance.empty() ? 1 : 0;
      for (std::size_t p = 0; p < picture.radiance.size(); ++p)
      {
        const double error = std::abs(static_cast<double>(picture.radiance[p][0]) - 0.5) +
          static_cast<double>(picture.transmittance[p][0]);
        ours = std::isfinite(error) ? std::max(ours, error) : 1;
      }
      // What gets to the middle of a step.
      const double naive = std::abs(std::exp(-0.5e6) - 0.5);
      return Outcome{ figure("error", naive), figure("error", ours), ours <= 0.01 };
    } });
}
}
}
