// SPDX-License-Identifier: BSD-3-Clause
#include "MethodScenes.h"

#include <CloudArrays.h>
#include <MethodChoice.h>
#include <RadianceError.h>
#include <SceneParts.h>
#include <vtkCamera.h>
#include <vtkCloudCellVolume.h>
#include <vtkCloudGradedBackdrop.h>
#include <vtkCloudHaze.h>
#include <vtkCloudHeightField.h>
#include <vtkCloudHeightFieldShadow.h>
#include <vtkCloudHeightFieldSource.h>
#include <vtkCloudModelSelector.h>
#include <vtkCloudPictureCheck.h>
#include <vtkCloudPlane.h>
#include <vtkCloudSurface.h>
#include <vtkCloudTerrain.h>
#include <vtkCloudTerrainSource.h>
#include <vtkCloudUniformMedium.h>
#include <vtkCloudWater.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSphereSource.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace nephoscope::program
{
namespace
{
/// Numbers that are the same with every standard library.
class Dice
{
public:
  explicit Dice(int seed)
    : Random(static_cast<std::uint32_t>(seed))
  {
  }
  double between(double low, double high)
  {
    return low + (high - low) * this->Random() / 4294967296.0;
  }
  /// As likely in each decade.
  double ratio(double low, double high) { return low * std::pow(high / low, this->between(0, 1)); }

private:
  std::mt19937 Random;
};

vtkSmartPointer<vtkCloudscape> emptyScape(Dice& dice, int width, double height, double pitch)
{
  auto scape = vtkSmartPointer<vtkCloudscape>::New();
  const vtkNew<vtkCamera> camera;
  const double turn = dice.between(-0.5, 0.5);
  camera->SetPosition(dice.between(-3000, 3000), dice.between(-3000, 3000), height);
  double eye[3];
  camera->GetPosition(eye);
  camera->SetFocalPoint(eye[0] + std::sin(turn), eye[1] + std::cos(turn), eye[2] + pitch);
  camera->SetViewUp(0, 0, 1);
  camera->SetViewAngle(dice.ratio(3, 50));
  scape->SetCamera(camera);
  scape->SetSize(width, 3 * width / 4);
  scape->ComputeDepthOff();
  scape->SetBackdrop(vtkNew<vtkCloudGradedBackdrop>());
  return scape;
}

vtkSmartPointer<vtkCloudHeightFieldSource> clouds(Dice& dice, double height)
{
  auto shape = vtkSmartPointer<vtkCloudHeightFieldSource>::New();
  shape->SetPlaneHeight(height);
  shape->SetCover(dice.between(0.25, 0.7));
  shape->SetWavelength(dice.between(1200, 2500));
  shape->SetRelief(dice.between(80, 200));
  shape->SetRoundness(dice.between(30, 150));
  shape->SetBaseDepth(dice.between(60, 150));
  shape->SetNumberOfWaves(static_cast<int>(dice.between(8, 16)));
  shape->SetNumberOfBillows(static_cast<int>(dice.between(3, 8)));
  shape->SetSeed(static_cast<int>(dice.between(1, 1e6)));
  return shape;
}

MethodScene cloudScene(Dice& dice, int width, bool fromBelow)
{
  const double height = dice.between(800, 1600);
  const auto scape = emptyScape(dice, width, fromBelow ? 200 : height + dice.between(900, 2000),
    fromBelow ? dice.between(0.15, 0.5) : dice.between(-0.7, -0.3));
  const vtkNew<vtkCloudHeightField> body;
  body->SetInputConnection(clouds(dice, height)->GetOutputPort());
  const double factor = dice.ratio(0.3, 3);
  body->SetSunExtinction(factor * 0.0093);
  body->SetViewExtinction(factor * 0.0163);
  body->SetBackgroundExtinction(factor * 0.0198);
  body->SetFarDistance(15000);
  scape->AddBody(body);
  return { "light in height-field clouds", scape };
}

MethodScene hazeScene(Dice& dice, int width, bool withClouds)
{
  const double height = dice.between(1000, 2500);
  const auto scape = emptyScape(dice, width, dice.between(50, 300), dice.between(0, 0.3));
  const vtkNew<vtkCloudPlane> ground;
  const vtkNew<vtkCloudHaze> haze;
  const double density = dice.ratio(1e-5, 3e-4);
  haze->SetExtinction(0.8 * density, density, 1.2 * density);
  haze->SetTowardSun(dice.between(-0.6, 0.6), 0.7, dice.between(0.4, 1.5));
  haze->SetHeight(height);
  if (withClouds)
  {
    const vtkNew<vtkCloudHeightFieldShadow> shadow;
    shadow->SetInputConnection(clouds(dice, height)->GetOutputPort());
    shadow->SetDimensions(401, 401);
    shadow->SetSpacing(dice.between(25, 60));
    double eye[3];
    scape->GetCamera()->GetPosition(eye);
    shadow->SetCenter(eye[0], eye[1]);
    haze->SetInputConnection(shadow->GetOutputPort());
  }
  scape->AddBody(haze);
  scape->AddBody(ground);
  return { "light in haze", scape };
}

MethodScene gridScene(Dice& dice, int width, bool colored)
{
  const auto scape = emptyScape(dice, width, dice.between(500, 2500), dice.between(-0.1, 0.1));
  const vtkNew<vtkImageData> grid;
  const int n = static_cast<int>(dice.between(14, 40));
  const int levels = n / 2;
  grid->SetDimensions(n, n + 5, levels);
  grid->SetSpacing(12000.0 / n, 12000.0 / n, 3000.0 / levels);
  double eye[3];
  scape->GetCamera()->GetPosition(eye);
  grid->SetOrigin(eye[0] - 6000, eye[1] + 4000, 0);
  const double wave = dice.between(600, 1500);
  const vtkNew<vtkFloatArray> fraction;
  const vtkNew<vtkFloatArray> color;
  fraction->SetName(arrays::CloudFraction);
  color->SetName(arrays::SourceColor);
  color->SetNumberOfComponents(3);
  for (vtkIdType point = 0; point < grid->GetNumberOfPoints(); ++point)
  {
    double at[3];
    grid->GetPoint(point, at);
    const double f =
      std::sin(at[0] / wave) * std::sin(at[1] / wave + at[0] / 3000) * std::sin(at[2] / 900);
    fraction->InsertNextValue(static_cast<float>(f > 0 ? f * f : 0));
    const double light = 0.5 + 0.5 * std::sin(at[0] / 2000 + at[2] / 500);
    color->InsertNextTuple3(light, 1 - light, 0.5);
  }
  grid->GetPointData()->AddArray(fraction);
  if (colored)
  {
    grid->GetPointData()->AddArray(color);
  }
  const vtkNew<vtkCloudCellVolume> volume;
  volume->SetInputData(grid);
  volume->SetFullCoverExtinction(dice.ratio(2e-4, 5e-3));
  scape->AddBody(volume);
  return { "cells", scape };
}

/// One that can be drawn in one way only, and takes its time.
MethodScene plainScene(Dice& dice, int width, const std::string& part, vtkCloudBody* body)
{
  const auto scape = emptyScape(dice, width, 300, -0.1);
  scape->AddBody(body);
  return { part, scape };
}

void addPlainScenes(Dice& dice, int width, std::vector<MethodScene>& scenes)
{
  const vtkNew<vtkCloudPlane> ground;
  scenes.push_back(plainScene(dice, width, "ground", ground));
  const vtkNew<vtkCloudUniformMedium> haze;
  haze->SetExtinction(1e-4, 1e-4, 1e-4);
  scenes.push_back(plainScene(dice, width, "uniform haze", haze));
  const vtkNew<vtkCloudWater> water;
  scenes.push_back(plainScene(dice, width, "water", water));
  const vtkNew<vtkCloudTerrainSource> hills;
  hills->SetDimensions(401, 401);
  hills->SetSpacing(50);
  const vtkNew<vtkCloudTerrain> terrain;
  terrain->SetInputConnection(hills->GetOutputPort());
  scenes.push_back(plainScene(dice, width, "terrain", terrain));
  for (const bool textured : { false, true })
  {
    const vtkNew<vtkSphereSource> ball;
    ball->SetRadius(6000);
    ball->SetThetaResolution(width);
    ball->SetPhiResolution(width);
    const vtkNew<vtkCloudSurface> surface;
    surface->SetInputConnection(ball->GetOutputPort());
    surface->SetBackFaces(true);
    surface->SetTextureWavelength(3000);
    surface->SetOpacityMode(
      textured ? vtkCloudSurface::OpacityFromTexture : vtkCloudSurface::UniformOpacity);
    scenes.push_back(plainScene(dice, width, textured ? "texture" : "surface", surface));
  }
}

vtkDataArray* draw(vtkCloudscape* scape, double& seconds)
{
  scape->Modified();
  scape->Update();
  seconds = scape->GetPrepareSeconds() + scape->GetTileSeconds();
  return scape->GetOutput()->GetPointData()->GetArray(arrays::Radiance);
}

/// Exact radiances of the pixels that a part touches. Where it touches fewer than this share, 95 % of them are no more than the few
/// at its edges, and the scene says nothing of errors.
constexpr double LeastTouched = 0.25;

struct ExactPixels
{
  std::vector<vtkIdType> pixels;
  std::vector<double> radiance;
  double emptySeconds = 1e30;
  double pipelineSeconds = 0;
  bool areEnough = false;

  ExactPixels(vtkCloudscape* scape, int count)
  {
    double seconds = 0;
    draw(scape, seconds);
    this->pipelineSeconds = scape->GetPipelineSeconds();
    const vtkNew<vtkCloudPictureCheck> check;
    check->SetNumberOfPixels(count);
    check->Check(scape);
    scape->GetBody(0)->VisibilityOff();
    vtkDataArray* bare = nullptr;
    for (int run = 0; run < 3; ++run)
    {
      bare = draw(scape, seconds);
      this->emptySeconds = std::min(this->emptySeconds, seconds);
    }
    for (std::size_t i = 0; i < check->GetPixels().size(); ++i)
    {
      const double* const exact = &check->GetExact()[3 * i];
      if (radianceError(bare->GetTuple3(check->GetPixels()[i]), exact) > 1e-6)
      {
        this->pixels.push_back(check->GetPixels()[i]);
        this->radiance.insert(this->radiance.end(), exact, exact + 3);
      }
    }
    scape->GetBody(0)->VisibilityOn();
    this->areEnough = static_cast<double>(this->pixels.size()) >=
      LeastTouched * static_cast<double>(check->GetPixels().size());
  }

  PictureErrors compare(vtkDataArray* drawn) const
  {
    std::vector<double> errors;
    for (std::size_t i = 0; i < this->pixels.size(); ++i)
    {
      errors.push_back(radianceError(drawn->GetTuple3(this->pixels[i]), &this->radiance[3 * i]));
    }
    return { quantile(errors, 0.95), quantile(errors, 1) };
  }
};
}

double guessedSeconds(const SceneOption& option)
{
  for (const MethodModel& model : vtkCloudModelSelector::GetModels())
  {
    if (model.name == option.model)
    {
      return CostModel{ model.seconds }.seconds(option.work);
    }
  }
  return Endless;
}

MethodScene methodScene(SceneKind kind, int seed, int width)
{
  Dice dice(seed);
  switch (kind)
  {
    case SceneKind::CloudsFromBelow:
    case SceneKind::CloudsFromAbove:
      return cloudScene(dice, width, kind == SceneKind::CloudsFromBelow);
    case SceneKind::HazeUnderClouds:
    case SceneKind::ClearHaze:
      return hazeScene(dice, width, kind == SceneKind::HazeUnderClouds);
    default:
      return gridScene(dice, width, kind == SceneKind::ColoredCells);
  }
}

PictureErrors errorsOf(const MethodScene& scene, int pixels)
{
  double seconds = 0;
  const vtkNew<vtkFloatArray> drawn;
  drawn->DeepCopy(draw(scene.scape, seconds));
  return ExactPixels(scene.scape, pixels).compare(drawn);
}

std::vector<MethodScene> methodScenes(int seed, int width)
{
  Dice dice(seed);
  std::vector<MethodScene> scenes;
  for (int n = 0; n < 2; ++n)
  {
    const int across = n == 0 ? width : 2 * width;
    scenes.push_back(cloudScene(dice, across, true));
    scenes.push_back(cloudScene(dice, across, false));
    scenes.push_back(hazeScene(dice, across, true));
    scenes.push_back(hazeScene(dice, across, n == 0));
    scenes.push_back(gridScene(dice, across, true));
    scenes.push_back(gridScene(dice, across, false));
    addPlainScenes(dice, across, scenes);
  }
  return scenes;
}

std::vector<TriedOption> tryMethods(const MethodScene& scene, int pixels, int runs, double most)
{
  const vtkNew<vtkCloudModelSelector> selector;
  selector->SetCloudscape(scene.scape);
  const ExactPixels exact(scene.scape, pixels);
  std::vector<TriedOption> tried;
  for (const ScenePart& part : selector->GetParts())
  {
    for (const SceneOption& option : part.options)
    {
      if (option.model == "shadow")
      {
        tried.push_back({ option.model, option.name, option.work, 1, 0, exact.pipelineSeconds });
      }
      if (option.model == "picture" && scene.scape->GetNumberOfBodies() == 1)
      {
        tried.push_back({ option.model, option.name, option.work, 1, 0, exact.emptySeconds });
      }
      if (part.name != scene.part || option.model == "nothing" || !exact.areEnough ||
        guessedSeconds(option) > most)
      {
        continue;
      }
      option.apply();
      TriedOption result{ option.model, option.name, option.work, option.coarseness, option.bound };
      result.seconds = 1e30;
      for (int run = 0; run < runs; ++run)
      {
        double seconds = 0;
        const PictureErrors errors = exact.compare(draw(scene.scape, seconds));
        result.error = errors.error95;
        result.largest = errors.largest;
        result.seconds = std::min(result.seconds, seconds);
      }
      result.seconds = std::max(1e-6, result.seconds - exact.emptySeconds);
      tried.push_back(result);
    }
  }
  return tried;
}
}
