// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudscape
 * @brief Draws bodies before a backdrop: the picture as a vtkImageData of float arrays.
 *
 * The picture is cut into square tiles. For each tile, from several threads at once,
 *  1. the bodies emit segments into the tile's deep pixels, the opaque bodies first;
 *  2. each deep pixel is sorted and composited front to back, overlaps split and mixed (nephoscope::composite);
 *  3. the backdrop is added where light gets through.
 * So translucent surfaces, volumes and opaque things interpenetrate correctly. A part that a scene does not name costs
 * nothing. No display and no OpenGL is needed.
 *
 * With a controller of several processes the picture is theirs together: of the bodies that draw pieces (vtkCloudBody::DrawsPieces;
 * cells and surfaces) each process updates its own piece, as given by UpdatePiece, and draws that; the others are the same in all
 * processes. In each deep pixel what the pieces amount to, or where they interlock their segments, comes together in one process and is
 * composited as one process's is (RankedTiles.h): no order of pieces is needed, and they may interlock. Update is then to be called by all, with the same scene; the
 * picture is the output of process 0, the others' is empty. A piece may be empty. Data that are given to a body directly, without
 * a pipeline, are the process's own piece.
 *
 * Input    none; bodies have their own pipelines, which are brought up to date first.
 * Output   vtkImageData of Size, spacing 1, point arrays (float):
 *            Radiance       3, linear RGB
 *            Transmittance  3, what the bodies let through of the backdrop
 *            Depth          1, scene units along the ray to where the mean transmittance falls to 1/2, +infinity if
 *                           it does not; with several rays a pixel, the median of theirs
 * Parameters: see the setters.
 * Method   L = L_body + T_body L_backdrop, the equation of nephoscope::Segment.
 * Errors   of several processes the same in all. No camera, a size that is not positive or, times Samples, over 32768, a body that cannot be prepared,
 *          processes with other settings or another number of visible bodies: vtkErrorMacro, an empty output.
 * Cost     that of the bodies plus O(n log n) for the n segments of each pixel. Memory is that of the picture and of
 *          one tile's segments a thread. The same bits for any number of threads. Reports progress and can be aborted.
 * @sa vtkCloudBody, vtkCloudBackdrop, nephoscope::DeepTile
 */
#ifndef vtkCloudscape_h
#define vtkCloudscape_h

#include "vtkCloudRenderingModule.h" // for export macro
#include "vtkImageAlgorithm.h"
#include "vtkSmartPointer.h" // for members

#include <vector> // for members

class vtkCamera;
class vtkCloudBackdrop;
class vtkCloudBody;
class vtkImageData;
class vtkMultiProcessController;
struct TileScene;

#ifndef __VTK_WRAP__
namespace nephoscope
{
class Camera;
}
#endif

class VTKCLOUDRENDERING_EXPORT vtkCloudscape : public vtkImageAlgorithm
{
public:
  static vtkCloudscape* New();
  vtkTypeMacro(vtkCloudscape, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Where the picture is taken from: position, focal point, view-up, view angle or parallel scale. Clipping planes do not
  /// matter. Required.
  void SetCamera(vtkCamera* camera);
  vtkCamera* GetCamera() const;
  ///@}

  ///@{
  /// Draw on a cylinder about the camera's view-up through its position, this many degrees wide, above 0 to 360, the focal
  /// point in the picture's middle; pixels are square, so the height follows from Size. 0: the camera's own projection.
  /// vtkCloudSurface and vtkCloudCellVolume refuse it. Default 0.
  vtkSetClampMacro(CylinderAngle, double, 0, 360);
  vtkGetMacro(CylinderAngle, double);
  ///@}

  ///@{
  /// Width and height, pixels, 1 to 32768. Default 1024 x 768.
  vtkSetVector2Macro(Size, int);
  vtkGetVector2Macro(Size, int);
  ///@}

  ///@{
  /// Edge of a tile, pixels. Affects memory and speed, never the picture. Default 32.
  vtkSetClampMacro(TileSize, int, 1, 1024);
  vtkGetMacro(TileSize, int);
  ///@}

  ///@{
  /// Samples x Samples rays a pixel, 1 to 8, whose light is averaged: smooth outlines for Samples^2 times the time.
  /// Default 1.
  vtkSetClampMacro(Samples, int, 1, 8);
  vtkGetMacro(Samples, int);
  ///@}

  ///@{
  /// Whether to find Depth; without, it is infinity everywhere. Default on. Off, a cell volume that is the only translucent body
  /// is drawn twice as fast: its parts need no order.
  vtkSetMacro(ComputeDepth, bool);
  vtkGetMacro(ComputeDepth, bool);
  vtkBooleanMacro(ComputeDepth, bool);
  ///@}

  ///@{
  /// What is behind everything. Default none: black.
  void SetBackdrop(vtkCloudBackdrop* backdrop);
  vtkCloudBackdrop* GetBackdrop() const;
  ///@}

  ///@{
  /// The bodies of the scene; adding one twice draws it twice.
  void AddBody(vtkCloudBody* body);
  void RemoveAllBodies();
  int GetNumberOfBodies() const;
  vtkCloudBody* GetBody(int index) const; ///< in the order they were added; null if there is none
  ///@}

  ///@{
  /// Processes that draw the picture together. Default none: this one alone draws all of it.
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController() const;
  ///@}

  ///@{
  /// Figures of the last run: segments composited; bytes that processes sent one another to put them together; seconds that the bodies'
  /// pipelines, their preparation and the tiles took.
  vtkGetMacro(NumberOfSegments, vtkIdType);
  vtkGetMacro(BytesSent, vtkIdType);
  vtkGetMacro(PipelineSeconds, double);
  vtkGetMacro(PrepareSeconds, double);
  vtkGetMacro(TileSeconds, double);
  ///@}

#ifndef __VTK_WRAP__
  /// The rays of the picture: Samples x Samples a pixel. @pre there is a camera
  nephoscope::Camera GetRays() const;
#endif

  vtkMTimeType GetMTime() override;

protected:
  vtkCloudscape();
  ~vtkCloudscape() override;

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override;

private:
  vtkCloudscape(const vtkCloudscape&) = delete;
  void operator=(const vtkCloudscape&) = delete;

  bool Validate();
  bool AgreeOn(bool valid);
  bool IsOfSeveralRanks() const;
  void UpdateBodies();
  bool UpdateInputs(vtkCloudBody* body);
  bool HasPieceOf(vtkCloudBody* body) const;
  bool PrepareBodies(TileScene& scene, bool& sums);
  bool DrawAll(const TileScene& scene, bool sums, vtkImageData* image);

  vtkSmartPointer<vtkCamera> Camera;
  vtkSmartPointer<vtkCloudBackdrop> Backdrop;
  vtkSmartPointer<vtkMultiProcessController> Controller;
  std::vector<vtkSmartPointer<vtkCloudBody>> Bodies;
  double CylinderAngle = 0;
  int Size[2] = { 1024, 768 };
  int TileSize = 32;
  int Samples = 1;
  bool ComputeDepth = true;
  vtkIdType NumberOfSegments = 0;
  vtkIdType BytesSent = 0;
  double PipelineSeconds = 0;
  double PrepareSeconds = 0;
  double TileSeconds = 0;
};
#endif
