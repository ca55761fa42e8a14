// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudFit.h"

#include "FitDensity.h"
#include "vtkAbstractArray.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkRectilinearGrid.h"
#include "vtkTable.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

using testing::HasSubstr;

namespace
{
std::string errorOf(vtkCloudFit* fit)
{
  std::string text;
  vtkNew<vtkCallbackCommand> note;
  note->SetClientData(&text);
  note->SetCallback([](vtkObject*, unsigned long, void* client, void* data)
    { *static_cast<std::string*>(client) += static_cast<const char*>(data); });
  fit->AddObserver(vtkCommand::ErrorEvent, note);
  fit->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, note);
  fit->Update();
  fit->RemoveObserver(note);
  fit->GetExecutive()->RemoveObserver(note);
  return text;
}

double number(vtkTable* table, vtkIdType row, const char* column)
{
  return table->GetValueByName(row, column).ToDouble();
}
}

// A row for each parameter; the first is the power's k, whose value and error are known.
TEST(CloudFit, PutsOutATable)
{
  const vtkNew<vtkCloudFit> fit;
  fit->SetRange(0, 2);
  fit->Update();
  vtkTable* const table = fit->GetOutput();
  // 3 powers of 1 + 2 + 1 parameters; polynomials of degree n: n + 1, n and n - 1
  ASSERT_EQ(table->GetNumberOfRows(), 3 * 4 + (3 + 2 + 1) + (4 + 3 + 2) + (5 + 4 + 3));
  EXPECT_EQ(table->GetValueByName(0, "Fit").ToString(), "power 2 k");
  EXPECT_EQ(table->GetValueByName(0, "Parameter").ToString(), "k");
  EXPECT_NEAR(number(table, 0, "Value"), 0.71793, 5e-6);
  EXPECT_EQ(number(table, 0, "Determined"), 1);
  EXPECT_EQ(number(table, 0, "AtBound"), 0);
  EXPECT_NEAR(number(table, 0, "TrainingMax"), 0.0718, 5e-5);
  EXPECT_EQ(number(table, 0, "HeldOutCases"), 1002);
  vtkAbstractArray* const covariance = table->GetColumnByName("Covariance");
  ASSERT_NE(covariance, nullptr);
  EXPECT_EQ(covariance->GetNumberOfComponents(), 5);
  const double error = number(table, 0, "StandardError");
  EXPECT_NEAR(covariance->GetVariantValue(0).ToDouble(), error * error, 1e-15);
}

TEST(CloudFit, SaysWhatIsWrong)
{
  const vtkNew<vtkCloudFit> fit;
  fit->SetSubject("nothing");
  EXPECT_THAT(errorOf(fit), HasSubstr("there is no fit 'nothing'; there are transmittance"));
  EXPECT_EQ(fit->GetOutput()->GetNumberOfRows(), 0);
  const vtkNew<vtkCloudFit> empty;
  empty->SetRange(3, 3);
  EXPECT_THAT(errorOf(empty), HasSubstr("the range 3:3 is empty"));
}

namespace
{
/// A column of one Gaussian at uneven heights, 1/m; a layer of 200 m about 1 km.
vtkSmartPointer<vtkRectilinearGrid> column()
{
  const vtkNew<vtkDoubleArray> heights;
  const vtkNew<vtkDoubleArray> extinction;
  extinction->SetName("Extinction");
  for (double z = 0; z < 2500; z += 20 + z / 50)
  {
    heights->InsertNextValue(z);
    extinction->InsertNextValue(0.02 * std::exp(-0.5 * std::pow((z - 1000) / 200, 2)));
  }
  const vtkNew<vtkDoubleArray> place;
  place->InsertNextValue(0);
  auto grid = vtkSmartPointer<vtkRectilinearGrid>::New();
  grid->SetDimensions(1, 1, static_cast<int>(heights->GetNumberOfTuples()));
  grid->SetXCoordinates(place);
  grid->SetYCoordinates(place);
  grid->SetZCoordinates(heights);
  grid->GetPointData()->AddArray(extinction);
  return grid;
}

double valueOf(vtkTable* table, const std::string& fit, const std::string& parameter)
{
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    if (table->GetValueByName(row, "Fit").ToString() == fit &&
      table->GetValueByName(row, "Parameter").ToString() == parameter)
    {
      return number(table, row, "Value");
    }
  }
  return NAN;
}
}

