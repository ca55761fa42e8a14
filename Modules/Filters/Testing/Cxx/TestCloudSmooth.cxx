// SPDX-License-Identifier: BSD-3-Clause
#include "ContourTesting.h"
#include "vtkCloudSmooth.h"

namespace
{
vtkDataArray* smoothed(vtkCloudSmooth* filter)
{
  return vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0))
    ->GetPointData()
    ->GetArray(nephoscope::arrays::CloudFraction);
}

/// A globe from pole to pole, one layer thick or more, radius in m, the last column on the first.
vtkSmartPointer<vtkStructuredGrid> wholeGlobe(const std::array<int, 3>& n)
{
  return structuredGrid(n,
    [n](const Vector& p) -> Vector
    {
      const double lon = 2 * Pi * (int(p[0]) % (n[0] - 1)) / (n[0] - 1);
      const double lat = Pi * (p[1] / (n[1] - 1) - 0.5);
      const double r = 6.371e6 + 1e4 * p[2];
      return { r * std::cos(lat) * std::cos(lon), r * std::cos(lat) * std::sin(lon),
        r * std::sin(lat) };
    });
}
}

TEST(CloudSmooth, WavesAreMultipliedByTheStatedFactor)
{
  // On a cylinder, a closed line of uniform steps d; along z a cosine that fits the open ends.
  const std::array<int, 3> n = { 49, 31, 2 };
  const double radius = 1000;
  const double dz = 100;
  auto grid = structuredGrid(n,
    [n, radius, dz](const Vector& p) -> Vector
    {
      const double a = 2 * Pi * (int(p[0]) % (n[0] - 1)) / (n[0] - 1);
      return { (radius + p[2]) * std::cos(a), (radius + p[2]) * std::sin(a), dz * p[1] };
    });
  for (int waves : { 1, 4, 24 })
  {
    for (int halves : { 0, 3 })
    {
      vtkNew<vtkDoubleArray> field;
      field->SetName(nephoscope::arrays::CloudFraction);
      for (vtkIdType id = 0; id < grid->GetNumberOfPoints(); ++id)
      {
        field->InsertNextValue(
          std::cos(2 * Pi * waves * (id % 49) / 48) * std::cos(Pi * halves * (id / 49 % 31) / 30));
      }
      grid->GetPointData()->AddArray(field);
      vtkNew<vtkCloudSmooth> filter;
      filter->SetInputData(grid);
      filter->SetLength(150);
      filter->SetPasses(3);
      filter->Update();
      const double s = 150 * 150 / 6.0;
      const double d = 2 * radius * std::sin(Pi / 48);
      const double factor =
        std::pow(1 + s * 4 / (d * d) * std::pow(std::sin(Pi * waves / 48), 2), -3) *
        std::pow(1 + s * 4 / (dz * dz) * std::pow(std::sin(Pi * halves / 60), 2), -3);
      for (vtkIdType id = 0; id < vtkIdType(49) * 31; ++id) // the inner layer, whose radius that is
      {
        EXPECT_NEAR(smoothed(filter)->GetComponent(id, 0), factor * field->GetValue(id), 1e-12);
      }
    }
  }
}

TEST(CloudSmooth, ManyPassesAreAGaussian)
{
  // exp(-kappa^2 L^2 / 2) for a wave that steps resolve.
  const int m = 400;
  auto grid = structuredGrid({ m + 1, 2, 2 }, [](const Vector& p) -> Vector { return p; });
  const double kappa = 8 * Pi / m;
  vtkNew<vtkDoubleArray> field;
  field->SetName(nephoscope::arrays::CloudFraction);
  for (vtkIdType id = 0; id < grid->GetNumberOfPoints(); ++id)
  {
    field->InsertNextValue(std::cos(kappa * (id % (m + 1))));
  }
  grid->GetPointData()->AddArray(field);
  vtkNew<vtkCloudSmooth> filter;
  filter->SetInputData(grid);
  filter->SetLength(15);
  filter->SetPasses(100);
  filter->Update();
  EXPECT_NEAR(smoothed(filter)->GetComponent(0, 0), std::exp(-kappa * kappa * 225 / 2), 2e-3);
}

