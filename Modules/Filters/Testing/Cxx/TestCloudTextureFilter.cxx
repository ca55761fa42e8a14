// SPDX-License-Identifier: BSD-3-Clause
#include "CloudArrays.h"
#include "CloudTexture.h"
#include "ErrorText.h"
#include "vtkCloudTexture.h"

#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <gtest/gtest.h>

namespace
{
vtkNew<vtkImageData> image()
{
  vtkNew<vtkImageData> data;
  data->SetDimensions(9, 7, 5);
  data->SetSpacing(1, 2, 3);
  return data;
}
}

TEST(CloudTextureFilter, EvaluatesTheKernelAtThePoints)
{
  vtkNew<vtkImageData> data = image();
  vtkNew<vtkCloudTexture> filter;
  filter->SetInputData(data);
  filter->SetMetersPerUnit(1e5);
  filter->SetSamplingDistance(2e4);
  filter->Update();
  vtkDataArray* opacity =
    filter->GetOutput()->GetPointData()->GetArray(nephoscope::arrays::Opacity);
  ASSERT_NE(opacity, nullptr);
  const nephoscope::CloudTexture texture;
  double spread[2];
  opacity->GetRange(spread);
  EXPECT_LT(spread[0], spread[1]);
  for (vtkIdType id = 0; id < data->GetNumberOfPoints(); ++id)
  {
    double x[3];
    data->GetPoint(id, x);
    const double meters[3] = { 1e5 * x[0], 1e5 * x[1], 1e5 * x[2] };
    EXPECT_EQ(opacity->GetComponent(id, 0), float(texture.opacity(meters, 2e4)));
  }
}

TEST(CloudTextureFilter, TextureCoordinatesTakeThePointsPlace)
{
  vtkNew<vtkImageData> data = image();
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetName(nephoscope::arrays::TextureCoordinates);
  coordinates->SetNumberOfComponents(3);
  for (vtkIdType id = 0; id < data->GetNumberOfPoints(); ++id)
  {
    coordinates->InsertNextTuple3(7e4 * id, 2e5, -3e4 * id);
  }
  data->GetPointData()->AddArray(coordinates);
  vtkNew<vtkCloudTexture> filter;
  filter->SetInputData(data);
  filter->SetMetersPerUnit(1e5);
  filter->Update();
  vtkDataArray* opacity =
    filter->GetOutput()->GetPointData()->GetArray(nephoscope::arrays::Opacity);
  const nephoscope::CloudTexture texture;
  for (vtkIdType id = 0; id < data->GetNumberOfPoints(); ++id)
  {
    double x[3];
    coordinates->GetTuple(id, x);
    EXPECT_EQ(opacity->GetComponent(id, 0), float(texture.opacity(x)));
  }
}

TEST(CloudTextureFilter, SaysWhatIsWrongWithCoordinates)
{
  vtkNew<vtkImageData> data = image();
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetName(nephoscope::arrays::TextureCoordinates);
  coordinates->SetNumberOfComponents(2);
  coordinates->SetNumberOfTuples(data->GetNumberOfPoints());
  data->GetPointData()->AddArray(coordinates);
  vtkNew<vtkCloudTexture> filter;
  filter->SetInputData(data);
  EXPECT_NE(errorTextOf(filter).find("'TextureCoordinates' has 2 components; give positions"),
    std::string::npos);
}
