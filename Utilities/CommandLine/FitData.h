// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file FitData.h
 * @brief What `nephoscope fit` takes from scenes and data files: optical depths that really occur, and densities.
 */
#ifndef FitData_h
#define FitData_h

#include "Scene.h"

#include <DensityGrid.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace nephoscope::program
{
class Progress;

/// West to east, south to north, bottom to top: x0, x1, y0, y1, z0, z1, m.
using Box = std::array<double, 6>;

/**
 * The clouds' optical depth along each of the camera's rays that meets cloud, up to what is opaque: of volumes and height fields, green.
 * Surfaces and haze are not counted. The picture has at most 256 pixels a side, a ray each.
 * @throw Failure if the scene has no such clouds or no ray meets them
 */
std::vector<double> depthsOf(Scene scene, Progress& progress);

/**
 * Extinction over height of a data file's column.
 *
 * Of condensate if the file has it (droplets of 10 um, crystals of 30 um), else 0.2 per km times the cloud fraction. Levels where
 * the file has no value are left out.
 * @param place longitude and latitude, degrees; the nearest column is taken, and said on standard error
 * @throw Failure if there is none within three grid steps
 */
DensityGrid columnOf(Data data, const std::array<double, 2>& place);

/// Extinction of a VTK image (.vti): its points in the box, or all. @throw Failure
DensityGrid volumeOf(const std::string& path, const std::optional<Box>& box);

/// Extinction of the first height-field clouds of a scene at 49 x 49 x 33 points of a box. @throw Failure
DensityGrid volumeOf(const Scene& scene, const Box& box, Progress& progress);
}
#endif
