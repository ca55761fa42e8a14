// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file MethodScenes.h
 * @brief Small scenes of one kind of body each, to try methods on: what calibrations and their tests measure.
 */
#ifndef MethodScenes_h
#define MethodScenes_h

#include <vtkCloudscape.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

namespace nephoscope
{
struct SceneOption;
}

namespace nephoscope::program
{
struct MethodScene
{
  std::string part; ///< of nephoscope::partsOf, whose methods are tried
  vtkSmartPointer<vtkCloudscape> scape;
};

/// Kinds of scenes in which several methods can be tried.
enum class SceneKind
{
  CloudsFromBelow,
  CloudsFromAbove,
  HazeUnderClouds,
  ClearHaze,
  ColoredCells,
  Cells
};

/// One of them; equal for equal seeds.
MethodScene methodScene(SceneKind kind, int seed, int width);

/// Scenes with clouds, haze and grids of all sorts in views 3 to 50 degrees high, none alike; equal for equal seeds. @param width of the pictures, pixels; they differ
std::vector<MethodScene> methodScenes(int seed, int width);

/// A method as it did in a scene.
struct TriedOption
{
  std::string model;
  std::string name;
  std::vector<double> work;
  double coarseness = 1;
  double bound = 0;
  double seconds = 0; ///< without those of an empty picture; the shortest of the runs
  double error = 0;   ///< of 95 % of the pixels that the part touches
  double largest = 0; ///< of all
};

/// What a method takes by its built-in constants.
double guessedSeconds(const SceneOption& option);

/// Errors of a picture as the scene is drawn now, against exact pixels that the part touches.
struct PictureErrors
{
  double error95 = 0; ///< of 95 % of the pixels
  double largest = 0;
};

/// @param pixels that are drawn exactly at most. Of the scene's bodies the first is the part's. They keep the exact methods.
PictureErrors errorsOf(const MethodScene& scene, int pixels);

/**
 * Draw a scene by each of its part's methods and compare pixels to exact ones. The scene keeps the last method. No method is tried if
 * the part touches fewer than a quarter of the pixels.
 * @param most seconds that a method may take by its built-in constants; dearer ones are not tried
 */
std::vector<TriedOption> tryMethods(const MethodScene& scene, int pixels, int runs, double most);
}
#endif
