// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudBody.h"

#include "Camera.h"
#include "vtkDataObject.h"

#include <algorithm>

vtkCloudBody::vtkCloudBody()
{
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(0);
}

void vtkCloudBody::SetInputData(vtkDataObject* data)
{
  this->SetInputDataObject(0, data);
}

vtkMTimeType vtkCloudBody::GetInputsMTime()
{
  vtkMTimeType newest = this->GetMTime();
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    for (int connection = 0; connection < this->GetNumberOfInputConnections(port); ++connection)
    {
      if (vtkDataObject* data = this->GetInputDataObject(port, connection))
      {
        newest = std::max(newest, data->GetMTime());
      }
    }
  }
  return newest;
}

bool vtkCloudBody::IsFlat(const nephoscope::Camera& camera)
{
  if (camera.isCylindrical())
  {
    vtkErrorMacro("A " << this->GetClassName()
                       << " is drawn by projecting its cells, whose edges are not straight in a "
                          "cylindrical picture; "
                          "choose a perspective or parallel camera.");
    return false;
  }
  return true;
}
