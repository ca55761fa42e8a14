// SPDX-License-Identifier: BSD-3-Clause
// vtkCloudVolumeMapper in a window, against the software picture, VTK's own mapper and a march along the rays.
#include "CellVolumeReference.h"
#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCloudCellVolume.h"
#include "vtkCloudVolumeMapper.h"
#include "vtkCloudscape.h"
#include "vtkColorTransferFunction.h"
#include "vtkDataSetTriangleFilter.h"
#include "vtkImageData.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTestErrorObserver.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkUnstructuredGridVolumeRayCastMapper.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

using namespace reference;

namespace
{
constexpr int Width = 97;
constexpr int Height = 61;
/// Over black only the window's colour is rounded; over a colour the blending's parts are too.
constexpr double OverBlack = 1 / 255.0;
constexpr double OverColor = 1.5 / 255;
}

class CloudVolumeMapper : public testing::Test
{
protected:
  void SetUp() override
  {
    this->Opacity->AddPoint(0, 0);
    this->Opacity->AddPoint(1, 1);
    this->OneColor();
    this->Property->SetScalarOpacity(this->Opacity);
    this->Property->SetColor(this->Colors);
    this->Property->SetScalarOpacityUnitDistance(0.5);
    this->Property->SetInterpolationTypeToLinear();
    this->Volume->SetProperty(this->Property);
    this->Volume->SetMapper(this->Mapper);
    this->Renderer->AddVolume(this->Volume);
    this->SetBackground(0.2, 0.4, 0.8); // which 8 bits hold
    this->Window->SetOffScreenRendering(1);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(Width, Height);
    this->Window->AddRenderer(this->Renderer);
    vtkCamera* const camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(2, -5, 1.5);
    camera->SetFocalPoint(0, 0, 0);
    camera->SetViewUp(0.1, 0.2, 1);
    camera->SetViewAngle(30);
    camera->SetClippingRange(1, 20);
  }

  void SetBackground(double r, double g, double b)
  {
    this->Behind = { r, g, b };
    this->Renderer->SetBackground(r, g, b);
  }

  void OneColor()
  {
    this->Colors->RemoveAllPoints();
    this->Colors->AddRGBPoint(0, 1, 0.5, 0.25);
    this->Colors->AddRGBPoint(1, 1, 0.5, 0.25);
  }
  void TwoColors()
  {
    this->Colors->RemoveAllPoints();
    this->Colors->AddRGBPoint(0, 1, 0.1, 0);
    this->Colors->AddRGBPoint(1, 0, 0.6, 1);
  }

  /// Scalars from 0 to 1 in warped cells.
  static vtkNew<vtkStructuredGrid> Cells(int nx = 7, int ny = 6, int nz = 5)
  {
    vtkNew<vtkStructuredGrid> grid = makeGrid(nx, ny, nz, warped, randomDensity(0.05, 1, 3));
    grid->GetPointData()->SetActiveScalars(nephoscope::arrays::CloudFraction);
    return grid;
  }

  /// The window's colours, 0 to 1.
  std::vector<double> Draw()
  {
    this->Window->Render();
    vtkNew<vtkUnsignedCharArray> rgb;
    this->Window->GetPixelData(0, 0, Width - 1, Height - 1, 0, rgb);
    std::vector<double> colors(3 * static_cast<std::size_t>(Width) * Height);
    for (std::size_t v = 0; v < colors.size(); ++v)
    {
      colors[v] = rgb->GetValue(static_cast<vtkIdType>(v)) / 255.0;
    }
    return colors;
  }

  static double Largest(const std::vector<double>& a, const std::vector<double>& b)
  {
    double largest = 0;
    for (std::size_t v = 0; v < a.size(); ++v)
    {
      largest = std::max(largest, std::abs(a[v] - b[v]));
    }
    return largest;
  }
  static double Mean(const std::vector<double>& a, const std::vector<double>& b)
  {
    double sum = 0;
    for (std::size_t v = 0; v < a.size(); ++v)
    {
      sum += std::abs(a[v] - b[v]);
    }
    return sum / static_cast<double>(a.size());
  }

  /// The same by vtkCloudscape, over the background.
  std::vector<double> SoftwarePicture(vtkStructuredGrid* cells)
  {
    vtkNew<vtkCloudCellVolume> body;
    body->SetInputData(cells);
    body->SetFullCoverExtinction(1 / this->Property->GetScalarOpacityUnitDistance());
    body->SetColor(1, 0.5, 0.25);
    vtkNew<vtkCloudscape> scape;
    scape->SetCamera(this->Renderer->GetActiveCamera());
    scape->SetSize(Width, Height);
    scape->AddBody(body);
    scape->Update();
    vtkPointData* const picture = scape->GetOutput()->GetPointData();
    std::vector<double> colors;
    for (int p = 0; p < Width * Height; ++p)
    {
      for (int c = 0; c < 3; ++c)
      {
        colors.push_back(picture->GetArray(nephoscope::arrays::Radiance)->GetComponent(p, c) +
          picture->GetArray(nephoscope::arrays::Transmittance)->GetComponent(p, c) *
            this->Behind[c]);
      }
    }
    return colors;
  }

