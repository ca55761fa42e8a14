// SPDX-License-Identifier: BSD-3-Clause
#include "CloudTexture.h"
#include "FogBall.h"
#include "RenderingTest.h"
#include "vtkCellArray.h"
#include "vtkCloudCellVolume.h"
#include "vtkCloudSurface.h"
#include "vtkCloudUniformMedium.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkSphereSource.h"
#include "vtkTestErrorObserver.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace
{
/// A rectangle from a corner and two edges, in cells x cells pairs of triangles; normals u x v.
vtkSmartPointer<vtkPolyData> sheet(const nephoscope::Vector3& corner, const nephoscope::Vector3& u,
  const nephoscope::Vector3& v, int cells)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> triangles;
  for (int j = 0; j <= cells; ++j)
  {
    for (int i = 0; i <= cells; ++i)
    {
      const nephoscope::Vector3 p = corner + (double(i) / cells) * u + (double(j) / cells) * v;
      points->InsertNextPoint(p.v);
      if (i < cells && j < cells)
      {
        const vtkIdType at = j * (cells + 1) + i;
        const vtkIdType lower[3] = { at, at + 1, at + cells + 2 };
        const vtkIdType upper[3] = { at, at + cells + 2, at + cells + 1 };
        triangles->InsertNextCell(3, lower);
        triangles->InsertNextCell(3, upper);
      }
    }
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(triangles);
  return data;
}

/// Cloud fraction 1 in -1.5 .. 1.5 along x and z, -1 .. 1 along y, in uneven numbers of cells.
vtkSmartPointer<vtkImageData> uniformBox()
{
  auto box = vtkSmartPointer<vtkImageData>::New();
  box->SetDimensions(4, 5, 6);
  box->SetOrigin(-1.5, -1, -1.5);
  box->SetSpacing(1, 0.5, 0.6);
  vtkNew<vtkFloatArray> fraction;
  fraction->SetName(nephoscope::arrays::CloudFraction);
  fraction->SetNumberOfTuples(box->GetNumberOfPoints());
  fraction->Fill(1);
  box->GetPointData()->AddArray(fraction);
  return box;
}

/// A wall that faces the eye, at a distance from it.
vtkSmartPointer<vtkPolyData> wall(double distance, double half, int cells = 3)
{
  return sheet({ -half, distance - 5, -half }, { 2 * half, 0, 0 }, { 0, 0, 2 * half }, cells);
}
}

class CloudSurface : public RenderingTest
{
protected:
  void SetUp() override
  {
    this->RenderingTest::SetUp();
    this->Sphere->SetRadius(1);
    this->Sphere->SetThetaResolution(96);
    this->Sphere->SetPhiResolution(64);
    this->Sphere->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    this->Surface->SetInputConnection(this->Sphere->GetOutputPort());
  }
  vtkNew<vtkSphereSource> Sphere;
  vtkNew<vtkCloudSurface> Surface;
};

TEST_F(CloudSurface, SilhouetteOfASphereHasTheAreaOfItsCone)
{
  this->Scape->SetSize(610, 430);
  this->Draw({ this->Surface });
  double hidden = 0;
  for (int y = 0; y < 430; ++y)
  {
    for (int x = 0; x < 610; ++x)
    {
      hidden += 1 - this->Transmittance(x, y);
    }
  }
  // The cone about a unit sphere 5 away meets the plane at depth 1 in a circle of radius 1 / sqrt(24).
  const double pixel = this->KernelCamera().pixel();
  const double circle = vtkMath::Pi() / 24 / (pixel * pixel);
  // The 96-sided mesh lies inside the sphere, by up to 1 - cos(pi/64)^2 = 0.24 % of the area.
  EXPECT_LT(hidden, circle * 1.0005);
  EXPECT_GT(hidden, circle * 0.9971);
}

