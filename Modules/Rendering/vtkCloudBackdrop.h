// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudBackdrop
 * @brief What is seen where the bodies let light through: radiance at infinity for a direction.
 * @sa vtkCloudscape, vtkCloudGradedBackdrop
 */
#ifndef vtkCloudBackdrop_h
#define vtkCloudBackdrop_h

#include "vtkCloudRenderingModule.h" // for export macro
#include "vtkObject.h"

class VTKCLOUDRENDERING_EXPORT vtkCloudBackdrop : public vtkObject
{
public:
  vtkTypeMacro(vtkCloudBackdrop, vtkObject);

  /**
   * Radiance, linear RGB, that reaches an eye which looks along a unit direction (from the eye outward).
   * Called from several threads at once.
   */
  virtual void GetRadiance(const double direction[3], float radiance[3]) const = 0;

protected:
  vtkCloudBackdrop();
  ~vtkCloudBackdrop() override;

private:
  vtkCloudBackdrop(const vtkCloudBackdrop&) = delete;
  void operator=(const vtkCloudBackdrop&) = delete;
};
#endif
