// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file SceneView.h
 * @brief What a scene does not say of its view, chosen from the data: exaggeration, camera, sun, sky.
 */
#ifndef SceneView_h
#define SceneView_h

#include "Scene.h"

#include <Vector3.h>
#include <vtkSmartPointer.h>

#include <vector>

class vtkCamera;
class vtkCloudGradedBackdrop;
class vtkStructuredGrid;

namespace nephoscope::program
{
/// How a grid lies in the scene.
struct Extent
{
  std::string geometry = "Local"; ///< Map, Globe or Local
  double planetRadius = 0;        ///< scene units; Globe only
  double heightScale = 1;         ///< scene units per metre of height
  double gridStep = 0;       ///< scene units; typical distance of neighbours from south to north
  double bounds[6] = {};     ///< of the troposphere's points, scene units
  bool global = false;       ///< Globe: the points go round
  Vector3 middle;            ///< of the clouds; Globe: of the data, unit direction from the centre
  std::vector<Vector3> hull; ///< points in cloud; all points if there is no cloud

  bool isGlobe() const { return this->geometry == "Globe"; }
};

Extent extentOf(vtkStructuredGrid* grid);

/// Factor on heights that shows clouds as bodies: 10 on a whole globe, up to 40 where its grid is coarse; else the
/// troposphere rises to a quarter of the data's width, from 1 to 40, two digits.
double exaggerationOf(const Extent& extent);

/// The camera that a view and the data ask for.
vtkSmartPointer<vtkCamera> cameraOf(
  const CameraView& view, const Extent& extent, const std::array<int, 2>& size);

/// Unit direction toward the sun: as given, else over the eye's left shoulder.
Vector3 towardSunOf(const Light& light, const Extent& extent, vtkCamera* camera);

/// Dark space round a globe, a clear sky elsewhere; what is given wins.
vtkSmartPointer<vtkCloudGradedBackdrop> backdropOf(const Backdrop& backdrop, const Extent& extent);
}
#endif
