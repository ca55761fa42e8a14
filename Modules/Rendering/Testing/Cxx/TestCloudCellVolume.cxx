// SPDX-License-Identifier: BSD-3-Clause
#include "CellVolumeReference.h"
#include "DeepTile.h"
#include "vtkCamera.h"
#include "vtkCloudCellVolume.h"
#include "vtkCloudscape.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkSMPTools.h"
#include "vtkTestErrorObserver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

using namespace reference;

namespace
{
/// A translucent sheet across every ray at a distance.
class Sheet : public vtkCloudBody
{
public:
  static Sheet* New();
  vtkTypeMacro(Sheet, vtkCloudBody);
  double Distance = 0;
  float Opacity = 0;
  float Light = 0;

  bool IsOpaque() const override { return this->Opacity == 1; }
  bool Prepare(const nephoscope::Camera&) override { return true; }
  void Emit(const nephoscope::Camera&, nephoscope::DeepTile& tile) const override
  {
    const float tau = -std::log1p(-this->Opacity);
    const float light = this->Opacity * this->Light;
    const nephoscope::TileExtent& e = tile.extent();
    for (int p = 0; p < e.width * e.height; ++p)
    {
      tile.add(e.x0 + p % e.width, e.y0 + p / e.width,
        { this->Distance, this->Distance, { tau, tau, tau }, { light, light, light } });
    }
  }
};
vtkStandardNewMacro(Sheet);
}

class CloudCellVolume : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Volume->SetFullCoverExtinction(1);
    this->Volume->SetColor(1, 0.5, 0.25);
    this->Scape->SetCamera(this->Eye);
    this->Scape->SetSize(37, 23);
    this->Scape->SetTileSize(16);
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

  Camera KernelCamera()
  {
    const double* const p = this->Eye->GetPosition();
    const Vector3 eye = { p[0], p[1], p[2] };
    const double* const f = this->Eye->GetFocalPoint();
    const Vector3 target = { f[0], f[1], f[2] };
    const double* const u = this->Eye->GetViewUp();
    const Vector3 up = { u[0], u[1], u[2] };
    const int* const size = this->Scape->GetSize();
    return this->Eye->GetParallelProjection()
      ? Camera::parallel(eye, target, up, this->Eye->GetParallelScale(), size[0], size[1])
      : Camera::perspective(eye, target, up, this->Eye->GetViewAngle(), size[0], size[1]);
  }

  float Value(const char* name, int pixel, int component)
  {
    return this->Scape->GetOutput()->GetPointData()->GetArray(name)->GetComponent(pixel, component);
  }

  /// Compares every pixel with the sum over all tetrahedra; returns the pixels with cloud. The reference may be moved by
  /// some pixels, off faces that it would count twice.
  int Compare(vtkStructuredGrid* grid, double moved = 0)
  {
    this->Volume->SetInputData(grid);
    this->Scape->Modified();
    this->Scape->Update();
    const Camera camera = this->KernelCamera();
    int cloudy = 0;
    for (int pixel = 0; pixel < camera.width() * camera.height(); ++pixel)
    {
      const int row = pixel / camera.width();
      const Ray ray = camera.ray(pixel % camera.width() + 0.5 + moved, row + 0.5 + 0.6 * moved);
      const Real tau = opticalDepth(ray, grid);
      const double transmittance = std::exp(-tau);
      cloudy += transmittance < 1 - 1e-3;
      const double depth = this->Value(nephoscope::arrays::Depth, pixel, 0);
      EXPECT_NEAR(std::isinf(depth) ? transmittance : std::exp(-opticalDepth(ray, grid, depth)),
        std::max(0.5, transmittance), this->DepthTolerance)
        << "pixel " << pixel;
      for (int c = 0; c < 3; ++c)
      {
        EXPECT_NEAR(this->Value(nephoscope::arrays::Transmittance, pixel, c), transmittance, 1e-5)
          << "pixel " << pixel;
        EXPECT_NEAR(this->Value(nephoscope::arrays::Radiance, pixel, c),
          -this->Volume->GetColor()[c] * std::expm1(-tau), 1e-5)
          << "pixel " << pixel;
      }
    }
    this->CompareWithoutDepth();
    return cloudy;
  }

  /// Summed in any order, the picture is the same but for its Depth.
  void CompareWithoutDepth()
  {
    const int pixels = this->Scape->GetSize()[0] * this->Scape->GetSize()[1];
    std::vector<float> light[2];
    for (const bool depth : { true, false })
    {
      this->Scape->SetComputeDepth(depth);
      this->Scape->Update();
      for (int n = 0; n < 6 * pixels; ++n)
      {
        light[depth].push_back(
          this->Value(n % 6 < 3 ? nephoscope::arrays::Radiance : nephoscope::arrays::Transmittance,
            n / 6, n % 3));
        EXPECT_TRUE(depth || std::isinf(this->Value(nephoscope::arrays::Depth, n / 6, 0)));
      }
    }
    this->Scape->ComputeDepthOn();
    for (int n = 0; n < 6 * pixels; ++n)
    {
      ASSERT_NEAR(light[0][n], light[1][n], 5e-7) << "pixel " << n / 6;
    }
  }

  double DepthTolerance = 1e-5; ///< in the transmittance at Depth, which is a float
  vtkNew<vtkCamera> Eye;
  vtkNew<vtkCloudCellVolume> Volume;
  vtkNew<vtkCloudscape> Scape;
};

