// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file RankExchange.h
 * @brief Bytes from every process to every other, through a vtkMultiProcessController.
 *
 * In each step the processes meet in pairs, as the teams of a tournament do (the circle method): n - 1 steps for an even number, n for an
 * odd one, in which one rests. The lower rank of a pair sends first. So blocking messages of any length are never waited for in a
 * circle, and nobody holds more than what it sends and receives.
 */
#ifndef RankExchange_h
#define RankExchange_h

#include <vector>

class vtkMultiProcessController;

/// With whom a rank meets in a step, 0 to stepsOf(ranks) - 1; the rank itself if it rests.
int partnerOf(int rank, int ranks, int step);
int stepsOf(int ranks);

/**
 * Send outgoing[r] to rank r, for all r. All processes of the controller have to call it.
 * @param outgoing one for each rank; emptied as they go
 * @return what came from each rank; that of this rank is what it had for itself
 */
std::vector<std::vector<char>> exchange(
  vtkMultiProcessController* controller, std::vector<std::vector<char>>& outgoing);
#endif
