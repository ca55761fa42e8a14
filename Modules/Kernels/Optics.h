// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Optics.h
 * @brief From what a model says of a cloud to its extinction, 1/m.
 *
 * Two rules. The physical one takes condensate (Max 1994, "Illumination", tau = 3/(4 r) times the water's volume fraction,
 * with the extinction efficiency that the paper leaves out):
 *
 *     sigma = Q 3/(4 r) rho_air q / rho_water
 *
 * The visual one takes cloud fraction, which says how much of the sky is covered and nothing about thickness: sigma is
 * proportional to it.
 *
 * @sa vtkCloudCellVolume, TestOptics.cxx
 */
#ifndef Optics_h
#define Optics_h

namespace nephoscope
{
inline constexpr double LiquidWaterDensity = 1000; ///< kg/m3
inline constexpr double IceDensity = 917;          ///< kg/m3

/// What stands for infinite density, 1/m: a millimetre of it is opaque, and sums of it stay finite in float.
inline constexpr float DensestExtinction = 1e9F;

/// What a condensate's particles are like.
struct Particles
{
  double extinctionEfficiency =
    2; ///< Q, dimensionless; 1 is the geometric cross-section of Max 1994, 2 is Mie's limit
  double effectiveRadius = 10e-6;      ///< r, m, > 0
  double density = LiquidWaterDensity; ///< of the substance, kg/m3
};

/**
 * Extinction of a mixing ratio.
 * @param q condensate, kg per kg of air
 * @param airDensity kg/m3
 * @return 1/m; not limited to what is usable, see usableExtinction
 */
constexpr double condensateExtinctionPerMeter(
  double q, double airDensity, const Particles& particles)
{
  return particles.extinctionEfficiency * 3 / (4 * particles.effectiveRadius) * airDensity * q /
    particles.density;
}

/// p / (R T) of dry air, kg/m3; p in Pa, T in K.
double airDensity(double pressure, double temperature);
/// Of the US Standard Atmosphere 1976 at a height, kg/m3; z in m above sea level.
double standardAirDensity(double z);

/// Negative becomes 0, infinite or enormous becomes DensestExtinction, NaN stays NaN (its cells are left empty).
float usableExtinction(double extinction);
}
#endif
