// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file RankExchange.h
 * @brief Bytes from every process to every other, through a vtkMultiProcessController, in pairs (PairedExchange.h).
 */
#ifndef RankExchange_h
#define RankExchange_h

#include <vector>

class vtkMultiProcessController;

/**
 * Send outgoing[r] to rank r, for all r. All processes of the controller have to call it.
 * @param outgoing one for each rank; emptied as they go
 * @return what came from each rank; that of this rank is what it had for itself
 */
std::vector<std::vector<char>> exchange(
  vtkMultiProcessController* controller, std::vector<std::vector<char>>& outgoing);
#endif
