// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudPictureCheck.h"

#include "Camera.h"
#include "CloudArrays.h"
#include "RadianceError.h"
#include "vtkCamera.h"
#include "vtkCloudModelSelector.h"
#include "vtkCloudscape.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <random>

vtkStandardNewMacro(vtkCloudPictureCheck);

namespace
{
/// Pictures of one ray of another's camera, with its bodies and its backdrop.
class RayPicture
{
public:
  explicit RayPicture(vtkCloudscape* scape)
    : Rays(scape->GetRays())
  {
    for (int i = 0; i < scape->GetNumberOfBodies(); ++i)
    {
      this->Scape->AddBody(scape->GetBody(i));
    }
    const double up[3] = { this->Rays.up()[0], this->Rays.up()[1], this->Rays.up()[2] };
    this->View->SetViewUp(up);
    // One pixel as wide as the other's.
    this->View->SetViewAngle(2 * vtkMath::DegreesFromRadians(std::atan(this->Rays.pixel() / 2)));
    this->View->SetParallelProjection(this->Rays.isParallel());
    this->View->SetParallelScale(this->Rays.pixel() / 2);
    this->Scape->SetCamera(this->View);
    this->Scape->SetSize(1, 1);
    this->Scape->SetComputeDepth(false);
    this->Scape->SetBackdrop(scape->GetBackdrop());
  }

  /// Adds the radiance of the ray through a place of the picture.
  void Add(double x, double y, double sum[3])
  {
    const nephoscope::Ray ray = this->Rays.ray(x, y);
    const nephoscope::Vector3 target = ray.origin + ray.direction;
    this->View->SetPosition(ray.origin[0], ray.origin[1], ray.origin[2]);
    this->View->SetFocalPoint(target[0], target[1], target[2]);
    this->Scape->Update();
    vtkDataArray* const radiance =
      this->Scape->GetOutput()->GetPointData()->GetArray(nephoscope::arrays::Radiance);
    for (int c = 0; c < 3; ++c)
    {
      sum[c] += radiance ? radiance->GetComponent(0, c) : 0;
    }
  }

private:
  nephoscope::Camera Rays;
  vtkNew<vtkCamera> View;
  vtkNew<vtkCloudscape> Scape;
};
}

/// The first of a random order of all; sorted.
void vtkCloudPictureCheck::ChoosePixels(vtkIdType count)
{
  // Floyd's choice without repetition; the same with every standard library.
  std::mt19937_64 random(static_cast<std::uint64_t>(this->Seed));
  const vtkIdType wanted = std::min<vtkIdType>(this->NumberOfPixels, count);
  this->Pixels.clear();
  for (vtkIdType last = count - wanted; last < count; ++last)
  {
    const auto pixel = static_cast<vtkIdType>(random() % static_cast<std::uint64_t>(last + 1));
    const auto at = std::lower_bound(this->Pixels.begin(), this->Pixels.end(), pixel);
    const bool isNew = at == this->Pixels.end() || *at != pixel;
    this->Pixels.insert(isNew ? at : this->Pixels.end(), isNew ? pixel : last);
  }
}

bool vtkCloudPictureCheck::Check(vtkCloudscape* scape)
{
  vtkDataArray* const drawn =
    scape ? scape->GetOutput()->GetPointData()->GetArray(nephoscope::arrays::Radiance) : nullptr;
  if (!drawn || !scape->GetCamera())
  {
    vtkErrorMacro("There is no picture to check: give a cloudscape that has been drawn.");
    return false;
  }
  vtkNew<vtkCloudModelSelector> selector;
  selector->SetCloudscape(scape);
  selector->SelectExact();
  this->ChoosePixels(drawn->GetNumberOfTuples());
  this->Exact.clear();
  this->Errors.clear();
  RayPicture picture(scape);
  const int n = scape->GetSamples();
  const int width = scape->GetOutput()->GetDimensions()[0];
  for (const vtkIdType pixel : this->Pixels)
  {
    const vtkIdType column = pixel % width;
    const vtkIdType row = pixel / width;
    double exact[3] = { 0, 0, 0 };
    for (int ray = 0; ray < n * n; ++ray)
    {
      const vtkIdType x = n * column + ray % n;
      const vtkIdType y = n * row + ray / n;
      picture.Add(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5, exact);
    }
    double radiance[3];
    drawn->GetTuple(pixel, radiance);
    for (double& c : exact)
    {
      c /= n * n;
      this->Exact.push_back(c);
    }
    this->Errors.push_back(nephoscope::radianceError(radiance, exact));
    double done =
      static_cast<double>(this->Errors.size()) / static_cast<double>(this->Pixels.size());
    this->InvokeEvent(vtkCommand::ProgressEvent, &done);
  }
  this->MedianError = nephoscope::quantile(this->Errors, 0.5);
  this->Error95 = nephoscope::quantile(this->Errors, 0.95);
  this->LargestError = nephoscope::quantile(this->Errors, 1);
  return true;
}

double vtkCloudPictureCheck::GetShareAbove(double error) const
{
  const auto above = std::count_if(
    this->Errors.begin(), this->Errors.end(), [error](double e) { return e > error; });
  return this->Errors.empty()
    ? 0
    : static_cast<double>(above) / static_cast<double>(this->Errors.size());
}

void vtkCloudPictureCheck::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfPixels: " << this->NumberOfPixels << '\n';
  os << indent << "Seed: " << this->Seed << '\n';
  os << indent << "MedianError: " << this->MedianError << '\n';
  os << indent << "Error95: " << this->Error95 << '\n';
  os << indent << "LargestError: " << this->LargestError << '\n';
}
