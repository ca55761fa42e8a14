// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file LandMask.h
 * @brief Where on the Earth there is land: VTK's continents as a raster of longitude and latitude.
 */
#ifndef LandMask_h
#define LandMask_h

#include <vector>

namespace nephoscope
{
/**
 * @brief The share of land in cells of 360/2048 degrees.
 *
 * The outlines are those of vtkEarthSource: 17 coasts of some 10 000 points, 10 to 30 km apart, without lakes and small
 * islands. Each is filled row by row (four lines a row, the share of the cell exact along each line).
 */
class LandMask
{
public:
  static constexpr int Columns = 2048;
  static constexpr int Rows = 1024;
  static constexpr double Cell = 360.0 / Columns; ///< degrees

  /// The one mask; made when it is first asked for (some 50 ms). Thread-safe.
  static const LandMask& earth();

  /**
   * Share of land, 0 to 1, about a place.
   * @param longitude, latitude degrees, any finite longitude; the poles are clamped
   * @param footprint width of a pixel, degrees: the coast is drawn that wide even where it is finer than the raster
   */
  double landAt(double longitude, double latitude, double footprint) const;

private:
  LandMask();
  /// A closed outline; the longitudes go on beyond 180 where it does. Fills it.
  struct Outline
  {
    std::vector<double> longitude;
    std::vector<double> latitude;
  };
  void fill(const Outline& outline);
  void fillSpan(int row, double from, double to, double weight);
  float at(int column, int row) const { return this->Land[row * Columns + column]; }

  std::vector<float> Land;
};
}
#endif
