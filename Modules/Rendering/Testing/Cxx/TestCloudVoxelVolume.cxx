// SPDX-License-Identifier: BSD-3-Clause
// Sparse voxels in a picture: closed forms of a slab, what stands in it, and what is kept between pictures.
#include "CloudArrays.h"
#include "PhaseFunction.h"
#include "RenderingTest.h"
#include "vtkCallbackCommand.h"
#include "vtkCloudPicture.h"
#include "vtkCloudPlane.h"
#include "vtkCloudVoxelVolume.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace
{
namespace arrays = nephoscope::arrays;

/// Bricks of a function of the voxels' indices over [low, high) bricks; the matrix as given, row by row.
template <class Function>
vtkSmartPointer<vtkPolyData> bricks(
  const int low[3], const int high[3], const double matrix[16], const Function& f)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkIntArray> origins;
  origins->SetName(arrays::VoxelOrigins);
  origins->SetNumberOfComponents(3);
  vtkNew<vtkFloatArray> values;
  values->SetName(arrays::VoxelBricks);
  values->SetNumberOfComponents(512);
  for (int k = low[2]; k < high[2]; ++k)
  {
    for (int j = low[1]; j < high[1]; ++j)
    {
      for (int i = low[0]; i < high[0]; ++i)
      {
        const int first[3] = { 8 * i, 8 * j, 8 * k };
        double place[3];
        for (int row = 0; row < 3; ++row)
        {
          const double* const m = matrix + 4 * row;
          place[row] = m[0] * first[0] + m[1] * first[1] + m[2] * first[2] + m[3];
        }
        points->InsertNextPoint(place);
        origins->InsertNextTypedTuple(first);
        float brick[512];
        for (int v = 0; v < 512; ++v)
        {
          brick[v] =
            static_cast<float>(f(first[0] + v % 8, first[1] + v / 8 % 8, first[2] + v / 64));
        }
        values->InsertNextTypedTuple(brick);
      }
    }
  }
  data->SetPoints(points);
  data->GetPointData()->AddArray(origins);
  data->GetPointData()->AddArray(values);
  vtkNew<vtkDoubleArray> place;
  place->SetName(arrays::VoxelToScene);
  for (int n = 0; n < 16; ++n)
  {
    place->InsertNextValue(matrix[n]);
  }
  data->GetFieldData()->AddArray(place);
  return data;
}

// Voxels of 0.1 x 0.05 x 0.2, turned about z by 90 degrees: index i runs along y, j against x.
constexpr double Turned[16] = { 0, -0.05, 0, 0, 0.1, 0, 0, 0, 0, 0, 0.2, 0, 0, 0, 0, 1 };

/// A wall of density 2 from y = 0 (its middle) to y = 1.5, far to the sides; half a voxel's slope at either end.
vtkSmartPointer<vtkPolyData> wall()
{
  const int low[3] = { 0, -16, -6 };
  const int high[3] = { 2, 16, 6 };
  return bricks(low, high, Turned, [](int, int, int) { return 2; });
}

std::string errorsOf(vtkCloudVoxelVolume* body, vtkCloudscape* scape)
{
  std::string text;
  const auto keep = [](vtkObject*, unsigned long, void* to, void* said)
  { *static_cast<std::string*>(to) += static_cast<const char*>(said); };
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&text);
  observer->SetCallback(keep);
  body->AddObserver(vtkCommand::ErrorEvent, observer);
  scape->AddObserver(vtkCommand::ErrorEvent, observer);
  scape->AddBody(body);
  scape->Update();
  body->RemoveObserver(observer);
  scape->RemoveObserver(observer);
  return text;
}
}

class VoxelVolume : public RenderingTest
{
protected:
  void SetUp() override
  {
    RenderingTest::SetUp();
    this->Body->SetTowardSun(0, -1, 0);
    this->Body->SetSunColor(1, 0.5, 0.25);
    this->Body->SetAmbient(0);
  }
  vtkNew<vtkCloudVoxelVolume> Body;
};

