// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file Exponential.h
 * @brief An exponential without branches or calls, so that loops over it become vector instructions.
 *
 * x = n ln 2 + r with |r| <= ln(2) / 2 and exp x = 2^n exp r; ln 2 in two parts (Cody and Waite 1980), then Taylor's series to
 * r^11, whose remainder is below 1e-14 of the value.
 *
 * Precondition: x <= 700. Below -700 it is exp(-700), 1e-304. Relative error below 1e-13; its exact counterpart is std::exp.
 * In single precision, with ln 2 of 15 bits and the rest and a series to r^7: x <= 87, below -87 it is exp(-87), 2e-38; relative error below 3e-7.
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

inline float exponentialFloat(float x)
{
  constexpr float Magic = 12582912.0F; // 1.5 * 2^23
  constexpr float High = 0.693359375F;
  constexpr float Low = -2.12194440e-4F;
  const float y = x > -87.0F ? x : -87.0F;
  const float shifted = y * 1.44269504F + Magic;
  const float n = shifted - Magic;
  const float r = (y - n * High) - n * Low;
  const float series = 1 +
    r *
      (1 +
        r *
          (1.0F / 2 +
            r *
              (1.0F / 6 +
                r * (1.0F / 24 + r * (1.0F / 120 + r * (1.0F / 720 + r * (1.0F / 5040)))))));
  std::uint32_t bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  std::uint32_t value;
  std::memcpy(&value, &series, sizeof value);
  value += bits << 23;
  float result;
  std::memcpy(&result, &value, sizeof result);
  return result;
}
}
#endif
