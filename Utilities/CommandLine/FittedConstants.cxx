// SPDX-License-Identifier: BSD-3-Clause
#include "FittedConstants.h"

#include "Messages.h"

#include <CalibrationFile.h>
#include <CalibrationPath.h>
#include <HeightFieldScattering.h>
#include <vtkCloudHeightField.h>

#include <algorithm>
#include <cmath>

namespace nephoscope::program
{
namespace
{
/// Notes that none can be read only for what is shipped: it is only better, not needed.
bool readShipped(Calibration& calibration)
{
  try
  {
    calibration = readCalibration(calibrationPath("heightfield"), "heightfield");
    return true;
  }
  catch (const ReadError& error)
  {
    note(std::string("warning: ") + error.what() + "; Max's own constants are used");
    return false;
  }
}

const Fit& fitFor(const Calibration& calibration, vtkCloudHeightField* clouds)
{
  const ScatteringDensities max;
  const double sun = clouds->GetSunExtinction() / max.sun;
  const double view = clouds->GetViewExtinction() / max.view;
  const bool likeMax = std::abs(sun - 1) < 0.1 && std::abs(view - 1) < 0.1;
  if (std::min(sun, view) < 0.25 || std::max(sun, view) > 4)
  {
    note("warning: the constants of Sexp1986 were fitted to 0.25 to 4 times Max's extinctions");
  }
  return calibration.fit(
    likeMax ? "printed with gain, densities 1" : "printed with gain, densities 0.25 to 4");
}
}

void setConstants(vtkCloudHeightField* clouds, const HeightFieldBody& body)
{
  if (body.calibration == "none")
  {
    return;
  }
  Calibration calibration;
  if (body.calibration != "shipped")
  {
    calibration = readCalibration(body.calibration, "heightfield");
  }
  else if (!readShipped(calibration))
  {
    return;
  }
  const Fit& fit = fitFor(calibration, clouds);
  clouds->SetSunFactor(fit.value("ma"));
  clouds->SetViewFactor(fit.value("mb"));
  clouds->SetGain(fit.value("gain"));
}
}
