// SPDX-License-Identifier: BSD-3-Clause
#include "CloudArrays.h"
#include "CloudTexture.h"
#include "ErrorText.h"
#include "vtkCloudContour.h"
#include "vtkCloudTexture.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
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

namespace
{
/// The image with cloudiness, and coordinates linear in the place, of two textures with weights.
vtkNew<vtkImageData> faded(double weight)
{
  vtkNew<vtkImageData> data = image();
  vtkNew<vtkFloatArray> cloud;
  cloud->SetName(nephoscope::arrays::CloudFraction);
  vtkNew<vtkFloatArray> coordinates[2];
  coordinates[0]->SetName(nephoscope::arrays::TextureCoordinates);
  coordinates[1]->SetName(nephoscope::arrays::OtherTextureCoordinates);
  for (int n = 0; n < 2; ++n)
  {
    coordinates[n]->SetNumberOfComponents(3);
    for (vtkIdType id = 0; id < data->GetNumberOfPoints(); ++id)
    {
      const double* const x = data->GetPoint(id);
      coordinates[n]->InsertNextTuple3(7e4 * x[0] + 1e7 * n, 2e5 * x[1] - 3e4 * x[0], -3e4 * x[2]);
      if (n == 0)
      {
        cloud->InsertNextValue(static_cast<float>(x[2] / 12));
      }
    }
    data->GetPointData()->AddArray(coordinates[n]);
  }
  data->GetPointData()->SetScalars(cloud);
  vtkNew<vtkDoubleArray> weights;
  weights->SetName(nephoscope::arrays::TextureWeights);
  weights->InsertNextValue(weight);
  weights->InsertNextValue(1 - weight);
  data->GetFieldData()->AddArray(weights);
  return data;
}
}

TEST(CloudTextureFilter, CrossFadesTwoTexturesAlsoOnAContour)
{
  const nephoscope::CloudTexture texture;
  for (const double weight : { 0.0, 0.4, 1.0 })
  {
    vtkNew<vtkImageData> data = faded(weight);
    vtkNew<vtkCloudContour> contour;
    contour->SetInputData(data);
    contour->SetValue(0, 0.4);
    vtkNew<vtkCloudTexture> filter;
    filter->SetInputConnection(contour->GetOutputPort());
    filter->Update();
    vtkDataSet* const output = vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0));
    vtkDataArray* const opacity = output->GetPointData()->GetArray(nephoscope::arrays::Opacity);
    ASSERT_NE(opacity, nullptr);
    ASSERT_GT(output->GetNumberOfPoints(), 50);
    for (vtkIdType id = 0; id < output->GetNumberOfPoints(); ++id)
    {
      const double* const x = output->GetPoint(id);
      const double first[3] = { 7e4 * x[0], 2e5 * x[1] - 3e4 * x[0], -3e4 * x[2] };
      const double second[3] = { first[0] + 1e7, first[1], first[2] };
      // Coordinates are floats: a metre of 1e7, to which the texture is not sensitive.
      EXPECT_NEAR(opacity->GetComponent(id, 0),
        texture.opacityOf(texture.blended(first, second, weight)), 1e-3);
    }
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
