// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file SceneBuilder.h
 * @brief From a scene's description to a vtkCloudscape that can draw it.
 */
#ifndef SceneBuilder_h
#define SceneBuilder_h

#include "Scene.h"
#include "SceneView.h"

#include <vtkSmartPointer.h>
#include <vtkType.h>

class vtkCloudNetCDFReader;
class vtkCloudscape;
class vtkStructuredGrid;

namespace nephoscope::program
{
class Progress;

struct BuiltScene
{
  vtkSmartPointer<vtkCloudscape> scape; ///< its inputs are up to date; only drawing is left
  double readSeconds = 0;
  double filterSeconds = 0;
  vtkIdType cells = 0;     ///< of the grid
  vtkIdType triangles = 0; ///< of all surfaces
};

/// The data of a scene at its time, and how they lie; of a scene without data, nothing and a plane in metres.
struct SceneData
{
  vtkSmartPointer<vtkCloudNetCDFReader> reader; ///< as the scene wants it; its output is the grid
  vtkSmartPointer<vtkStructuredGrid> grid;
  Extent lie;
};

/// @throw Failure for data that cannot be read or drawn
SceneData readData(const Scene& scene, Progress& progress);

/// A picture of a grid that has been read, or of no data if `grid` is null. @param lie may be that of another time, so that the view does not depend on clouds
BuiltScene buildScene(const Scene& scene, vtkStructuredGrid* grid, const Extent& lie,
  bool addGround, Progress& progress);

/**
 * Read the data, make the bodies' inputs and put the picture together.
 *
 * With `addGround` the clouds get a globe under them, or a plane and haze. Choices that a user should know of
 * are said on standard error.
 * @throw Failure for data that cannot be read or drawn
 */
BuiltScene buildScene(const Scene& scene, bool addGround, Progress& progress);
}
#endif
