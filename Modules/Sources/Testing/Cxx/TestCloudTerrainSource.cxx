// SPDX-License-Identifier: BSD-3-Clause
#include "CloudArrays.h"
#include "FractalNoise.h"
#include "vtkCloudTerrainSource.h"
#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkTestErrorObserver.h"

#include <gtest/gtest.h>

#include <cmath>

TEST(CloudTerrainSource, GridIsWhereItIsAskedFor)
{
  vtkNew<vtkCloudTerrainSource> source;
  source->SetDimensions(31, 18);
  source->SetCenter(1000, -400);
  source->SetSpacing(50);
  source->SetSeed(3);
  source->Update();
  vtkImageData* const image = source->GetOutput();
  EXPECT_EQ(image->GetNumberOfPoints(), 31 * 18);
  vtkDataArray* const heights = image->GetPointData()->GetArray(nephoscope::arrays::Height);
  ASSERT_NE(heights, nullptr);
  nephoscope::FractalHills hills;
  hills.seed = 3;
  for (vtkIdType point : { 0, 30, 31, 200, 557 })
  {
    double at[3];
    image->GetPoint(point, at);
    float height;
    hills.row(at[0], at[1], 1, 1, &height);
    EXPECT_EQ(heights->GetComponent(point, 0), height);
  }
  double bounds[6];
  image->GetBounds(bounds);
  EXPECT_EQ(bounds[0], 250);
  EXPECT_EQ(bounds[1], 1750);
  EXPECT_EQ(bounds[2], -825);
  EXPECT_EQ(bounds[3], 25);
}

TEST(CloudTerrainSource, BadSizesAreRefused)
{
  vtkNew<vtkCloudTerrainSource> source;
  vtkNew<vtkTest::ErrorObserver> errors;
  vtkNew<vtkTest::ErrorObserver> pipeline;
  source->AddObserver(vtkCommand::ErrorEvent, errors);
  source->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, pipeline);
  source->SetDimensions(1, 40);
  source->Update();
  EXPECT_NE(errors->GetErrorMessage().find("Dimensions 1 x 40"), std::string::npos);
  errors->Clear();
  source->SetDimensions(100000, 100000);
  source->Update();
  EXPECT_NE(errors->GetErrorMessage().find("2^28"), std::string::npos);
  errors->Clear();
  source->SetDimensions(4, 5);
  source->SetSpacing(-1);
  source->Update();
  EXPECT_NE(errors->GetErrorMessage().find("Spacing -1"), std::string::npos);
  errors->Clear();
  source->SetSpacing(30);
  source->SetCenter(0, -1e10);
  source->Update();
  EXPECT_NE(errors->GetErrorMessage().find("farther than 2^19 Wavelengths"), std::string::npos);
  errors->Clear();
  source->SetCenter(std::nan(""), 0);
  source->Update();
  EXPECT_NE(errors->GetErrorMessage().find("farther than 2^19 Wavelengths"), std::string::npos);
  EXPECT_EQ(source->GetOutput()->GetNumberOfPoints(), 0);
}
