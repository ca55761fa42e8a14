// SPDX-License-Identifier: BSD-3-Clause
// vtkCloudCellVolume's orders of cells against the order of each pixel, and against what is known in closed form.
#include "CellVolumeReference.h"
#include "vtkCamera.h"
#include "vtkCloudCellVolume.h"
#include "vtkCloudUniformMedium.h"
#include "vtkCloudscape.h"
#include "vtkExecutive.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkSMPTools.h"
#include "vtkTestErrorObserver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace reference;

namespace
{
constexpr int Orders[] = { vtkCloudCellVolume::PixelDepth, vtkCloudCellVolume::Visibility,
  vtkCloudCellVolume::Centroid };

/// Gives each point a colour of its own, so that the order of cells is seen.
void paint(vtkStructuredGrid* grid, const std::function<std::array<double, 3>(vtkIdType)>& color)
{
  vtkNew<vtkFloatArray> colors;
  colors->SetName(nephoscope::arrays::SourceColor);
  colors->SetNumberOfComponents(3);
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    colors->InsertNextTuple(color(p).data());
  }
  grid->GetPointData()->AddArray(colors);
}

void paintAtRandom(vtkStructuredGrid* grid, unsigned seed)
{
  std::mt19937 random(seed);
  paint(grid,
    [&random](vtkIdType)
    {
      return std::array<double, 3>{ random() % 1000 / 999.0, random() % 1000 / 999.0,
        random() % 1000 / 999.0 };
    });
}

/// Cloud in patches: many cells are empty.
Density patches(double density, unsigned seed)
{
  auto random = std::make_shared<std::mt19937>(seed);
  return [random, density](int i, int j, int k)
  {
    const bool clear = std::sin(2.1 * i) * std::cos(1.7 * j + 0.5 * k) < 0.1;
    return clear ? 0.0 : density * (0.2 + (*random)() % 1000 / 999.0);
  };
}

/// The outside of a block turned about its upright axis, the more the higher.
Vector3 twisted(double a, double b, double c)
{
  const double turn = 0.8 * c;
  const double x = 2 * a - 1;
  const double y = 2 * b - 1;
  return { x * std::cos(turn) - y * std::sin(turn), x * std::sin(turn) + y * std::cos(turn), c };
}
}

class CellOrders : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Volume->SetFullCoverExtinction(1);
    this->Scape->SetCamera(this->Eye);
    this->Scape->SetSize(83, 61);
    this->Scape->AddBody(this->Volume);
  }

  void Look(const Vector3& from, const Vector3& to, double angleOrScale, bool parallel = false)
  {
    this->Eye->SetPosition(from.v);
    this->Eye->SetFocalPoint(to.v);
    this->Eye->SetViewUp(0.1, 0.2, 1);
    this->Eye->SetParallelProjection(parallel);
    this->Eye->SetViewAngle(parallel ? 30 : angleOrScale);
    this->Eye->SetParallelScale(parallel ? angleOrScale : 1);
  }

  std::vector<float> Draw(int order, const char* name = nephoscope::arrays::Radiance)
  {
    this->Volume->SetOrder(order);
    this->Scape->Modified();
    this->Scape->Update();
    auto* const array =
      vtkFloatArray::SafeDownCast(this->Scape->GetOutput()->GetPointData()->GetArray(name));
    return { array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues() };
  }

  static double Largest(const std::vector<float>& a, const std::vector<float>& b)
  {
    double largest = a.size() == b.size() ? 0 : INFINITY;
    for (std::size_t v = 0; v < std::min(a.size(), b.size()); ++v)
    {
      largest = std::max(largest, std::abs(static_cast<double>(a[v]) - b[v]));
    }
    return largest;
  }

  /// The visibility order draws what the order of each pixel draws; the centroids' does not.
  void ExpectVisibilityIsExact()
  {
    const std::vector<float> exact = this->Draw(vtkCloudCellVolume::PixelDepth);
    const std::vector<float> sorted = this->Draw(vtkCloudCellVolume::Visibility);
    EXPECT_EQ(this->Volume->GetNumberOfCycles(), 0);
    EXPECT_LT(this->Largest(exact, sorted), 1e-6);
    const double naive = this->Largest(exact, this->Draw(vtkCloudCellVolume::Centroid));
    EXPECT_GT(naive, 1e-3);
    EXPECT_EQ(this->Volume->GetNumberOfCycles(), 0);
    const char* const through = nephoscope::arrays::Transmittance;
    EXPECT_LT(this->Largest(this->Draw(vtkCloudCellVolume::PixelDepth, through),
                this->Draw(vtkCloudCellVolume::Visibility, through)),
      1e-6);
  }

  vtkNew<vtkCamera> Eye;
  vtkNew<vtkCloudCellVolume> Volume;
  vtkNew<vtkCloudscape> Scape;
};