  std::array<double, 3> Behind{};
  vtkNew<vtkPiecewiseFunction> Opacity;
  vtkNew<vtkColorTransferFunction> Colors;
  vtkNew<vtkVolumeProperty> Property;
  vtkNew<vtkCloudVolumeMapper> Mapper;
  vtkNew<vtkVolume> Volume;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
};

// The window shows the software picture, pixel on pixel, to its last bit, in perspective and in parallel.
TEST_F(CloudVolumeMapper, IsTheSoftwarePicture)
{
  const auto cells = Cells();
  this->Mapper->SetInputData(cells.Get());
  EXPECT_GT(this->Mean(this->SoftwarePicture(cells), this->SoftwarePicture(Cells(2, 2, 2))), 0.02);
  for (const bool parallel : { false, true })
  {
    this->Renderer->GetActiveCamera()->SetParallelProjection(parallel);
    this->Renderer->GetActiveCamera()->SetParallelScale(1.3);
    this->SetBackground(0.2, 0.4, 0.8);
    EXPECT_LE(this->Largest(this->Draw(), this->SoftwarePicture(cells)), OverColor);
    this->SetBackground(0, 0, 0);
    EXPECT_LE(this->Largest(this->Draw(), this->SoftwarePicture(cells)), OverBlack);
  }
}

// So it does in a part of the window, beside the rest.
TEST_F(CloudVolumeMapper, KeepsToItsViewport)
{
  const auto cells = Cells();
  this->Mapper->SetInputData(cells.Get());
  this->SetBackground(0, 0, 0);
  const std::vector<double> whole = this->SoftwarePicture(cells);
  this->Window->SetSize(2 * Width, 3 * Height);
  this->Renderer->SetViewport(0.5, 1 / 3.0, 1, 2 / 3.0);
  this->Window->Render();
  vtkNew<vtkUnsignedCharArray> rgb;
  this->Window->GetPixelData(0, 0, 2 * Width - 1, 3 * Height - 1, 0, rgb);
  for (int y = 0; y < 3 * Height; ++y)
  {
    for (int x = 0; x < 2 * Width; ++x)
    {
      const bool inside = x >= Width && y >= Height && y < 2 * Height;
      const double expected = inside ? whole[3 * ((y - Height) * Width + x - Width)] : 0;
      EXPECT_NEAR(rgb->GetValue(3 * (y * 2 * Width + x)) / 255.0, expected, OverBlack);
    }
  }
}

// The tetrahedra of an unstructured grid in two colours look as VTK's own ray caster draws them. Its rays miss the pixels'
// middles by half a pixel, so they are near on average; at the cells' outlines they differ.
TEST_F(CloudVolumeMapper, IsNearVTKsOwnMapper)
{
  this->TwoColors();
  const auto cells = Cells(4, 3, 4);
  vtkNew<vtkDataSetTriangleFilter> split;
  split->SetInputData(cells);
  this->Mapper->SetInputConnection(split->GetOutputPort());
  const std::vector<double> ours = this->Draw();
  vtkNew<vtkUnstructuredGridVolumeRayCastMapper> peer;
  peer->SetAutoAdjustSampleDistances(0);
  peer->SetImageSampleDistance(1);
  peer->SetInputConnection(split->GetOutputPort());
  this->Volume->SetMapper(peer);
  const std::vector<double> theirs = this->Draw();
  this->Volume->SetVisibility(false);
  const std::vector<double> nothing = this->Draw();
  EXPECT_LE(this->Mean(ours, theirs), 0.005);
  EXPECT_GT(this->Mean(ours, nothing), 0.03);
  EXPECT_NEAR(this->Mean(ours, nothing), this->Mean(theirs, nothing), 0.002);
}

// An unstructured grid of a structured one's tetrahedra is the same picture, whatever their order.
TEST_F(CloudVolumeMapper, DrawsTetrahedraAsItDrawsCells)
{
  this->TwoColors();
  const auto cells = Cells(2, 2, 2);
  this->Mapper->SetInputData(cells.Get());
  const std::vector<double> structured = this->Draw();
  vtkNew<vtkUnstructuredGrid> tetrahedra;
  tetrahedra->SetPoints(cells->GetPoints());
  tetrahedra->GetPointData()->ShallowCopy(cells->GetPointData());
  const vtkIdType corners[5][4] = { { 4, 6, 5, 0 }, { 1, 3, 0, 5 }, { 7, 5, 6, 3 }, { 0, 5, 3, 6 },
    { 2, 0, 3, 6 } };
  for (const auto& tetrahedron : corners)
  {
    tetrahedra->InsertNextCell(VTK_TETRA, 4, tetrahedron);
  }
  this->Mapper->SetInputData(tetrahedra.Get());
  EXPECT_EQ(this->Largest(structured, this->Draw()), 0);
}

