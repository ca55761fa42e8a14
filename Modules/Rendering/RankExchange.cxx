// SPDX-License-Identifier: BSD-3-Clause
#include "RankExchange.h"

#include "PairedExchange.h"

#include "vtkMultiProcessController.h"

std::vector<std::vector<char>> exchange(
  vtkMultiProcessController* controller, std::vector<std::vector<char>>& outgoing)
{
  return nephoscope::exchangeInPairs(*controller, outgoing);
}
