// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudUniformMedium
 * @brief Uniform haze between the eye and whatever is seen.
 *
 * Input    none.
 * Method   one segment a pixel, from the eye to the nearer of Range and the nearest opaque surface, s scene units long:
 *          optical depth Extinction s, radiance Color (1 - exp(-Extinction s)) - Perlin's fog blend. Where it overlaps
 *          other media, they mix as uniform media do (nephoscope::composite).
 *          A stretch thicker than 100 in its thinnest channel that is not clear is cut there.
 * Cost     a segment a pixel.
 * @sa vtkCloudscape
 */
#ifndef vtkCloudUniformMedium_h
#define vtkCloudUniformMedium_h

#include "vtkCloudBody.h"
#include "vtkCloudRenderingModule.h" // for export macro

class VTKCLOUDRENDERING_EXPORT vtkCloudUniformMedium : public vtkCloudBody
{
public:
  static vtkCloudUniformMedium* New();
  vtkTypeMacro(vtkCloudUniformMedium, vtkCloudBody);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Extinction per scene unit, RGB >= 0. Default 0: clear.
  vtkSetVector3Macro(Extinction, double);
  vtkGetVector3Macro(Extinction, double);
  ///@}
  ///@{
  /// Radiance of haze of endless depth, linear RGB >= 0. Default (0.5, 0.6, 0.75).
  vtkSetVector3Macro(Color, double);
  vtkGetVector3Macro(Color, double);
  ///@}
  ///@{
  /// How far from the eye it reaches, scene units. Default VTK_DOUBLE_MAX: without end.
  vtkSetClampMacro(Range, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(Range, double);
  ///@}

#ifndef __VTK_WRAP__
  bool Prepare(const nephoscope::Camera& camera) override;
  void Emit(const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const override;
#endif

protected:
  vtkCloudUniformMedium();
  ~vtkCloudUniformMedium() override = default;

  double Extinction[3] = { 0, 0, 0 };
  double Color[3] = { 0.5, 0.6, 0.75 };
  double Range = VTK_DOUBLE_MAX;

private:
  vtkCloudUniformMedium(const vtkCloudUniformMedium&) = delete;
  void operator=(const vtkCloudUniformMedium&) = delete;
};
#endif
