// SPDX-License-Identifier: BSD-3-Clause
// The contours of many processes; run with the tests of TestRanks.cxx.
#include "PieceTesting.h"
#include "RankTesting.h"

#include "vtkCloudContour.h"
#include "vtkCloudNetCDFReader.h"

#include "vtkNew.h"
#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

namespace
{
/// Numbers of all processes, in rank 0, one process's after another's.
std::vector<double> gathered(const std::vector<double>& own)
{
  const auto size = static_cast<vtkIdType>(own.size());
  std::vector<vtkIdType> sizes(static_cast<std::size_t>(ranks()));
  controller()->AllGather(&size, sizes.data(), 1);
  std::vector<vtkIdType> starts{ 0 };
  for (const vtkIdType n : sizes)
  {
    starts.push_back(starts.back() + n);
  }
  std::vector<double> all(static_cast<std::size_t>(starts.back()));
  controller()->GatherV(own.data(), all.data(), size, sizes.data(), starts.data(), 0);
  return all;
}

/// The triangles of all processes' contours are those of one process's, to the bit.
TEST(RankedSurface, HasTheTrianglesOfTheWhole)
{
  vtkNew<vtkCloudNetCDFReader> reader;
  reader->SetFileName(NEPHOSCOPE_SOURCE_DIR "/Data/sample_climate.nc");
  vtkNew<vtkCloudContour> contour;
  contour->SetInputConnection(reader->GetOutputPort());
  contour->UpdatePiece(rank(), ranks(), 0);
  std::vector<Triangle> own;
  addTriangles(contour->GetOutput(), own);
  std::vector<double> numbers(own.size() * sizeof(Triangle) / sizeof(double));
  std::memcpy(numbers.data(), own.data(), own.size() * sizeof(Triangle));
  const std::vector<double> all = gathered(numbers);
  if (rank() == 0)
  {
    std::vector<Triangle> together(all.size() * sizeof(double) / sizeof(Triangle));
    std::memcpy(together.data(), all.data(), all.size() * sizeof(double));
    std::sort(together.begin(), together.end());
    const auto whole = trianglesInPieces(1,
      [&contour](int piece, int pieces)
      {
        contour->UpdatePiece(piece, pieces, 0);
        return contour->GetOutput();
      });
    EXPECT_GT(whole.size(), 1000U);
    EXPECT_TRUE(together == whole);
  }
}
}
