// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file MovingScene.h
 * @brief A scene at any moment of an animation: clouds carried by the wind, textures that move with them, keyframed view.
 */
#ifndef MovingScene_h
#define MovingScene_h

#include "SceneBuilder.h"

#include <vtkCloudTextureAdvection.h>
#include <vtkCloudTimeInterpolator.h>
#include <vtkNew.h>

namespace nephoscope::program
{
/**
 * A moment depends on the scene and the data alone, not on those that were drawn before; drawn in order, each costs less.
 * Data whose wind is not known, or whose grid it cannot be followed on, fade from step to step with textures that stand
 * still; a note says so. A single time stands still.
 */
class MovingScene
{
public:
  /**
   * @param from, to first and last time as for timeOf; without one the file's
   * @throw Failure for times that the file does not have, or that do not rise
   */
  MovingScene(const Scene& scene, const std::optional<std::string>& from,
    const std::optional<std::string>& to, Progress& progress);

  /// @param moment 0 at the first frame, 1 at the last. @throw Failure
  BuiltScene at(double moment);

private:
  bool windCarries();

  Scene Parts;
  Progress& Watch;
  SceneData Data;
  double Begin = 0; // s
  double End = 0;
  bool Moves = false;   // there is more than one time
  bool Carries = false; // and wind
  vtkNew<vtkCloudTimeInterpolator> Between;
  vtkNew<vtkCloudTextureAdvection> Textures;
};
}
#endif
