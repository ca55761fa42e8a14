// SPDX-License-Identifier: BSD-3-Clause
#include "CloudArrays.h"
#include "Cumulus.h"
#include "vtkCellArray.h"
#include "vtkCloudHeightFieldShadow.h"
#include "vtkCloudHeightFieldSource.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTestErrorObserver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{
nephoscope::HeightFieldShape shapeOf(vtkPolyData* data, double& plane)
{
  auto* const numbers = vtkDoubleArray::SafeDownCast(
    data->GetFieldData()->GetAbstractArray(nephoscope::arrays::HeightField));
  nephoscope::HeightFieldShape shape;
  EXPECT_TRUE(nephoscope::shapeOf(
    numbers->GetPointer(0), static_cast<std::size_t>(numbers->GetNumberOfValues()), shape, plane));
  return shape;
}
}

// The numbers alone: what was set comes out, and waves of one's own replace the made-up ones.
TEST(CloudHeightFieldSource, WritesTheShape)
{
  vtkNew<vtkCloudHeightFieldSource> source;
  source->SetPlaneHeight(700);
  source->SetPolynomial(1, 2, 3, 4, 5, 6);
  source->SetRoundness(9);
  source->AddWave(5, 0.1, 0.2, 0.3, 1);
  source->Update();
  EXPECT_EQ(source->GetOutput()->GetNumberOfPoints(), 0);
  double plane = 0;
  nephoscope::HeightFieldShape shape = shapeOf(source->GetOutput(), plane);
  EXPECT_EQ(plane, 700);
  EXPECT_EQ(shape.c, 9);
  EXPECT_EQ(shape.polynomial[5], 6);
  ASSERT_EQ(shape.waves.size(), 1U);
  EXPECT_EQ(shape.waves[0].shape, nephoscope::WaveShape::Absolute);
  source->RemoveAllWaves();
  source->SetNumberOfWaves(5);
  source->Update();
  shape = shapeOf(source->GetOutput(), plane);
  EXPECT_EQ(shape.waves.size(), 5U);
}

// The surfaces: points on the field's tops and bottoms, winding that agrees with the normals, closed at the plane.
TEST(CloudHeightFieldSource, MakesSurfaces)
{
  vtkNew<vtkCloudHeightFieldSource> source;
  source->SetDimensions(61, 43);
  source->SetBounds(-3000, 3000, 100, 4000);
  source->Update();
  vtkPolyData* const surface = source->GetOutput();
  ASSERT_EQ(surface->GetNumberOfPoints(), 2 * 61 * 43);
  ASSERT_GT(surface->GetNumberOfPolys(), 100);
  double plane = 0;
  const nephoscope::HeightField field(shapeOf(surface, plane));
  for (vtkIdType point = 0; point < surface->GetNumberOfPoints(); point += 7)
  {
    double at[3];
    surface->GetPoint(point, at);
    const double f = field.value(at[0], at[1]);
    const double height = point < 61 * 43 ? field.top(f) : field.bottom(f);
    EXPECT_NEAR(at[2], plane + (f > 0 ? height : 0), 0.05);
  }
  vtkDataArray* const normals = surface->GetPointData()->GetNormals();
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfPolys(); cell += 5)
  {
    surface->GetPolys()->GetCellAtId(cell, ids);
    double a[3], b[3], c[3], n[3];
    surface->GetPoint(ids->GetId(0), a);
    surface->GetPoint(ids->GetId(1), b);
    surface->GetPoint(ids->GetId(2), c);
    normals->GetTuple(ids->GetId(0), n);
    const double winding = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    EXPECT_GT(winding * n[2], 0);
  }
}

// A cycle closes with the same bits.
TEST(CloudHeightFieldSource, CyclesClose)
{
  vtkNew<vtkCloudHeightFieldSource> source;
  source->SetCycleVector(0, -1500);
  source->SetFrames(49);
  double plane = 0;
  source->Update();
  const std::vector<double> first = nephoscope::numbersOf(shapeOf(source->GetOutput(), plane), 0);
  source->SetFrame(49);
  source->Update();
  EXPECT_EQ(nephoscope::numbersOf(shapeOf(source->GetOutput(), plane), 0), first);
  source->SetFrame(7);
  source->Update();
  EXPECT_NE(nephoscope::numbersOf(shapeOf(source->GetOutput(), plane), 0), first);
}

TEST(CloudHeightFieldSource, SaysWhatIsWrong)
{
  vtkNew<vtkCloudHeightFieldSource> source;
  vtkNew<vtkTest::ErrorObserver> errors;
  source->AddObserver(vtkCommand::ErrorEvent, errors);
  source->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
  source->SetWavelength(-1);
  source->Update();
  EXPECT_NE(errors->GetErrorMessage().find("Wavelength -1"), std::string::npos);
  errors->Clear();
  source->SetWavelength(100);
  source->SetDimensions(100000, 100000);
  source->Update();
  EXPECT_NE(errors->GetErrorMessage().find("more than 2^28 points"), std::string::npos);
}

// A shadow is exp(-extinction thickness) of the field at each point; without its input it says so.
TEST(CloudHeightFieldShadow, IsThatOfTheThickness)
{
  vtkNew<vtkCloudHeightFieldSource> source;
  vtkNew<vtkCloudHeightFieldShadow> shadow;
  shadow->SetInputConnection(source->GetOutputPort());
  shadow->SetDimensions(31, 22);
  shadow->SetSpacing(150);
  shadow->SetCenter(100, -50);
  shadow->SetExtinction(0.01);
  shadow->Update();
  double plane = 0;
  const nephoscope::HeightField field(shapeOf(source->GetOutput(), plane));
  vtkImageData* const image = shadow->GetOutput();
  ASSERT_EQ(image->GetNumberOfPoints(), 31 * 22);
  int clouded = 0;
  for (vtkIdType point = 0; point < image->GetNumberOfPoints(); ++point)
  {
    double at[3];
    image->GetPoint(point, at);
    EXPECT_EQ(at[2], plane);
    const double f = field.value(at[0], at[1]);
    const double through = f > 0 ? std::exp(-0.01 * (field.top(f) - field.bottom(f))) : 1;
    EXPECT_NEAR(
      image->GetPointData()->GetArray(nephoscope::arrays::SunTransmittance)->GetComponent(point, 0),
      through, 1e-6);
    clouded += f > 0 ? 1 : 0;
  }
  EXPECT_GT(clouded, 50);
  vtkNew<vtkTest::ErrorObserver> errors;
  shadow->AddObserver(vtkCommand::ErrorEvent, errors);
  shadow->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, errors);
  vtkNew<vtkPolyData> nothing;
  shadow->SetInputDataObject(nothing);
  shadow->Update();
  EXPECT_NE(errors->GetErrorMessage().find("no field data array HeightField"), std::string::npos);
}