TEST(CloudSmooth, ConservesTheAreaWeightedMeanOnAGlobeAndStaysInRange)
{
  const std::array<int, 3> n = { 61, 37, 3 };
  auto grid = wholeGlobe(n);
  std::mt19937 random(3);
  addField(grid, [&random](const Vector&) { return random() % 2; });
  auto* field = grid->GetPointData()->GetArray(0);
  for (vtkIdType row = 0; row < vtkIdType(n[1]) * n[2]; ++row)
  {
    // One value at each pole, and the seam closed.
    const int j = int(row) % n[1];
    for (int i = 0; i < n[0]; ++i)
    {
      if (j == 0 || j == n[1] - 1 || i == n[0] - 1)
      {
        field->SetComponent(row * n[0] + i, 0, field->GetComponent(row * n[0], 0));
      }
    }
  }
  vtkNew<vtkCloudSmooth> filter;
  filter->SetInputData(grid);
  filter->SetLength(8e5);
  filter->Update();
  for (int k = 0; k < n[2]; ++k)
  {
    double sums[3] = { 0, 0, 0 };
    for (int j = 0; j < n[1]; ++j)
    {
      const double area = std::cos(Pi * (double(j) / (n[1] - 1) - 0.5));
      for (int i = 0; i < n[0]; ++i)
      {
        const vtkIdType id = i + n[0] * (j + n[1] * k);
        const double value = smoothed(filter)->GetComponent(id, 0);
        EXPECT_GE(value, -1e-6);
        EXPECT_LE(value, 1 + 1e-6);
        sums[0] += i < n[0] - 1 ? area : 0;
        sums[1] += i < n[0] - 1 ? area * field->GetComponent(id, 0) : 0;
        sums[2] += i < n[0] - 1 ? area * value : 0;
      }
      const vtkIdType first = vtkIdType(n[0]) * (j + vtkIdType(n[1]) * k);
      EXPECT_EQ(smoothed(filter)->GetComponent(first, 0),
        smoothed(filter)->GetComponent(first + n[0] - 1, 0));
    }
    // To the area that the poles' rows are given so that they have one: 1e-4 of the globe.
    EXPECT_NEAR(sums[2] / sums[0], sums[1] / sums[0], 1e-4);
  }
  // A pole's row becomes one value.
  EXPECT_NEAR(smoothed(filter)->GetComponent(0, 0), smoothed(filter)->GetComponent(30, 0), 1e-4);
}

TEST(CloudSmooth, SmoothsAsFarInMetresAtEveryLatitude)
{
  // A spot's second moment grows by Length^2 along each direction, at the equator and at 60 degrees.
  const std::array<int, 3> n = { 361, 181, 2 };
  auto grid = wholeGlobe(n);
  const double length = 4e5;
  double spread[2];
  for (int where = 0; where < 2; ++where)
  {
    const int j0 = where == 0 ? 90 : 150;
    const vtkIdType centre = 180 + n[0] * j0;
    const Vector x0 = pointOf(grid, centre);
    addField(grid, [x0](const Vector& x) { return dot(x - x0, x - x0) < 1 ? 1.0 : 0.0; });
    vtkNew<vtkCloudSmooth> filter;
    filter->SetInputData(grid);
    filter->SetLength(length);
    filter->SetPasses(4);
    filter->Update();
    double sum = 0;
    double moment = 0;
    for (int j = 0; j < n[1]; ++j)
    {
      const double area = std::cos(Pi * (j - 90) / 180);
      for (int i = 0; i < n[0] - 1; ++i)
      {
        const vtkIdType id = i + n[0] * j;
        const double value = smoothed(filter)->GetComponent(id, 0);
        const Vector d = pointOf(grid, id) - x0;
        sum += area * value;
        moment += area * value * dot(d, d);
      }
    }
    spread[where] = moment / sum;
  }
  EXPECT_NEAR(spread[0] / (2 * length * length), 1, 0.02);
  EXPECT_NEAR(spread[1] / (2 * length * length), 1, 0.06); // the parallel curves
}

