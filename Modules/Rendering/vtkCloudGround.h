// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudGround
 * @brief The opaque ground under the clouds: sea and land in plain colours, lit by sun and sky.
 *
 * Input    none.
 * Method   colour of sea and land mixed by the share of land (nephoscope::LandMask, VTK's own continents), coast lines
 *          and graticule over it, Lambert's law and the sky's light (vtkCloudLitBody).
 * @sa vtkCloudGlobe, vtkCloudPlane, nephoscope::LandMask
 */
#ifndef vtkCloudGround_h
#define vtkCloudGround_h

#include "vtkCloudLitBody.h"
#include "vtkCloudRenderingModule.h" // for export macro

namespace nephoscope
{
struct Vector3;
}

class VTKCLOUDRENDERING_EXPORT vtkCloudGround : public vtkCloudLitBody
{
public:
  vtkTypeMacro(vtkCloudGround, vtkCloudLitBody);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Reflectance of the sea, or of all if there is no land; linear RGB. Default (0.01, 0.033, 0.08), a dark blue.
  vtkSetVector3Macro(SeaColor, double);
  vtkGetVector3Macro(SeaColor, double);
  ///@}
  ///@{
  /// Reflectance of land, linear RGB. Default (0.13, 0.12, 0.065), a muted olive.
  vtkSetVector3Macro(LandColor, double);
  vtkGetVector3Macro(LandColor, double);
  ///@}
  ///@{
  /// Reflectance of coast lines and graticule, linear RGB. Default (0.22, 0.22, 0.2).
  vtkSetVector3Macro(LineColor, double);
  vtkGetVector3Macro(LineColor, double);
  ///@}
  ///@{
  /// Whether there is land. Default on for a globe, off for a plane.
  vtkSetMacro(Land, bool);
  vtkGetMacro(Land, bool);
  vtkBooleanMacro(Land, bool);
  ///@}
  ///@{
  /// Whether the coast is drawn as a line; needs Land. Default off.
  vtkSetMacro(CoastLines, bool);
  vtkGetMacro(CoastLines, bool);
  vtkBooleanMacro(CoastLines, bool);
  ///@}
  ///@{
  /// Meridians and parallels at multiples of this, degrees; 0 for none. Default 0.
  vtkSetClampMacro(Graticule, double, 0, 90);
  vtkGetMacro(Graticule, double);
  ///@}

  bool IsOpaque() const override { return true; }

protected:
  vtkCloudGround();
  ~vtkCloudGround() override = default;

#ifndef __VTK_WRAP__
  /// Reflectance of a place in degrees; the width of a pixel, degrees of longitude and of latitude.
  nephoscope::Vector3 ColorAt(
    double longitude, double latitude, double pixelEast, double pixelNorth) const;
#endif

  double SeaColor[3] = { 0.01, 0.033, 0.08 };
  double LandColor[3] = { 0.13, 0.12, 0.065 };
  double LineColor[3] = { 0.22, 0.22, 0.2 };
  bool Land = false;
  bool CoastLines = false;
  double Graticule = 0;

private:
  vtkCloudGround(const vtkCloudGround&) = delete;
  void operator=(const vtkCloudGround&) = delete;
};
#endif
