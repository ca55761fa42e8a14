// SPDX-License-Identifier: BSD-3-Clause
// Where orders of cells are known to fail: what each pixel's own order, a visibility order and that of centroids draw.
#include "TestPicture.h"

#include "CloudArrays.h"
#include "vtkCloudCellVolume.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkStructuredGrid.h"

#include <algorithm>
#include <cmath>

namespace nephoscope
{
namespace stability
{
namespace
{
constexpr double Pi = 3.14159265358979323846;

using ColorOf = std::function<RGB(int, int, int)>;

void paint(vtkStructuredGrid* grid, const ColorOf& color)
{
  int n[3];
  grid->GetDimensions(n);
  vtkNew<vtkFloatArray> colors;
  colors->SetName(arrays::SourceColor);
  colors->SetNumberOfComponents(3);
  for (int p = 0; p < n[0] * n[1] * n[2]; ++p)
  {
    colors->InsertNextTuple(color(p % n[0], p / n[0] % n[1], p / n[0] / n[1]).data());
  }
  grid->GetPointData()->AddArray(colors);
}

/// A picture in some order, and the cycles that were reported with it.
struct InOrder
{
  Picture picture;
  long long cycles;
};

InOrder drawInOrder(vtkStructuredGrid* grid, const View& view, int order, double scale = 1)
{
  const auto body = bodyOf(grid);
  body->SetOrder(order);
  body->SetExtinctionScale(scale);
  vtkObject::GlobalWarningDisplayOff(); // of cycles, which are asked for
  const Picture picture = draw({ body }, view);
  vtkObject::GlobalWarningDisplayOn();
  return { picture, body->GetNumberOfCycles() };
}

double largest(const std::vector<RGB>& a, const std::vector<RGB>& b)
{
  double difference = a.empty() || a.size() != b.size() ? 1 : 0;
  for (std::size_t p = 0; p < std::min(a.size(), b.size()); ++p)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      const double here = std::abs(static_cast<double>(a[p][c]) - b[p][c]);
      difference = std::isfinite(here) ? std::max(difference, here) : 1;
    }
  }
  return difference;
}

/// Whether cells were drawn once each, whatever their order: the transmittance does not depend on it.
bool eachOnce(const InOrder& sorted, const InOrder& exact)
{
  return largest(sorted.picture.transmittance, exact.picture.transmittance) < 1e-6;
}

/// Three tetrahedra over the sides of a triangle with the corners given, each rising from its first end, the others below it
/// there; cells 0, 2 and 4 of a grid whose corners coincide but for the four of the tetrahedron in the middle.
vtkSmartPointer<vtkStructuredGrid> threeTetrahedra(const Vector3 (&corner)[3])
{
  auto grid = makeGrid(
    { 6, 2, 2 },
    [](double, double, double) {
      return Vector3{ 0, 0, 0 };
    },
    [](int, int, int) { return 1e4; });
  for (int n = 0; n < 3; ++n)
  {
    const Vector3 side = corner[(n + 1) % 3] - corner[n];
    const Vector3 across = 0.12 * normalized(cross({ 0, 0, 1 }, side));
    const Vector3 low = corner[n] - 0.3 * side + Vector3{ 0, 0, 0.05 * n };
    const Vector3 high = corner[n] + 1.3 * side + Vector3{ 0, 0, 0.8 + 0.05 * n };
    const Vector3 ends[4] = { low - across, low + across, high - across,
      high + across + Vector3{ 0, 0, 0.05 } };
    // By bit pattern; the tetrahedron in the middle has the corners 0, 3, 5 and 6.
    constexpr int End[8] = { 0, 0, 0, 1, 0, 2, 3, 1 };
    for (int v = 0; v < 8; ++v)
    {
      grid->GetPoints()->SetPoint(
        2 * n + (v & 1) + 6 * (v >> 1 & 1) + 12 * (v >> 2), ends[End[v]].v);
    }
  }
  grid->BlankCell(1);
  grid->BlankCell(3);
  paint(grid,
    [](int i, int, int) {
      return RGB{ i / 2 == 0 ? 1.0F : 0, i / 2 == 1 ? 1.0F : 0, i / 2 == 2 ? 1.0F : 0 };
    });
  return grid;
}

/// At corner n + 1, tetrahedron n is before the next: how often another is seen there.
int wrongCrossings(const InOrder& drawn, const View& view, const Vector3 (&corner)[3])
{
  int wrong = 0;
  for (int n = 0; n < 3; ++n)
  {
    const Projected seen = view.camera().project(corner[(n + 1) % 3]);
    const auto p = static_cast<std::size_t>(seen.y) * view.width + static_cast<std::size_t>(seen.x);
    wrong += drawn.picture.radiance[p][n] > 0.999F ? 0 : 1;
  }
  return wrong;
}

const StabilityRegistration threeInACycle({ "order", "a visibility cycle of three tetrahedra",
  "sorted by pixel: the nearer is seen at each crossing; as one order: one cycle told, each drawn "
  "once, one crossing wrong",
  []
  {
    Vector3 corner[3];
    for (int n = 0; n < 3; ++n)
    {
      corner[n] = { std::cos(2 * Pi * n / 3), std::sin(2 * Pi * n / 3), 0 };
    }
    const auto grid = threeTetrahedra(corner);
    const View above{ { 0, 0, 5 }, { 0, 0, 0 }, 30, 1.6, 96, 96 };
    const int byPixel =
      wrongCrossings(drawInOrder(grid, above, vtkCloudCellVolume::PixelDepth), above, corner);
    const InOrder sorted = drawInOrder(grid, above, vtkCloudCellVolume::Visibility);
    const int wrong = wrongCrossings(sorted, above, corner);
    const int naive =
      wrongCrossings(drawInOrder(grid, above, vtkCloudCellVolume::Centroid), above, corner);
    constexpr double Thin = 1e-3; // so that all shine through each other
    const bool once = eachOnce(drawInOrder(grid, above, vtkCloudCellVolume::Visibility, Thin),
      drawInOrder(grid, above, vtkCloudCellVolume::PixelDepth, Thin));
    return Outcome{ std::to_string(naive) + " of 3 crossings wrong by centroids",
      std::to_string(byPixel) + " wrong by pixel; " + std::to_string(wrong) + " in one order, " +
        std::to_string(sorted.cycles) + " cycle told" + (once ? "" : ", NOT each drawn once"),
      byPixel == 0 && wrong == 1 && sorted.cycles == 1 && once };
  } });

/// Errors of the three orders against each ray's own light.
struct Errors
{
  double byPixel = 0;
  double visibility = 0;
  double centroid = 0;
  long long cycles = 0;
  int raysThatComeBack = 0;
  bool once = false;
};

Errors compare(vtkStructuredGrid* grid, const View& view)
{
  const Camera camera = view.camera();
  std::vector<RGB> truth;
  Errors errors;
  for (int p = 0; p < view.width * view.height; ++p)
  {
    const ExactLight light = exactLight(grid, camera, p % view.width, p / view.width, 1e-9);
    errors.raysThatComeBack += light.comesBack ? 1 : 0;
    truth.push_back({ static_cast<float>(light.radiance[0]), static_cast<float>(light.radiance[1]),
      static_cast<float>(light.radiance[2]) });
  }
  const InOrder exact = drawInOrder(grid, view, vtkCloudCellVolume::PixelDepth);
  const InOrder sorted = drawInOrder(grid, view, vtkCloudCellVolume::Visibility);
  errors.byPixel = largest(exact.picture.radiance, truth);
  errors.visibility = largest(sorted.picture.radiance, truth);
  errors.centroid =
    largest(drawInOrder(grid, view, vtkCloudCellVolume::Centroid).picture.radiance, truth);
  errors.cycles = sorted.cycles;
  errors.once = eachOnce(sorted, exact);
  return errors;
}

std::string orderFigures(const Errors& errors)
{
  return figure("error", errors.byPixel) + " by pixel; " + figure("error", errors.visibility) +
    " in one order, " + std::to_string(errors.cycles) + " cycles";
}

RGB levelColor(int i, int j, int k)
{
  return { k % 2 == 0 ? 1.0F : 0.1F, (i + j) % 2 == 0 ? 0.9F : 0.2F, 0.5F };
}

const StabilityRegistration curvedLevels(
  { "order", "a cycle made by curved levels: rays leave a cell over a ridge and come back into it",
    "radiance of each ray's own order within 1e-5: tetrahedra of upright columns have no cycle",
    []
    {
      const auto grid = makeGrid(
        { 4, 5, 4 },
        [](double a, double b, double c)
        {
          const double ridge = 0.3 * std::cos(3 * Pi * a) * std::cos(4 * Pi * b);
          return Vector3{ 3 * a, 4 * b, 1.5 * c + std::sin(Pi * c) * ridge };
        },
        [](int i, int j, int) { return 0.4 + 0.3 * ((i + j) % 2); });
      paint(grid, levelColor);
      const Errors errors = compare(grid, { { -6, -5, 1.2 }, { 1.5, 2, 0.75 }, 28, 0, 24, 16 });
      return Outcome{ figure("error", errors.centroid) + " by centroids, " +
          std::to_string(errors.raysThatComeBack) + " rays come back",
        orderFigures(errors),
        errors.byPixel < 1e-5 && errors.visibility < 1e-5 && errors.cycles == 0 &&
          errors.raysThatComeBack > 0 };
    } });

const StabilityRegistration turnedColumns({ "order",
  "a cycle of cells that share faces: columns that turn with height, seen along their axis",
  "by pixel within 1e-5; as one order: cycles told, each drawn once",
  []
  {
    const auto grid = makeGrid(
      { 4, 4, 2 },
      [](double a, double b, double c)
      {
        const double x = 2 * a - 1;
        const double y = 2 * b - 1;
        const double turn = 0.8 * c;
        return Vector3{ x * std::cos(turn) - y * std::sin(turn),
          x * std::sin(turn) + y * std::cos(turn), c };
      },
      [](int i, int j, int) { return 1 + 0.5 * ((i + j) % 2); });
    paint(grid, levelColor);
    const Errors errors = compare(grid, { { 0, 0, 5 }, { 0, 0, 0 }, 30, 1.5, 24, 16 });
    return Outcome{ figure("error", errors.centroid) + " by centroids",
      orderFigures(errors) + (errors.once ? "" : ", NOT each drawn once"),
      errors.byPixel < 1e-5 && errors.cycles > 0 && errors.once };
  } });
}
}
}
