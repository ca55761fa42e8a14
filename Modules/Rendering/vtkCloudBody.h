// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudBody
 * @brief What stands in a vtkCloudscape: emits segments of viewing rays into the deep pixels of a tile.
 *
 * A body is the last algorithm of a pipeline, as a vtkMapper is: it has input ports and no output. A vtkCloudscape
 *  1. brings each body's inputs up to date,
 *  2. calls Prepare with the camera, once a frame, from one thread,
 *  3. calls Hide, then Emit for each tile, from several threads at once.
 * What is independent of the camera is kept between frames and rebuilt only when the input or the body has changed.
 *
 * @sa vtkCloudscape, nephoscope::DeepTile, nephoscope::Segment
 */
#ifndef vtkCloudBody_h
#define vtkCloudBody_h

#include "vtkAlgorithm.h"
#include "vtkCloudRenderingModule.h" // for export macro

namespace nephoscope
{
class Camera;
class DeepTile;
struct Ray;
}

class VTKCLOUDRENDERING_EXPORT vtkCloudBody : public vtkAlgorithm
{
public:
  vtkTypeMacro(vtkCloudBody, vtkAlgorithm);

  ///@{
  /// The data of port 0 as given, or of a pipeline by SetInputConnection.
  void SetInputData(vtkDataObject* data);
  ///@}
  ///@{
  /// Whether a vtkCloudscape draws it. Default on.
  vtkSetMacro(Visibility, bool);
  vtkGetMacro(Visibility, bool);
  vtkBooleanMacro(Visibility, bool);
  ///@}
  ///@{
  /// Whether an optional input counts; one that does not is not brought up to date either. Default: all do.
  void SetInputUse(int port, bool use);
  bool GetInputUse(int port) const;
  ///@}

#ifndef __VTK_WRAP__
  /// Get ready for a camera. The inputs are up to date. Returns false, after vtkErrorMacro, if it cannot be drawn.
  virtual bool Prepare(const nephoscope::Camera& camera) = 0;

  /// Add the segments that the rays of the tile's pixels meet. Called from several threads at once.
  virtual void Emit(const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const = 0;

  /// For those that HidesAhead: tell the tile beyond which distances nothing is seen, before any body emits. Called as Emit is.
  virtual void Hide(const nephoscope::Camera&, nephoscope::DeepTile&) const {}
#endif

  /// Whether all its segments are opaque; those bodies are emitted first, so that the others can skip what is hidden.
  virtual bool IsOpaque() const
  {
    return false;
  }

  /// Whether an opaque body knows at once where it is, but works its light out long: it is told first what it hides, and emitted after
  /// other opaque bodies, so that no light is worked out that they hide.
  virtual bool HidesAhead() const
  {
    return false;
  }

  /// Whether each of several processes draws its own piece of the input. Of other bodies all processes have the whole, and it is
  /// drawn once.
  virtual bool DrawsPieces() const
  {
    return false;
  }

  /// Cells (of the input or of the body's own shape) that the last Prepare found worth drawing.
  virtual vtkIdType GetNumberOfDrawnCells() const
  {
    return 0;
  }

protected:
  vtkCloudBody();
  ~vtkCloudBody() override = default;

  /// The newer of what the body and its inputs' data were last changed.
  vtkMTimeType GetInputsMTime();

#ifndef __VTK_WRAP__
  /// For bodies that are drawn by projecting corners: whether the picture is flat, which a cylindrical one is not; vtkErrorMacro
  /// if it is not.
  bool IsFlat(const nephoscope::Camera& camera);
#endif

  /// The data of an optional input, if it counts.
  vtkDataObject* GetUsedInput(int port);

  bool Visibility = true;
  unsigned UnusedInputs = 0; ///< a bit for each port

private:
  vtkCloudBody(const vtkCloudBody&) = delete;
  void operator=(const vtkCloudBody&) = delete;
};
#endif
