// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudContour
 * @brief Contour surfaces of a gridded field by tetrahedra: watertight, with merged points and normals.
 *
 * Each hexahedral cell is taken as five tetrahedra of alternating parity, so that neighbours agree at their faces, and the
 * field as linear in each (Max 1994, "2-D Cloud Surfaces"). The tetrahedra are never made. Passes:
 *  1. range      the least and greatest of each 64 values along i; kept until the field's array changes
 *  2. classify   which points are inside, as bits, for all contour values; only of words that are crossed is the field read
 *  3. count      crossed edges and triangles of each row of the grid
 *  4. sum        prefix sums: every vertex and triangle has its place
 *  5. generate   gradients at the ends of crossed edges; vertices with normals and interpolated arrays; triangles
 * Tetrahedral unstructured grids are contoured likewise, their edges merged by sorting.
 *
 * Input    port 0: vtkStructuredGrid, vtkRectilinearGrid, vtkImageData, or vtkUnstructuredGrid of tetrahedra.
 *          The field: a point array with one component, CloudFraction unless SetInputArrayToProcess names another
 *          (an empty name, as ParaView has it before it knows the input, is no other).
 * Output   vtkPolyData, triangles. Points are double where a structured or unstructured grid's are, else float.
 *          Point arrays: all of the input's, interpolated along the edges (integers become float); the field itself holds
 *          the contour value; Normals, 3 float, unit length. Field data pass through.
 * Parameters: see the setters.
 * Method   Inside is value >= contour value. On an edge from a to b the vertex lies at t = (value - f_a) / (f_b - f_a).
 *          Normals are minus the gradient, interpolated along the edge: they point out of the cloud, to lower values.
 *          The gradient is that of central differences on the curvilinear grid (nephoscope::curvilinearGradient), so
 *          it is right to second order on a smooth grid; for tetrahedra, the volume-weighted mean. Where it is more than 30 degrees on the wrong side of its
 *          edge (at kinks and collapsed cells), its part along the edge is put right.
 *          Triangles wind counter-clockwise seen from outside.
 *          Watertight: each edge of the surface is shared by exactly two triangles, except at the grid's boundary and at
 *          cells that are left out; the surface is open there, at the ground for one. Where a point's value equals the
 *          contour value, vertices coincide and some triangles have no area: they are kept, for without them the
 *          surface would not be connected.
 *          A globe's seam, where the first and last points of every row along i coincide in place (to 1e-4 of a step) and value,
 *          is closed: the surface is connected across it. This needs an even number of cells round the globe. With an
 *          odd number the face diagonals differ there; the surface is then open at the seam, and a warning says so.
 * Pieces   one level of ghosts is asked of the input, for the gradients; with it the triangles of all pieces are those of the whole,
 *          to the bit, their normals included. Vertices on the border of two pieces are in both.
 * Errors   no such array, not a point array, not one component, a contour value that is not finite, a cell that is not
 *          a tetrahedron: vtkErrorMacro, an empty output. Grids with one layer have no cells: an empty output, no error.
 * Cost     O(points / 64 + crossed cells), the first time for a field O(points). The same bits for any number of threads.
 * Memory   Besides the output, for structured grids: a bit a point and 56 bytes a row for each value, a bit a point for the ranges
 *          (two for double), 2 bits a point where some cells are left out, and while normals are made at most 48 bytes for each
 *          point of nine rows a thread. Measured on 320 x 160 x 19 points of a curvilinear grid in float: 2.6 % of the input for
 *          one value, 8.8 % for four. For unstructured grids 32 bytes a tetrahedron.
 *          Kept between updates: the ranges, and the output's arrays, into which the next output is written if nobody
 *          else holds them by then and they are large enough, at most twice. With ReleaseDataFlag on, no arrays are kept.
 *          As everywhere in VTK, who changes the field's values in place calls Modified() on its array.
 * Limits   Left out are cells with a corner that is not finite, with a blanked point, blanked cells and duplicate
 *          (ghost) cells. On a grid that is partly inverted, winding is right where most cells have it.
 * @sa nephoscope::ContourLevel, TetrahedralContour.h, vtkCloudSmooth, vtkCloudTexture, TestCloudContour.cxx, TestCloudContourPeer.cxx
 */
#ifndef vtkCloudContour_h
#define vtkCloudContour_h

#include "vtkCloudFiltersModule.h" // for export macro
#include "vtkPolyDataAlgorithm.h"

#include <memory> // for members
#include <vector> // for members

class vtkDataArray;
class vtkDataSet;

class VTKCLOUDFILTERS_EXPORT vtkCloudContour : public vtkPolyDataAlgorithm
{
public:
  static vtkCloudContour* New();
  vtkTypeMacro(vtkCloudContour, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The contour values, in the field's unit. Default: one, 0.15, the 15 % of cloudiness of Max's figures.
  void SetValue(int i, double value);
  double GetValue(int i) const;
  void SetNumberOfContours(int number);
  int GetNumberOfContours() const;
  void GenerateValues(int number, double first, double last);
  ///@}

  ///@{
  /// Whether to give normals. Default on.
  vtkSetMacro(ComputeNormals, bool);
  vtkGetMacro(ComputeNormals, bool);
  vtkBooleanMacro(ComputeNormals, bool);
  ///@}

protected:
  vtkCloudContour();
  ~vtkCloudContour() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkCloudContour(const vtkCloudContour&) = delete;
  void operator=(const vtkCloudContour&) = delete;

  vtkDataArray* FindField(vtkDataSet* input, vtkInformationVector** inputVector);
  bool CheckValues();

  class vtkInternals;

  std::vector<double> Values;
  bool ComputeNormals = true;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
