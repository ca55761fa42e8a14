// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCloudVolumeRepresentation.h"

#include "vtkCloudVolumeMapper.h"

#include <vtkNew.h>
#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkCloudVolumeRepresentation);

namespace
{
constexpr const char* MapperName = "Nephoscope";
}

vtkCloudVolumeRepresentation::vtkCloudVolumeRepresentation()
{
  const vtkNew<vtkCloudVolumeMapper> mapper;
  this->AddVolumeMapper(MapperName, mapper);
  this->Superclass::SetActiveVolumeMapper(MapperName);
}

void vtkCloudVolumeRepresentation::SetActiveVolumeMapper(const char*)
{
  this->Superclass::SetActiveVolumeMapper(MapperName);
}
