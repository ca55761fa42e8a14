// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file ReadError.h
 * @brief What is wrong with a file, in one line that names the variable and the remedy. The reader adds the file.
 */
#ifndef ReadError_h
#define ReadError_h

#include <stdexcept>

namespace nephoscope
{
struct ReadError : std::runtime_error
{
  using std::runtime_error::runtime_error;
};
}
#endif