TEST_F(CloudCellVolume, PictureDoesNotDependOnTilesOrThreads)
{
  const auto grid = makeGrid(9, 8, 5, warped, randomDensity(0.05, 5, 8));
  this->Volume->SetInputData(grid);
  this->Look({ 0.5, -1.5, 0.8 }, { 0, 0, 0 }, 60);
  this->Scape->SetSize(101, 75);
  std::vector<float> first[2];
  // First of the tests and from many to few: TBB does not raise its limit again.
  for (int threads : { 4, 2, 1 })
  {
    vtkSMPTools::Initialize(threads);
    this->Scape->SetTileSize(threads == 4 ? 32 : threads == 2 ? 7 : 80);
    for (const bool depth : { true, false })
    {
      this->Scape->SetComputeDepth(depth);
      this->Scape->Update();
      for (int pixel = 0; pixel < 101 * 75; ++pixel)
      {
        const float value = this->Value(nephoscope::arrays::Radiance, pixel, 0);
        if (threads == 4)
        {
          first[depth].push_back(value);
        }
        ASSERT_EQ(value, first[depth][pixel]);
      }
    }
  }
}

TEST_F(CloudCellVolume, AgreesWithASumOverAllTetrahedraFromOutside)
{
  const auto grid = makeGrid(7, 6, 5, warped, randomDensity(0.05, 5, 1));
  this->Look({ 4, -5, 3 }, { 0, 0, 0 }, 25);
  EXPECT_GT(this->Compare(grid), 200);
  this->Look({ -3, 1, -6 }, { 0, 0, 0 }, 1.6, true);
  EXPECT_GT(this->Compare(grid), 200);
}

TEST_F(CloudCellVolume, AgreesInsideTheData)
{
  const auto grid = makeGrid(7, 6, 5, warped, randomDensity(0.05, 5, 2));
  this->Look({ 0.11, 0.07, 0.03 }, { 1, 0.4, 0.2 }, 100);
  EXPECT_EQ(this->Compare(grid), 37 * 23);
  this->Look({ 0.11, 0.07, 0.03 }, { -1, -0.4, 0.2 }, 150);
  EXPECT_GT(this->Compare(grid), 700);
  this->Look({ 0.11, 0.07, 0.03 }, { -1, -0.4, 0.2 }, 1, true);
  EXPECT_GT(this->Compare(grid), 200);
}

TEST_F(CloudCellVolume, AgreesFromVerticesEdgesAndFacesOfAStraightGrid)
{
  const auto cube = [](double a, double b, double c) { return Vector3{ 4 * a, 4 * b, 4 * c }; };
  const auto grid = makeGrid(5, 5, 5, cube, [](int i, int j, int k) { return 0.1 * (i + j * k); });
  this->Eye->SetViewUp(0, 0, 1);
  for (const Vector3& from :
    { Vector3{ 2, 2, 2 }, Vector3{ 2, 1.5, 2 }, Vector3{ 2, 1.5, 2.25 }, Vector3{ 2, -7, 2 } })
  {
    for (const bool parallel : { false, true })
    {
      this->Look(from, { from[0], from[1] + 1, from[2] }, parallel ? 2.875 : 60, parallel);
      this->Eye->SetViewUp(0, 0, 1);
      EXPECT_GT(this->Compare(grid, 1e-8), 100);
    }
  }
}

