// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file ClassicHeader.h
 * @brief Checks the header of a classic NetCDF file before netCDF-C opens it.
 *
 * netCDF-C allocates what a damaged header claims, gigabytes for a file of a kilobyte, and reads past the end of a file
 * that was cut short as zeros. The header is walked after "The NetCDF Classic Format Specification" (CDF-1, 2 and 5).
 */
#ifndef ClassicHeader_h
#define ClassicHeader_h

#include <cstddef>
#include <string>

namespace nephoscope
{
/// Does nothing for a file of another format.
/// @throws ReadError if the header contradicts itself or promises more than the file holds
void checkClassicHeader(const std::string& path, std::size_t fileSize);
}
#endif
