// SPDX-License-Identifier: BSD-3-Clause
#include "ContourTesting.h"
#include "vtkCloudSmooth.h"
#include "vtkCloudTexture.h"

TEST(CloudContour, SphereHasItsAreaToSecondOrder)
{
  double errors[2];
  for (int level = 0; level < 2; ++level)
  {
    const int m = 16 << level;
    vtkNew<vtkImageData> image;
    image->SetDimensions(m + 1, m + 2, m + 3);
    image->SetOrigin(-1, -1, -1);
    image->SetSpacing(2.0 / m, 2.0 / m, 2.0 / m);
    addField(image, [](const Vector& x) { return 1 - std::sqrt(dot(x, x)); });
    errors[level] = std::abs(areaOf(contourOf(image, 0.4F)) - 4 * Pi * 0.36);
  }
  EXPECT_GT(errors[0] / errors[1], 3.4);
  EXPECT_LT(errors[1], 0.02);
}

TEST(CloudContour, NormalsConvergeToTheGradientOnACurvedGridAndAgreeWithWinding)
{
  // A smooth, non-orthogonal, stretched map, once right-handed and once left-handed.
  const Function f = [](const Vector& x)
  { return 1 - (x[0] * x[0] + 2 * x[1] * x[1] + 3 * x[2] * x[2]); };
  for (int hand : { 1, -1 })
  {
    double worst[2] = { 0, 0 };
    for (int level = 0; level < 2; ++level)
    {
      const int m = 20 << level;
      auto grid = structuredGrid({ m + 1, m + 3, m - 1 },
        [m, hand](const Vector& p) -> Vector
        {
          const double u = 2 * p[0] / m - 1;
          const double v = 2 * p[1] / (m + 2) - 1;
          const double w = 2 * p[2] / (m - 2) - 1;
          return { u + 0.1 * std::sin(2 * v + w), v + 0.15 * u * u,
            hand * (w + 0.3 * w * w * w + 0.1 * u) };
        });
      addField(grid, f);
      auto surface = contourOf(grid, 0.5F);
      ASSERT_GT(surface->GetNumberOfCells(), 500);
      for (vtkIdType p = 0; p < surface->GetNumberOfPoints(); ++p)
      {
        const Vector x = pointOf(surface, p);
        const Vector g = { x[0], 2 * x[1], 3 * x[2] };
        Vector normal;
        surface->GetPointData()->GetNormals()->GetTuple(p, normal.data());
        EXPECT_NEAR(dot(normal, normal), 1, 1e-6);
        const double cosine = dot(normal, g) / std::sqrt(dot(g, g));
        worst[level] = std::max(worst[level], std::acos(std::min(cosine, 1.0)));
      }
      vtkNew<vtkIdList> ids;
      for (vtkIdType t = 0; t < surface->GetNumberOfCells(); ++t)
      {
        surface->GetCellPoints(t, ids);
        const Vector a = pointOf(surface, ids->GetId(0));
        const Vector face =
          cross(pointOf(surface, ids->GetId(1)) - a, pointOf(surface, ids->GetId(2)) - a);
        Vector normal;
        surface->GetPointData()->GetNormals()->GetTuple(ids->GetId(0), normal.data());
        EXPECT_GE(dot(face, normal), -1e-9 * std::sqrt(dot(face, face)));
      }
    }
    EXPECT_LT(worst[1], 0.02); // rad
    EXPECT_GT(worst[0] / worst[1], 3);
  }
}

TEST(CloudContour, NormalsOfTetrahedraPointOutOfTheCloud)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(19, 20, 21);
  image->SetOrigin(-9, -9, -9);
  addField(image, [](const Vector& x) { return 1 - std::sqrt(dot(x, x)) / 10; });
  auto surface = contourOf(tetrahedraOf(image.Get()), 0.4F);
  ASSERT_GT(surface->GetNumberOfPoints(), 500);
  for (vtkIdType p = 0; p < surface->GetNumberOfPoints(); ++p)
  {
    const Vector x = pointOf(surface, p);
    Vector normal;
    surface->GetPointData()->GetNormals()->GetTuple(p, normal.data());
    EXPECT_GT(dot(normal, x) / std::sqrt(dot(x, x)), 0.97);
  }
}