// First of the tests and from many to few: TBB does not raise its limit again.
TEST_F(CellOrders, TheSameBitsForAnyNumberOfThreadsAndTiles)
{
  const auto grid = makeGrid(19, 14, 6, twisted, randomDensity(0.5, 5, 2));
  paintAtRandom(grid, 9);
  this->Volume->SetInputData(grid);
  this->Look({ 0, 0, 5 }, { 0, 0, 0 }, 1.5, true);
  std::vector<float> first[3];
  vtkIdType cycles = 0;
  this->Scape->GlobalWarningDisplayOff(); // it has cycles
  for (const int threads : { 4, 2, 1 })
  {
    vtkSMPTools::Initialize(threads);
    this->Scape->SetTileSize(threads == 4 ? 32 : threads == 2 ? 7 : 80);
    for (const int order : Orders)
    {
      const std::vector<float> picture = this->Draw(order);
      first[order] = threads == 4 ? picture : first[order];
      EXPECT_EQ(picture, first[order]) << threads << " threads, order " << order;
      cycles += this->Volume->GetNumberOfCycles();
    }
  }
  this->Scape->GlobalWarningDisplayOn();
  EXPECT_GT(cycles, 0);
  EXPECT_EQ(cycles % 3, 0);
}

TEST_F(CellOrders, VisibilityIsExactFromOutsideAndInside)
{
  const auto grid = makeGrid(11, 9, 7, warped, patches(4, 1));
  paintAtRandom(grid, 1);
  this->Volume->SetInputData(grid);
  this->Look({ 4, -5, 3 }, { 0, 0, 0 }, 25);
  this->ExpectVisibilityIsExact();
  this->Look({ -3, 1, -6 }, { 0, 0, 0 }, 1.6, true);
  this->ExpectVisibilityIsExact();
  this->Look({ 0.11, 0.07, 0.03 }, { 1, 0.4, 0.2 }, 100);
  this->ExpectVisibilityIsExact();
}

// Curved levels over hills on a globe whose inside is open and whose seam is closed in place only.
TEST_F(CellOrders, VisibilityIsExactOnAGlobe)
{
  const auto grid = makeGrid(33, 18, 6, globe, patches(4e-6, 3));
  paintAtRandom(grid, 2);
  this->Volume->SetInputData(grid);
  this->Look({ 2e7, 1e7, 1.2e7 }, { 0, 0, 0 }, 35);
  this->ExpectVisibilityIsExact();
  this->Look({ 2e7, 1e6, 1.2e6 }, { 0, 0, 0 }, 8e6, true);
  this->ExpectVisibilityIsExact();
  this->Look({ 6.9e6, 1e5, 2e5 }, { 6.9e6, 5e6, 1e6 }, 90);
  this->ExpectVisibilityIsExact();
}

// So it is with a medium in and around the cloud: where the order is right, no segment is moved.
TEST_F(CellOrders, OtherBodiesFindTheirPlaceBetweenCells)
{
  const auto grid = makeGrid(11, 9, 7, warped, patches(4, 4));
  this->Volume->SetInputData(grid);
  vtkNew<vtkCloudUniformMedium> haze;
  haze->SetExtinction(0.2, 0.2, 0.2);
  haze->SetColor(0.1, 0.5, 0.9);
  this->Scape->AddBody(haze);
  this->Look({ 4, -5, 3 }, { 0, 0, 0 }, 25);
  EXPECT_LT(this->Largest(this->Draw(vtkCloudCellVolume::PixelDepth),
              this->Draw(vtkCloudCellVolume::Visibility)),
    2e-6);
}

// Two long thin leaves, slanting away from the eye, the first of them 0.5 before the second but reaching further back.
// Each has optical depth tau; 1 - exp(-tau) of its colour is seen where it comes first and exp(-tau) of that behind.
TEST_F(CellOrders, LongThinCellsInClosedForm)
{
  const auto leaves = [](double a, double b, double c)
  {
    const bool first = c < 0.5;
    const double x = 20 * a - (first ? 4 : 16);
    const double inner = c > 0.3 && c < 0.7 ? 1 : 0; // levels 1 and 2 of 0 to 3
    return Vector3{ x, x + (first ? 0.1 * inner : 0.6 - 0.1 * inner), 2 * b - 1 };
  };
  for (const double tau : { 0.25, 1.0, 3.0 })
  {
    const auto grid = makeGrid(2, 2, 4, leaves, [tau](int, int, int) { return 10 * tau; });
    paint(grid,
      [](vtkIdType p) {
        return std::array<double, 3>{ p < 8 ? 1.0 : 0, 0, p < 8 ? 0 : 1.0 };
      });
    grid->BlankCell(1); // between the leaves
    this->Volume->SetInputData(grid);
    this->Look({ 0, -30, 0 }, { 0, 0, 0 }, 0.7, true);
    const double through = std::exp(-tau);
    for (const int order : Orders)
    {
      const bool right = order != vtkCloudCellVolume::Centroid;
      const std::vector<float> light = this->Draw(order);
      EXPECT_EQ(this->Volume->GetNumberOfCycles(), 0);
      for (std::size_t pixel = 0; pixel < light.size() / 3; ++pixel)
      {
        EXPECT_NEAR(light[3 * pixel], (right ? 1 : through) * (1 - through), 1e-6);
        EXPECT_NEAR(light[3 * pixel + 2], (right ? through : 1) * (1 - through), 1e-6);
      }
    }
  }
}

