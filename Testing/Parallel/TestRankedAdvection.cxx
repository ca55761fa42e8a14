// SPDX-License-Identifier: BSD-3-Clause
// Textures that many processes carry along together: run by mpirun with 1 to 5 of them. To the bit what each makes alone of the whole.
#include "RankTesting.h"
#include "WindSource.h"

#include "CloudArrays.h"
#include "ColumnBlocks.h"
#include "vtkCloudNetCDFReader.h"
#include "vtkCloudTextureAdvection.h"

#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStructuredGrid.h"

#include <functional>

namespace
{
constexpr double Hour = 3600;

/// Tells what nobody else has to know.
class ObservedAdvection : public vtkCloudTextureAdvection
{
public:
  static ObservedAdvection* New();
  vtkTypeMacro(ObservedAdvection, vtkCloudTextureAdvection);
  using vtkCloudTextureAdvection::FarthestReach;
};
vtkStandardNewMacro(ObservedAdvection);

vtkIdType sumOfAll(vtkIdType here)
{
  vtkIdType all = 0;
  controller()->AllReduce(&here, &all, 1, vtkCommunicator::SUM_OP);
  return all;
}

/// Whether this process gets the same from its piece as from the whole, and the same figures. `ghosts` levels about the piece.
void expectPieceOfWhole(
  vtkCloudTextureAdvection* together, vtkCloudTextureAdvection* alone, double time, int ghosts)
{
  SCOPED_TRACE(testing::Message() << time / Hour << " h");
  ASSERT_TRUE(together->UpdateTimeStep(time, rank(), ranks(), ghosts));
  ASSERT_TRUE(alone->UpdateTimeStep(time, 0, 1, 0));
  EXPECT_EQ(together->GetUsedRestartPeriod(), alone->GetUsedRestartPeriod());
  EXPECT_EQ(together->GetMedianStretch(), alone->GetMedianStretch());
  EXPECT_EQ(together->GetMaximumStretch(), alone->GetMaximumStretch());
  EXPECT_EQ(together->GetNumberOfSubsteps(), alone->GetNumberOfSubsteps());
  vtkStructuredGrid* const piece = together->GetOutput();
  vtkStructuredGrid* const whole = alone->GetOutput();
  if (ghosts == 0)
  {
    EXPECT_EQ(sumOfAll(piece->GetNumberOfCells()), whole->GetNumberOfCells());
  }
  if (piece->GetNumberOfPoints() == 0)
  {
    return;
  }
  int e[6];
  piece->GetExtent(e);
  const int* const n = whole->GetDimensions();
  vtkIdType different = 0;
  for (const char* name : { nephoscope::arrays::TextureCoordinates,
         nephoscope::arrays::OtherTextureCoordinates, nephoscope::arrays::TextureStretch })
  {
    vtkDataArray* const a = piece->GetPointData()->GetArray(name);
    vtkDataArray* const b = whole->GetPointData()->GetArray(name);
    ASSERT_EQ(a == nullptr, b == nullptr) << name;
    for (vtkIdType p = 0; a && p < piece->GetNumberOfPoints(); ++p)
    {
      const vtkIdType columns = e[1] - e[0] + 1;
      const int i = e[0] + static_cast<int>(p % columns);
      const vtkIdType row = p / columns;
      const vtkIdType j = e[2] + row % (e[3] - e[2] + 1);
      const vtkIdType k = row / (e[3] - e[2] + 1);
      const int column = nephoscope::ringColumn({ 0, n[0] - 1, 0, 0, 0, 0 }, i, 0);
      for (int c = 0; c < a->GetNumberOfComponents(); ++c)
      {
        different +=
          a->GetComponent(p, c) != b->GetComponent(column + n[0] * (j + n[1] * k), c) ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(different, 0);
  vtkDataArray* const weights = piece->GetFieldData()->GetArray(nephoscope::arrays::TextureWeights);
  ASSERT_EQ(weights != nullptr, together->GetCrossFade());
  if (weights)
  {
    vtkDataArray* const expected =
      whole->GetFieldData()->GetArray(nephoscope::arrays::TextureWeights);
    EXPECT_EQ(weights->GetComponent(0, 0), expected->GetComponent(0, 0));
  }
}

const std::vector<double> ForthAndBack{ 0, 0.7 * Hour, 2 * Hour, 3.4 * Hour, 2.1 * Hour, 5 * Hour,
  0.2 * Hour };

/// The same settings and the same air, with and without the others.
class Pair
{
public:
  explicit Pair(const std::function<void(WindSource*, vtkCloudTextureAdvection*)>& arrange)
  {
    for (int n = 0; n < 2; ++n)
    {
      this->Filter[n]->SetInputConnection(this->Source[n]->GetOutputPort());
      arrange(this->Source[n], this->Filter[n]);
    }
    this->Filter[1]->SetController(nullptr);
  }
  void expectSame(const std::vector<double>& times = ForthAndBack, int ghosts = 1)
  {
    for (const double time : times)
    {
      expectPieceOfWhole(this->Filter[0], this->Filter[1], time, ghosts);
    }
  }
  vtkNew<WindSource> Source[2];
  vtkNew<ObservedAdvection> Filter[2];
};

TEST(RankedAdvection, GlobalMapOverTheSeamAndThePoles)
{
  Pair pair(
    [](WindSource*, vtkCloudTextureAdvection* filter) { filter->SetRestartPeriod(1.5 * Hour); });
  pair.expectSame();
}

/// A closing column, rows at the poles, which stencils go over, and a period of its own.
TEST(RankedAdvection, GlobeWithPoleRowsCubic)
{
  Pair pair(
    [](WindSource* source, vtkCloudTextureAdvection* filter)
    {
      source->Geometry = "Globe";
      source->Columns = 61;
      source->Spacing = 6;
      source->Rows = 19;
      source->FirstLatitude = -90;
      source->RowSpacing = 10;
      filter->SetIntegratorToRungeKutta4();
      filter->SetInterpolationToCubic();
    });
  pair.expectSame();
}

/// From 4 processes on some have a part of the ring and ghosts more than once round it.
TEST(RankedAdvection, MoreGhostsThanColumns)
{
  Pair pair(
    [](WindSource* source, vtkCloudTextureAdvection*)
    {
      source->Geometry = "Globe";
      source->Columns = 4;
      source->Spacing = 120;
      source->Rows = 7;
      source->FirstLatitude = -60;
      source->RowSpacing = 20;
    });
  pair.expectSame({ 1.2 * Hour }, 10);
}

/// Air comes from beyond the edges. Rows from north to south.
TEST(RankedAdvection, RegionOfASphere)
{
  Pair pair(
    [](WindSource* source, vtkCloudTextureAdvection* filter)
    {
      source->FirstLongitude = 155; // over the date line
      source->Spacing = 1.5;
      source->Columns = 37;
      source->FirstLatitude = 60;
      source->RowSpacing = -1.25;
      source->Rows = 21;
      source->Levels = 3;
      filter->CrossFadeOff();
      filter->SetIntegratorToRungeKutta4();
    });
  pair.expectSame(ForthAndBack, 0);
}

TEST(RankedAdvection, Plane)
{
  for (const bool cubic : { false, true })
  {
    Pair pair(
      [cubic](WindSource* source, vtkCloudTextureAdvection* filter)
      {
        source->Geometry = "Local";
        source->Columns = 43;
        source->Rows = 15;
        source->Spacing = 40; // km
        source->RowSpacing = 55;
        filter->SetInterpolation(
          cubic ? vtkCloudTextureAdvection::Cubic : vtkCloudTextureAdvection::Linear);
        filter->SetRestartPeriod(1.3 * Hour);
      });
    pair.expectSame();
  }
}

/// Between rows and levels of opposite wind a cubic overshoots it: parcels come from farther away than any wind at a point carries them.
TEST(RankedAdvection, AirFromBeyondTheReachOfTheStrongestWind)
{
  Pair pair(
    [](WindSource* source, vtkCloudTextureAdvection* filter)
    {
      source->Geometry = "Local";
      source->Columns = 160;
      source->Rows = 9;
      source->Levels = 5;
      source->Spacing = 5; // km
      source->RowSpacing = 75;
      source->Speed = 6;
      source->Roughness = 70;
      filter->SetInterpolationToCubic();
      filter->SetTolerance(1e7); // one step
      filter->CrossFadeOff();
    });
  pair.expectSame({ 2 * Hour, 5 * Hour });
  EXPECT_EQ(pair.Filter[0]->FarthestReach() > 1, ranks() > 1);
  EXPECT_EQ(pair.Filter[1]->FarthestReach(), 1); // the whole is at hand
}

/// A row of 3 columns of cells: with more processes some have nothing.
TEST(RankedAdvection, ProcessesWithNothing)
{
  Pair pair(
    [](WindSource* source, vtkCloudTextureAdvection*)
    {
      source->Geometry = "Local";
      source->Columns = 4;
      source->Rows = 2;
      source->Spacing = source->RowSpacing = 900;
    });
  pair.expectSame();
  EXPECT_EQ(everywhere(pair.Filter[0]->GetOutput()->GetNumberOfPoints() > 0), ranks() <= 3);
}

TEST(RankedAdvection, WithoutTimes)
{
  Pair pair(
    [](WindSource* source, vtkCloudTextureAdvection* filter)
    {
      source->Times.clear();
      filter->CrossFadeOff();
    });
  pair.expectSame({ 0 });
}

/// An input that always gives the whole.
TEST(RankedAdvection, InputsThatAreWhole)
{
  Pair pair([](WindSource* source, vtkCloudTextureAdvection*) { source->GivesPieces = false; });
  pair.expectSame({ 1.2 * Hour, 0.3 * Hour });
}

/// Real data, with more ghosts.
TEST(RankedAdvection, FilesOfAModel)
{
  for (const int geometry : { vtkCloudNetCDFReader::Globe, vtkCloudNetCDFReader::Map })
  {
    vtkNew<vtkCloudNetCDFReader> readers[2];
    vtkNew<vtkCloudTextureAdvection> filters[2];
    for (int n = 0; n < 2; ++n)
    {
      readers[n]->SetFileName(NEPHOSCOPE_SOURCE_DIR "/Data/sample_climate.nc");
      readers[n]->SetGeometry(geometry);
      filters[n]->SetInputConnection(readers[n]->GetOutputPort());
      filters[n]->SetTolerance(1e5); // few substeps
    }
    filters[1]->SetController(nullptr);
    readers[0]->UpdateInformation();
    const double step = readers[0]->GetTimeValue(1) - readers[0]->GetTimeValue(0);
    const bool globe = geometry == vtkCloudNetCDFReader::Globe;
    expectPieceOfWhole(
      filters[0], filters[1], readers[0]->GetTimeValue(0) + (globe ? step : 0.7 * step), 2);
  }
}

/// A part of the pieces, asked for by one process alone, concerns nobody else.
TEST(RankedAdvection, OtherPiecesAreMadeAlone)
{
  if (rank() == 0)
  {
    Pair pair([](WindSource*, vtkCloudTextureAdvection*) {});
    ASSERT_TRUE(pair.Filter[0]->UpdateTimeStep(1.5 * Hour, 2, 7, 1));
    EXPECT_GT(pair.Filter[0]->GetOutput()->GetNumberOfPoints(), 0);
  }
}

/// What one process cannot use none uses, and none waits for ever.
TEST(RankedAdvection, WindIsMissingInOneProcess)
{
  const bool wrong = rank() == ranks() - 1;
  Pair pair([wrong](WindSource* source, vtkCloudTextureAdvection*)
    { source->WithoutWindFrom = wrong ? 2 * Hour : 1e30; });
  const Errors errors(pair.Filter[0]);
  const Errors ofPipeline(pair.Filter[0]->GetExecutive());
  pair.Filter[0]->UpdateTimeStep(2.5 * Hour, rank(), ranks(), 0);
  EXPECT_EQ(pair.Filter[0]->GetOutput()->GetNumberOfPoints(), 0);
  const char* const expected = wrong ? "no point array Wind" : "Another process cannot use";
  EXPECT_NE(errors.Text.find(expected), std::string::npos) << errors.Text;
  // Earlier times are still to be had.
  ASSERT_TRUE(pair.Filter[0]->UpdateTimeStep(0.6 * Hour, rank(), ranks(), 0));
  expectPieceOfWhole(pair.Filter[0], pair.Filter[1], 0.6 * Hour, 0);
}

TEST(RankedAdvection, InputFailsInOneProcess)
{
  const bool wrong = rank() == ranks() - 1;
  Pair pair([wrong](WindSource* source, vtkCloudTextureAdvection*)
    { source->FailsFrom = wrong ? 2 * Hour : 1e30; });
  const Errors ofSource(pair.Source[0]);
  const Errors ofSourcePipeline(pair.Source[0]->GetExecutive());
  const Errors errors(pair.Filter[0]);
  const Errors ofPipeline(pair.Filter[0]->GetExecutive());
  pair.Filter[0]->UpdateTimeStep(2.5 * Hour, rank(), ranks(), 0);
  EXPECT_EQ(pair.Filter[0]->GetOutput()->GetNumberOfPoints(), 0);
  const char* const expected = wrong ? "The input has failed" : "Another process cannot use";
  EXPECT_NE(errors.Text.find(expected), std::string::npos) << errors.Text;
}

TEST(RankedAdvection, AbortInOneProcess)
{
  Pair pair([](WindSource*, vtkCloudTextureAdvection*) {});
  if (rank() == ranks() - 1)
  {
    vtkNew<vtkCallbackCommand> stop;
    stop->SetCallback([](vtkObject* who, unsigned long, void*, void*)
      { static_cast<vtkAlgorithm*>(who)->AbortExecuteOn(); });
    pair.Filter[0]->AddObserver("ProgressEvent", stop);
  }
  pair.Filter[0]->UpdateTimeStep(2.5 * Hour, rank(), ranks(), 0);
  EXPECT_FALSE(
    pair.Filter[0]->GetOutput()->GetPointData()->HasArray(nephoscope::arrays::TextureCoordinates));
}

/// Nobody reads more than its block before the time that is asked for, and then its ghosts.
TEST(RankedAdvection, ProcessesReadTheirOwn)
{
  Pair pair([](WindSource*, vtkCloudTextureAdvection*) {});
  pair.Filter[0]->UpdateTimeStep(2.5 * Hour, rank(), ranks(), 0);
  const vtkIdType whole = 48 * 25 * 4;
  EXPECT_LE(pair.Source[0]->LargestPiece, ranks() == 1 ? whole : whole * 6 / 5 / ranks() + 300);
}
}

int main(int argc, char* argv[])
{
  return runRankedTests(argc, argv);
}