TEST_F(CloudCellVolume, AgreesOnAGlobeInMetres)
{
  const auto grid = makeGrid(17, 10, 5, globe, randomDensity(1e-8, 1e-5, 3));
  this->Look({ 2e7, 1e7, 1.2e7 }, { 0, 0, 0 }, 35);
  EXPECT_GT(this->Compare(grid), 200);
  this->Look({ 2e7, 1e7, 1.2e7 }, { 0, 0, 0 }, 8e6, true);
  EXPECT_GT(this->Compare(grid), 200);
  // Over the pole in the middle of the image, and within the shell, along it.
  this->Look({ 0, 0, 2.5e7 }, { 0, 0, 0 }, 35);
  EXPECT_GT(this->Compare(grid, 1e-8), 200);
  this->Look({ 6.9e6, 1e5, 2e5 }, { 6.9e6, 5e6, 1e6 }, 90);
  EXPECT_GT(this->Compare(grid), 200);
}

TEST_F(CloudCellVolume, AgreesForEveryOpticalDepth)
{
  for (double power = -12; power <= 6; power += 1.5)
  {
    const double scale = std::pow(10, power);
    const auto grid = makeGrid(4, 5, 3, warped, randomDensity(0.1 * scale, scale, 4));
    this->Look({ 4, -5, 3 }, { 0, 0, 0 }, 25);
    this->DepthTolerance = 1e-5 + 5e-7 * scale; // the rounding of a depth of 7
    this->Compare(grid);
    // Thin cloud is not lost either: relative to what it is.
    if (scale <= 1e-3)
    {
      const Camera camera = this->KernelCamera();
      for (int pixel = 0; pixel < 37 * 23; ++pixel)
      {
        const int row = pixel / 37;
        const double tau = opticalDepth(camera.ray(pixel % 37 + 0.5, row + 0.5), grid);
        EXPECT_NEAR(
          this->Value(nephoscope::arrays::Radiance, pixel, 0), -std::expm1(-tau), 1e-5 * tau);
      }
    }
  }
}

TEST_F(CloudCellVolume, FoldedAndFlatCellsAddWhatTheyTake)
{
  // Levels that cross, a level that coincides with its neighbour, a corner pulled through its cell.
  const auto folded = [](double a, double b, double c)
  {
    Vector3 p = warped(a, b, c > 0.4 && c < 0.6 ? 0.25 : c);
    p[2] += c * 0.7 * std::sin(9 * a);
    p[0] *= a > 0.4 && a < 0.5 ? -1 : 1;
    return p;
  };
  const auto grid = makeGrid(7, 6, 5, folded, randomDensity(0.05, 5, 5));
  this->Look({ 4, -5, 3 }, { 0, 0, 0 }, 25);
  EXPECT_GT(this->Compare(grid), 200);
  const auto flat = [](double a, double b, double) { return Vector3{ a, b, 0 }; };
  EXPECT_EQ(this->Compare(makeGrid(4, 3, 3, flat, randomDensity(1, 5, 5))), 0);
}

