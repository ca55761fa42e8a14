// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file StructuredOutput.h
 * @brief From the file's boxes to the points of the output: the seam, the poles, the arrays.
 */
#ifndef StructuredOutput_h
#define StructuredOutput_h

#include "CloudFields.h"
#include "ColumnBlocks.h"
#include "SceneLayout.h"

class vtkStructuredGrid;

namespace nephoscope
{
const char* geometryName(SceneGeometry geometry);

class OutputGrid
{
public:
  OutputGrid() = default;
  OutputGrid(const GridAxes& axes, const HorizontalGrid& grid, SceneGeometry geometry);

  /// Points along an axis.
  int size(int axis) const;
  /// Whether the grid goes round and its last column is the first again, in the same place.
  bool isRing() const { return this->Axes.periodic && this->Geometry == SceneGeometry::Globe; }
  /// What must be read for an extent: a pole needs its whole row. On a ring columns go on beyond both ends.
  Region region(const int extent[6], std::size_t time) const;
  /// @throws ReadError if the whole field is missing
  void fill(vtkStructuredGrid* output, const int extent[6], const Region& region,
    const CloudFields& fields, const SceneLayout& layout, const CloudFile& file) const;
  /// Field data and units.
  void attach(vtkStructuredGrid* output, const HorizontalGrid& grid, const SceneLayout& layout,
    const CloudFile& file) const;

  /// Points and cells outside of a block are those of other pieces.
  static void markGhosts(
    vtkStructuredGrid* output, const PointExtent& extent, const PointExtent& block);

private:
  /// Where a row of the output comes from: a row of the region, or the mean of one at a pole.
  struct Row
  {
    std::size_t at = 0; ///< in the region
    int pole = 0;       ///< -1 south, 1 north, 0 none
  };
  bool hasPole(const int extent[6]) const;
  Row row(int j, const Region& region) const;
  int turn(int i) const
  {
    const int columns = static_cast<int>(this->Axes.nx);
    return i >= 0 ? i / columns : -1 - (-1 - i) / columns;
  }
  std::size_t column(int i) const
  {
    return static_cast<std::size_t>(i - this->turn(i) * static_cast<int>(this->Axes.nx));
  }
  /// A field on the points of the extent; at a pole the mean of what is not missing.
  std::vector<float> place(
    const std::vector<float>& values, const int extent[6], const Region& region) const;
  void addPoints(vtkStructuredGrid* output, const std::vector<float>& height, const int extent[6],
    const SceneLayout& layout) const;
  void addWind(vtkStructuredGrid* output, const CloudFields& fields, const int extent[6],
    const Region& region, const SceneLayout& layout) const;
  void hide(vtkStructuredGrid* output, const std::vector<float>& master,
    const std::vector<char>& groundless, const int extent[6], const Region& region) const;

  GridAxes Axes;
  SceneGeometry Geometry = SceneGeometry::Map;
  bool South = false;
  bool North = false;
};
}
#endif