TEST(CloudContour, InterpolatesArraysAndKeepsValuesApart)
{
  // Linear arrays are reproduced exactly; several values follow one another.
  auto image = randomImage({ 10, 9, 8 }, false, 11);
  vtkNew<vtkFloatArray> linear;
  linear->SetName("Linear");
  linear->SetNumberOfComponents(2);
  vtkNew<vtkIntArray> integers;
  integers->SetName("Integers");
  for (vtkIdType id = 0; id < image->GetNumberOfPoints(); ++id)
  {
    const Vector x = pointOf(image, id);
    linear->InsertNextTuple2(x[0] + 10 * x[1], x[2]);
    integers->InsertNextValue(int(x[0]));
  }
  image->GetPointData()->AddArray(linear);
  image->GetPointData()->AddArray(integers);
  vtkNew<vtkCloudContour> contour;
  contour->SetInputData(image);
  contour->GenerateValues(2, 0.05, 0.25);
  contour->Update();
  vtkPolyData* surface = contour->GetOutput();
  auto first = contourOf(image, 0.05);
  auto second = contourOf(image, 0.25);
  EXPECT_EQ(surface->GetNumberOfCells(), first->GetNumberOfCells() + second->GetNumberOfCells());
  ASSERT_EQ(surface->GetNumberOfPoints(), first->GetNumberOfPoints() + second->GetNumberOfPoints());
  vtkPointData* data = surface->GetPointData();
  for (vtkIdType p = 0; p < surface->GetNumberOfPoints(); ++p)
  {
    const Vector x = pointOf(surface, p);
    EXPECT_NEAR(data->GetArray("Linear")->GetComponent(p, 0), x[0] + 10 * x[1], 1e-4);
    EXPECT_NEAR(data->GetArray("Linear")->GetComponent(p, 1), x[2], 1e-5);
    EXPECT_NEAR(data->GetArray("Integers")->GetComponent(p, 0), x[0], 1e-5);
    EXPECT_EQ(data->GetArray("CloudFraction")->GetComponent(p, 0),
      p < first->GetNumberOfPoints() ? 0.05F : 0.25F);
  }
}

TEST(CloudContour, SameBitsForAnyNumberOfThreads)
{
  auto grid = globe({ 81, 67, 7 });
  std::mt19937 random(12);
  addField(grid, [&random](const Vector& x) { return x[0] + (random() % 100) / 100.0; });
  vtkSMPTools::Initialize(1);
  auto one = contourOf(grid, 0.3F);
  for (int threads : { 2, 4 })
  {
    vtkSMPTools::Initialize(threads);
    expectSame(one, contourOf(grid, 0.3F));
  }
  vtkSMPTools::Initialize();
}

TEST(CloudContour, ThinAndEmptyGridsGiveNothing)
{
  for (const std::array<int, 3>& n :
    { std::array<int, 3>{ 9, 8, 1 }, { 1, 8, 7 }, { 9, 1, 7 }, { 1, 1, 1 } })
  {
    auto surface = contourOf(randomImage(n, false, 13), 0.15F);
    EXPECT_EQ(surface->GetNumberOfCells(), 0);
  }
  vtkNew<vtkStructuredGrid> empty;
  EXPECT_EQ(contourOf(empty, 0.15F)->GetNumberOfCells(), 0);
  // Values past both ends of the range, and beyond a float.
  auto image = randomImage({ 5, 6, 7 }, false, 14);
  for (double value : { -1.0, 0.0, 0.31, 1e300, -1e300 })
  {
    EXPECT_EQ(contourOf(image, value)->GetNumberOfCells(), 0) << value;
  }
}

TEST(CloudContour, ExtremeValuesAndFlatCellsStayFinite)
{
  // Doubles whose differences overflow, on cells of which some have no volume.
  auto grid = structuredGrid({ 7, 6, 5 },
    [](const Vector& p) -> Vector {
      return { p[0] * p[1], p[1], std::floor(p[2] / 2) };
    });
  vtkNew<vtkDoubleArray> field;
  field->SetName(nephoscope::arrays::CloudFraction);
  std::mt19937 random(15);
  for (vtkIdType id = 0; id < grid->GetNumberOfPoints(); ++id)
  {
    field->InsertNextValue(random() % 2 == 0 ? 1.5e308 : -1.5e308);
  }
  grid->GetPointData()->AddArray(field);
  auto surface = contourOf(grid, 0.5);
  EXPECT_GT(surface->GetNumberOfPoints(), 100);
  for (vtkIdType p = 0; p < surface->GetNumberOfPoints(); ++p)
  {
    Vector normal;
    surface->GetPointData()->GetNormals()->GetTuple(p, normal.data());
    const Vector x = pointOf(surface, p);
    EXPECT_TRUE(std::isfinite(x[0] + x[1] + x[2]));
    EXPECT_NEAR(dot(normal, normal), 1, 1e-5);
  }
}