TEST_F(CloudCellVolume, SeamAndPolesOfAUniformShellShowNoTrace)
{
  // A ray through a spherical shell has the same length whatever the grid is turned to; facets are
  // shallower by the versine of a degree, more where they are grazed.
  const auto sphere = [](double a, double b, double c)
  {
    const double latitude = M_PI * (b - 0.5);
    const double across = b == 0 || b == 1 ? 0 : std::cos(latitude);
    const double longitude = 2 * M_PI * a;
    const double r = 1 + c;
    return Vector3{ r * across * std::cos(longitude), r * across * std::sin(longitude),
      r * std::sin(latitude) };
  };
  const auto grid = makeGrid(181, 91, 2, sphere, [](int, int, int) { return 1.0; });
  for (const Vector3& from : { Vector3{ 9, 0, 0 }, Vector3{ 0, 0, -9 } })
  {
    this->Look(from, { 0, 0, 0 }, 2.5, true);
    this->Volume->SetInputData(grid);
    this->Scape->Modified();
    this->Scape->Update();
    const Camera camera = this->KernelCamera();
    for (int pixel = 0; pixel < 37 * 23; ++pixel)
    {
      const int row = pixel / 37;
      const Vector3 o = camera.ray(pixel % 37 + 0.5, row + 0.5).origin;
      const double along = dot(o, camera.forward());
      const double miss2 = dot(o, o) - along * along;
      if (std::abs(miss2 - 1) > 0.02 && std::abs(miss2 - 4) > 0.08)
      {
        const double tau =
          2 * (std::sqrt(std::max(0.0, 4 - miss2)) - std::sqrt(std::max(0.0, 1 - miss2)));
        EXPECT_NEAR(this->Value(nephoscope::arrays::Transmittance, pixel, 0), std::exp(-tau),
          1e-2 * std::exp(-tau) + 1e-7);
      }
    }
  }
}

TEST_F(CloudCellVolume, OpticalDepthOfAPictureIsTheMass)
{
  // The sum over a parallel picture of optical depth times pixel area is the integral of the density.
  const auto grid = makeGrid(6, 7, 4, warped, randomDensity(0.01, 0.5, 7));
  this->Scape->SetSize(301, 283);
  this->Look({ 4, -5, 3 }, { 0, 0, 0 }, 1.9, true);
  this->Volume->SetInputData(grid);
  this->Scape->Update();
  double seen = 0;
  for (int pixel = 0; pixel < 301 * 283; ++pixel)
  {
    seen -= std::log1p(-this->Value(nephoscope::arrays::Radiance, pixel, 0));
  }
  seen *= std::pow(2 * 1.9 / 283, 2);
  // Rays down z through a fine lattice, integrated independently, as the mass.
  double mass = 0;
  const int n = 140;
  for (int i = 0; i < n * n; ++i)
  {
    const double x = -2 + 4 * (i % n + 0.5) / n;
    const int row = i / n;
    const double y = -1.5 + 3 * (row + 0.5) / n;
    mass += opticalDepth(Ray{ { x, y, -5 }, { 0, 0, 1 } }, grid) * 12 / (n * n);
  }
  EXPECT_NEAR(seen / mass, 1, 1e-3);
}

TEST_F(CloudCellVolume, SheetsBeforeWithinAndBehindAVolumeByHand)
{
  // Two kilometres of cloud from 10 to 12, extinction 0.1 + 0.6 (z - 10); sheets at 9, 11 (inside a cell) and 13.
  const auto block = [](double a, double b, double c) { return Vector3{ a, b, 12 - 2 * c }; };
  const auto grid = makeGrid(2, 2, 2, block, [](int, int, int k) { return k == 0 ? 1.3 : 0.1; });
  this->Look({ 0.5, 0.5, 0 }, { 0.5, 0.5, 1 }, 0.2, true);
  this->Volume->SetInputData(grid);
  vtkNew<Sheet> sheets[3];
  for (int s = 0; s < 3; ++s)
  {
    sheets[s]->Distance = 9 + 2 * s;
    sheets[s]->Opacity = 0.25F;
    sheets[s]->Light = 2 + s;
    this->Scape->AddBody(sheets[s]);
  }
  this->Scape->Update();
  const double t1 = std::exp(-0.1 - 0.3);
  const double t2 = std::exp(-0.7 - 0.3);
  const double inner = 0.25 * 3 + 0.75 * (1 - t2 + t2 * 0.25 * 4);
  for (int pixel = 0; pixel < 37 * 23; ++pixel)
  {
    EXPECT_NEAR(
      this->Value(nephoscope::arrays::Transmittance, pixel, 0), 0.75 * 0.75 * 0.75 * t1 * t2, 1e-6);
    EXPECT_NEAR(this->Value(nephoscope::arrays::Radiance, pixel, 0),
      0.25 * 2 + 0.75 * (1 - t1 + t1 * inner), 2e-6);
  }
}