TEST_F(CloudSurface, SamplesAreAveragedAndTheirDepthIsTheMedian)
{
  // Three rays a pixel each way: the picture of three times the size, averaged.
  vtkNew<vtkCloudGradedBackdrop> backdrop;
  backdrop->SetZenith(0, 1, 0);
  backdrop->SetNadir(1, 0, 0);
  this->Scape->SetBackdrop(backdrop);
  this->Surface->SetOpacity(0.5);
  this->Surface->SetBackFaces(true);
  this->Scape->SetSize(3 * Width, 3 * Height);
  this->Draw({ this->Surface });
  vtkNew<vtkImageData> fine;
  fine->DeepCopy(this->Scape->GetOutput());
  this->Scape->SetSize(Width, Height);
  this->Scape->SetSamples(3);
  this->Draw({ this->Surface });
  for (const char* name : { nephoscope::arrays::Radiance, nephoscope::arrays::Depth })
  {
    vtkDataArray* const array = fine->GetPointData()->GetArray(name);
    for (int y = 0; y < Height; ++y)
    {
      for (int x = 0; x < Width; ++x)
      {
        std::vector<double> values;
        for (int s = 0; s < 9; ++s)
        {
          values.push_back(array->GetComponent((3 * y + s / 3) * 3 * Width + 3 * x + s % 3, 0));
        }
        std::sort(values.begin(), values.end());
        const double mean = std::accumulate(values.begin(), values.end(), 0.0) / 9;
        const bool depth = name == nephoscope::arrays::Depth;
        ASSERT_FLOAT_EQ(this->At(name, x, y), depth ? values[4] : mean) << x << ' ' << y;
      }
    }
  }
}

TEST_F(CloudSurface, ClosedSurfaceIsEnteredAndLeftOnceByEveryRay)
{
  this->Surface->SetOpacity(0.5);
  this->Draw({ this->Surface });
  std::vector<double> front;
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      front.push_back(this->Transmittance(x, y));
      EXPECT_TRUE(front.back() == 1 || std::abs(front.back() - 0.5) < 1e-6) << front.back();
    }
  }
  const vtkIdType faces = this->Surface->GetNumberOfDrawnCells();
  this->Surface->BackFacesOn();
  this->Draw({ this->Surface });
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      const double once = front[static_cast<std::size_t>(y) * Width + x];
      EXPECT_NEAR(this->Transmittance(x, y), once * once, 1e-6);
    }
  }
  // From 5 radii away less than half of it faces the eye.
  EXPECT_GT(faces, 0);
  EXPECT_GT(this->Surface->GetNumberOfDrawnCells(), 2 * faces);
}

TEST_F(CloudSurface, EyeInsideSeesBackFacesOnlyOnRequest)
{
  this->Camera->SetPosition(0.1, -0.2, 0.05);
  this->Surface->SetOpacity(0.25);
  for (const bool back : { false, true })
  {
    this->Surface->SetBackFaces(back);
    this->Draw({ this->Surface });
    for (int y = 0; y < Height; ++y)
    {
      for (int x = 0; x < Width; ++x)
      {
        ASSERT_NEAR(this->Transmittance(x, y), back ? 0.75 : 1, 1e-6);
      }
    }
  }
}

TEST_F(CloudSurface, ShadesAPlainWallByNormalAndSun)
{
  this->Surface->SetInputData(wall(4, 0.5));
  this->Surface->SetTowardSun(0, -3, 4); // n . l = 0.6
  this->Surface->SetWrap(0);
  this->Surface->SetAmbient(0.25);
  this->Surface->SetSunColor(1, 0.9, 0.8);
  this->Surface->SetSkyColor(0.5, 0.6, 0.7);
  this->Surface->SetColor(0.9, 0.8, 0.7);
  this->Surface->SetOpacity(0.75);
  this->Draw({ this->Surface });
  const double sun[3] = { 1, 0.9, 0.8 };
  const double sky[3] = { 0.5, 0.6, 0.7 };
  const double color[3] = { 0.9, 0.8, 0.7 };
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(
      this->Radiance(30, 21, c), 0.75 * color[c] * (0.75 * 0.6 * sun[c] + 0.25 * sky[c]), 1e-6);
  }
  EXPECT_NEAR(this->Transmittance(30, 21), 0.25, 1e-6);
}

