// SPDX-License-Identifier: BSD-3-Clause
#include "Quality.h"

#include "Failure.h"
#include "Messages.h"
#include "Progress.h"

#include <CalibrationFile.h>
#include <CalibrationPath.h>
#include <vtkCloudModelSelector.h>
#include <vtkCloudPictureCheck.h>
#include <vtkCloudscape.h>
#include <vtkNew.h>

#include <sstream>

namespace nephoscope::program
{
void useCalibration(vtkCloudModelSelector* selector)
{
  try
  {
    selector->SetCalibration(readCalibration(calibrationPath("methods"), "methods"));
  }
  catch (const std::runtime_error& error)
  {
    note(std::string(error.what()) + "; until then methods are chosen by built-in constants");
  }
}

std::string chooseMethods(const Quality& quality, vtkCloudscape* scape)
{
  if (!quality.isAsked())
  {
    return {};
  }
  const vtkNew<vtkCloudModelSelector> selector;
  selector->SetCloudscape(scape);
  selector->SetTolerance(quality.tolerance.value_or(0));
  selector->SetSeconds(quality.seconds.value_or(0));
  useCalibration(selector);
  selector->Select();
  Messages::throwIfError("quality");
  return selector->Explain();
}

std::string verified(const Quality& quality, vtkCloudscape* scape, int pixels, Progress& progress)
{
  const vtkNew<vtkCloudPictureCheck> check;
  check->SetNumberOfPixels(pixels);
  progress.watch(check, "verify");
  check->Check(scape);
  progress.forget();
  Messages::throwIfError("verify");
  const int* const size = scape->GetSize();
  std::ostringstream out;
  out.precision(2);
  out << "verified " << check->GetNumberOfChecked() << " of "
      << static_cast<long>(size[0]) * size[1] << " pixels by exact methods: error median "
      << check->GetMedianError() << ", 95 % " << check->GetError95() << ", largest "
      << check->GetLargestError() << '\n';
  if (quality.tolerance)
  {
    const double tolerance = *quality.tolerance;
    out << (check->GetError95() <= tolerance ? "the tolerance of " : "THE TOLERANCE OF ")
        << tolerance
        << (check->GetError95() <= tolerance ? " is met by 95 % of the pixels"
                                             : " IS EXCEEDED by more than 5 % of the pixels")
        << "; " << 100 * check->GetShareAbove(tolerance) << " % are above it\n";
  }
  return out.str();
}
}