// What is opaque hides the cloud behind it, and cloud before it lies over it: a plane through the middle of a uniform slab
// lets half the optical depth through, two limits tell which half.
TEST_F(CloudVolumeMapper, StopsAtWhatIsOpaque)
{
  const auto slab = makeGrid(
    4, 3, 5,
    [](double a, double b, double c) {
      return Vector3{ 6 * a - 3, 2 * b - 1, 6 * c - 3 };
    },
    [](int, int, int) { return 1.0; });
  slab->GetPointData()->SetActiveScalars(nephoscope::arrays::CloudFraction);
  this->Mapper->SetInputData(slab.Get());
  vtkCamera* const camera = this->Renderer->GetActiveCamera();
  camera->SetPosition(0, -5, 0);
  camera->ParallelProjectionOn();
  camera->SetParallelScale(1);
  camera->SetClippingRange(1, 12);
  vtkNew<vtkPlaneSource> plane;
  vtkNew<vtkPolyDataMapper> surface;
  surface->SetInputConnection(plane->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(surface);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(0, 1, 0);
  this->Renderer->AddActor(actor);
  for (const double at : { -2.0, -0.5, 0.25, 1.5 })
  {
    plane->SetOrigin(-9, at, -9);
    plane->SetPoint1(9, at, -9);
    plane->SetPoint2(-9, at, 9);
    const std::vector<double> colors = this->Draw();
    const double length = std::clamp(at + 1, 0.0, 2.0);
    const double through = std::exp(-length / 0.5);
    const double expected[3] = { 1 - through, 0.5 * (1 - through) + through, 0.25 * (1 - through) };
    for (const int pixel : { 0, Width * Height / 2, Width * Height - 1 })
    {
      for (int c = 0; c < 3; ++c)
      {
        EXPECT_NEAR(colors[3 * pixel + c], expected[c], 1 / 255.0) << "plane at y = " << at;
      }
    }
  }
}

// The same in perspective, with a plane that is tilted: distances follow the rays. The thickness before it is known.
TEST_F(CloudVolumeMapper, StopsAtATiltedPlaneInPerspective)
{
  const auto slab = makeGrid(
    4, 3, 5,
    [](double a, double b, double c) {
      return Vector3{ 8 * a - 4, 2 * b - 1, 8 * c - 4 };
    },
    [](int, int, int) { return 1.0; });
  slab->GetPointData()->SetActiveScalars(nephoscope::arrays::CloudFraction);
  this->Mapper->SetInputData(slab.Get());
  vtkCamera* const camera = this->Renderer->GetActiveCamera();
  camera->SetPosition(0, -5, 0);
  camera->SetViewUp(0, 0, 1);
  vtkNew<vtkPlaneSource> plane; // y = 0.4 x
  plane->SetOrigin(-9, -3.6, -9);
  plane->SetPoint1(9, 3.6, -9);
  plane->SetPoint2(-9, -3.6, 9);
  vtkNew<vtkPolyDataMapper> surface;
  surface->SetInputConnection(plane->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(surface);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(0, 1, 0);
  this->Renderer->AddActor(actor);
  const std::vector<double> colors = this->Draw();
  const Camera rays =
    Camera::perspective({ 0, -5, 0 }, { 0, 0, 0 }, { 0, 0, 1 }, 30, Width, Height);
  for (int pixel = 0; pixel < Width * Height; pixel += 7)
  {
    const int row = pixel / Width;
    const Vector3 d = rays.ray(pixel % Width + 0.5, row + 0.5).direction;
    const double length = std::max(0.0, 5 / (d[1] - 0.4 * d[0]) - 4 / d[1]);
    EXPECT_NEAR(colors[3 * pixel], 1 - std::exp(-length / 0.5), 1.5 / 255) << "pixel " << pixel;
  }
}

// Colours that vary along the ray: a slab whose scalar grows in depth, against the integral in steps of a 20,000th.
TEST_F(CloudVolumeMapper, IntegratesColoursThatVary)
{
  this->TwoColors();
  const auto slab = makeGrid(
    4, 5, 3,
    [](double a, double b, double c) {
      return Vector3{ 6 * a - 3, 2 * b - 1, 6 * c - 3 };
    },
    [](int, int j, int) { return j / 4.0; });
  slab->GetPointData()->SetActiveScalars(nephoscope::arrays::CloudFraction);
  this->Mapper->SetInputData(slab.Get());
  vtkCamera* const camera = this->Renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(1);
  for (const double side : { -5.0, 5.0 })
  {
    camera->SetPosition(0, side, 0);
    const std::vector<double> colors = this->Draw();
    constexpr int Steps = 20000;
    double light[3] = { 0, 0, 0 };
    double through = 1;
    for (int n = 0; n < Steps; ++n)
    {
      const double x = (n + 0.5) / Steps;
      const double scalar = side < 0 ? x : 1 - x;
      const double opacity = -std::expm1(-scalar / 0.5 * 2 / Steps);
      const double color[3] = { 1 - scalar, 0.1 + 0.5 * scalar, scalar };
      for (int c = 0; c < 3; ++c)
      {
        light[c] += through * opacity * color[c];
      }
      through *= 1 - opacity;
    }
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(
        colors[3 * (Width * Height / 2) + c], light[c] + through * this->Behind[c], OverColor)
        << "from y = " << side;
    }
  }
}

// A change of the property, of the vtkVolume's place and of the data each shows in the next frame.
TEST_F(CloudVolumeMapper, FollowsWhatChanges)
{
  const auto cells = Cells();
  this->Mapper->SetInputData(cells.Get());
  const std::vector<double> first = this->Draw();
  this->Property->SetScalarOpacityUnitDistance(0.1);
  const std::vector<double> denser = this->Draw();
  EXPECT_GT(this->Largest(first, denser), 0.1);
  EXPECT_LE(this->Largest(denser, this->SoftwarePicture(cells)), OverColor);
  this->Volume->SetPosition(100, 0, 0);
  const std::vector<double> away = this->Draw();
  for (std::size_t v = 0; v < away.size(); ++v)
  {
    EXPECT_NEAR(away[v], this->Behind[v % 3], 1 / 255.0);
  }
  this->Volume->SetPosition(0, 0, 0);
  EXPECT_LE(this->Largest(denser, this->Draw()), 1e-9);
  cells->GetPointData()->GetScalars()->Fill(0);
  cells->GetPointData()->GetScalars()->Modified();
  EXPECT_EQ(this->Largest(away, this->Draw()), 0);
}

TEST_F(CloudVolumeMapper, ErrorsSayWhatIsWrong)
{
  vtkNew<vtkTest::ErrorObserver> errors;
  this->Mapper->AddObserver(vtkCommand::ErrorEvent, errors);
  const auto expect = [this, &errors](const std::string& words)
  {
    const std::vector<double> colors = this->Draw();
    EXPECT_NE(errors->GetErrorMessage().find(words), std::string::npos)
      << errors->GetErrorMessage();
    EXPECT_NEAR(colors[0], this->Behind[0], 1 / 255.0);
    errors->Clear();
  };
  vtkNew<vtkStructuredGrid> bare;
  bare->DeepCopy(Cells());
  bare->GetPointData()->Initialize();
  this->Mapper->SetInputData(bare.Get());
  expect("SelectScalarArray");
  this->Mapper->SetInputData(Cells(3, 2, 1).Get());
  expect("has no cells");
  vtkNew<vtkUnstructuredGrid> hexahedron;
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> scalars;
  const vtkIdType ids[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
  for (int p = 0; p < 8; ++p)
  {
    points->InsertNextPoint((p & 1) ^ (p >> 1 & 1), p >> 1 & 1, p >> 2);
    scalars->InsertNextValue(1);
  }
  hexahedron->SetPoints(points);
  hexahedron->GetPointData()->SetScalars(scalars);
  hexahedron->InsertNextCell(VTK_HEXAHEDRON, 8, ids);
  this->Mapper->SetInputData(hexahedron.Get());
  expect("vtkDataSetTriangleFilter");
  for (const vtkIdType wrong : { vtkIdType(8), vtkIdType(1) << 40, vtkIdType(-3) })
  {
    vtkNew<vtkUnstructuredGrid> loose;
    loose->SetPoints(points);
    loose->GetPointData()->SetScalars(scalars);
    const vtkIdType corners[4] = { 0, 1, 2, wrong };
    loose->InsertNextCell(VTK_TETRA, 4, corners);
    this->Mapper->SetInputData(loose.Get());
    expect("The cell 0 is on a point that the grid does not have: its 8 points");
  }
  this->Mapper->SetInputData(Cells().Get());
  this->Renderer->GetActiveCamera()->SetWindowCenter(0.5, 0);
  expect("off-centre");
  this->Renderer->GetActiveCamera()->SetWindowCenter(0, 0);
  this->Mapper->SetBlendModeToMaximumIntensity();
  expect("SetBlendModeToComposite");
}
