// SPDX-License-Identifier: BSD-3-Clause
// Many processes: run by mpirun with 1 to 5 of them. Pictures are those of one process.
#include "CloudArrays.h"
#include "RankTesting.h"

#include "vtkCloudCellVolume.h"
#include "vtkCloudContour.h"
#include "vtkCloudGlobe.h"
#include "vtkCloudGradedBackdrop.h"
#include "vtkCloudNetCDFReader.h"
#include "vtkCloudPicture.h"
#include "vtkCloudSmooth.h"
#include "vtkCloudSurface.h"
#include "vtkCloudUniformMedium.h"
#include "vtkCloudscape.h"

#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkExecutive.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStructuredGrid.h"
#include "vtkTrivialProducer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace
{
const std::string Climate = std::string(NEPHOSCOPE_SOURCE_DIR) + "/Data/sample_climate.nc";

/// A globe seen from 4 radii away, off its axes.
void look(vtkCloudscape* scape, int width, int height)
{
  constexpr double Radius = 6371229;
  vtkNew<vtkCamera> camera;
  camera->SetPosition(2.9 * Radius, -1.7 * Radius, 2.1 * Radius);
  camera->SetFocalPoint(0, 0, 0);
  camera->SetViewUp(0, 0, 1);
  camera->SetViewAngle(32);
  scape->SetCamera(camera);
  scape->SetSize(width, height);
}

/// The largest difference of all values of two pictures; infinite ones have to be in the same places.
double difference(vtkImageData* a, vtkImageData* b)
{
  double most = 0;
  for (const char* name :
    { nephoscope::arrays::Radiance, nephoscope::arrays::Transmittance, nephoscope::arrays::Depth })
  {
    vtkDataArray* const x = a->GetPointData()->GetArray(name);
    vtkDataArray* const y = b->GetPointData()->GetArray(name);
    if (!x || !y || x->GetNumberOfTuples() != y->GetNumberOfTuples())
    {
      return INFINITY;
    }
    const double unit = std::string(name) == nephoscope::arrays::Depth ? 1e7 : 1; // m
    for (vtkIdType p = 0; p < x->GetNumberOfTuples(); ++p)
    {
      for (int c = 0; c < x->GetNumberOfComponents(); ++c)
      {
        const double u = x->GetComponent(p, c);
        const double v = y->GetComponent(p, c);
        most = u == v ? most : std::max(most, std::abs(u - v) / unit);
      }
    }
  }
  return most;
}

double brightest(vtkImageData* image)
{
  double range[2];
  image->GetPointData()->GetArray(nephoscope::arrays::Radiance)->GetRange(range, 0);
  return range[1];
}

/// The picture by all ranks and by one are compared in rank 0.
void expectSamePicture(vtkCloudscape* together, vtkCloudscape* alone)
{
  together->SetController(controller());
  together->Update();
  if (rank() > 0)
  {
    EXPECT_EQ(together->GetOutput()->GetNumberOfPoints(), 0);
    return;
  }
  alone->Update();
  ASSERT_GT(alone->GetNumberOfSegments(), 1000);
  EXPECT_GT(brightest(alone->GetOutput()), 0.1);
  EXPECT_LE(difference(together->GetOutput(), alone->GetOutput()), 1e-6);
}

/// Cells as fog, a translucent surface in them, with a sheet of haze and a globe that all processes have.
class Scene
{
public:
  explicit Scene(vtkAlgorithm* cells)
  {
    this->Contour->SetInputConnection(cells->GetOutputPort());
    this->Contour->SetValue(0, 0.4);
    this->Surface->SetInputConnection(this->Contour->GetOutputPort());
    this->Volume->SetInputConnection(cells->GetOutputPort());
    this->Globe->SetRadius(6371229);
    this->Haze->SetExtinction(2e-8, 3e-8, 4e-8);
    this->Haze->SetColor(0.2, 0.3, 0.4);
    this->Sky->SetColor(0.01, 0.02, 0.05);
    this->Scape->SetBackdrop(this->Sky);
  }
  void AddFog() { this->Scape->AddBody(this->Volume); }
  void AddAll()
  {
    this->Surface->SetOpacity(0.6);
    this->Scape->AddBody(this->Surface);
    this->Scape->AddBody(this->Haze);
    this->Scape->AddBody(this->Globe);
    this->AddFog();
  }

  vtkNew<vtkCloudContour> Contour;
  vtkNew<vtkCloudSurface> Surface;
  vtkNew<vtkCloudCellVolume> Volume;
  vtkNew<vtkCloudGlobe> Globe;
  vtkNew<vtkCloudUniformMedium> Haze;
  vtkNew<vtkCloudGradedBackdrop> Sky;
  vtkNew<vtkCloudscape> Scape;
};

/// The same scene twice, on readers of their own; `arrange` puts bodies into each. Returns that of all processes.
template <class Arrange>
vtkSmartPointer<vtkCloudscape> expectSamePictureOfClimate(Arrange&& arrange)
{
  vtkNew<vtkCloudNetCDFReader> readers[2];
  for (vtkCloudNetCDFReader* reader : { readers[0].Get(), readers[1].Get() })
  {
    reader->SetFileName(Climate.c_str());
    reader->SetVerticalExaggeration(40);
  }
  Scene together(readers[0]);
  Scene alone(readers[1]);
  arrange(together);
  arrange(alone);
  expectSamePicture(together.Scape, alone.Scape);
  if (rank() == 0 && alone.Scape->GetNumberOfBodies() == 1)
  {
    EXPECT_EQ(together.Scape->GetNumberOfSegments(), alone.Scape->GetNumberOfSegments());
  }
  return together.Scape.Get();
}

/// Blocks of columns follow one another along nearly all rays: processes send what their segments, 24 bytes each, amount to.
TEST(RankedPicture, SendsFarLessThanItsSegments)
{
  vtkNew<vtkCloudNetCDFReader> reader;
  reader->SetFileName(Climate.c_str());
  reader->SetVerticalExaggeration(40);
  Scene scene(reader);
  scene.Scape->AddBody(scene.Surface);
  scene.AddFog();
  look(scene.Scape, 150, 110);
  scene.Scape->SetController(controller());
  scene.Scape->Update();
  const vtkIdType segments = scene.Scape->GetNumberOfSegments();
  const vtkIdType sent = scene.Scape->GetBytesSent();
  EXPECT_GT(segments, 10000);
  EXPECT_EQ(sent > 0, ranks() > 1);
  EXPECT_LT(5 * sent, 24 * segments);
}

/// Haze overlaps all pieces: after the first round of tiles all segments are sent.
TEST(RankedPicture, HazeEverywhereInManyRounds)
{
  const auto together = expectSamePictureOfClimate(
    [](Scene& scene)
    {
      scene.AddAll();
      scene.Scape->SetTileSize(4);
      look(scene.Scape, 97, 83);
    });
  // One in `ranks` stays where it is. With runs and requests it would be 27.7 bytes or more for each segment.
  const auto segments = static_cast<double>(together->GetNumberOfSegments());
  const auto sent = static_cast<double>(together->GetBytesSent());
  EXPECT_LE(ranks() * sent, 26.8 * (ranks() - 1) * segments);
  EXPECT_GT(segments, 1000);
}

/// No cell is drawn twice or not at all.
TEST(RankedPicture, FogAloneHasAsManySegments)
{
  expectSamePictureOfClimate(
    [](Scene& scene)
    {
      scene.AddFog();
      look(scene.Scape, 64, 48);
    });
}

TEST(RankedPicture, FogAndSurfaceAndGlobeAndHazeInterlock)
{
  expectSamePictureOfClimate(
    [](Scene& scene)
    {
      scene.AddAll();
      look(scene.Scape, 150, 110); // not whole tiles
    });
}

/// Optical depths are summed in each process, and the globe hides.
TEST(RankedPicture, SumsOfOneMedium)
{
  expectSamePictureOfClimate(
    [](Scene& scene)
    {
      scene.Scape->AddBody(scene.Globe);
      scene.AddFog();
      scene.Scape->ComputeDepthOff();
      look(scene.Scape, 200, 97);
    });
}

TEST(RankedPicture, OpaqueSurfaceInFogWithSeveralRaysAPixel)
{
  expectSamePictureOfClimate(
    [](Scene& scene)
    {
      scene.Scape->AddBody(scene.Surface);
      scene.AddFog();
      scene.Scape
        ->ComputeDepthOff(); // yet no sums: the surface of another process may be before the fog
      scene.Scape->SetSamples(2);
      scene.Scape->SetTileSize(16);
      look(scene.Scape, 90, 70);
    });
}

/// One body's pipeline asks for the whole of what another's has a piece of.
TEST(RankedPicture, PipelineThatIsShared)
{
  vtkNew<vtkCloudNetCDFReader> readers[2];
  vtkNew<vtkCloudSmooth> smooth[2];
  std::unique_ptr<Scene> scenes[2];
  for (int n = 0; n < 2; ++n)
  {
    readers[n]->SetFileName(Climate.c_str());
    readers[n]->SetVerticalExaggeration(40);
    smooth[n]->SetInputConnection(readers[n]->GetOutputPort());
    scenes[n] = std::make_unique<Scene>(readers[n]);
    scenes[n]->Contour->SetInputConnection(smooth[n]->GetOutputPort());
    scenes[n]->AddAll();
    look(scenes[n]->Scape, 96, 64);
  }
  expectSamePicture(scenes[0]->Scape, scenes[1]->Scape);
}

/// A block of 3 columns of cells: with more processes some have nothing.
vtkSmartPointer<vtkStructuredGrid> fewColumns()
{
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(4, 2, 5);
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> cloud;
  cloud->SetName(nephoscope::arrays::CloudFraction);
  for (int p = 0; p < 40; ++p)
  {
    const int place[3] = { p % 4, p / 4 % 2, p / 8 };
    points->InsertNextPoint(1000 * place[0], 1000 * place[1], 700 * place[2]);
    cloud->InsertNextValue(0.1F * static_cast<float>(p % 7) + 0.2F);
  }
  grid->SetPoints(points);
  grid->GetPointData()->SetScalars(cloud);
  return grid;
}

TEST(RankedPicture, ProcessesWithNothing)
{
  vtkNew<vtkTrivialProducer> producers[2];
  vtkNew<vtkCloudSmooth> cut[2]; // by nothing: it gives pieces
  std::unique_ptr<Scene> scenes[2];
  for (int n = 0; n < 2; ++n)
  {
    producers[n]->SetOutput(fewColumns());
    cut[n]->SetLength(0);
    cut[n]->SetInputConnection(producers[n]->GetOutputPort());
    scenes[n] = std::make_unique<Scene>(cut[n]);
    scenes[n]->Volume->SetFullCoverExtinction(1e-3);
    scenes[n]->Scape->AddBody(scenes[n]->Surface);
    scenes[n]->AddFog();
    scenes[n]->Scape->SetSize(80, 60);
    vtkNew<vtkCamera> camera;
    camera->SetPosition(9000, -8000, 5000);
    camera->SetFocalPoint(1500, 500, 1400);
    camera->SetViewUp(0, 0, 1);
    scenes[n]->Scape->SetCamera(camera);
  }
  expectSamePicture(scenes[0]->Scape, scenes[1]->Scape);
  const bool nothing = cut[0]->GetOutput()->GetNumberOfPoints() == 0;
  EXPECT_EQ(everywhere(!nothing), ranks() <= 3);
}

/// A wall of 90 x 1 x 4 cells that winds round the vertical three times: what one process has of it encloses what another has.
vtkSmartPointer<vtkStructuredGrid> spiral()
{
  constexpr int Columns = 91;
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(Columns, 2, 5);
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> cloud;
  cloud->SetName(nephoscope::arrays::CloudFraction);
  for (int p = 0; p < 2 * 5 * Columns; ++p)
  {
    const double turn = 3.0 * (p % Columns) / (Columns - 1);
    const double radius = 2000 + 1500 * turn - 700 * (p / Columns % 2);
    const double angle = 2 * M_PI * turn;
    const int level = p / (2 * Columns);
    points->InsertNextPoint(radius * std::cos(angle), radius * std::sin(angle), 700 * level);
    cloud->InsertNextValue(0.1F * static_cast<float>(p % 7) + 0.1F);
  }
  grid->SetPoints(points);
  grid->GetPointData()->SetScalars(cloud);
  return grid;
}

/// Pixels in which a process sees something of its own piece, of all processes together.
vtkIdType pixelsOfPieces(Scene& scene)
{
  scene.Scape->SetController(nullptr);
  scene.Scape->Update();
  vtkDataArray* const through =
    scene.Scape->GetOutput()->GetPointData()->GetArray(nephoscope::arrays::Transmittance);
  vtkIdType own = 0;
  for (vtkIdType p = 0; p < through->GetNumberOfTuples(); ++p)
  {
    own += through->GetComponent(p, 0) < 1 ? 1 : 0;
  }
  vtkIdType all = 0;
  controller()->AllReduce(&own, &all, 1, vtkCommunicator::SUM_OP);
  return all;
}

TEST(RankedPicture, PiecesThatEncloseOthers)
{
  vtkNew<vtkTrivialProducer> producers[2];
  vtkNew<vtkCloudSmooth> cut[2]; // by nothing: it gives pieces
  std::unique_ptr<Scene> scenes[2];
  for (int n = 0; n < 2; ++n)
  {
    producers[n]->SetOutput(spiral());
    cut[n]->SetLength(0);
    cut[n]->SetInputConnection(producers[n]->GetOutputPort());
    scenes[n] = std::make_unique<Scene>(cut[n]);
    scenes[n]->Volume->SetFullCoverExtinction(3e-4);
    scenes[n]->Surface->SetOpacity(0.3);
    scenes[n]->Scape->AddBody(scenes[n]->Surface);
    scenes[n]->AddFog();
    scenes[n]->Scape->SetSize(110, 70);
    vtkNew<vtkCamera> camera;
    camera->SetPosition(9000, -14000, 4000);
    camera->SetFocalPoint(0, 0, 1400);
    camera->SetViewUp(0, 0, 1);
    camera->SetViewAngle(40);
    scenes[n]->Scape->SetCamera(camera);
  }
  expectSamePicture(scenes[0]->Scape, scenes[1]->Scape);
  scenes[0]->Scape->ComputeDepthOff(); // nothing is asked for but segments of runs that overlap
  scenes[0]->Scape->Update();
  const vtkIdType sent = scenes[0]->Scape->GetBytesSent();
  vtkNew<vtkTrivialProducer> piece;
  cut[0]->UpdatePiece(rank(), ranks(), 0);
  piece->SetOutput(cut[0]->GetOutput());
  scenes[0]->Volume->SetInputConnection(piece->GetOutputPort());
  scenes[0]->Contour->SetInputConnection(piece->GetOutputPort());
  const vtkIdType runs = pixelsOfPieces(*scenes[0]);
  EXPECT_EQ(static_cast<double>(sent) > 1.1 * 56 * static_cast<double>(runs), ranks() > 1);
}

/// What one process cannot draw none draws, and none waits for ever.
TEST(RankedPicture, ErrorInOneProcess)
{
  const bool wrong = rank() == ranks() - 1;
  vtkSmartPointer<vtkStructuredGrid> grid = fewColumns();
  if (wrong)
  {
    grid->GetPointData()->GetScalars()->SetName("Something");
  }
  vtkNew<vtkCloudCellVolume> volume;
  volume->SetInputData(grid);
  vtkNew<vtkCloudscape> scape;
  scape->SetController(controller());
  scape->AddBody(volume);
  look(scape, 40, 30);
  const Errors ofVolume(volume);
  const Errors ofScape(scape);
  scape->Update();
  EXPECT_EQ(ofVolume.Text.empty(), !wrong);
  const char* const expected = wrong ? "cannot be drawn" : "Another process cannot draw";
  EXPECT_NE(ofScape.Text.find(expected), std::string::npos) << ofScape.Text;
  EXPECT_EQ(scape->GetOutput()->GetNumberOfPoints(), 0);
}

/// They would not understand each other's packets.
TEST(RankedPicture, ProcessesWithOtherSettings)
{
  vtkNew<vtkCloudCellVolume> volume;
  volume->SetInputData(fewColumns());
  vtkNew<vtkCloudscape> scape;
  scape->SetController(controller());
  scape->AddBody(volume);
  look(scape, 40, 30);
  const bool other = ranks() > 1 && rank() == ranks() - 1;
  const auto expectError = [&scape](const char* expected)
  {
    const Errors errors(scape);
    scape->Update();
    EXPECT_EQ(errors.Text.find(expected) != std::string::npos, ranks() > 1) << errors.Text;
    EXPECT_EQ(scape->GetOutput()->GetNumberOfPoints() > 0, ranks() == 1);
    scape->RemoveAllObservers();
  };
  scape->SetTileSize(other ? 16 : 32);
  expectError("Processes differ in Size");
  scape->SetTileSize(32);
  volume->SetVisibility(!other);
  expectError("Processes differ in Size");
  volume->SetVisibility(true);
  scape->SetSize(other ? 0 : 40, 30);
  expectError(other ? "is not within" : "Another process cannot draw the picture");
}

/// A piece that cannot be read is no process without a piece: the picture would have a hole.
TEST(RankedPicture, FileThatOneProcessCannotRead)
{
  const bool wrong = rank() == ranks() - 1;
  vtkNew<vtkCloudNetCDFReader> reader;
  reader->SetFileName(wrong ? "none.nc" : Climate.c_str());
  vtkNew<vtkCloudCellVolume> volume;
  volume->SetInputConnection(reader->GetOutputPort());
  vtkNew<vtkCloudscape> scape;
  scape->SetController(controller());
  scape->AddBody(volume);
  look(scape, 40, 30);
  const Errors ofReader(reader);
  const Errors ofPipeline(reader->GetExecutive());
  const Errors ofScape(scape);
  scape->Update();
  const char* const expected =
    wrong ? "The input of a vtkCloudCellVolume fails" : "Another process cannot draw";
  if (ranks() > 1)
  {
    EXPECT_NE(ofScape.Text.find(expected), std::string::npos) << ofScape.Text;
  }
  EXPECT_EQ(scape->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(RankedPicture, AbortInOneProcess)
{
  vtkNew<vtkCloudNetCDFReader> reader;
  reader->SetFileName(Climate.c_str());
  Scene scene(reader);
  scene.AddFog();
  look(scene.Scape, 700, 500);
  scene.Scape->SetController(controller());
  if (rank() == ranks() - 1)
  {
    vtkNew<vtkCallbackCommand> stop;
    stop->SetCallback([](vtkObject* who, unsigned long, void*, void*)
      { static_cast<vtkAlgorithm*>(who)->AbortExecuteOn(); });
    scene.Scape->AddObserver("ProgressEvent", stop);
  }
  scene.Scape->Update();
  EXPECT_EQ(scene.Scape->GetOutput()->GetNumberOfPoints(), 0);
}

/// In the middle of fewColumns().
vtkSmartPointer<vtkPolyData> triangle()
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(100, 500, 100);
  points->InsertNextPoint(2900, 500, 200);
  points->InsertNextPoint(1600, 500, 2500);
  data->SetPoints(points);
  data->AllocateExact(1, 3);
  const vtkIdType corners[3] = { 0, 1, 2 };
  data->InsertNextCell(VTK_TRIANGLE, 3, corners);
  return data;
}

vtkSmartPointer<vtkCloudPicture> pictureOf(vtkDataObject* first, vtkDataObject* second)
{
  auto picture = vtkSmartPointer<vtkCloudPicture>::New();
  picture->SetSize(90, 60);
  picture->SetInputDataObject(0, first);
  picture->SetInputDataObject(1, second);
  picture->GetVolume()->SetFullCoverExtinction(1e-3);
  picture->GetSurface()->SetOpacity(0.5);
  return picture;
}

/// The grid in the first process, the polygons in the last; the others' pieces are empty polygons or grids.
TEST(RankedFilter, DrawsWhatOneProcessHas)
{
  const auto grid = fewColumns();
  const auto polygons = triangle();
  const vtkNew<vtkStructuredGrid> noGrid;
  const vtkNew<vtkPolyData> noPolygons;
  const bool last = rank() == ranks() - 1;
  vtkDataObject* const ownGrid = rank() == 0 ? grid.Get() : noGrid.Get();
  vtkDataObject* const ownPolygons = last ? polygons.Get() : noPolygons.Get();
  const auto together = pictureOf(ownPolygons, ownGrid);
  together->SetController(controller());
  together->Update();
  const auto bare = pictureOf(ownPolygons, noPolygons);
  bare->SetController(controller());
  bare->Update();
  if (rank() > 0)
  {
    EXPECT_EQ(together->GetOutput()->GetNumberOfPoints(), 0);
    return;
  }
  const auto alone = pictureOf(polygons, grid);
  const auto bareAlone = pictureOf(polygons, nullptr);
  for (vtkCloudPicture* picture : { alone.Get(), bareAlone.Get() })
  {
    picture->SetController(nullptr);
    picture->Update();
    EXPECT_GT(brightest(picture->GetOutput()), 0.1);
  }
  EXPECT_LE(difference(together->GetOutput(), alone->GetOutput()), 1e-6);
  EXPECT_LE(difference(bare->GetOutput(), bareAlone->GetOutput()), 1e-6);
}

/// All of them say so, and none waits for ever.
TEST(RankedFilter, InputThatOneProcessCannotDraw)
{
  const bool last = rank() == ranks() - 1;
  const auto polygons = triangle();
  const vtkNew<vtkPolyData> noPolygons;
  const auto messageOf = [](vtkCloudPicture* picture)
  {
    const Errors errors(picture);
    const Errors ofPipeline(picture->GetExecutive());
    picture->SetController(controller());
    picture->Update();
    EXPECT_EQ(picture->GetOutput()->GetNumberOfPoints(), 0);
    return errors.Text;
  };
  const auto twice = pictureOf(polygons, last ? polygons.Get() : noPolygons.Get());
  EXPECT_NE(messageOf(twice).find("Both inputs are surfaces"), std::string::npos);
  const auto without = pictureOf(polygons, nullptr);
  if (last)
  {
    without->SetSurface(nullptr);
  }
  const char* const expected = last ? "call SetSurface" : "Another process cannot draw its inputs";
  EXPECT_NE(messageOf(without).find(expected), std::string::npos);
  const auto grid = fewColumns();
  vtkDataObject* const other = last ? static_cast<vtkDataObject*>(polygons) : grid;
  const std::string mixed = ranks() > 1 ? messageOf(pictureOf(other, nullptr)) : "Another process";
  EXPECT_NE(mixed.find(last ? "Another process" : "in another"), std::string::npos) << mixed;
}
}

int main(int argc, char* argv[])
{
  return runRankedTests(argc, argv);
}
