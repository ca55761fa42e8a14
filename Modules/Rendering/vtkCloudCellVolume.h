// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkCloudCellVolume
 * @brief Draws the cells of a structured grid as glowing fog, in the cells' own shape, without resampling.
 *
 * The counterpart of the volume rendering of Max 1994. Each hexahedral cell is five tetrahedra, the same as the contour's,
 * and the density is linear in each: along each ray-tetrahedron segment it is linear too and the optical depth has a
 * closed form. Segments go to the deep pixels, which sort each ray's own, so the order is right for any camera, in the data
 * too, and for any mesh, folded levels included; or, to see what that is worth, they are composited in one order of
 * the tetrahedra for the whole picture (see Order).
 *  1. When the input changes: extinction of each point, cells that are not empty, columns of them.
 *  2. For a camera: the pixels that each column may touch, and for each square of the image the list of its columns.
 *  3. For a tile: its columns' tetrahedra, each met with the rays of the pixels in its bounding box.
 *
 * Input    port 0: vtkStructuredGrid, vtkRectilinearGrid or vtkImageData with point arrays (1 component)
 *            CloudFraction            for the rule CloudFraction, or what SetInputArrayToProcess(0, ...) names
 *            LiquidWater, IceWater    kg/kg, for the rule Condensate: one of them or both
 *            Pressure, Temperature    Pa, K, for the air's density; else
 *            Height                   m, for that of the US Standard Atmosphere 1976; else it is that of sea level
 *            SourceColor (or what SetInputArrayToProcess(1, ...) names), 3 components, optional: what Color is multiplied by
 *          field data HeightScale: scene units per metre of height, 1 if absent.
 * Output   none; segments, one for each pair of pixel and tetrahedron that meet.
 * Parameters: see the setters.
 * Method   CloudFraction: sigma = FullCoverExtinction * fraction, a visual rule.
 *          Condensate: sigma = sum over liquid and ice of Q 3/(4 r) rho_air q / rho_substance, 1/m (nephoscope/Optics.h).
 *          A scene unit has sigma ExtinctionScale / HeightScale: as heights are exaggerated, so is the extinction reduced, and
 *          optical depths along the vertical are the atmosphere's own; slanting rays see what an atmosphere of the
 *          exaggerated shape would show.
 *          Density emitter, Max 1994 eq. 5-7: L = kappa (1 - exp(-tau)), tau = length (s0 + s1) / 2, kappa the Color.
 *          With a SourceColor kappa is linear in a tetrahedron too, and its light is integrated (nephoscope/LinearEmission.h).
 *          Order (only where kappa varies, or other bodies shine through the cloud, does an order make a difference to the
 *          picture: the light of one kappa is that of the sum of optical depths, however they come):
 *          PixelDepth   each ray's segments by their distance.
 *          Visibility   tetrahedra that share a face by the side of it that the eye is on (Williams 1992, MPVO), those with
 *                       a gap between them by the rays that cross it (as Cook et al. 2004): empty cells, the seam, the inside of a
 *                       globe under its levels and the air over a valley are gaps. Guaranteed: if there is no cycle,
 *                       every ray of the picture meets the tetrahedra in this order, whatever the shape of levels. Cycles
 *                       are counted; in one, the tetrahedron with the nearest centroid is drawn first and so on, each once.
 *                       Tetrahedra that overlap (folded levels) are drawn whole, one after the other, and may count as cycles.
 *          Centroid     tetrahedra by the depth of their centroids, as vtkCellCenterDepthSort does. Nothing is guaranteed.
 * Errors   other data, no cells, no array (names those there are), an array of another length, a HeightScale that is not
 *          positive, a cylindrical camera: vtkErrorMacro, Prepare returns false and vtkCloudscape draws nothing.
 * Cost     per frame O(columns + cells in view + segments), in parallel; with no other translucent body and no Depth
 *          (vtkCloudscape::ComputeDepthOff) segments of one colour are summed and not kept, at half the time. Memory 28 bytes a
 *          point, 1 a cell and 36 a column.
 *          The same bits for any number of threads. The orders of cells add some 100 bytes (Visibility) or 16
 *          (Centroid) for each tetrahedron in view while one thread works them out, 4 afterwards, and 2 a cell; they keep
 *          a segment of 52 bytes instead of a piece of 24.
 * Limits   Negative extinction is read as 0, infinite as 1e9/m. The cells at a NaN or a hidden point are empty, so are
 *          blanked and duplicate cells. Cells without volume add nothing; inverted ones add the length that they take.
 *          Rays are displaced by a billionth of a pixel. Transmittances are within 1e-5 of exact.
 *          Cycles: vtkWarningMacro once for each input that has one, GetNumberOfCycles. More than 4,294,967,295
 *          tetrahedra in view have no order of cells: an error.
 * @sa vtkCloudscape, vtkCloudContour, nephoscope::ColumnRays, nephoscope::visibilityOrder, TestCloudCellVolume.cxx,
 *     TestCellOrders.cxx
 */
#ifndef vtkCloudCellVolume_h
#define vtkCloudCellVolume_h

#include "vtkCloudBody.h"
#include "vtkCloudRenderingModule.h" // for export macro

#include <memory> // for the internals
#include <vector> // for CountPoints