TEST_F(CloudSurface, AttributesAreThoseOfTheRaysPointOnATiltedTriangle)
{
  // A wall that is tilted strongly to the line of sight; opacity is a linear function of position.
  vtkSmartPointer<vtkPolyData> tilted = sheet({ -4, -4, -1 }, { 8, 0, 0 }, { 0, 12, 4 }, 2);
  vtkNew<vtkFloatArray> opacity;
  opacity->SetName(nephoscope::arrays::Opacity);
  const auto linear = [](const nephoscope::Vector3& p)
  { return 0.1 + 0.05 * (p[0] + 4) + 0.03 * (p[1] + 4); };
  for (vtkIdType i = 0; i < tilted->GetNumberOfPoints(); ++i)
  {
    const double* const p = tilted->GetPoint(i);
    opacity->InsertNextValue(static_cast<float>(linear({ p[0], p[1], p[2] })));
  }
  tilted->GetPointData()->AddArray(opacity);
  this->Surface->SetInputData(tilted);
  this->Surface->SetOpacityModeToArray();
  this->Surface->BackFacesOn();
  this->Draw({ this->Surface });
  int hits = 0;
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      // Plane: z = -1 + (y + 4) / 3.
      const nephoscope::Ray ray = this->RayOf(x, y);
      const double t =
        (-1 + (ray.origin[1] + 4) / 3 - ray.origin[2]) / (ray.direction[2] - ray.direction[1] / 3);
      const nephoscope::Vector3 at = ray.origin + t * ray.direction;
      if (t > 0 && std::abs(at[0]) < 3.99 && at[1] > -3.99 && at[1] < 7.99)
      {
        ++hits;
        ASSERT_NEAR(1 - this->Transmittance(x, y), linear(at), 2e-6) << x << ' ' << y;
      }
    }
  }
  EXPECT_GT(hits, 500);
}

TEST_F(CloudSurface, DepthIsTheDistanceAlongTheRay)
{
  this->Surface->SetInputData(wall(4, 1.4));
  this->Draw({ this->Surface });
  for (int x = 12; x < 49; x += 4)
  {
    EXPECT_NEAR(this->Depth(x, 20), 4 / this->RayOf(x, 20).direction[1], 1e-6);
  }
}

TEST_F(CloudSurface, TranslucentSurfacesAroundAndInAVolumeMakeTheHandComputedPixel)
{
  // Along the middle ray: a wall at 3, opacity 1/4; a volume from 4 to 6, optical depth 2 ln 2; a wall at 5, opacity 1/2,
  // in the volume's middle; a wall at 7, opacity 3/4.
  const double places[3] = { 3, 5, 7 };
  const double opacities[3] = { 0.25, 0.5, 0.75 };
  const double colors[3] = { 0.8, 0.4, 0.4 };
  vtkNew<vtkCloudSurface> walls[3];
  for (int i = 0; i < 3; ++i)
  {
    walls[i]->SetInputData(wall(places[i], 0.5));
    walls[i]->SetOpacity(opacities[i]);
    walls[i]->SetColor(colors[i], colors[i], colors[i]);
    walls[i]->SetAmbient(1);
    walls[i]->SetSkyColor(1, 1, 1);
  }
  vtkNew<FogBall> ball;
  ball->Extinction = std::log(2.0);
  std::fill_n(ball->Glow, 3, 0.6);
  vtkNew<vtkCloudCellVolume> cells;
  cells->SetInputData(uniformBox());
  cells->SetFullCoverExtinction(std::log(2.0));
  cells->SetColor(0.6, 0.6, 0.6);
  vtkNew<vtkCloudGradedBackdrop> backdrop;
  backdrop->SetColor(1.2, 1.2, 1.2);
  this->Scape->SetBackdrop(backdrop);
  // Each half of the volume lets 1/2 through and adds 0.3. From behind: 1.2 -> 0.3 + 0.3 = 0.6 -> 0.3 + 0.3 = 0.6
  // -> 0.2 + 0.3 = 0.5 -> 0.3 + 0.25 = 0.55 -> 0.2 + 0.75 * 0.55 = 0.6125.
  for (vtkCloudBody* volume :
    { static_cast<vtkCloudBody*>(ball), static_cast<vtkCloudBody*>(cells) })
  {
    for (const auto& order :
      std::vector<std::vector<vtkCloudBody*>>{ { walls[0], volume, walls[1], walls[2] },
        { walls[1], walls[2], volume, walls[0] }, { volume, walls[2], walls[1], walls[0] } })
    {
      this->Draw(order);
      EXPECT_NEAR(this->Radiance(30, 21), 0.6125, 1e-6) << volume->GetClassName();
      EXPECT_NEAR(this->Transmittance(30, 21), 0.75 * 0.5 * 0.5 * 0.5 * 0.25, 1e-6);
    }
  }
}

