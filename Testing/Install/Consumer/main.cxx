// SPDX-License-Identifier: BSD-3-Clause
// A haze of optical depth 1 before an opaque wall of radiance 1: the wall arrives attenuated by exp(-1).
// And a cloudscape without bodies: all of the black backdrop gets through.
// And the calibrations are those of the library's own tree, the argument.
#include "CalibrationFile.h"
#include "CalibrationPath.h"
#include "CloudArrays.h"
#include "Segment.h"
#include "vtkCloudscape.h"

#include <vtkCamera.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <cmath>
#include <cstdio>
#include <string>

int main(int, char** arguments)
{
  const nephoscope::RGB wall{ nephoscope::Opaque, nephoscope::Opaque, nephoscope::Opaque };
  nephoscope::Segment segments[] = { { 5, 5, wall, { 1, 1, 1 } },
    { 1, 2, { 1, 1, 1 }, { 0, 0, 0 } } };
  const float arrived = nephoscope::composite(segments, segments + 2).radiance[0];
  std::printf("%.7f of the wall arrives\n", arrived);

  vtkNew<vtkCamera> camera;
  vtkNew<vtkCloudscape> cloudscape;
  cloudscape->SetCamera(camera);
  cloudscape->SetSize(3, 2);
  cloudscape->Update();
  vtkDataArray* through =
    cloudscape->GetOutput()->GetPointData()->GetArray(nephoscope::arrays::Transmittance);
  const double transmittance = through ? through->GetComponent(5, 0) : 0;
  std::printf("%g of the backdrop arrives\n", transmittance);

  const std::string path = nephoscope::calibrationPath("slab");
  std::printf("constants of %s\n", path.c_str());
  const bool own = path.rfind(arguments[1], 0) == 0;
  return own && nephoscope::readCalibration(path).what == "slab" &&
      std::abs(arrived - std::exp(-1.0)) < 1e-6 && transmittance == 1
    ? 0
    : 1;
}
