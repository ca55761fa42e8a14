// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file VolumeCells.h
 * @brief The cells of a data set with the optics of a vtkVolumeProperty: what vtkCloudVolumeMapper draws.
 */
#ifndef VolumeCells_h
#define VolumeCells_h

#include "CellColumns.h"
#include "ScreenBins.h"
#include "TetrahedronMesh.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkDataArray;
class vtkDataSet;
class vtkMatrix4x4;
class vtkVolumeProperty;

/// Structured cells as columns, those of a vtkUnstructuredGrid as tetrahedra; one of the two is empty.
class VolumeCells
{
public:
  /// Read cells and optics; placed where the matrix puts them. Returns what is wrong, or nothing.
  std::string Read(
    vtkDataSet* cells, vtkDataArray* scalars, vtkVolumeProperty* property, vtkMatrix4x4* matrix);

  /// Get ready for a camera.
  void Look(const nephoscope::Camera& camera);

  /// Add the segments of a tile's pixels. From several threads at once.
  void Emit(const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const;

private:
  std::string ReadStructured(vtkDataSet* cells, const int extent[6]);
  std::string ReadTetrahedra(vtkDataSet* cells);
  void ReadOptics(vtkDataArray* scalars, vtkVolumeProperty* property);
  void KeepOneColor();
  template <class Rays, class Cells>
  void LookAt(const Cells& cells, const nephoscope::Camera& camera);
  template <class Rays, class Cells>
  void EmitFrom(
    const Cells& cells, const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const;

  nephoscope::CellColumns Columns;
  nephoscope::TetrahedronMesh Mesh;
  std::vector<float> Extinction;          ///< of the data set's points, in its order
  std::vector<nephoscope::RGB> Color;     ///< likewise
  nephoscope::RGB OneColor = { 0, 0, 0 }; ///< where all points have it
  std::vector<std::uint32_t> Drawn;       ///< columns or tetrahedra with something to draw
  bool Structured = false;
  ScreenBins Bins;
};
#endif
