// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file VerticalCoordinate.h
 * @brief From a model's vertical coordinate to pressure and height, and the cloud fraction that a box of moist air implies.
 *
 * Symbols: p pressure, ps surface pressure, p0 reference pressure [Pa]; z height above sea level [m], the geopotential
 * height Phi/g0 (it is 0.3 % under the geometric one at 20 km); T temperature, Tv virtual temperature [K]; q specific
 * humidity [kg/kg].
 *
 * The coordinates follow the CF conventions, appendix D, "Parametric Vertical Coordinates".
 * Precondition everywhere: finite input. Postcondition: finite output, except where a line says otherwise.
 */
#ifndef VerticalCoordinate_h
#define VerticalCoordinate_h

#include <cstddef>

namespace nephoscope
{
inline constexpr double StandardGravity = 9.80665;       ///< m/s2
inline constexpr double DryAirGasConstant = 287.05;      ///< J/(kg K)
inline constexpr double WaterVapourGasConstant = 461.51; ///< J/(kg K)
inline constexpr double DryAirKappa = 2.0 / 7.0;         ///< R/cp

/// p = ap + b ps: atmosphere_hybrid_sigma_pressure_coordinate, ap in Pa.
constexpr double hybridPressure(double ap, double b, double ps)
{
  return ap + b * ps;
}

/// p = a p0 + b ps: the same, second spelling, a without unit (CAM's hyam, P0, hybm, PS).
constexpr double hybridPressure(double a, double p0, double b, double ps)
{
  return a * p0 + b * ps;
}

/// p = ptop + sigma (ps - ptop): atmosphere_sigma_coordinate.
constexpr double sigmaPressure(double sigma, double ptop, double ps)
{
  return ptop + sigma * (ps - ptop);
}

/// p = p0 exp(-lev): atmosphere_ln_pressure_coordinate.
double lnPressure(double p0, double lev);

/// z = a + b orog: atmosphere_hybrid_height_coordinate.
constexpr double hybridHeight(double a, double b, double orography)
{
  return a + b * orography;
}

/// z = a ztop + b1 zsurf1 + b2 zsurf2: atmosphere_sleve_coordinate (Schaer et al. 2002: large and small scale terrain).
constexpr double sleveHeight(
  double a, double ztop, double b1, double zsurf1, double b2, double zsurf2)
{
  return a * ztop + b1 * zsurf1 + b2 * zsurf2;
}

/// Tv = T (1 + (Rv/Rd - 1) q).
constexpr double virtualTemperature(double temperature, double q)
{
  return temperature * (1 + (WaterVapourGasConstant / DryAirGasConstant - 1) * q);
}

/// T = theta (p / 1000 hPa)^(R/cp). @pre p > 0
double temperatureOfPotential(double theta, double p);

/**
 * Height of pressure levels by the hypsometric equation, dz = -(Rd Tv / g0) dln p, from the ground up:
 *
 *     z[0] = zs + (Rd / g0) Tv[0] ln(ps / p[0])
 *     z[k] = z[k-1] + (Rd / g0) (Tv[k-1] + Tv[k]) / 2 ln(p[k-1] / p[k])
 *
 * Exact where Tv is linear in ln p between the levels, second order in the spacing otherwise.
 * @pre p > 0 and falling with k; a level under the ground (p > ps) comes out under zs
 */
void hypsometricHeights(
  std::size_t n, const double* p, const double* tv, double ps, double zs, double* z);

/**
 * The US Standard Atmosphere 1976 (NOAA-S/T 76-1562), below 84.852 km of geopotential height: seven layers of constant lapse
 * rate. Above the last and below the first the nearest layer's law goes on.
 * @param z geopotential height, m
 */
double standardPressure(double z);    ///< Pa
double standardTemperature(double z); ///< K; at least 150 above the table
/// The inverse of standardPressure. @pre p > 0; p <= 0 is read as 1e-6 Pa
double standardHeight(double p);

/// Saturation vapour pressure [Pa] over water, Murphy and Koop 2005 eq. 10; T clamped to 123..332 K, where the fit holds.
double saturationPressureWater(double temperature);
/// Saturation vapour pressure [Pa] over ice, Murphy and Koop 2005 eq. 7; T clamped to 110..273.16 K.
double saturationPressureIce(double temperature);

/// q* = eps e / (p - (1 - eps) e), eps = Rd/Rv; 1 where e reaches p (the air is all vapour).
double saturationHumidity(double e, double p);

/**
 * Cloud fraction of a box from its mean condensate and humidity, Xu and Randall 1996 (J. Atmos. Sci. 53, 3084) eq. 1:
 *
 *     C = RH^0.25 [1 - exp(-100 qc / ((1 - RH) q*)^0.49)]   RH < 1;   C = 1   RH >= 1 and qc > 0;   C = 0   qc <= 0
 *
 * @param liquid, ice mean mixing ratios, kg/kg; negative is read as 0
 * @param q specific humidity, kg/kg; q* is weighted by liquid and ice between saturation over water and over ice.
 * @pre p > 0; a temperature is clamped as above
 */
double cloudFractionXuRandall(double liquid, double ice, double q, double temperature, double p);
}
#endif