TEST_F(CloudSurface, FogEndsAtTheOpaqueSurfaceWhateverTheOrder)
{
  this->Surface->SetInputData(wall(4, 0.8));
  this->Surface->SetAmbient(1);
  this->Surface->SetSkyColor(0, 0, 0);
  vtkNew<vtkCloudUniformMedium> haze;
  haze->SetExtinction(0.1, 0.2, 0);
  haze->SetColor(1, 0.5, 7);
  for (const auto& order :
    std::vector<std::vector<vtkCloudBody*>>{ { haze, this->Surface }, { this->Surface, haze } })
  {
    this->Draw(order);
    EXPECT_NEAR(this->Radiance(30, 21, 0), 1 - std::exp(-0.4), 1e-6);
    EXPECT_NEAR(this->Radiance(30, 21, 1), 0.5 * (1 - std::exp(-0.8)), 1e-6);
    EXPECT_EQ(this->Radiance(30, 21, 2), 0);
    // Past the wall it goes on for ever.
    EXPECT_NEAR(this->Radiance(1, 1, 0), 1, 1e-6);
    EXPECT_LT(this->Transmittance(1, 1), 1e-40);
  }
  haze->SetRange(2);
  this->Draw({ haze });
  EXPECT_NEAR(this->Radiance(30, 21, 0), 1 - std::exp(-0.2), 1e-6);
}

TEST_F(CloudSurface, MediumRefusesNegativeExtinction)
{
  vtkNew<vtkCloudUniformMedium> haze;
  vtkNew<vtkTest::ErrorObserver> errors;
  haze->AddObserver(vtkCommand::ErrorEvent, errors);
  haze->SetExtinction(0.1, -0.2, 0);
  EXPECT_FALSE(haze->Prepare(this->KernelCamera()));
  EXPECT_NE(errors->GetErrorMessage().find("Extinction -0.2"), std::string::npos);
}

TEST_F(CloudSurface, TextureIsEvaluatedForEachHit)
{
  this->Surface->SetInputData(wall(4, 0.9));
  this->Surface->SetOpacityModeToTexture();
  this->Surface->SetTextureWavelength(0.5);
  this->Surface->SetTextureRimThreshold(this->Surface->GetTextureThreshold());
  this->Surface->SetOpacity(0.8);
  this->Draw({ this->Surface });
  nephoscope::CloudTextureParameters parameters;
  parameters.wavelength = 0.5;
  const nephoscope::CloudTexture texture(parameters);
  const nephoscope::Camera camera = this->KernelCamera();
  double least = 1;
  double most = 0;
  for (int y = 4; y < 40; ++y)
  {
    for (int x = 12; x < 49; ++x)
    {
      const nephoscope::Ray ray = camera.ray(x + 0.5, y + 0.5);
      const double t = 4 / ray.direction[1];
      const nephoscope::Vector3 at = ray.origin + t * ray.direction;
      const double opacity = 0.8 * texture.opacity(at.v, camera.footprint(t) / ray.direction[1], 1);
      ASSERT_NEAR(1 - this->Transmittance(x, y), opacity, 2e-5) << x << ' ' << y;
      least = std::min(least, opacity);
      most = std::max(most, opacity);
    }
  }
  EXPECT_LT(least, 0.1);
  EXPECT_GT(most, 0.7);
}

