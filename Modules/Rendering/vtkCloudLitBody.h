// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudLitBody
 * @brief A body whose surface is lit by the sun and by the sky.
 *
 * Method   Gardner 1985 eq. 8 with the sun's and the sky's colours (nephoscope::SurfaceShade):
 *          radiance = colour (SunColor (1 - a) {...} + SkyColor a), a = Ambient.
 *          A surface seen full in the sun has about radiance 1 with the defaults. There are no cast shadows.
 * @sa vtkCloudSurface, vtkCloudGround, nephoscope::SurfaceShade
 */
#ifndef vtkCloudLitBody_h
#define vtkCloudLitBody_h

#include "vtkCloudBody.h"
#include "vtkCloudRenderingModule.h" // for export macro

namespace nephoscope
{
struct SurfaceShade;
}

class VTKCLOUDRENDERING_EXPORT vtkCloudLitBody : public vtkCloudBody
{
public:
  vtkTypeMacro(vtkCloudLitBody, vtkCloudBody);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Direction from the scene to the sun, any length > 0. Default (0, 0, 1).
  vtkSetVector3Macro(TowardSun, double);
  vtkGetVector3Macro(TowardSun, double);
  ///@}
  ///@{
  /// Radiance of a white surface that faces the sun, linear RGB >= 0. Default (1, 0.97, 0.91), a warm white.
  vtkSetVector3Macro(SunColor, double);
  vtkGetVector3Macro(SunColor, double);
  ///@}
  ///@{
  /// Radiance of a white surface under the sky alone, linear RGB >= 0. Default (0.62, 0.76, 1), a light blue.
  vtkSetVector3Macro(SkyColor, double);
  vtkGetVector3Macro(SkyColor, double);
  ///@}
  ///@{
  /// Gardner's a, the sky's share of the light, 0 to 1. Default 0.25.
  vtkSetClampMacro(Ambient, double, 0, 1);
  vtkGetMacro(Ambient, double);
  ///@}

protected:
  vtkCloudLitBody() = default;
  ~vtkCloudLitBody() override = default;

#ifndef __VTK_WRAP__
  /// The light of this body upon a colour; no texture, no highlight, Lambert's law.
  nephoscope::SurfaceShade MakeShade() const;
#endif

  double TowardSun[3] = { 0, 0, 1 };
  double SunColor[3] = { 1, 0.97, 0.91 };
  double SkyColor[3] = { 0.62, 0.76, 1 };
  double Ambient = 0.25;

private:
  vtkCloudLitBody(const vtkCloudLitBody&) = delete;
  void operator=(const vtkCloudLitBody&) = delete;
};
#endif
