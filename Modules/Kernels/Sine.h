// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Sine.h
 * @brief A sine without branches or calls, so that loops over it become vector instructions.
 *
 * x = n pi + r with |r| <= pi/2 and sin x = (-1)^n sin r; pi in two parts (Cody and Waite 1980), then Taylor's series to r^15,
 * whose remainder is below (pi/2)^17 / 17! = 6.1e-12.
 *
 * Precondition: |x| < 1e10. Absolute error there below 1e-11 + |x| 2.3e-16; its exact counterpart is std::sin.
 */
#ifndef Sine_h
#define Sine_h

#include <cstdint>
#include <cstring>

namespace nephoscope
{
inline double sine(double x)
{
  constexpr double Magic =
    6755399441055744.0; // 1.5 * 2^52: adding it rounds to an integer in the low bits
  constexpr double PiHigh = 3.141592651605606; // 28 bits, so that n PiHigh is exact for |n| < 2^25
  constexpr double PiLow = 1.984187159361081e-09;
  const double shifted = x * 0.31830988618379067 + Magic;
  std::uint64_t bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  const double n = shifted - Magic;
  const double r = (x - n * PiHigh) - n * PiLow;
  const double q = r * r;
  const double s = r +
    r * q *
      (-1.0 / 6 +
        q *
          (1.0 / 120 +
            q *
              (-1.0 / 5040 +
                q *
                  (1.0 / 362880 +
                    q * (-1.0 / 39916800 + q * (1.0 / 6227020800.0 - q / 1307674368000.0))))));
  std::uint64_t sign;
  std::memcpy(&sign, &s, sizeof sign);
  sign ^= bits << 63;
  double result;
  std::memcpy(&result, &sign, sizeof result);
  return result;
}
}
#endif
