// SPDX-License-Identifier: BSD-3-Clause
// Light on a globe: Lambert's law for level cloud tops, the sky's share alone by night.
#include "Daylight.h"

#include <CloudArrays.h>
#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStructuredGrid.h>

#include <cmath>

namespace
{
using namespace nephoscope;
using namespace nephoscope::program;

TEST(Daylight, IsLambertsLawByDayAndTheSkysShareByNight)
{
  // Three columns of two levels: the sun overhead, 60 degrees from overhead, and behind the globe.
  const Vector3 verticals[3] = { { 1, 0, 0 }, { 0.5, 0, std::sqrt(0.75) }, { -1, 0, 0 } };
  const vtkNew<vtkPoints> points;
  for (const double radius : { 6.4e6, 6.6e6 })
  {
    for (const Vector3& vertical : verticals)
    {
      points->InsertNextPoint((radius * vertical).v);
    }
  }
  const vtkNew<vtkStructuredGrid> grid;
  grid->SetDimensions(3, 1, 2);
  grid->SetPoints(points);
  SurfaceShade shade;
  shade.towardSun = { 1, 0, 0 };
  shade.sun = { 1, 0.9, 0.8 };
  shade.sky = { 0.4, 0.5, 0.6 };
  shade.ambient = 0.25;
  const auto lit = inDaylight(grid, shade);
  vtkDataArray* const light = lit->GetPointData()->GetArray(arrays::SourceColor);
  ASSERT_NE(light, nullptr);
  EXPECT_EQ(grid->GetPointData()->GetArray(arrays::SourceColor), nullptr)
    << "the input is as it was";
  const double cosines[3] = { 1, 0.5, 0 };
  for (vtkIdType point = 0; point < 6; ++point)
  {
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(light->GetComponent(point, c),
        0.75 * cosines[point % 3] * shade.sun[c] + 0.25 * shade.sky[c], 1e-6)
        << "point " << point << ", component " << c;
    }
  }
}
}
