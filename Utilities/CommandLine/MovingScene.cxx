// SPDX-License-Identifier: BSD-3-Clause
#include "MovingScene.h"

#include "Failure.h"
#include "Keyframes.h"
#include "Messages.h"
#include "ModelFile.h"
#include "Progress.h"
#include "Quality.h"

#include <vtkCloudNetCDFReader.h>
#include <vtkCloudscape.h>
#include <vtkStructuredGrid.h>

#include <algorithm>

namespace nephoscope::program
{
namespace
{
/// The scene at the last of the file's times that is not after a time.
Scene atTime(Scene scene, const std::optional<std::string>& time)
{
  const auto reader = openModelFile(scene.data);
  int step = 0;
  if (reader->GetNumberOfTimeSteps() == 0)
  {
    step = timeStepOf(reader, time);
  }
  else
  {
    const double seconds = timeOf(reader, time);
    while (step + 1 < reader->GetNumberOfTimeSteps() && reader->GetTimeValue(step + 1) <= seconds)
    {
      ++step;
    }
  }
  scene.data.time = std::to_string(step);
  return scene;
}

bool movesTexture(const Scene& scene)
{
  for (const Body& body : scene.bodies)
  {
    const auto* const texture = std::get_if<TextureBody>(&body);
    if (texture && texture->advect)
    {
      return true;
    }
  }
  return false;
}
}

MovingScene::MovingScene(const Scene& scene, const std::optional<std::string>& from,
  const std::optional<std::string>& to, Progress& progress)
  : Parts(scene)
  , Watch(progress)
  , Data(scene.data.file.empty() ? SceneData() : readData(atTime(scene, from), progress))
{
  if (scene.data.file.empty())
  {
    return;
  }
  vtkCloudNetCDFReader* const reader = this->Data.reader;
  const int steps = reader->GetNumberOfTimeSteps();
  this->Moves = steps > 1;
  if (!this->Moves)
  {
    note(scene.data.file + ": has one time; its clouds stand still");
    return;
  }
  this->Begin = timeOf(reader, from);
  this->End = to ? timeOf(reader, to) : reader->GetTimeValue(steps - 1);
  if (!(this->End > this->Begin))
  {
    throw Failure(scene.data.file + ": the animation would begin at '" + from.value_or("0") +
      "' and end at '" + to.value_or("the last time") +
      "', which is not later; give a later --to or an earlier --from");
  }
  this->Between->SetInputConnection(reader->GetOutputPort());
  this->Textures->SetInputConnection(this->Between->GetOutputPort());
  // A tenth of a grid step is not seen: the wind itself is not known better.
  const double tolerance = std::clamp(this->Data.lie.gridStep / 10, 1e-3, 1e7);
  this->Between->SetTolerance(tolerance);
  this->Textures->SetTolerance(tolerance);
  constexpr double Hour = 3600;
  this->Textures->SetRestartPeriod(scene.animation.restartPeriod.value_or(0) * Hour);
  this->Carries = this->windCarries();
  this->Between->SetCarryClouds(this->Carries);
}

/// Whether the first time has a wind that can be followed. If not, says why.
bool MovingScene::windCarries()
{
  this->Textures->UpdateTimeStep(this->Begin);
  try
  {
    Messages::throwIfError(this->Parts.data.file);
  }
  catch (const Failure& failure)
  {
    note(std::string(failure.what()) + " The clouds fade from step to step instead of moving.");
    return false;
  }
  return true;
}

BuiltScene MovingScene::at(double moment)
{
  vtkSmartPointer<vtkStructuredGrid> grid = this->Data.grid;
  if (this->Moves)
  {
    const bool textures = this->Carries && movesTexture(this->Parts);
    vtkStructuredGridAlgorithm* const source =
      textures ? static_cast<vtkStructuredGridAlgorithm*>(this->Textures) : this->Between;
    source->UpdateTimeStep(
      moment < 1 ? this->Begin + moment * (this->End - this->Begin) : this->End);
    Messages::throwIfError(this->Parts.data.file);
    grid = source->GetOutput();
  }
  BuiltScene built =
    buildScene(sceneAt(this->Parts, moment), grid, this->Data.lie, false, this->Watch);
  built.scape->SetComputeDepth(false); // frames are PNG
  chooseMethods(this->Parts.quality, built.scape);
  return built;
}
}