TEST_F(VoxelVolume, AWallLitFromTheEyesSideHasItsClosedForm)
{
  this->Body->SetInputData(wall());
  this->Body->SetExtinctionScale(0.4);
  this->Body->SetAlbedo(0.9);
  this->Body->SetAsymmetry(-0.3);
  this->Draw({ this->Body });
  const int x = Width / 2;
  const int y = Height / 2;
  const double depth = 0.4 * 2 * 1.6; // 16 voxels of 0.1
  EXPECT_NEAR(this->Transmittance(x, y), std::exp(-depth), 1e-4);
  const double phase = 12.566370614359172 * nephoscope::henyeyGreenstein(-0.3, -1.0);
  const double light = 0.9 * phase * (1 - std::exp(-2 * depth)) / 2;
  EXPECT_NEAR(this->Radiance(x, y, 0), light, 3e-3 * light);
  EXPECT_NEAR(this->Radiance(x, y, 2), light / 4, 1e-3 * light);
  // Half gets through to depth ln 2, as a uniform medium's would within a segment.
  EXPECT_NEAR(this->Depth(x, y), 5 - 0.05 + std::log(2) / 0.8, 0.02);
  EXPECT_GT(this->Body->GetNumberOfDrawnCells(), 700);
}

TEST_F(VoxelVolume, WhatStandsInItHidesWhatIsBehind)
{
  this->Camera->SetPosition(0, 0, 9);
  this->Camera->SetViewUp(0, 1, 0);
  vtkNew<vtkCloudPlane> ground;
  ground->SetHeight(0.3);
  ground->SetSeaColor(0, 0, 0);
  ground->SetLandColor(0, 0, 0);
  const int low[3] = { -2, -4, -2 };
  const int high[3] = { 2, 4, 2 };
  this->Body->SetTowardSun(0, 0, 1);
  this->Body->SetInputData(bricks(low, high, Turned, [](int, int, int) { return 1; }));
  this->Draw({ this->Body, ground });
  // From the top, 15.5 voxels of 0.2 with half a voxel's slope, down to 0.3.
  const double depth = 15 * 0.2 + 0.1 - 0.3;
  EXPECT_NEAR(this->Radiance(Width / 2, Height / 2, 0), (1 - std::exp(-2 * depth)) / 2, 5e-3);
  EXPECT_EQ(this->Transmittance(Width / 2, Height / 2), 0);
}

TEST_F(VoxelVolume, TheSkysShareIsThatOfAThickCloud)
{
  this->Body->SetInputData(wall());
  this->Body->SetExtinctionScale(100);
  this->Body->SetAmbient(1);
  this->Body->SetSkyColor(0.2, 0.4, 0.6);
  this->Draw({ this->Body });
  // The ray ends where 1e-4 gets through.
  EXPECT_NEAR(this->Radiance(Width / 2, Height / 2, 1), 0.4, 1e-4);
}

TEST_F(VoxelVolume, APictureDrawsThemWithOrWithoutASurfaceAndFitsThem)
{
  // One brick of 0.8 x 0.4 x 1.6 seen along -x: half a voxel of slope on each side is within the frame.
  const int low[3] = { 0, 0, 0 };
  const int high[3] = { 1, 1, 1 };
  const vtkNew<vtkCloudPicture> picture;
  picture->SetInputData(bricks(low, high, Turned, [](int, int, int) { return 2; }));
  picture->SetVoxels(this->Body);
  picture->SetSize(Width, Height);
  picture->SetPosition(1, 0, 0);
  picture->ParallelProjectionOn();
  picture->Update();
  const auto transmittance = [&picture](int x, int y)
  {
    return picture->GetOutput()
      ->GetPointData()
      ->GetArray(arrays::Transmittance)
      ->GetComponent(y * Width + x, 0);
  };
  EXPECT_NEAR(transmittance(Width / 2, Height / 2), std::exp(-2 * 0.4), 1e-4);
  // From the lowest to the highest voxel that is not clear 9 of the frame's 9 * 1.1 voxels.
  EXPECT_EQ(transmittance(Width / 2, 1), 1);
  EXPECT_LT(transmittance(Width / 2, 4), 1);
  EXPECT_LT(transmittance(Width / 2, Height - 5), 1);
  EXPECT_EQ(transmittance(Width / 2, Height - 2), 1);

  const vtkNew<vtkPolyData> nothing;
  picture->SetInputDataObject(1, nothing);
  picture->Update();
  EXPECT_NEAR(transmittance(Width / 2, Height / 2), std::exp(-2 * 0.4), 1e-4);
}