class vtkDataArray;
class vtkDataSet;

class VTKCLOUDRENDERING_EXPORT vtkCloudCellVolume : public vtkCloudBody
{
public:
  static vtkCloudCellVolume* New();
  vtkTypeMacro(vtkCloudCellVolume, vtkCloudBody);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// From what the extinction is worked out.
  enum Rule
  {
    CloudFraction = 0,
    Condensate = 1
  };

  ///@{
  /// Default CloudFraction.
  vtkSetClampMacro(ExtinctionRule, int, CloudFraction, Condensate);
  vtkGetMacro(ExtinctionRule, int);
  void SetExtinctionRuleToCloudFraction() { this->SetExtinctionRule(CloudFraction); }
  void SetExtinctionRuleToCondensate() { this->SetExtinctionRule(Condensate); }
  ///@}

  ///@{
  /// Extinction where the cloud fraction is 1, 1/m of height. Default 2e-4: five kilometres of it have optical
  /// depth 1.
  vtkSetClampMacro(FullCoverExtinction, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(FullCoverExtinction, double);
  ///@}

  ///@{
  /// Multiplies the extinction of either rule. Default 1.
  vtkSetClampMacro(ExtinctionScale, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(ExtinctionScale, double);
  ///@}

  ///@{
  /// Points with less extinction than this, per scene unit, count as clear, and cells of such points are not drawn. No ray of length
  /// s changes by more than an optical depth of s times this. Default 0: all is drawn.
  vtkSetClampMacro(LeastExtinction, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(LeastExtinction, double);
  ///@}

  ///@{
  /// Q, the extinction cross-section over the geometric one. Default 2; 1 is as printed in Max 1994.
  vtkSetClampMacro(ExtinctionEfficiency, double, 0, VTK_DOUBLE_MAX);
  vtkGetMacro(ExtinctionEfficiency, double);
  ///@}

  ///@{
  /// Effective radius of droplets, m. Default 10e-6.
  vtkSetClampMacro(LiquidRadius, double, 1e-9, VTK_DOUBLE_MAX);
  vtkGetMacro(LiquidRadius, double);
  ///@}

  ///@{
  /// Effective radius of ice crystals, m. Default 30e-6.
  vtkSetClampMacro(IceRadius, double, 1e-9, VTK_DOUBLE_MAX);
  vtkGetMacro(IceRadius, double);
  ///@}

  ///@{
  /// kappa: the radiance of cloud so thick that nothing shows through, linear RGB. Default 1, 1, 1.
  vtkSetVector3Macro(Color, double);
  vtkGetVector3Macro(Color, double);
  ///@}

  /// In what order segments are composited.
  enum OrderOfSegments
  {
    PixelDepth = 0,
    Visibility = 1,
    Centroid = 2
  };

  ///@{
  /// Default PixelDepth, which is exact. The others are for comparison: slower, and right at best.
  vtkSetClampMacro(Order, int, PixelDepth, Centroid);
  vtkGetMacro(Order, int);
  void SetOrderToPixelDepth() { this->SetOrder(PixelDepth); }
  void SetOrderToVisibility() { this->SetOrder(Visibility); }
  void SetOrderToCentroid() { this->SetOrder(Centroid); }
  const char* GetOrderAsString() const;
  ///@}

  /// Groups of tetrahedra that no order suits, each of which is before each other on some path of pairs: of the last
  /// picture, 0 in the orders that do not look for them.
  vtkIdType GetNumberOfCycles() const;

#ifndef __VTK_WRAP__
  /// How many of the input's points have an extinction of at least each of `least`, per scene unit, which ascend: no more than are above 0.
  /// Empty if the input cannot be drawn. Brings the input up to date.
  std::vector<vtkIdType> CountPoints(const std::vector<double>& least);

  bool Prepare(const nephoscope::Camera& camera) override;
  void Emit(const nephoscope::Camera& camera, nephoscope::DeepTile& tile) const override;
#endif

  bool DrawsPieces() const override
  {
    return true;
  }

  /// Cells that are not empty, of the columns that may touch the picture.
  vtkIdType GetNumberOfDrawnCells() const override;

protected:
  vtkCloudCellVolume();
  ~vtkCloudCellVolume() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;

private:
  vtkCloudCellVolume(const vtkCloudCellVolume&) = delete;
  void operator=(const vtkCloudCellVolume&) = delete;

  struct ExtinctionAtPoint;
  bool ReadGrid();
  bool ReadColors(vtkDataSet* grid);
  bool PutInOrder(const nephoscope::Camera& camera);
  bool SetUpExtinction(vtkDataSet* grid, ExtinctionAtPoint& extinction);
  vtkDataArray* FindArray(vtkDataSet* grid, vtkDataArray* array, const char* name, bool required);

  int ExtinctionRule = CloudFraction;
  double FullCoverExtinction = 2e-4;
  double ExtinctionScale = 1;
  double LeastExtinction = 0;
  double ExtinctionEfficiency = 2;
  double LiquidRadius = 10e-6;
  double IceRadius = 30e-6;
  double Color[3] = { 1, 1, 1 };
  int Order = PixelDepth;

  struct Internals;
  std::unique_ptr<Internals> Data;
};
#endif
