// SPDX-License-Identifier: BSD-3-Clause
// Pieces, without processes: the parts that the pipeline makes one after the other are, together, the whole to the bit.
#include "PieceTesting.h"

#include "ColumnBlocks.h"
#include "vtkCloudContour.h"
#include "vtkCloudNetCDFReader.h"
#include "vtkCloudSmooth.h"
#include "vtkCloudTexture.h"
#include "vtkCloudTextureAdvection.h"
#include "vtkCloudTimeInterpolator.h"

#include "vtkDataSetAttributes.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkStructuredGrid.h"
#include "vtkTrivialProducer.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace
{
using nephoscope::PointExtent;

const std::string Climate = std::string(NEPHOSCOPE_SOURCE_DIR) + "/Data/sample_climate.nc";
constexpr double Hour = 3600;
const std::vector<int> Divisions{ 2, 3, 4, 7 };
const std::vector<int> OneDivision{ 3 }; // for filters that work on the whole and cut

/// The whole grid of a reader, to look points up in.
class Whole
{
public:
  explicit Whole(vtkCloudNetCDFReader* reader)
  {
    reader->UpdatePiece(0, 1, 0);
    this->Grid->DeepCopy(reader->GetOutput());
    this->Grid->GetExtent(this->Extent.data());
  }
  /// The point (i, j, k), on a ring beyond its ends too.
  vtkIdType id(int i, int j, int k) const
  {
    const int ring = this->Extent[1];
    const int column = i < 0 ? i + ring : i > ring ? i - ring : i;
    return column + (ring + 1) * (j + vtkIdType(this->Extent[3] + 1) * k);
  }
  vtkNew<vtkStructuredGrid> Grid;
  PointExtent Extent;
};

bool sameTuple(vtkDataArray* a, vtkIdType at, vtkDataArray* b, vtkIdType bt)
{
  for (int c = 0; c < a->GetNumberOfComponents(); ++c)
  {
    const double x = a->GetComponent(at, c);
    const double y = b->GetComponent(bt, c);
    if (x != y && !(std::isnan(x) && std::isnan(y)))
    {
      return false;
    }
  }
  return true;
}

/// Every array of a piece, places too, has the whole's values; counts the cells that are the piece's own.
void comparePiece(vtkStructuredGrid* piece, const Whole& whole, std::map<vtkIdType, int>& cells)
{
  PointExtent e;
  piece->GetExtent(e.data());
  vtkUnsignedCharArray* const ghosts = piece->GetCellGhostArray();
  vtkIdType point = 0;
  vtkIdType cell = 0;
  int different = 0;
  for (int k = e[4]; k <= e[5]; ++k)
  {
    for (int j = e[2]; j <= e[3]; ++j)
    {
      for (int i = e[0]; i <= e[1]; ++i, ++point)
      {
        const vtkIdType there = whole.id(i, j, k);
        different +=
          sameTuple(piece->GetPoints()->GetData(), point, whole.Grid->GetPoints()->GetData(), there)
          ? 0
          : 1;
        for (const char* name : { nephoscope::arrays::CloudFraction, nephoscope::arrays::Wind,
               nephoscope::arrays::Height })
        {
          different += sameTuple(piece->GetPointData()->GetArray(name), point,
                         whole.Grid->GetPointData()->GetArray(name), there)
            ? 0
            : 1;
        }
        if (i < e[1] && j < e[3] && k < e[5])
        {
          const bool own =
            !ghosts || (ghosts->GetValue(cell) & vtkDataSetAttributes::DUPLICATECELL) == 0;
          if (own)
          {
            ++cells[there];
          }
          ++cell;
        }
      }
    }
  }
  EXPECT_EQ(different, 0);
}

/// The reader's pieces, ghosts included, are parts of the whole, and each cell is one piece's own.
void expectReaderInPieces(int geometry, int pieces, int ghosts)
{
  SCOPED_TRACE(testing::Message() << pieces << " pieces, geometry " << geometry);
  vtkNew<vtkCloudNetCDFReader> reader;
  reader->SetFileName(Climate.c_str());
  reader->SetGeometry(geometry);
  const Whole whole(reader);
  std::map<vtkIdType, int> cells;
  for (int piece = 0; piece < pieces; ++piece)
  {
    reader->UpdatePiece(piece, pieces, ghosts);
    ASSERT_GT(reader->GetOutput()->GetNumberOfPoints(), 0);
    PointExtent e;
    reader->GetOutput()->GetExtent(e.data());
    EXPECT_EQ(e[4], 0);
    EXPECT_EQ(e[5], whole.Extent[5]) << "levels are not divided";
    comparePiece(reader->GetOutput(), whole, cells);
  }
  EXPECT_EQ(static_cast<vtkIdType>(cells.size()), whole.Grid->GetNumberOfCells());
  for (const auto& [cell, owners] : cells)
  {
    ASSERT_EQ(owners, 1) << cell;
  }
}

TEST(ReaderInPieces, GlobeWithGhostsAcrossTheSeam)
{
  for (const int pieces : Divisions)
  {
    expectReaderInPieces(vtkCloudNetCDFReader::Globe, pieces, 2);
  }
}

TEST(ReaderInPieces, MapEndsAtItsSeam)
{
  expectReaderInPieces(vtkCloudNetCDFReader::Map, 4, 1);
  expectReaderInPieces(vtkCloudNetCDFReader::Map, 5, 0);
}

TEST(ReaderInPieces, GhostsGoOnBeyondTheSeam)
{
  vtkNew<vtkCloudNetCDFReader> reader;
  reader->SetFileName(Climate.c_str());
  reader->UpdatePiece(0, 2, 3); // the western half
  PointExtent west;
  reader->GetOutput()->GetExtent(west.data());
  EXPECT_EQ(west[0], -3);
  EXPECT_EQ(west[1], 64 + 3);
  vtkUnsignedCharArray* const ghosts = reader->GetOutput()->GetPointGhostArray();
  ASSERT_TRUE(ghosts);
  EXPECT_EQ(ghosts->GetValue(0), vtkDataSetAttributes::DUPLICATEPOINT);
  EXPECT_EQ(ghosts->GetValue(3), 0);
}

/// More pieces than columns of cells, 5 x 3 of them: each has one, the others none.
TEST(ColumnBlocks, PiecesLeftOverAreEmpty)
{
  const PointExtent whole{ 2, 7, -1, 2, 0, 9 };
  std::map<std::pair<int, int>, int> owners;
  int empty = 0;
  for (int piece = 0; piece < 40; ++piece)
  {
    PointExtent block;
    if (!nephoscope::columnBlock(whole, piece, 40, block))
    {
      ++empty;
      continue;
    }
    EXPECT_EQ(block[4], 0);
    EXPECT_EQ(block[5], 9);
    for (int j = block[2]; j < block[3]; ++j)
    {
      for (int i = block[0]; i < block[1]; ++i)
      {
        ++owners[{ i, j }];
      }
    }
  }
  EXPECT_EQ(empty, 40 - 15);
  EXPECT_EQ(owners.size(), 15U);
  for (const auto& [cell, count] : owners)
  {
    EXPECT_EQ(count, 1) << cell.first << ", " << cell.second;
  }
}

TEST(ColumnBlocks, RingsGoOnForEver)
{
  const PointExtent whole{ 5, 8, 0, 24, 0, 1 }; // 3 columns of cells
  const int points[] = { 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 3, 1, 2, 0, 1, 2 };
  for (int n = 0; n < 16; ++n)
  {
    EXPECT_EQ(nephoscope::ringColumn(whole, n - 2, 0), points[n]) << n;
    EXPECT_EQ(nephoscope::ringColumn(whole, n - 2, 1), points[n] % 3) << n;
  }
}

/// Blocks of a large grid differ in size by what rounding leaves.
TEST(ColumnBlocks, AreBalanced)
{
  const PointExtent whole{ 0, 320, 0, 161, 0, 18 };
  for (const int pieces : { 2, 3, 5, 16, 1000 })
  {
    double least = 1e30;
    double most = 0;
    for (int piece = 0; piece < pieces; ++piece)
    {
      PointExtent block;
      ASSERT_TRUE(nephoscope::columnBlock(whole, piece, pieces, block));
      const double cells = double(block[1] - block[0]) * (block[3] - block[2]);
      least = std::min(least, cells);
      most = std::max(most, cells);
    }
    EXPECT_LT(most / least, pieces < 100 ? 1.1 : 1.8) << pieces;
  }
}

/// The contour of a filter's output in one piece and in several.
void expectSameSurface(
  vtkAlgorithm* source, double time, double value, const std::vector<int>& divisions)
{
  vtkNew<vtkCloudContour> contour;
  contour->SetInputConnection(source->GetOutputPort());
  contour->SetValue(0, value);
  const auto update = [&contour, time](int piece, int pieces)
  {
    contour->UpdateTimeStep(time, piece, pieces, 0);
    return contour->GetOutput();
  };
  const std::vector<Triangle> whole = trianglesInPieces(1, update);
  ASSERT_GT(whole.size(), 1000U);
  for (const int pieces : divisions)
  {
    const std::vector<Triangle> parts = trianglesInPieces(pieces, update);
    EXPECT_EQ(parts.size(), whole.size()) << pieces;
    EXPECT_TRUE(parts == whole) << pieces;
  }
}

TEST(ContourInPieces, HasTheTrianglesOfTheWhole)
{
  for (const int geometry : { vtkCloudNetCDFReader::Globe, vtkCloudNetCDFReader::Map })
  {
    SCOPED_TRACE(geometry);
    vtkNew<vtkCloudNetCDFReader> reader;
    reader->SetFileName(Climate.c_str());
    reader->SetGeometry(geometry);
    expectSameSurface(reader, 0, 0.15, Divisions);
  }
}

/// With 10,000 pieces for 128 x 65 columns most have nothing, without an error.
TEST(ContourInPieces, EmptyPiecesAreSilent)
{
  vtkNew<vtkCloudNetCDFReader> reader;
  reader->SetFileName(Climate.c_str());
  vtkNew<vtkCloudContour> contour;
  contour->SetInputConnection(reader->GetOutputPort());
  int full = 0;
  for (int piece = 0; piece < 10000; piece += 97)
  {
    EXPECT_EQ(contour->UpdatePiece(piece, 10000, 0), 1);
    full += reader->GetOutput()->GetNumberOfPoints() > 0 ? 1 : 0;
  }
  EXPECT_GT(full, 0);
  EXPECT_LT(full, 104);
}

TEST(SmoothInPieces, IsThatOfTheWhole)
{
  vtkNew<vtkCloudNetCDFReader> reader;
  reader->SetFileName(Climate.c_str());
  vtkNew<vtkCloudSmooth> smooth;
  smooth->SetInputConnection(reader->GetOutputPort());
  smooth->SetLength(300e3);
  expectSameSurface(smooth, 0, 0.15, OneDivision);
}

TEST(TimeInterpolatorInPieces, IsThatOfTheWhole)
{
  vtkNew<vtkCloudNetCDFReader> reader;
  reader->SetFileName(Climate.c_str());
  reader->UpdateInformation();
  vtkNew<vtkCloudTimeInterpolator> between;
  between->SetInputConnection(reader->GetOutputPort());
  between->SetInterpolationToLinear();
  expectSameSurface(
    between, 0.4 * reader->GetTimeValue(0) + 0.6 * reader->GetTimeValue(1), 0.15, OneDivision);
}

/// The corners' texture coordinates are compared too.
TEST(TextureInPieces, IsThatOfTheWhole)
{
  vtkNew<vtkCloudNetCDFReader> reader;
  reader->SetFileName(Climate.c_str());
  reader->UpdateInformation();
  vtkNew<vtkCloudTextureAdvection> advection;
  advection->SetInputConnection(reader->GetOutputPort());
  vtkNew<vtkCloudTexture> texture;
  texture->SetInputConnection(advection->GetOutputPort());
  expectSameSurface(texture, reader->GetTimeValue(1) + Hour, 0.15, OneDivision);
}

/// The same of data that are there as a whole and cut by a filter: one that smooths by nothing.
void expectSameCutSurface(vtkDataSet* data, double value)
{
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(data);
  vtkNew<vtkCloudSmooth> cut;
  cut->SetLength(0);
  cut->SetInputConnection(producer->GetOutputPort());
  expectSameSurface(cut, 0, value, Divisions);
}

/// An image's gradients are made in another way, axis by axis.
TEST(ContourInPieces, OfAnImage)
{
  vtkNew<vtkImageData> image;
  image->SetExtent(-3, 25, 2, 21, 0, 8);
  image->SetSpacing(0.7, 1.1, 1.9);
  vtkNew<vtkFloatArray> cloud;
  cloud->SetName(nephoscope::arrays::CloudFraction);
  for (vtkIdType p = 0; p < image->GetNumberOfPoints(); ++p)
  {
    double x[3];
    image->GetPoint(p, x);
    cloud->InsertNextValue(
      static_cast<float>(std::sin(x[0]) * std::cos(0.5 * x[1]) + std::sin(0.3 * x[2])));
  }
  image->GetPointData()->SetScalars(cloud);
  expectSameCutSurface(image, 0.25);
}

/// A globe of 2 n + 1 cells round, whose surface is open at its seam: its normals there are the same in pieces.
TEST(ContourInPieces, OddNumberOfCellsRoundTheGlobe)
{
  vtkNew<vtkStructuredGrid> grid;
  const int n[3] = { 32, 14, 5 };
  grid->SetDimensions(n);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkFloatArray> cloud;
  cloud->SetName(nephoscope::arrays::CloudFraction);
  for (int p = 0; p < n[0] * n[1] * n[2]; ++p)
  {
    const double longitude = p % n[0] % (n[0] - 1) * 2 * 3.14159265358979 / (n[0] - 1);
    const double latitude = (p / n[0] % n[1] - 6.5) * 0.2;
    const int level = p / n[0] / n[1];
    const double height = level;
    const double r = 100 + height;
    points->InsertNextPoint(r * std::cos(latitude) * std::cos(longitude),
      r * std::cos(latitude) * std::sin(longitude), r * std::sin(latitude));
    cloud->InsertNextValue(static_cast<float>(
      0.5 + 0.4 * std::sin(5 * longitude + 0.7) * std::cos(4 * latitude) - 0.05 * (height - 2)));
  }
  grid->SetPoints(points);
  grid->GetPointData()->SetScalars(cloud);
  vtkObject::GlobalWarningDisplayOff(); // the whole says that it is open at the seam
  expectSameCutSurface(grid, 0.5);
  vtkObject::GlobalWarningDisplayOn();
}
}