TEST(CloudContour, SaysWhatIsWrong)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 4, 5);
  vtkNew<vtkFloatArray> wind;
  wind->SetName("Wind");
  wind->SetNumberOfComponents(3);
  wind->SetNumberOfTuples(60);
  wind->Fill(0);
  image->GetPointData()->AddArray(wind);
  vtkNew<vtkCloudContour> contour;
  contour->SetInputData(image);
  EXPECT_NE(errorTextOf(contour).find(
              "No point array 'CloudFraction' to contour; the input has: Wind. Choose one"),
    std::string::npos);
  contour->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Wind");
  EXPECT_NE(
    errorTextOf(contour).find("'Wind' has 3 components; a contour needs one"), std::string::npos);
  vtkNew<vtkCloudContour> notANumber;
  auto good = randomImage({ 3, 4, 5 }, false, 16);
  notANumber->SetInputData(good);
  notANumber->SetValue(0, std::nan(""));
  EXPECT_NE(errorTextOf(notANumber).find("is not finite; give a number"), std::string::npos);
  EXPECT_EQ(notANumber->GetOutput()->GetNumberOfCells(), 0);

  vtkNew<vtkUnstructuredGrid> voxel;
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(8);
  voxel->SetPoints(points);
  const vtkIdType ids[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
  voxel->InsertNextCell(VTK_VOXEL, 8, ids);
  addField(voxel, [](const Vector&) { return 0.0; });
  vtkNew<vtkCloudContour> mixed;
  mixed->SetInputData(voxel);
  EXPECT_NE(errorTextOf(mixed).find("vtkDataSetTriangleFilter makes tetrahedra of them"),
    std::string::npos);
}

TEST(CloudContour, RefusesDataThatAreNotWhole)
{
  auto image = randomImage({ 3, 4, 5 }, false, 17);
  vtkNew<vtkFloatArray> few;
  few->SetName("Few");
  few->SetNumberOfTuples(7);
  few->Fill(1);
  image->GetPointData()->AddArray(few);
  const std::string wanted = "Point array 'Few' has 7 tuples for 60 points; give one for each";
  vtkNew<vtkCloudContour> contour;
  contour->SetInputData(image);
  EXPECT_NE(errorTextOf(contour).find(wanted), std::string::npos);
  EXPECT_EQ(contour->GetOutput()->GetNumberOfPoints(), 0);
  vtkNew<vtkCloudSmooth> smooth;
  smooth->SetInputData(image);
  smooth->SetLength(1);
  EXPECT_NE(errorTextOf(smooth).find(wanted), std::string::npos);
  vtkNew<vtkCloudTexture> texture;
  texture->SetInputData(image);
  EXPECT_NE(errorTextOf(texture).find(wanted), std::string::npos);
}

TEST(CloudContour, RefusesGridsWithoutAPointForEachPlace)
{
  const std::string wanted = "coordinates do not fill its dimensions";
  auto curvilinear = structuredGrid({ 3, 4, 5 }, [](const Vector& p) { return p; });
  addField(curvilinear, [](const Vector& x) { return x[0]; });
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(2);
  curvilinear->SetPoints(points);
  vtkNew<vtkRectilinearGrid> product;
  product->SetDimensions(3, 4, 5);
  vtkNew<vtkFloatArray> axis;
  axis->SetNumberOfTuples(2);
  axis->Fill(0);
  product->SetXCoordinates(axis);
  for (vtkDataSet* grid :
    { static_cast<vtkDataSet*>(curvilinear), static_cast<vtkDataSet*>(product) })
  {
    vtkNew<vtkCloudContour> contour;
    contour->SetInputDataObject(grid);
    EXPECT_NE(errorTextOf(contour).find(wanted), std::string::npos);
    vtkNew<vtkCloudSmooth> smooth;
    smooth->SetInputDataObject(grid);
    EXPECT_NE(errorTextOf(smooth).find(wanted), std::string::npos);
  }
}

TEST(CloudContour, RefusesCellsOnPointsThatThereAreNot)
{
  for (const vtkIdType wrong : { vtkIdType(4), vtkIdType(99999999), vtkIdType(-5) })
  {
    vtkNew<vtkUnstructuredGrid> grid;
    vtkNew<vtkPoints> points;
    for (int n = 0; n < 4; ++n)
    {
      points->InsertNextPoint(n == 1, n == 2, n == 3);
    }
    grid->SetPoints(points);
    const vtkIdType ids[4] = { 0, 1, 2, wrong };
    grid->InsertNextCell(VTK_TETRA, 4, ids);
    addField(grid, [](const Vector& x) { return x[0]; });
    vtkNew<vtkCloudContour> contour;
    contour->SetInputData(grid);
    EXPECT_NE(errorTextOf(contour).find("cells on points that it does not have: its 4 points"),
      std::string::npos);
  }
}

TEST(CloudContour, RefusesATetrahedronOfThreeCorners)
{
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(4);
  grid->SetPoints(points);
  const vtkIdType ids[3] = { 0, 1, 2 };
  grid->InsertNextCell(VTK_TETRA, 3, ids);
  addField(grid, [](const Vector&) { return 0.0; });
  vtkNew<vtkCloudContour> contour;
  contour->SetInputData(grid);
  EXPECT_NE(errorTextOf(contour).find("cells that are not tetrahedra"), std::string::npos);
}
