// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudPicture
 * @brief vtkCloudscape as a filter: a picture of a grid, a surface, sparse voxels, or two of them, for pipelines and ParaView.
 *
 *  1. a grid is drawn by Volume, a surface by Surface, sparse voxels by Voxels; they may interpenetrate;
 *  2. the camera is moved until all of it is seen, if FitToInputs is on;
 *  3. vtkCloudscape draws them with Ground before Backdrop.
 *
 * Several processes draw one picture of their pieces together, exactly (vtkCloudscape::SetController), pieces may be empty; process 0
 * has it, the others' output is empty.
 *
 * Input    port 0 and, optional, port 1: what vtkCloudCellVolume takes (vtkStructuredGrid, vtkRectilinearGrid, vtkImageData), what
 *          vtkCloudVoxelVolume takes (vtkPolyData with VoxelBricks) and what vtkCloudSurface takes (other vtkPolyData), in any order,
 *          at most one of each; voxels whole in every process. Field data Geometry and PlanetRadius, as
 *          vtkCloudNetCDFReader gives them and vtkCloudContour passes them, for AutomaticGround.
 * Output   vtkImageData of Size, that of vtkCloudscape: Radiance, Transmittance, Depth; and DisplayColor (3 unsigned char, sRGB of
 *          Radiance), which are the active scalars.
 * Parameters: see the setters; the parts have their own.
 * Errors   other data, two inputs of one kind, those of vtkCloudscape: vtkErrorMacro, an empty output. Polygons without points are of no
 *          kind, or of that which the input is of in other processes. What this filter finds wrong in one of several processes is an
 *          error of all; if an input fails in one process alone this filter is not reached there, and the others wait for it.
 * Cost     that of vtkCloudscape. Parts keep what does not depend on the camera.
 * @sa vtkCloudscape, vtkCloudPictureWriter, TestCloudPicture.cxx
 */
#ifndef vtkCloudPicture_h
#define vtkCloudPicture_h

#include "vtkCloudRenderingModule.h" // for export macro
#include "vtkImageAlgorithm.h"
#include "vtkSmartPointer.h" // for members

#include <array> // for arguments

class vtkCamera;
class vtkCloudBackdrop;
class vtkCloudBody;
class vtkCloudCellVolume;
class vtkCloudGlobe;
class vtkCloudSurface;
class vtkCloudVoxelVolume;
class vtkCloudscape;
class vtkMultiProcessController;

