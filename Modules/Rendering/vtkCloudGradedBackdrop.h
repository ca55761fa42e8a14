// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudGradedBackdrop
 * @brief A colour that goes from the nadir by the horizon to the zenith; a plain one if the three are equal.
 *
 * Parameters
 *   Up       direction of the zenith, any length                      default (0, 0, 1)
 *   Zenith, Horizon, Nadir   radiance, linear RGB, >= 0               default black
 * Method: with s the sine of the elevation, horizon + |s| (zenith - horizon) for s >= 0, towards nadir for s < 0.
 * @sa vtkCloudscape
 */
#ifndef vtkCloudGradedBackdrop_h
#define vtkCloudGradedBackdrop_h

#include "vtkCloudBackdrop.h"

class VTKCLOUDRENDERING_EXPORT vtkCloudGradedBackdrop : public vtkCloudBackdrop
{
public:
  static vtkCloudGradedBackdrop* New();
  vtkTypeMacro(vtkCloudGradedBackdrop, vtkCloudBackdrop);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void GetRadiance(const double direction[3], float radiance[3]) const override;

  ///@{
  /// Direction of the zenith, any length > 0. Default (0, 0, 1).
  vtkSetVector3Macro(Up, double);
  vtkGetVector3Macro(Up, double);
  ///@}
  ///@{
  /// Radiance overhead, linear RGB. Default black.
  vtkSetVector3Macro(Zenith, double);
  vtkGetVector3Macro(Zenith, double);
  ///@}
  ///@{
  /// Radiance at the horizon, linear RGB. Default black.
  vtkSetVector3Macro(Horizon, double);
  vtkGetVector3Macro(Horizon, double);
  ///@}
  ///@{
  /// Radiance below, linear RGB. Default black.
  vtkSetVector3Macro(Nadir, double);
  vtkGetVector3Macro(Nadir, double);
  ///@}
  /// All three alike.
  void SetColor(double r, double g, double b);

protected:
  vtkCloudGradedBackdrop() = default;
  ~vtkCloudGradedBackdrop() override = default;

  double Up[3] = { 0, 0, 1 };
  double Zenith[3] = { 0, 0, 0 };
  double Horizon[3] = { 0, 0, 0 };
  double Nadir[3] = { 0, 0, 0 };

private:
  vtkCloudGradedBackdrop(const vtkCloudGradedBackdrop&) = delete;
  void operator=(const vtkCloudGradedBackdrop&) = delete;
};
#endif