TEST(CloudSmooth, MissingValuesStayAndDoNotSpread)
{
  auto image = randomImage({ 20, 9, 4 }, false, 4);
  auto* field = image->GetPointData()->GetArray(0);
  field->SetComponent(47, 0, NAN);
  image->AllocatePointGhostArray();
  image->GetPointGhostArray()->SetValue(90, vtkDataSetAttributes::HIDDENPOINT);
  field->SetComponent(90, 0, 1e30);
  vtkNew<vtkCloudSmooth> filter;
  filter->SetInputData(image);
  filter->SetLength(3);
  filter->Update();
  for (vtkIdType id = 0; id < image->GetNumberOfPoints(); ++id)
  {
    const double value = smoothed(filter)->GetComponent(id, 0);
    EXPECT_EQ(std::isnan(value), id == 47);
    EXPECT_TRUE(id == 47 || id == 90 || (value >= 0 && value <= 0.31F)) << id;
  }
  EXPECT_EQ(smoothed(filter)->GetComponent(90, 0), 1e30F);
}

TEST(CloudSmooth, NamedArraysAreSmoothedAndOthersPass)
{
  auto image = randomImage({ 8, 7, 3 }, false, 5);
  vtkNew<vtkFloatArray> wind;
  wind->SetName(nephoscope::arrays::Wind);
  wind->SetNumberOfComponents(3);
  for (vtkIdType id = 0; id < image->GetNumberOfPoints(); ++id)
  {
    wind->InsertNextTuple3(7, id % 2, id);
  }
  image->GetPointData()->AddArray(wind);
  vtkNew<vtkCloudSmooth> filter;
  filter->SetInputData(image);
  filter->AddSmoothedArray(nephoscope::arrays::Wind);
  filter->SetLength(2);
  filter->Update();
  EXPECT_EQ(smoothed(filter), image->GetPointData()->GetArray(0));
  auto* result = vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0))
                   ->GetPointData()
                   ->GetArray(nephoscope::arrays::Wind);
  EXPECT_NE(result, wind.Get());
  for (vtkIdType id = 0; id < image->GetNumberOfPoints(); ++id)
  {
    EXPECT_NEAR(result->GetComponent(id, 0), 7, 1e-5);
    EXPECT_NEAR(result->GetComponent(id, 1), 0.5, 0.3);
  }
}

TEST(CloudSmooth, SaysWhichArrayIsMissing)
{
  auto image = randomImage({ 4, 3, 2 }, false, 6);
  vtkNew<vtkCloudSmooth> filter;
  filter->SetInputData(image);
  filter->AddSmoothedArray("Cloudiness");
  EXPECT_NE(errorTextOf(filter).find("No point array 'Cloudiness' to smooth"), std::string::npos);
}

TEST(CloudSmooth, ThinGridsAndNoLength)
{
  for (const std::array<int, 3>& n :
    { std::array<int, 3>{ 1, 9, 4 }, { 9, 1, 4 }, { 1, 1, 4 }, { 2, 2, 1 } })
  {
    auto image = randomImage(n, false, 7);
    vtkNew<vtkCloudSmooth> filter;
    filter->SetInputData(image);
    filter->SetLength(5);
    filter->Update();
    for (vtkIdType id = 0; id < image->GetNumberOfPoints(); ++id)
    {
      const double value = smoothed(filter)->GetComponent(id, 0);
      EXPECT_TRUE(value >= -1e-6 && value <= 0.3F + 1e-6);
    }
    filter->SetLength(0);
    filter->Update();
    EXPECT_EQ(smoothed(filter), image->GetPointData()->GetArray(0));
  }
}