class VTKCLOUDRENDERING_EXPORT vtkCloudPicture : public vtkImageAlgorithm
{
public:
  static vtkCloudPicture* New();
  vtkTypeMacro(vtkCloudPicture, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// What draws grids. Default a new one.
  void SetVolume(vtkCloudCellVolume* volume);
  vtkCloudCellVolume* GetVolume() const;
  ///@}
  ///@{
  /// What draws surfaces. Default a new one.
  void SetSurface(vtkCloudSurface* surface);
  vtkCloudSurface* GetSurface() const;
  ///@}
  ///@{
  /// What draws sparse voxels. Default a new one.
  void SetVoxels(vtkCloudVoxelVolume* voxels);
  vtkCloudVoxelVolume* GetVoxels() const;
  ///@}
  ///@{
  /// A body without input, such as vtkCloudGlobe or vtkCloudPlane. Default none.
  void SetGround(vtkCloudBody* ground);
  vtkCloudBody* GetGround() const;
  ///@}
  ///@{
  /// Without a Ground, draw a vtkCloudGlobe under clouds whose Geometry is Globe. Default on.
  vtkSetMacro(AutomaticGround, bool);
  vtkGetMacro(AutomaticGround, bool);
  vtkBooleanMacro(AutomaticGround, bool);
  ///@}
  ///@{
  /// What is behind everything. Default none: black.
  void SetBackdrop(vtkCloudBackdrop* backdrop);
  vtkCloudBackdrop* GetBackdrop() const;
  ///@}

  ///@{
  /// Width and height, pixels, 1 to 32768. Default 640 x 480.
  vtkSetVector2Macro(Size, int);
  vtkGetVector2Macro(Size, int);
  ///@}
  ///@{
  /// Samples x Samples rays a pixel, 1 to 8. Default 1.
  vtkSetClampMacro(Samples, int, 1, 8);
  vtkGetMacro(Samples, int);
  ///@}

  ///@{
  /// Move the camera along its line of sight, which then goes through the middle of the inputs, until they fill the picture: a
  /// sphere about their middle as wide as their longest side, and a tenth. Default on.
  vtkSetMacro(FitToInputs, bool);
  vtkGetMacro(FitToInputs, bool);
  vtkBooleanMacro(FitToInputs, bool);
  ///@}
  ///@{
  /// Where the camera is, scene units. Default (1, -1, 1).
  vtkSetVector3Macro(Position, double);
  vtkGetVector3Macro(Position, double);
  ///@}
  ///@{
  /// What it looks at, scene units. Default (0, 0, 0).
  vtkSetVector3Macro(FocalPoint, double);
  vtkGetVector3Macro(FocalPoint, double);
  ///@}
  ///@{
  /// What is up in the picture. Default (0, 0, 1).
  vtkSetVector3Macro(ViewUp, double);
  vtkGetVector3Macro(ViewUp, double);
  ///@}
  ///@{
  /// From the lower to the upper edge, degrees, above 0 and below 180. Default 30.
  vtkSetClampMacro(ViewAngle, double, 1e-8, 179.9);
  vtkGetMacro(ViewAngle, double);
  ///@}
  ///@{
  /// Parallel rays in place of a perspective, and half the picture's height then, scene units. Default off, 1.
  vtkSetMacro(ParallelProjection, bool);
  vtkGetMacro(ParallelProjection, bool);
  vtkBooleanMacro(ParallelProjection, bool);
  vtkSetMacro(ParallelScale, double);
  vtkGetMacro(ParallelScale, double);
  ///@}

  ///@{
  /// Processes that draw the picture together, each having a piece of the inputs. Default the global controller of VTK.
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController() const;
  ///@}

  vtkMTimeType GetMTime() override;

protected:
  vtkCloudPicture();
  ~vtkCloudPicture() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkCloudPicture(const vtkCloudPicture&) = delete;
  void operator=(const vtkCloudPicture&) = delete;

  bool IsOfSeveralRanks() const;
  bool CanDraw(const std::array<int, 2>& own, const std::array<int, 2>& kinds);
  bool AgreeOnKinds(vtkInformationVector** inputs, std::array<int, 2>& kinds);
  bool AddInputs(vtkCloudscape* scape, vtkInformationVector** inputs, double bounds[6]);
  void GatherBounds(double bounds[6]) const;
  vtkCloudBody* ChooseGround(vtkInformationVector** inputs);
  void SetUpCamera(vtkCamera* camera, const double bounds[6]) const;
  void Forward(vtkObject* scape, unsigned long, void*);

  vtkSmartPointer<vtkCloudCellVolume> Volume;
  vtkSmartPointer<vtkCloudSurface> Surface;
  vtkSmartPointer<vtkCloudVoxelVolume> Voxels;
  vtkSmartPointer<vtkCloudBody> Ground;
  vtkSmartPointer<vtkCloudGlobe> Globe; ///< of AutomaticGround
  vtkSmartPointer<vtkCloudBackdrop> Backdrop;
  vtkSmartPointer<vtkMultiProcessController> Controller;
  int Size[2] = { 640, 480 };
  int Samples = 1;
  bool AutomaticGround = true;
  bool FitToInputs = true;
  double Position[3] = { 1, -1, 1 };
  double FocalPoint[3] = { 0, 0, 0 };
  double ViewUp[3] = { 0, 0, 1 };
  double ViewAngle = 30;
  bool ParallelProjection = false;
  double ParallelScale = 1;
};
#endif
