// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file RenderingTest.h
 * @brief A small scene to draw bodies in, and its picture as numbers.
 */
#ifndef RenderingTest_h
#define RenderingTest_h

#include "Camera.h"
#include "CloudArrays.h"
#include "DeepTile.h"
#include "vtkCamera.h"
#include "vtkCloudBody.h"
#include "vtkCloudGradedBackdrop.h"
#include "vtkCloudscape.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

/// The eye at (0, -5, 0) looks at the origin, up is +z, the picture is 61 x 43.
class RenderingTest : public testing::Test
{
protected:
  static constexpr int Width = 61;
  static constexpr int Height = 43;

  void SetUp() override
  {
    this->Camera->SetPosition(0, -5, 0);
    this->Camera->SetFocalPoint(0, 0, 0);
    this->Camera->SetViewUp(0, 0, 1);
    this->Camera->SetViewAngle(30);
    this->Scape->SetCamera(this->Camera);
    this->Scape->SetSize(Width, Height);
    this->Scape->SetTileSize(13);
  }

  void Draw(const std::vector<vtkCloudBody*>& bodies)
  {
    this->Scape->RemoveAllBodies();
    for (vtkCloudBody* body : bodies)
    {
      this->Scape->AddBody(body);
    }
    this->Scape->Update();
  }

  /// A value of the picture.
  double At(const char* array, int x, int y, int component = 0)
  {
    vtkImageData* const picture = this->Scape->GetOutput();
    return picture->GetPointData()->GetArray(array)->GetComponent(
      y * picture->GetDimensions()[0] + x, component);
  }
  double Radiance(int x, int y, int component = 0)
  {
    return this->At(nephoscope::arrays::Radiance, x, y, component);
  }
  double Transmittance(int x, int y) { return this->At(nephoscope::arrays::Transmittance, x, y); }
  double Depth(int x, int y) { return this->At(nephoscope::arrays::Depth, x, y); }

  /// The ray of a pixel of a perspective camera.
  nephoscope::Ray RayOf(int x, int y) { return this->KernelCamera().ray(x + 0.5, y + 0.5); }
  nephoscope::Camera KernelCamera()
  {
    const auto vector = [](const double* v) { return nephoscope::Vector3{ v[0], v[1], v[2] }; };
    const int* const size = this->Scape->GetSize();
    return nephoscope::Camera::perspective(vector(this->Camera->GetPosition()),
      vector(this->Camera->GetFocalPoint()), vector(this->Camera->GetViewUp()),
      this->Camera->GetViewAngle(), size[0], size[1]);
  }

  vtkNew<vtkCamera> Camera;
  vtkNew<vtkCloudscape> Scape;
};
#endif
