// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudVolumeMapper
 * @brief Draws cells as glowing fog in any VTK render window, in place of VTK's own unstructured volume mappers.
 *
 * Change the line that makes a vtkProjectedTetrahedraMapper or vtkUnstructuredGridVolumeRayCastMapper, and no other: the
 * vtkVolume and its vtkVolumeProperty stay. The cells are drawn by the software renderer of vtkCloudCellVolume, exact per
 * pixel in any order, and laid over what the window shows. A frame
 *  1. reads cells and transfer functions, if they have changed;
 *  2. reads the window's depths, if something opaque was drawn, and keeps what lies before them;
 *  3. draws tile after tile, on all threads;
 *  4. blends the picture over the window's colours, premultiplied, 16 bits a channel, pixel on pixel.
 *
 * Input    port 0: vtkStructuredGrid, vtkRectilinearGrid, vtkImageData (each hexahedral cell is five tetrahedra, the same as
 *          the contour's), or vtkUnstructuredGrid of tetrahedra; point scalars of 1 component, as SetScalarMode and
 *          SelectScalarArray choose them.
 * Output   the window's colours. Depths are left as they are.
 * Parameters: those of vtkAbstractVolumeMapper; of the property ScalarOpacity, ScalarOpacityUnitDistance, and the RGB or grey
 *          transfer function, of component 0.
 * Method   As in vtkProjectedTetrahedraMapper, transfer functions are taken at the points; extinction =
 *          ScalarOpacity / ScalarOpacityUnitDistance per scene unit and colour are linear in each tetrahedron, hence along a
 *          ray: L = int c sigma exp(-tau), Max 1995 eq. 5 (nephoscope/LinearEmission.h). Colours are the window's own, not
 *          converted. Distances are those after the vtkVolume's matrix.
 * Errors   no points' scalars, several components, other cells, a maximum-intensity blend, an off-centre, oblique or
 *          explicitly given projection, no RenderingVolumeOpenGL2: vtkErrorMacro; the window stays as it was.
 * Cost     as vtkCloudCellVolume without Depth; in several colours also a sort of each pixel's segments, 104 bytes each in a tile. The
 *          window's depths are read and the picture is sent to it in each frame.
 * Limits   Shading, cropping, clipping planes and cell scalars are ignored. Radiance is within 1e-5 of exact before it is
 *          rounded to the window's bits. Depths are the window's: an opaque thing is placed as well as 24 bits between
 *          the clipping planes say. A viewport is 8192 pixels wide and high at most, where textures end at 16384.
 * @sa vtkCloudCellVolume, TestCloudVolumeMapper.cxx
 */
#ifndef vtkCloudVolumeMapper_h
#define vtkCloudVolumeMapper_h

#include "vtkCloudRenderingModule.h" // for export macro
#include "vtkUnstructuredGridVolumeMapper.h"

#include <memory> // for the internals

class VTKCLOUDRENDERING_EXPORT vtkCloudVolumeMapper : public vtkUnstructuredGridVolumeMapper
{
public:
  static vtkCloudVolumeMapper* New();
  vtkTypeMacro(vtkCloudVolumeMapper, vtkUnstructuredGridVolumeMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The cells. GetDataSetInput returns them; GetInput only a vtkUnstructuredGrid.
  void SetInputData(vtkUnstructuredGridBase* cells) override;
  void SetInputData(vtkDataSet* cells) override;
  ///@}

  /// Called by the vtkVolume while it is drawn.
  void Render(vtkRenderer* renderer, vtkVolume* volume) override;

  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkCloudVolumeMapper();
  ~vtkCloudVolumeMapper() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;

private:
  vtkCloudVolumeMapper(const vtkCloudVolumeMapper&) = delete;
  void operator=(const vtkCloudVolumeMapper&) = delete;

  bool ReadCells(vtkVolume* volume);
  bool CanProject(vtkRenderer* renderer);
  void DrawTiles(vtkRenderer* renderer);

  struct Internals;
  std::unique_ptr<Internals> Data;
};
#endif
