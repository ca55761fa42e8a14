// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file CloudArrays.h
 * @brief The names by which the modules meet: every array they exchange, its association, shape and unit.
 *
 * Nothing else in the project spells one of these names.
 */
#ifndef CloudArrays_h
#define CloudArrays_h

namespace nephoscope
{
namespace arrays
{
// Point arrays of a gridded cloud field, float unless said otherwise.
inline constexpr const char* CloudFraction = "CloudFraction"; ///< 1 component, 0..1
inline constexpr const char* LiquidWater = "LiquidWater";     ///< 1 component, kg/kg
inline constexpr const char* IceWater = "IceWater";           ///< 1 component, kg/kg
inline constexpr const char* Wind = "Wind";         ///< 3 components, m/s, along the scene's axes
inline constexpr const char* Pressure = "Pressure"; ///< 1 component, Pa
inline constexpr const char* Height =
  "Height"; ///< 1 component, m above sea level, never exaggerated
inline constexpr const char* Temperature = "Temperature";           ///< 1 component, K
inline constexpr const char* SpecificHumidity = "SpecificHumidity"; ///< 1 component, kg/kg
inline constexpr const char* PotentialTemperature =
  "PotentialTemperature"; ///< 1 component, K; only if it was asked for
inline constexpr const char* Extinction = "Extinction"; ///< 1 component, 1/m, >= 0
inline constexpr const char* SourceColor =
  "SourceColor"; ///< 3 components, linear RGB, >= 0: radiance of cloud so thick that nothing shows through, over its body's colour

// Point arrays of the transparency texture.
inline constexpr const char* TextureCoordinates =
  "TextureCoordinates"; ///< 3 components, m of the reference position
inline constexpr const char* OtherTextureCoordinates =
  "OtherTextureCoordinates"; ///< the same of a second texture that the first is cross-faded with
inline constexpr const char* TextureWeights =
  "TextureWeights"; ///< field data, double, the weights of the two; their sum is 1
inline constexpr const char* TextureStretch =
  "TextureStretch"; ///< 1 component, largest stretching of the coordinates of the heavier texture, 1 is none
inline constexpr const char* Opacity = "Opacity"; ///< 1 component, 0..1, Gardner's 1 - TR

// Point arrays of a picture (vtkImageData, float).
inline constexpr const char* Radiance = "Radiance"; ///< 3 components, linear RGB
inline constexpr const char* Transmittance =
  "Transmittance"; ///< 3 components, RGB, 0..1, of all that is not backdrop
inline constexpr const char* Depth =
  "Depth"; ///< 1 component, scene units along the ray to transmittance 1/2, or +inf

inline constexpr const char* DisplayColor =
  "DisplayColor"; ///< 3 components, unsigned char: sRGB of Radiance

// Point arrays of horizontal grids (vtkImageData of one layer), float.
inline constexpr const char* SunTransmittance =
  "SunTransmittance"; ///< 1 component, 0..1, what a cloud plane lets through of the sun; the image's z is the plane's

// Sparse voxels: a vtkPolyData with one point a brick of 8 x 8 x 8 voxels, at its first voxel's centre.
inline constexpr const char* VoxelBricks =
  "VoxelBricks"; ///< point array, float, 512 components: the voxels, x fastest
inline constexpr const char* VoxelOrigins =
  "VoxelOrigins"; ///< point array, int, 3 components: index of the first voxel, multiples of 8
inline constexpr const char* VoxelToScene =
  "VoxelToScene"; ///< field data, 16 doubles, row by row: (x, y, z, 1) = matrix (i, j, k, 1), voxels' centres at whole numbers

// Field data that say how a grid lies in the scene.
inline constexpr const char* Geometry = "Geometry";         ///< string: Map, Globe or Local
inline constexpr const char* PlanetRadius = "PlanetRadius"; ///< double, scene units; Globe only
inline constexpr const char* HeightScale =
  "HeightScale"; ///< double, scene units of vertical distance per metre of Height (the exaggeration, in metres)
inline constexpr const char* HeightField =
  "HeightField"; ///< double: a cloud between two height functions, as nephoscope::numbersOf writes it
inline constexpr const char* Projection = "Projection"; ///< string, PROJ definition; Local only
inline constexpr const char* Derived =
  "Derived"; ///< strings: what a reader computed and how, one line a quantity
}
}
#endif
