// SPDX-License-Identifier: BSD-3-Clause
// Pictures of the sample's day, drawn as an animation draws them: the clouds in them move with the wind, and new textures are
// brought in without a flicker.
#include "MovingScene.h"
#include "Progress.h"
#include "SceneFile.h"

#include <CloudArrays.h>
#include <vtkCloudNetCDFReader.h>
#include <vtkCloudTimeInterpolator.h>
#include <vtkCloudscape.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStructuredGrid.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

using namespace nephoscope::program;

namespace
{
constexpr double Degrees = 57.29577951308232;

/// A map seen from straight above, as good as parallel: clouds without shading on black, so that a pixel is an opacity.
struct PlanView
{
  int width;
  int height;
  double x; ///< of the picture's middle, m
  double y;
  double pixel; ///< m

  Scene scene(const std::string& animation) const
  {
    constexpr double Eye = 3e8; // m; heights, 30 times exaggerated, reach to 1e6
    const double angle = 2 * std::atan(this->height * this->pixel / 2 / Eye) * Degrees;
    char text[1024];
    std::snprintf(text, sizeof(text), R"(
picture: { size: [%d, %d], samples: 1 }
data: { file: %s/Data/sample_climate.nc, geometry: map, exaggeration: 30 }
camera: { position: [%g, %g, %g], target: [%g, %g, 0], up: [0, 1, 0], viewAngle: %.12g }
light: { ambient: 1 }
backdrop: { zenith: [0, 0, 0], horizon: [0, 0, 0], nadir: [0, 0, 0] }
animation: { %s }
bodies:
  - { type: texture, value: 0.15, wavelength: 600, octaves: 4, offset: 0.5, range: 0.25 }
)",
      this->width, this->height, NEPHOSCOPE_SOURCE_DIR, this->x, this->y, Eye, this->x, this->y,
      angle, animation.c_str());
    return parseScene(text, "plan.yaml");
  }
};

using Opacities = std::vector<double>;

Opacities opacitiesOf(const BuiltScene& built)
{
  built.scape->Update();
  vtkDataArray* const light =
    built.scape->GetOutput()->GetPointData()->GetArray(nephoscope::arrays::Radiance);
  Opacities picture;
  for (vtkIdType p = 0; p < light->GetNumberOfTuples(); ++p)
  {
    picture.push_back(light->GetComponent(p, 1));
  }
  return picture;
}

double medianOf(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double meanOf(const Opacities& picture)
{
  double sum = 0;
  for (const double value : picture)
  {
    sum += value;
  }
  return sum / static_cast<double>(picture.size());
}

/// The clouds and the wind of the sample at a time, on its own grid.
class Air
{
public:
  explicit Air(double time)
  {
    vtkNew<vtkCloudNetCDFReader> reader;
    reader->SetFileName(NEPHOSCOPE_SOURCE_DIR "/Data/sample_climate.nc");
    reader->SetGeometryToMap();
    vtkNew<vtkCloudTimeInterpolator> between;
    between->SetInputConnection(reader->GetOutputPort());
    between->UpdateTimeStep(time);
    this->Grid = between->GetOutput();
  }

  /// The wind at a place of the map, along x and y, m of the map a second, of those levels that have clouds; nothing where there are none, or
  /// where they move differently.
  std::optional<std::array<double, 2>> windOfClouds(double x, double y) const
  {
    int n[3];
    this->Grid->GetDimensions(n);
    const vtkIdType column = this->nearestColumn(x, y);
    vtkDataArray* const cloud =
      this->Grid->GetPointData()->GetArray(nephoscope::arrays::CloudFraction);
    vtkDataArray* const wind = this->Grid->GetPointData()->GetArray(nephoscope::arrays::Wind);
    std::array<double, 2> least{ 1e9, 1e9 };
    std::array<double, 2> most{ -1e9, -1e9 };
    for (int k = 0; k < n[2]; ++k)
    {
      const vtkIdType point = column + static_cast<vtkIdType>(n[0]) * n[1] * k;
      for (int c = 0; c < 2 && cloud->GetComponent(point, 0) >= 0.1; ++c)
      {
        least[c] = std::min(least[c], wind->GetComponent(point, c));
        most[c] = std::max(most[c], wind->GetComponent(point, c));
      }
    }
    if (!(most[0] >= least[0]) ||
      std::hypot(most[0] - least[0], most[1] - least[1]) >
        2 + 0.5 * std::hypot(most[0] + least[0], most[1] + least[1]) / 2)
    {
      return std::nullopt;
    }
    const double wider = 1 / std::cos(y / EarthRadius); // a parallel's metre on the map
    return std::array<double, 2>{ wider * (least[0] + most[0]) / 2, (least[1] + most[1]) / 2 };
  }

private:
  static constexpr double EarthRadius = 6371229;

  vtkIdType nearestColumn(double x, double y) const
  {
    int n[3];
    this->Grid->GetDimensions(n);
    vtkIdType best = 0;
    double least = 1e30;
    for (vtkIdType p = 0; p < static_cast<vtkIdType>(n[0]) * n[1]; ++p)
    {
      double at[3];
      this->Grid->GetPoint(p, at);
      const double distance = std::hypot(at[0] - x, at[1] - y);
      best = distance < least ? p : best;
      least = std::min(least, distance);
    }
    return best;
  }

  vtkSmartPointer<vtkStructuredGrid> Grid;
};

/// Where a block of one picture is found in the next, by the least squares of differences; nothing if that is not clear.
class BlockSearch
{
public:
  BlockSearch(const Opacities& before, const Opacities& after, int width)
    : Before(before)
    , After(after)
    , Width(width)
  {
  }

  static constexpr int Half = 20;  ///< of a block's side, pixels
  static constexpr int Reach = 14; ///< of the search

  std::optional<std::array<double, 2>> find(int x, int y) const
  {
    std::array<int, 2> best{ 0, 0 };
    double least = 1e30;
    double sum = 0;
    for (int dy = -Reach; dy <= Reach; ++dy)
    {
      for (int dx = -Reach; dx <= Reach; ++dx)
      {
        const double d = this->difference(x, y, dx, dy);
        sum += d;
        best = d < least ? std::array<int, 2>{ dx, dy } : best;
        least = std::min(least, d);
      }
    }
    const double mean = sum / ((2 * Reach + 1) * (2 * Reach + 1));
    if (least > 0.35 * mean || std::abs(best[0]) == Reach || std::abs(best[1]) == Reach)
    {
      return std::nullopt;
    }
    return std::array<double, 2>{ best[0] + this->vertex(x, y, best[0], best[1], 1, 0),
      best[1] + this->vertex(x, y, best[0], best[1], 0, 1) };
  }

private:
  double difference(int x, int y, int dx, int dy) const
  {
    double sum = 0;
    for (int j = -Half; j < Half; ++j)
    {
      for (int i = -Half; i < Half; ++i)
      {
        const double d = this->Before[x + i + this->Width * (y + j)] -
          this->After[x + i + dx + this->Width * (y + j + dy)];
        sum += d * d;
      }
    }
    return sum;
  }

  /// Of the parabola through three differences.
  double vertex(int x, int y, int dx, int dy, int alongX, int alongY) const
  {
    const double a = this->difference(x, y, dx - alongX, dy - alongY);
    const double b = this->difference(x, y, dx, dy);
    const double c = this->difference(x, y, dx + alongX, dy + alongY);
    return 0.5 * (a - c) / (a - 2 * b + c);
  }

  const Opacities& Before;
  const Opacities& After;
  int Width;
};
}

