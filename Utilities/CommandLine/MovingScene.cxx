// SPDX-License-Identifier: BSD-3-Clause
#include "MovingScene.h"

#include "Failure.h"
#include "Keyframes.h"
#include "Messages.h"
#include "ModelFile.h"
#include "Progress.h"

#include <vtkCloudNetCDFReader.h>
#include <vtkStructuredGrid.h>

#include <algorithm>

namespace nephoscope::program
{
namespace
{
Scene atTime(Scene scene, const std::optional<std::string>& time)
{
  scene.data.time = time;
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
  const int first = timeStepOf(reader, from);
  const int last = to ? timeStepOf(reader, to) : std::max(steps - 1, 0);
  if (last < first || (last == first && steps > 1))
  {
    throw Failure(scene.data.file + ": the animation would end at step " + std::to_string(last) +
      " and begin at step " + std::to_string(first) + "; give a later --to or an earlier --from");
  }
  this->Moves = steps > 1;
  if (!this->Moves)
  {
    note(scene.data.file + ": has one time; its clouds stand still");
    return;
  }
  this->Begin = reader->GetTimeValue(first);
  this->End = reader->GetTimeValue(last);
  this->Between->SetInputConnection(reader->GetOutputPort());
  this->Textures->SetInputConnection(this->Between->GetOutputPort());
  // A tenth of a grid step is not seen: the wind itself is not known better.
  const double tolerance = std::clamp(this->Data.lie.gridStep / 10, 1e-3, 1e7);
  this->Between->SetTolerance(tolerance);
  this->Textures->SetTolerance(tolerance);
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
  return buildScene(sceneAt(this->Parts, moment), grid, this->Data.lie, false, this->Watch);
}
}
