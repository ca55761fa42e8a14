// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudPlane
 * @brief An opaque horizontal plane: the ground of scenes in Map or Local geometry.
 *
 * Input    none.
 * Method   each ray is intersected with z = Height. In Map geometry longitude and latitude are x and y times
 *          DegreesPerUnit, so that land can be drawn. From below its lower side is seen, lit by the sky alone.
 * @sa vtkCloudGround, vtkCloudGlobe
 */
#ifndef vtkCloudPlane_h
#define vtkCloudPlane_h

#include "vtkCloudGround.h"
#include "vtkCloudRenderingModule.h" // for export macro

class VTKCLOUDRENDERING_EXPORT vtkCloudPlane : public vtkCloudGround
{
public:
  static vtkCloudPlane* New();
  vtkTypeMacro(vtkCloudPlane, vtkCloudGround);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// z of the plane, scene units. Default 0.
  vtkSetMacro(Height, double);
  vtkGetMacro(Height, double);
  ///@}
  ///@{
  /// Least and greatest x, least and greatest y, scene units. Default without end.
  vtkSetVector4Macro(Bounds, double);
  vtkGetVector4Macro(Bounds, double);
  ///@}
  ///@{
  /// Degrees of longitude and latitude in a scene unit, > 0: 1 if x and y are degrees, 180 / (pi R) if they are metres.
  /// For Land and Graticule. Default 1.
  vtkSetMacro(DegreesPerUnit, double);
  vtkGetMacro(DegreesPerUnit, double);
  ///@}

#ifndef __VTK_WRAP__
  bool Prepare(const nephoscope::Camera& camera) override;
  void Emit(const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const override;
#endif

protected:
  vtkCloudPlane() = default;
  ~vtkCloudPlane() override = default;

  double Height = 0;
  double Bounds[4] = { VTK_DOUBLE_MIN, VTK_DOUBLE_MAX, VTK_DOUBLE_MIN, VTK_DOUBLE_MAX };
  double DegreesPerUnit = 1;

private:
  vtkCloudPlane(const vtkCloudPlane&) = delete;
  void operator=(const vtkCloudPlane&) = delete;
};
#endif
