// SPDX-License-Identifier: BSD-3-Clause
// What an update leaves for the next changes no bit of it.
#include "ContourTesting.h"

namespace
{
/// The filter's output against that of one that has kept nothing.
void expectAsNew(vtkCloudContour* kept, vtkDataSet* data)
{
  kept->Update();
  vtkNew<vtkCloudContour> fresh;
  fresh->SetInputData(data);
  fresh->SetNumberOfContours(kept->GetNumberOfContours());
  for (int v = 0; v < kept->GetNumberOfContours(); ++v)
  {
    fresh->SetValue(v, kept->GetValue(v));
  }
  fresh->Update();
  ASSERT_GT(fresh->GetOutput()->GetNumberOfCells(), 100);
  expectSame(kept->GetOutput(), fresh->GetOutput());
}

vtkSmartPointer<vtkStructuredGrid> waves(const std::array<int, 3>& n, double phase)
{
  auto grid = globe(n);
  addField(grid,
    [phase](const Vector& x) { return std::sin(5 * x[0] + phase) * std::cos(4 * x[1] + x[2]); });
  return grid;
}
}

TEST(CloudContourKept, OtherValuesAreAsNew)
{
  auto grid = waves({ 131, 20, 9 }, 0);
  vtkNew<vtkCloudContour> contour;
  contour->SetInputData(grid);
  for (double value : { 0.15, 0.9, -0.4, 0.0, 0.16 })
  {
    contour->SetValue(0, value);
    expectAsNew(contour, grid);
  }
  contour->GenerateValues(5, -0.8, 0.8);
  expectAsNew(contour, grid);
}

TEST(CloudContourKept, ChangedArraysAreSeen)
{
  auto grid = waves({ 131, 20, 9 }, 0);
  vtkNew<vtkCloudContour> contour;
  contour->SetInputData(grid);
  expectAsNew(contour, grid);

  // In place: a word of points that no range let through before, then values that are not finite.
  auto* field = vtkFloatArray::SafeDownCast(grid->GetPointData()->GetArray(0));
  for (vtkIdType id = 0; id < field->GetNumberOfTuples(); ++id)
  {
    field->SetValue(id, -field->GetValue(id) + 0.2F);
  }
  field->Modified();
  expectAsNew(contour, grid);
  field->SetValue(1000, NAN);
  field->SetValue(5000, INFINITY);
  field->Modified();
  expectAsNew(contour, grid);
  field->SetValue(1000, 0);
  field->SetValue(5000, 0);
  field->Modified();
  expectAsNew(contour, grid);

  // Another array, another size, the same number of points in another shape, another type.
  for (const std::array<int, 3>& n :
    { std::array<int, 3>{ 131, 20, 9 }, { 81, 17, 7 }, { 81, 7, 17 } })
  {
    auto next = waves(n, 1);
    contour->SetInputData(next);
    expectAsNew(contour, next);
  }
  auto doubles = waves({ 81, 7, 17 }, 2);
  vtkNew<vtkDoubleArray> wide;
  wide->DeepCopy(doubles->GetPointData()->GetArray(0));
  doubles->GetPointData()->RemoveArray(0);
  doubles->GetPointData()->AddArray(wide);
  contour->SetInputData(doubles);
  expectAsNew(contour, doubles);
}

TEST(CloudContourKept, AnOutputThatIsHeldStaysAsItIs)
{
  auto grid = waves({ 81, 20, 9 }, 0);
  vtkNew<vtkCloudContour> contour;
  contour->SetInputData(grid);
  contour->Update();
  vtkNew<vtkPolyData> held;
  held->ShallowCopy(contour->GetOutput());
  vtkNew<vtkPolyData> copy;
  copy->DeepCopy(held);
  contour->SetValue(0, 0.17); // of nearly the same size
  contour->Update();
  EXPECT_NE(held->GetPoints()->GetData(), contour->GetOutput()->GetPoints()->GetData());
  expectSame(held, copy);

  // Only its memory is held.
  vtkNew<vtkDoubleArray> shared;
  shared->ShallowCopy(contour->GetOutput()->GetPoints()->GetData());
  vtkNew<vtkDoubleArray> sharedCopy;
  sharedCopy->DeepCopy(shared);
  contour->SetValue(0, 0.16);
  contour->Update();
  ASSERT_GT(shared->GetNumberOfValues(), 1000);
  for (vtkIdType n = 0; n < shared->GetNumberOfValues(); ++n)
  {
    EXPECT_EQ(shared->GetValue(n), sharedCopy->GetValue(n));
  }

  // Nobody holds it: its memory serves again, and only then.
  vtkDataArray* points = contour->GetOutput()->GetPoints()->GetData();
  const vtkMTimeType before = points->GetMTime();
  contour->SetValue(0, 0.18);
  expectAsNew(contour, grid);
  EXPECT_EQ(contour->GetOutput()->GetPoints()->GetData(), points);
  EXPECT_GT(points->GetMTime(), before);

  // A much smaller output does not keep the larger's memory.
  contour->SetValue(0, 0.95);
  contour->Update();
  ASSERT_GT(contour->GetOutput()->GetNumberOfPoints(), 100);
  auto* small = contour->GetOutput()->GetPoints()->GetData();
  EXPECT_LE(small->GetSize(), 2 * 3 * small->GetNumberOfTuples());
}