class MovingPictures : public testing::TestWithParam<std::array<double, 2>>
{
};

TEST_P(MovingPictures, CloudsInPicturesMoveWithTheWind)
{
  // An hour apart, in the westerlies of the north and of the south. Single blocks are misled where a lower cloud shines through or
  // an outline forms; the middle one of many is not.
  const PlanView view{ 720, 240, GetParam()[0], GetParam()[1], 14000 };
  Progress progress;
  MovingScene moving(view.scene(""), "2001-10-01T02:30", "2001-10-01T03:30", progress);
  const Opacities before = opacitiesOf(moving.at(0));
  const Opacities after = opacitiesOf(moving.at(1));
  const Air air(3 * 3600);
  const BlockSearch search(before, after, view.width);
  constexpr int Margin = BlockSearch::Half + BlockSearch::Reach + 1;
  std::vector<double> along; // the wind, in parts of it
  std::vector<double> across;
  for (int y = Margin; y < view.height - Margin; y += 10)
  {
    for (int x = Margin; x < view.width - Margin; x += 10)
    {
      const auto wind = air.windOfClouds(view.x + (x - 0.5 * view.width) * view.pixel,
        view.y + (y - 0.5 * view.height) * view.pixel);
      const auto moved = wind ? search.find(x, y) : std::nullopt;
      const double u = wind ? (*wind)[0] * 3600 / view.pixel : 0; // pixels
      const double v = wind ? (*wind)[1] * 3600 / view.pixel : 0;
      if (moved && std::hypot(u, v) > 1.5)
      {
        along.push_back((u * (*moved)[0] + v * (*moved)[1]) / (u * u + v * v));
        across.push_back((u * (*moved)[1] - v * (*moved)[0]) / (u * u + v * v));
      }
    }
  }
  ASSERT_GT(along.size(), 100U);
  EXPECT_NEAR(medianOf(along), 1, 0.1);
  EXPECT_NEAR(medianOf(across), 0, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Westerlies, MovingPictures,
  testing::Values(std::array<double, 2>{ 2e7, 4.5e6 }, std::array<double, 2>{ 2.8e7, -4.5e6 }));

TEST(MovingTextures, MeanOpacityIsSteadyWhileTheyCrossFade)
{
  // Every 20 minutes; at 2 hours a texture is gone and another begins.
  const PlanView view{ 240, 80, 2e7, 4e6, 8e4 };
  Progress progress;
  MovingScene moving(
    view.scene("restartPeriod: 2"), "2001-10-01T01:20", "2001-10-01T03:20", progress);
  double before = 0;
  for (int frame = 0; frame <= 6; ++frame)
  {
    const double now = meanOf(opacitiesOf(moving.at(frame / 6.0)));
    ASSERT_GT(now, 0.02);
    if (frame > 0)
    {
      EXPECT_NEAR(now / before, 1, 0.02) << "frame " << frame;
    }
    before = now;
  }
}
