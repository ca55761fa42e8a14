// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudVolumeRepresentation
 * @brief Shows a structured grid in ParaView's render views as fog, by vtkCloudVolumeMapper.
 *
 * ParaView's own representation of volumes, whose base class makes tetrahedra of the grid; only the mapper is ours.
 *
 * Limits   see vtkCloudVolumeMapper: point arrays of one component, no shading. Where several processes each draw a part of the data, the
 *          parts of a globe cannot be put in an order that suits every ray: vtkCloudPicture has no such limit.
 * @sa vtkCloudVolumeMapper
 */
#ifndef vtkCloudVolumeRepresentation_h
#define vtkCloudVolumeRepresentation_h

#include "vtkCloudParaViewModule.h" // for export macro
#include "vtkStructuredGridVolumeRepresentation.h"

class VTKCLOUDPARAVIEW_EXPORT vtkCloudVolumeRepresentation
  : public vtkStructuredGridVolumeRepresentation
{
public:
  static vtkCloudVolumeRepresentation* New();
  vtkTypeMacro(vtkCloudVolumeRepresentation, vtkStructuredGridVolumeRepresentation);

  /// There is one mapper; names are ignored.
  void SetActiveVolumeMapper(const char* name) override;

protected:
  vtkCloudVolumeRepresentation();
  ~vtkCloudVolumeRepresentation() override = default;

private:
  vtkCloudVolumeRepresentation(const vtkCloudVolumeRepresentation&) = delete;
  void operator=(const vtkCloudVolumeRepresentation&) = delete;
};
#endif