TEST_F(CloudCellVolume, WithoutDepthOtherBodiesAreStillWhereTheyAre)
{
  // Opaque within the cloud, so that it is summed before it; then translucent, so that it has to be cut.
  const auto grid = makeGrid(7, 6, 5, warped, randomDensity(0.05, 5, 1));
  this->Look({ 4, -5, 3 }, { 0, 0, 0 }, 25);
  this->Volume->SetInputData(grid);
  vtkNew<Sheet> sheet;
  sheet->Distance = 7;
  sheet->Light = 2;
  this->Scape->AddBody(sheet);
  for (const float opacity : { 1.0F, 0.6F })
  {
    sheet->Opacity = opacity;
    sheet->Modified();
    this->CompareWithoutDepth();
  }
  // Drawn twice, the first is not the last.
  sheet->Opacity = 1;
  this->Scape->AddBody(this->Volume);
  this->CompareWithoutDepth();
}

TEST_F(CloudCellVolume, EmptyAndStrangeDensitiesAreLeftOutOrLimited)
{
  const auto block = [](double a, double b, double c) { return Vector3{ 4 * a, 4 * b, c }; };
  const auto grid = makeGrid(5, 5, 2, block,
    [](int i, int j, int) {
      return i == 0 && j == 0 ? std::nan("") : i == 4 && j == 4 ? INFINITY : i == 0 ? -3.0 : 0.5;
    });
  this->Scape->SetSize(4, 4);
  this->Look({ 2, 2, 9 }, { 2, 2, 0 }, 2, true);
  this->Eye->SetViewUp(0, 1, 0);
  this->Volume->SetInputData(grid);
  grid->BlankCell(3);   // i = 3, j = 0
  grid->BlankPoint(20); // i = 0, j = 4
  this->Scape->Update();
  const auto transmittance = [this](int x, int y)
  { return this->Value(nephoscope::arrays::Transmittance, y * 4 + x, 0); };
  EXPECT_EQ(transmittance(0, 0), 1);
  EXPECT_EQ(transmittance(3, 0), 1);
  EXPECT_EQ(transmittance(0, 3), 1);
  EXPECT_EQ(transmittance(3, 3), 0);
  EXPECT_NEAR(transmittance(1, 1), std::exp(-0.5), 1e-6);
  // Negative is nothing: half of the cell's density, and no less.
  EXPECT_NEAR(transmittance(0, 1), std::exp(-0.25), 1e-6);
  EXPECT_EQ(this->Volume->GetNumberOfDrawnCells(), 13);
}

TEST_F(CloudCellVolume, OtherStructuredDataDrawTheSame)
{
  vtkNew<vtkImageData> image;
  image->SetExtent(3, 6, -1, 3, 2, 4);
  image->SetSpacing(0.5, 0.4, 0.3);
  image->SetOrigin(-2, -1, -1);
  vtkNew<vtkRectilinearGrid> rectilinear;
  vtkNew<vtkStructuredGrid> curvilinear;
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> fraction;
  fraction->SetName(nephoscope::arrays::CloudFraction);
  for (vtkIdType p = 0; p < image->GetNumberOfPoints(); ++p)
  {
    points->InsertNextPoint(image->GetPoint(p));
    fraction->InsertNextValue(p % 7);
  }
  curvilinear->SetExtent(image->GetExtent());
  rectilinear->SetExtent(image->GetExtent());
  curvilinear->SetPoints(points);
  vtkNew<vtkDoubleArray> axes[3];
  for (int a = 0; a < 3; ++a)
  {
    for (int i = image->GetExtent()[2 * a]; i <= image->GetExtent()[2 * a + 1]; ++i)
    {
      axes[a]->InsertNextValue(image->GetOrigin()[a] + i * image->GetSpacing()[a]);
    }
  }
  rectilinear->SetXCoordinates(axes[0]);
  rectilinear->SetYCoordinates(axes[1]);
  rectilinear->SetZCoordinates(axes[2]);
  this->Look({ 4, -5, 3 }, { 0.3, -0.5, 0 }, 20);
  std::vector<float> first;
  for (vtkDataSet* grid : { static_cast<vtkDataSet*>(image), static_cast<vtkDataSet*>(rectilinear),
         static_cast<vtkDataSet*>(curvilinear) })
  {
    grid->GetPointData()->AddArray(fraction);
    this->Volume->SetInputData(grid);
    this->Scape->Modified();
    this->Scape->Update();
    for (int pixel = 0; pixel < 37 * 23; ++pixel)
    {
      const float value = this->Value(nephoscope::arrays::Transmittance, pixel, 0);
      if (grid == image)
      {
        first.push_back(value);
      }
      EXPECT_NEAR(value, first[pixel], 1e-5);
    }
  }
  EXPECT_LT(*std::min_element(first.begin(), first.end()), 0.5);
}