// Seen along its axis, a twisted grid has a cycle: it is told once, and each cell drawn once.
TEST_F(CellOrders, CyclesAreToldAndEachCellIsDrawnOnce)
{
  const auto grid = makeGrid(4, 4, 2, twisted, randomDensity(1, 3, 6));
  paintAtRandom(grid, 5);
  this->Volume->SetInputData(grid);
  this->Look({ 0, 0, 5 }, { 0, 0, 0 }, 1.5, true);
  const std::vector<float> exact = this->Draw(vtkCloudCellVolume::PixelDepth);
  vtkNew<vtkTest::ErrorObserver> warnings;
  this->Volume->AddObserver(vtkCommand::WarningEvent, warnings);
  this->Volume->SetOrderToVisibility();
  this->Scape->Update();
  EXPECT_GE(this->Volume->GetNumberOfCycles(), 1);
  EXPECT_NE(warnings->GetWarningMessage().find("SetOrderToPixelDepth"), std::string::npos)
    << warnings->GetWarningMessage();
  warnings->Clear();
  this->Eye->Azimuth(0.01);
  this->Scape->Update();
  EXPECT_GE(this->Volume->GetNumberOfCycles(), 1);
  EXPECT_FALSE(warnings->GetWarning()) << warnings->GetWarningMessage();
  this->Eye->Azimuth(-0.01);
  const std::vector<float> sorted = this->Draw(vtkCloudCellVolume::Visibility);
  EXPECT_GT(this->Largest(exact, sorted), 1e-3);
  EXPECT_LT(
    this->Largest(exact, sorted), this->Largest(exact, this->Draw(vtkCloudCellVolume::Centroid)));
  const char* const through = nephoscope::arrays::Transmittance;
  const std::vector<float> whole = this->Draw(vtkCloudCellVolume::PixelDepth, through);
  for (const int order : Orders)
  {
    EXPECT_LT(this->Largest(whole, this->Draw(order, through)), 1e-6);
  }
  EXPECT_EQ(this->Volume->GetNumberOfCycles(), 0); // by centroid none is looked for
}

// One colour is light that no order changes.
TEST_F(CellOrders, OfOneColourAllOrdersAreOnePicture)
{
  this->Volume->SetInputData(makeGrid(11, 9, 7, warped, patches(4, 1)));
  this->Volume->SetColor(1, 0.5, 0.25);
  this->Look({ 4, -5, 3 }, { 0, 0, 0 }, 25);
  const std::vector<float> exact = this->Draw(vtkCloudCellVolume::PixelDepth);
  EXPECT_LT(this->Largest(exact, this->Draw(vtkCloudCellVolume::Visibility)), 1e-6);
  EXPECT_LT(this->Largest(exact, this->Draw(vtkCloudCellVolume::Centroid)), 1e-6);
}

TEST_F(CellOrders, ColoursMultiplyTheBodysAndStrangeOnesAreBlack)
{
  const auto slab = [](double a, double b, double c) { return Vector3{ 4 * a, 4 * b, c }; };
  const auto grid = makeGrid(3, 3, 2, slab, [](int, int, int) { return 50.0; });
  paint(grid, [](vtkIdType) { return std::array<double, 3>{ 0.5, -1, std::nan("") }; });
  this->Volume->SetInputData(grid);
  this->Volume->SetColor(0.8, 0.7, 0.6);
  this->Look({ 2, 2, 9 }, { 2, 2, 0 }, 1, true);
  for (const int order : Orders)
  {
    const std::vector<float> light = this->Draw(order);
    EXPECT_NEAR(light[0], 0.4, 1e-6);
    EXPECT_EQ(light[1], 0);
    EXPECT_EQ(light[2], 0);
  }
}

TEST_F(CellOrders, ColoursOfAnotherShapeAreAnError)
{
  const auto grid = makeGrid(4, 3, 3, warped, randomDensity(1, 2, 1));
  vtkNew<vtkFloatArray> gray;
  gray->SetName(nephoscope::arrays::SourceColor);
  gray->SetNumberOfTuples(grid->GetNumberOfPoints());
  gray->Fill(1);
  grid->GetPointData()->AddArray(gray);
  this->Volume->SetInputData(grid);
  vtkNew<vtkTest::ErrorObserver> errors;
  this->Volume->AddObserver(vtkCommand::ErrorEvent, errors);
  vtkNew<vtkTest::ErrorObserver> others;
  this->Scape->AddObserver(vtkCommand::ErrorEvent, others);
  this->Scape->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, others);
  this->Scape->Update();
  EXPECT_NE(
    errors->GetErrorMessage().find("give red, green and blue for each point"), std::string::npos)
    << errors->GetErrorMessage();
}