TEST_F(CloudSurface, TextureFollowsItsCoordinatesAndTheirScale)
{
  // Coordinates 1000 times the position with a wavelength 1000 times as long: the same picture.
  this->Surface->SetInputData(wall(4, 0.9));
  this->Surface->SetOpacityModeToTexture();
  this->Surface->SetTextureWavelength(0.5);
  this->Draw({ this->Surface });
  vtkNew<vtkImageData> first;
  first->DeepCopy(this->Scape->GetOutput());

  vtkSmartPointer<vtkPolyData> mapped = wall(4, 0.9);
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetName(nephoscope::arrays::TextureCoordinates);
  coordinates->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < mapped->GetNumberOfPoints(); ++i)
  {
    const double* const p = mapped->GetPoint(i);
    coordinates->InsertNextTuple3(1000 * p[0], 1000 * p[1], 1000 * p[2]);
  }
  mapped->GetPointData()->AddArray(coordinates);
  this->Surface->SetInputData(mapped);
  this->Surface->SetTextureWavelength(500);
  this->Draw({ this->Surface });
  vtkDataArray* const before = first->GetPointData()->GetArray(nephoscope::arrays::Radiance);
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      ASSERT_NEAR(this->Radiance(x, y), before->GetComponent(y * Width + x, 0), 1e-4);
    }
  }
}

TEST_F(CloudSurface, TwoTexturesAreCrossFadedForEachHit)
{
  const nephoscope::Vector3 away{ 30, -50, 70 };
  vtkSmartPointer<vtkPolyData> mapped = wall(4, 0.9);
  vtkNew<vtkFloatArray> coordinates[2];
  coordinates[0]->SetName(nephoscope::arrays::TextureCoordinates);
  coordinates[1]->SetName(nephoscope::arrays::OtherTextureCoordinates);
  for (int n = 0; n < 2; ++n)
  {
    coordinates[n]->SetNumberOfComponents(3);
    for (vtkIdType i = 0; i < mapped->GetNumberOfPoints(); ++i)
    {
      const double* const p = mapped->GetPoint(i);
      coordinates[n]->InsertNextTuple3(p[0] + n * away[0], p[1] + n * away[1], p[2] + n * away[2]);
    }
    mapped->GetPointData()->AddArray(coordinates[n]);
  }
  this->Surface->SetInputData(mapped);
  this->Surface->SetOpacityModeToTexture();
  this->Surface->SetTextureWavelength(0.5);
  this->Surface->SetTextureRimThreshold(this->Surface->GetTextureThreshold());
  nephoscope::CloudTextureParameters parameters;
  parameters.wavelength = 0.5;
  const nephoscope::CloudTexture texture(parameters);
  const nephoscope::Camera camera = this->KernelCamera();
  for (const double weight : { 0.0, 0.3, 1.0 })
  {
    vtkNew<vtkDoubleArray> weights;
    weights->SetName(nephoscope::arrays::TextureWeights);
    weights->InsertNextValue(weight);
    weights->InsertNextValue(1 - weight);
    mapped->GetFieldData()->AddArray(weights);
    mapped->Modified();
    this->Draw({ this->Surface });
    for (int y = 4; y < 40; ++y)
    {
      for (int x = 12; x < 49; ++x)
      {
        const nephoscope::Ray ray = camera.ray(x + 0.5, y + 0.5);
        const double t = 4 / ray.direction[1];
        const nephoscope::Vector3 at = ray.origin + t * ray.direction;
        const double value =
          texture.blended(at.v, (at + away).v, weight, camera.footprint(t) / ray.direction[1]);
        ASSERT_NEAR(1 - this->Transmittance(x, y), std::min(texture.opacityOf(value), 1.0), 1e-3);
      }
    }
  }
}

