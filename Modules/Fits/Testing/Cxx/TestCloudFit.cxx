// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudFit.h"

#include "vtkAbstractArray.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkNew.h"
#include "vtkTable.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
