// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Exponential.h
 * @brief An exponential without branches or calls, so that loops over it become vector instructions.
 *
 * x = n ln 2 + r with |r| <= ln(2) / 2 and exp x = 2^n exp r; ln 2 in two parts (Cody and Waite 1980), then Taylor's series to
 * r^11, whose remainder is below 1e-14 of the value.
 *
 * Precondition: x <= 700. Below -700 it is exp(-700), 1e-304. Relative error below 1e-13; its exact counterpart is std::exp.
 */
#ifndef Exponential_h
#define Exponential_h

#include <cstdint>
#include <cstring>

namespace nephoscope
{
inline double exponential(double x)
{
  constexpr double Magic = 6755399441055744.0;     // 1.5 * 2^52, as in Sine.h
  constexpr double High = 0.693147180369123816490; // 33 bits
  constexpr double Low = 1.90821492927058770002e-10;
  const double y = x > -700.0 ? x : -700.0;
  const double shifted = y * 1.4426950408889634 + Magic;
  const double n = shifted - Magic;
  const double r = (y - n * High) - n * Low;
  const double series = 1 +
    r *
      (1 +
        r *
          (1.0 / 2 +
            r *
              (1.0 / 6 +
                r *
                  (1.0 / 24 +
                    r *
                      (1.0 / 120 +
                        r *
                          (1.0 / 720 +
                            r *
                              (1.0 / 5040 +
                                r *
                                  (1.0 / 40320 +
                                    r *
                                      (1.0 / 362880 + r * (1.0 / 3628800 + r / 39916800.0))))))))));
  std::uint64_t bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  std::uint64_t value;
  std::memcpy(&value, &series, sizeof value);
  value += bits << 52;
  double result;
  std::memcpy(&result, &value, sizeof result);
  return result;
}
}
#endif