TEST_F(CloudCellVolume, CondensateFollowsMaxWithTheEfficiency)
{
  // One box of 2 units that stand for 1000 m: 0.3 g/kg of droplets and 0.1 g/kg of ice in air of 1 kg/m3.
  vtkNew<vtkImageData> box;
  box->SetDimensions(2, 2, 2);
  box->SetSpacing(1, 1, 2);
  const std::pair<const char*, double> values[] = { { nephoscope::arrays::LiquidWater, 3e-4 },
    { nephoscope::arrays::IceWater, 1e-4 }, { nephoscope::arrays::Pressure, 287.05 * 250 },
    { nephoscope::arrays::Temperature, 250 } };
  for (const auto& [name, value] : values)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->SetNumberOfTuples(8);
    array->FillComponent(0, value);
    box->GetPointData()->AddArray(array);
  }
  vtkNew<vtkDoubleArray> heightScale;
  heightScale->SetName(nephoscope::arrays::HeightScale);
  heightScale->InsertNextValue(0.002);
  box->GetFieldData()->AddArray(heightScale);
  this->Volume->SetInputData(box);
  this->Volume->SetExtinctionRuleToCondensate();
  this->Volume->SetExtinctionScale(0.01);
  this->Scape->SetSize(1, 1);
  this->Look({ 0.5, 0.5, 9 }, { 0.5, 0.5, 0 }, 0.1, true);
  this->Scape->Update();
  const double liquid = 2 * 0.75 / 10e-6 * 3e-4 / 1000;
  const double ice = 2 * 0.75 / 30e-6 * 1e-4 / 917;
  EXPECT_NEAR(this->Value(nephoscope::arrays::Transmittance, 0, 0),
    std::exp(-0.01 * 1000 * (liquid + ice)), 1e-6);
}

TEST_F(CloudCellVolume, ErrorsSayWhatIsWrong)
{
  vtkNew<vtkTest::ErrorObserver> errors;
  vtkNew<vtkTest::ErrorObserver> others;
  this->Volume->AddObserver(vtkCommand::ErrorEvent, errors);
  this->Scape->AddObserver(vtkCommand::ErrorEvent, others);
  this->Scape->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, others);
  const auto expect = [this, &errors](vtkDataObject* data, const char* message)
  {
    this->Volume->SetInputData(data);
    this->Scape->Modified();
    this->Scape->Update();
    EXPECT_NE(errors->GetErrorMessage().find(message), std::string::npos)
      << errors->GetErrorMessage();
    errors->Clear();
  };
  vtkNew<vtkPolyData> surface;
  expect(surface, "The input is vtkPolyData; give a vtkStructuredGrid");
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 2, 1);
  expect(image, "The grid of 3 x 2 x 1 points has no cells");
  image->SetDimensions(3, 2, 2);
  expect(image, "no point array CloudFraction (it has: none)");
  vtkNew<vtkFloatArray> array;
  array->SetName(nephoscope::arrays::CloudFraction);
  array->SetNumberOfComponents(2);
  array->SetNumberOfTuples(12);
  image->GetPointData()->AddArray(array);
  expect(image, "12 tuples of 2 for 12 points");
  this->Volume->SetExtinctionRuleToCondensate();
  expect(image, "no point array IceWater (it has: CloudFraction)");
  vtkNew<vtkDoubleArray> heightScale;
  heightScale->SetName(nephoscope::arrays::HeightScale);
  heightScale->InsertNextValue(-1);
  image->GetFieldData()->AddArray(heightScale);
  expect(image, "HeightScale is -1; it has to be positive");
  vtkNew<vtkStructuredGrid> hollow;
  hollow->SetDimensions(3, 2, 2);
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(5);
  hollow->SetPoints(points);
  expect(hollow, "The grid of 3 x 2 x 2 has 5 points; give one for each place");
}