TEST_F(VoxelVolume, TheSameBitsForAnyNumberOfThreads)
{
  const auto picture = [this](int threads)
  {
    std::vector<double> values;
    vtkSMPTools::LocalScope(vtkSMPTools::Config(threads),
      [&]
      {
        vtkNew<vtkCloudVoxelVolume> body;
        const int low[3] = { -2, -2, -2 };
        const int high[3] = { 2, 3, 1 };
        body->SetInputData(bricks(low, high, Turned,
          [](int i, int j, int k)
          { return std::max(0.0, std::sin(0.4 * i + 0.3 * j - 0.2 * k)); }));
        body->SetTowardSun(0.3, -0.5, 0.4);
        this->Scape->Modified();
        this->Draw({ body });
        for (int y = 0; y < Height; ++y)
        {
          for (int x = 0; x < Width; ++x)
          {
            values.push_back(this->Radiance(x, y));
          }
        }
      });
    return values;
  };
  const std::vector<double> one = picture(1);
  EXPECT_EQ(one, picture(2));
  EXPECT_GT(*std::max_element(one.begin(), one.end()), 0.05);
}

TEST_F(VoxelVolume, AChangedSunOrScaleChangesThePicture)
{
  this->Body->SetInputData(wall());
  this->Draw({ this->Body });
  const double lit = this->Radiance(Width / 2, Height / 2);
  this->Body->SetTowardSun(0, 1, 0);
  this->Scape->Update();
  const double behind = this->Radiance(Width / 2, Height / 2);
  // Lit from behind: depth exp(-depth) at scale 1.
  EXPECT_NEAR(behind, 3.2 * std::exp(-3.2), 2e-3);
  EXPECT_GT(lit, 3 * behind);
  this->Body->SetExtinctionScale(0);
  this->Scape->Update();
  EXPECT_EQ(this->Radiance(Width / 2, Height / 2), 0);
  EXPECT_EQ(this->Transmittance(Width / 2, Height / 2), 1);
}

TEST_F(VoxelVolume, WhatCannotBeDrawnIsTold)
{
  vtkNew<vtkCloudVoxelVolume> none;
  vtkNew<vtkPolyData> empty;
  none->SetInputData(empty);
  EXPECT_NE(errorsOf(none, this->Scape).find("has no bricks of scalar voxels"), std::string::npos);
  this->Scape->RemoveAllBodies();
  const double flat[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1 };
  const int low[3] = { 0, 0, 0 };
  const int high[3] = { 1, 1, 1 };
  vtkNew<vtkCloudVoxelVolume> thin;
  thin->SetInputData(bricks(low, high, flat, [](int, int, int) { return 1; }));
  EXPECT_NE(errorsOf(thin, this->Scape).find("cannot be inverted"), std::string::npos);
  this->Scape->RemoveAllBodies();
  auto far = bricks(low, high, Turned, [](int, int, int) { return 1; });
  auto* const origins =
    vtkIntArray::SafeDownCast(far->GetPointData()->GetArray(arrays::VoxelOrigins));
  auto* const values =
    vtkFloatArray::SafeDownCast(far->GetPointData()->GetArray(arrays::VoxelBricks));
  const int other[3] = { 1 << 29, -(1 << 29), 1 << 29 };
  origins->InsertNextTypedTuple(other);
  const std::vector<float> ones(512, 1);
  values->InsertNextTypedTuple(ones.data());
  vtkNew<vtkCloudVoxelVolume> apart;
  apart->SetInputData(far);
  EXPECT_NE(errorsOf(apart, this->Scape).find("lie too far apart"), std::string::npos);
}

TEST_F(VoxelVolume, NoBricksAreAnEmptyPicture)
{
  const int nothing[3] = { 0, 0, 0 };
  this->Body->SetInputData(bricks(nothing, nothing, Turned, [](int, int, int) { return 1; }));
  this->Draw({ this->Body });
  EXPECT_EQ(this->Transmittance(5, 5), 1);
  EXPECT_EQ(this->Radiance(5, 5), 0);
}
