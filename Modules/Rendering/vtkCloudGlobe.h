// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudGlobe
 * @brief An opaque sphere with sea and land: the ground of scenes in Globe geometry.
 *
 * Input    none.
 * Method   each ray is intersected with the sphere in closed form. Longitude 0 is along +x, 90 east along +y, the north
 *          pole along +z from the centre. A pixel that the limb cuts is covered by the share of a straight edge.
 * Limits   an eye inside the sphere does not see it.
 * @sa vtkCloudGround, vtkCloudPlane
 */
#ifndef vtkCloudGlobe_h
#define vtkCloudGlobe_h

#include "vtkCloudGround.h"
#include "vtkCloudRenderingModule.h" // for export macro

class VTKCLOUDRENDERING_EXPORT vtkCloudGlobe : public vtkCloudGround
{
public:
  static vtkCloudGlobe* New();
  vtkTypeMacro(vtkCloudGlobe, vtkCloudGround);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Radius, scene units, > 0. Default 6371229 (metres).
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  ///@}
  ///@{
  /// Centre, scene units. Default (0, 0, 0).
  vtkSetVector3Macro(Center, double);
  vtkGetVector3Macro(Center, double);
  ///@}
  ///@{
  /// Let pixels that the limb cuts be partly transparent. Default on.
  vtkSetMacro(SmoothLimb, bool);
  vtkGetMacro(SmoothLimb, bool);
  vtkBooleanMacro(SmoothLimb, bool);
  ///@}

#ifndef __VTK_WRAP__
  bool Prepare(const nephoscope::Camera& camera) override;
  void Emit(const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const override;
#endif

protected:
  vtkCloudGlobe();
  ~vtkCloudGlobe() override = default;

  double Radius = 6371229;
  double Center[3] = { 0, 0, 0 };
  bool SmoothLimb = true;

private:
  vtkCloudGlobe(const vtkCloudGlobe&) = delete;
  void operator=(const vtkCloudGlobe&) = delete;
};
#endif
