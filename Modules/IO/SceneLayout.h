// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file SceneLayout.h
 * @brief Lays columns of a grid into the scene: where a height comes to lie and which way east, north and up point.
 */
#ifndef SceneLayout_h
#define SceneLayout_h

#include "HorizontalGrid.h"

#include <array>
#include <cstddef>
#include <memory>
#include <string>

namespace nephoscope
{
enum class SceneGeometry
{
  Map,
  Globe,
  Local
};

struct SceneOptions
{
  SceneGeometry geometry = SceneGeometry::Map;
  bool degrees = false; ///< Map in degrees
  double exaggeration = 1;
};

/// One column in the scene: a point at height z is base + z rise; a wind is u along + v across + w up.
struct SceneColumn
{
  std::array<double, 3> base{ 0, 0, 0 };
  std::array<double, 3> rise{ 0, 0, 1 };   ///< scene units per metre
  std::array<double, 3> along{ 1, 0, 0 };  ///< unit vector of the wind's first component
  std::array<double, 3> across{ 0, 1, 0 }; ///< of its second
  std::array<double, 3> up{ 0, 0, 1 };
};

class SceneLayout
{
public:
  /// @throws ReadError if the grid cannot lie so
  SceneLayout(
    const HorizontalGrid& grid, const GridAxes& axes, const SceneOptions& options, bool gridWind);

  /// @param turn 1 for the column that closes the seam, else 0
  SceneColumn column(std::size_t i, std::size_t j, int turn) const;
  /// The column at a pole, sign +1 north or -1 south, on the meridian of column i.
  SceneColumn pole(std::size_t i, int sign, int turn) const;

  double heightScale() const; ///< scene units per metre
  const std::string& projection() const { return this->Definition; }

private:
  void globe(double longitude, double latitude, SceneColumn& column) const;
  void map(double longitude, double latitude, SceneColumn& column) const;
  void local(std::size_t at, SceneColumn& column) const;
  void turnGridWind(std::size_t i, std::size_t j, SceneColumn& column) const;

  const HorizontalGrid& Grid;
  GridAxes Axes;
  SceneOptions Options;
  bool GridWind;
  std::unique_ptr<Projection> Own; ///< about the middle of a grid that has no projection
  std::string Definition;
};
}
#endif