TEST_F(CloudSurface, RimThresholdFraysTheOutlineOnly)
{
  this->Surface->SetOpacityModeToTexture();
  this->Surface->SetTextureOffset(4); // nearly closed
  this->Surface->SetTextureThreshold(0);
  this->Surface->SetTextureRimThreshold(2);
  this->Surface->SetTextureRange(0.2);
  this->Draw({ this->Surface });
  EXPECT_LT(this->Transmittance(30, 21), 0.01);
  // The last pixel of the row that the sphere reaches: its radius is 43 / (2 tan(15) sqrt(24)) = 16.4 pixels.
  EXPECT_EQ(this->Transmittance(30 + 16, 21), 1);
  EXPECT_EQ(this->Transmittance(30 - 16, 21), 1);
}

TEST_F(CloudSurface, PictureDoesNotDependOnTilesOrThreads)
{
  this->Surface->SetOpacityModeToTexture();
  this->Surface->SetTextureWavelength(0.4);
  vtkNew<vtkImageData> first;
  // From many to few: TBB does not raise its limit again.
  for (const int threads : { 4, 2, 1 })
  {
    vtkSMPTools::Initialize(threads);
    this->Scape->SetTileSize(7 * threads);
    this->Surface->Modified();
    this->Draw({ this->Surface });
    if (threads == 4)
    {
      first->DeepCopy(this->Scape->GetOutput());
      continue;
    }
    vtkDataArray* const one = first->GetPointData()->GetArray(nephoscope::arrays::Radiance);
    vtkDataArray* const other =
      this->Scape->GetOutput()->GetPointData()->GetArray(nephoscope::arrays::Radiance);
    for (vtkIdType p = 0; p < Width * Height; ++p)
    {
      ASSERT_EQ(one->GetComponent(p, 1), other->GetComponent(p, 1));
    }
  }
}

TEST_F(CloudSurface, SkipsWhatIsNotFiniteOrHasNoArea)
{
  vtkSmartPointer<vtkPolyData> data = wall(4, 0.9, 2);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  data->GetPoints()->SetPoint(4, nan, nan, nan); // the middle one
  const vtkIdType line[3] = { 0, 1, 0 };
  const vtkIdType missing[3] = { 0, 1, 99 };
  data->GetPolys()->InsertNextCell(3, line);
  data->GetPolys()->InsertNextCell(3, missing);
  this->Surface->SetInputData(data);
  this->Draw({ this->Surface });
  EXPECT_EQ(this->Transmittance(30, 21), 1);
  // The lower right and upper left quarters keep the half that the middle does not belong to.
  EXPECT_EQ(this->Surface->GetNumberOfDrawnCells(), 2);
}

TEST_F(CloudSurface, EmptyAndWrongInput)
{
  vtkNew<vtkPolyData> empty;
  this->Surface->SetInputData(empty);
  this->Draw({ this->Surface });
  EXPECT_EQ(this->Transmittance(30, 21), 1);
  vtkNew<vtkImageData> image;
  vtkNew<vtkTest::ErrorObserver> errors;
  this->Surface->AddObserver(vtkCommand::ErrorEvent, errors);
  this->Surface->SetInputData(image);
  EXPECT_FALSE(this->Surface->Prepare(this->KernelCamera()));
  EXPECT_NE(errors->GetErrorMessage().find("not vtkPolyData"), std::string::npos);
}
