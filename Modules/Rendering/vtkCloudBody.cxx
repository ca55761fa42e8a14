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

void vtkCloudBody::SetInputUse(int port, bool use)
{
  const unsigned bit = 1U << static_cast<unsigned>(port);
  const unsigned unused = use ? this->UnusedInputs & ~bit : this->UnusedInputs | bit;
  if (unused != this->UnusedInputs)
  {
    this->UnusedInputs = unused;
    this->Modified();
  }
}

bool vtkCloudBody::GetInputUse(int port) const
{
  return (this->UnusedInputs >> static_cast<unsigned>(port) & 1U) == 0;
}

vtkDataObject* vtkCloudBody::GetUsedInput(int port)
{
  return this->GetInputUse(port) ? this->GetInputDataObject(port, 0) : nullptr;
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