TEST(CloudFit, FindsTheGaussianThatAColumnIs)
{
  const vtkNew<vtkCloudFit> fit;
  fit->SetSubject("density");
  fit->SetInputData(column());
  fit->SetTolerance(0.01);
  EXPECT_EQ(errorOf(fit), "");
  EXPECT_NEAR(valueOf(fit->GetOutput(), "Gaussian 1", "a"), 0.02, 2e-4);
  EXPECT_NEAR(valueOf(fit->GetOutput(), "Gaussian 1", "z"), 1000, 2);
  EXPECT_NEAR(std::abs(valueOf(fit->GetOutput(), "Gaussian 1", "m22")), 1.0 / 200, 1e-4);
  EXPECT_TRUE(std::isnan(valueOf(fit->GetOutput(), "Gaussian 2", "a")));
}

TEST(CloudFit, TakesDepthsThatOccur)
{
  const vtkNew<vtkDoubleArray> depths;
  for (int i = 0; i <= 400; ++i)
  {
    depths->InsertNextValue(0.5 * i / 400); // a thin cloud's
  }
  const vtkNew<vtkTable> table;
  table->AddColumn(depths);
  const vtkNew<vtkCloudFit> fit;
  fit->SetInputData(table);
  EXPECT_EQ(errorOf(fit), "");
  // Of thin cloud only the slope at 0 matters, which is 1; over all x k is 0.718.
  EXPECT_GT(number(fit->GetOutput(), 0, "Value"), 0.85);
  EXPECT_EQ(
    number(fit->GetOutput(), 0, "TrainingCases") + number(fit->GetOutput(), 0, "HeldOutCases"),
    400);
}

TEST(CloudFit, RefusesInputsThatItCannotUse)
{
  const vtkNew<vtkCloudFit> density;
  density->SetSubject("density");
  EXPECT_THAT(errorOf(density), HasSubstr("density needs an input that is a vtkImageData"));
  const vtkNew<vtkImageData> image;
  image->SetDimensions(3, 4, 5);
  density->SetInputData(image);
  EXPECT_THAT(errorOf(density), HasSubstr("the point array Extinction of one component, 1/m"));
  const vtkNew<vtkCloudFit> exact;
  exact->SetSubject("density");
  exact->SetInputData(column());
  exact->SetTolerance(0);
  EXPECT_THAT(errorOf(exact), HasSubstr("density: the tolerance has to be above 0"));
  const vtkNew<vtkCloudFit> depths;
  depths->SetInputData(column());
  EXPECT_THAT(errorOf(depths), HasSubstr("a vtkTable whose first column is optical depths"));
  const vtkNew<vtkDoubleArray> values;
  values->InsertNextValue(0);
  const vtkNew<vtkTable> table;
  table->AddColumn(values);
  depths->SetInputData(table);
  EXPECT_THAT(errorOf(depths), HasSubstr("the input has no optical depth above 0"));
  values->SetValue(0, NAN);
  values->Modified();
  table->Modified();
  EXPECT_THAT(errorOf(depths), HasSubstr("depth"));
  values->SetValue(0, 1);
  depths->SetSubject("slab");
  EXPECT_THAT(errorOf(depths), HasSubstr("the fit 'slab' takes no optical depths"));
}

// Abort ends the work after the first fit.
TEST(CloudFit, CanBeAborted)
{
  const vtkNew<vtkCloudFit> fit;
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { static_cast<vtkCloudFit*>(caller)->SetAbortExecute(1); });
  fit->AddObserver(vtkCommand::ProgressEvent, abort);
  fit->Update();
  EXPECT_EQ(fit->GetOutput()->GetNumberOfRows(), 1);
}

TEST(CloudFit, ListsItsSubjects)
{
  EXPECT_STREQ(vtkCloudFit::GetSubjectName(0), "transmittance");
  EXPECT_EQ(vtkCloudFit::GetSubjectName(-1), nullptr);
  EXPECT_EQ(vtkCloudFit::GetSubjectName(vtkCloudFit::GetNumberOfSubjects()), nullptr);
}
