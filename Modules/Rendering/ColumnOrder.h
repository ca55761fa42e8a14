// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file ColumnOrder.h
 * @brief The tetrahedra of columns in one order for a whole picture, and their segments in that order.
 *
 *  1. Number the tetrahedra of the columns that may touch the picture.
 *  2. Relations across faces (ColumnTetrahedra), column by column, and across gaps (RayGaps), tile by tile: both in parallel,
 *     in lists whose number does not depend on the threads'.
 *  3. One order of all (VisibilityOrder); or that of the centroids' depths alone.
 *  4. For a tile: its cells' tetrahedra sorted by their rank.
 *
 * @sa vtkCloudCellVolume
 */
#ifndef ColumnOrder_h
#define ColumnOrder_h

#include "CellColumns.h"
#include "ColumnTetrahedra.h"
#include "ScreenBins.h"
#include "VisibilityOrder.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

class ColumnOrder
{
public:
  enum class By
  {
    Visibility,
    Centroid
  };

  /// The columns, which have to stay, and those of them that have cells to draw; they were read anew.
  void Read(const nephoscope::CellColumns& columns, const std::vector<std::uint32_t>& drawn);

  /// Order for a camera, whose bins are those of the drawn columns. Returns false if there are too many to number.
  bool Build(By by, const ScreenBins& bins, const nephoscope::Camera& camera);

  std::size_t GetNumberOfCycles() const { return this->Cycles; }
  std::size_t GetNumberOfCellsInCycles() const { return this->CellsInCycles; }

  /// Add the segments of a tile's pixels. From several threads at once.
  void Emit(const ScreenBins& bins, const nephoscope::Camera& camera, const nephoscope::RGB& color,
    nephoscope::DeepTile& tile) const;

private:
  struct Ranked
  {
    std::uint32_t rank;
    std::uint32_t column;
    int k;
    int tetrahedron;
  };

  template <class Visit>
  void ForEachTetrahedron(std::uint32_t column, Visit&& visit) const;
  void RelateAcrossFaces(const std::vector<std::uint32_t>& columns,
    const nephoscope::Camera& camera, std::vector<nephoscope::CellRelations>& lists) const;
  void RelateAcrossGaps(const ScreenBins& bins, const nephoscope::Camera& camera,
    std::vector<nephoscope::CellRelations>& lists) const;
  std::vector<double> Depths(
    const std::vector<std::uint32_t>& columns, const nephoscope::Camera& camera) const;
  std::vector<Ranked> RankedInTile(const ScreenBins& bins, const nephoscope::Camera& camera,
    const nephoscope::TileRays& rays) const;

  const nephoscope::CellColumns* Columns = nullptr;
  const std::vector<std::uint32_t>* Drawn = nullptr;
  std::unique_ptr<nephoscope::ColumnTetrahedra> Tetrahedra;
  std::size_t Count = 0;
  std::vector<std::uint32_t> Rank; ///< of a tetrahedron's number
  std::size_t Cycles = 0;
  std::size_t CellsInCycles = 0;
};
#endif
