// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file PairedExchange.h
 * @brief Values from every process to every other, by messages that wait for each other.
 *
 * In each step the processes meet in pairs, as the teams of a tournament do (the circle method): n - 1 steps for an even number, n for an
 * odd one, in which one rests. The lower rank of a pair sends first. So blocking messages of any length are never waited for in a
 * circle, and nobody holds more than what it sends and receives.
 */
#ifndef PairedExchange_h
#define PairedExchange_h

#include <algorithm>
#include <cstddef>
#include <vector>

namespace nephoscope
{
/// Of all messages from one process to another.
constexpr int ExchangeTag = 7406;

/// Number of steps in which every process has met every other.
inline int exchangeSteps(int ranks)
{
  return ranks % 2 == 0 ? ranks - 1 : ranks;
}

/// With whom a rank meets in a step, 0 to exchangeSteps(ranks) - 1; the rank itself if it rests.
inline int exchangePartner(int rank, int ranks, int step)
{
  // One stays; the others sit in a circle of `steps` places and meet whose place adds up with theirs to the step.
  const int steps = exchangeSteps(ranks);
  if (rank == steps)
  {
    return step % 2 == 0 ? step / 2 : (step + steps) / 2;
  }
  const int other = (step - rank + steps) % steps;
  if (other != rank)
  {
    return other;
  }
  return steps < ranks ? steps : rank;
}

/**
 * @brief Send outgoing[r] to rank r, for all r. All processes have to call it.
 * @param controller who says GetNumberOfProcesses(), GetLocalProcessId(), Send(values, count, rank, tag) and Receive likewise, as a
 * vtkMultiProcessController does
 * @param outgoing one for each rank; emptied as they go
 * @param longest values of a message, whose bytes are counted by int in MPI
 * @return what came from each rank; that of this rank is what it had for itself
 */
template <class Controller, class Value>
std::vector<std::vector<Value>> exchangeInPairs(Controller& controller,
  std::vector<std::vector<Value>>& outgoing, long long longest = (1LL << 30) / sizeof(Value))
{
  const int ranks = controller.GetNumberOfProcesses();
  const int rank = controller.GetLocalProcessId();
  std::vector<std::vector<Value>> incoming(static_cast<std::size_t>(ranks));
  incoming[rank].swap(outgoing[rank]);
  const auto send = [&controller, &outgoing, longest](int to)
  {
    std::vector<Value>& values = outgoing[to];
    const auto size = static_cast<long long>(values.size());
    controller.Send(&size, 1, to, ExchangeTag);
    for (long long at = 0; at < size; at += longest)
    {
      controller.Send(values.data() + at, std::min(longest, size - at), to, ExchangeTag);
    }
    values = {};
  };
  const auto receive = [&controller, &incoming, longest](int from)
  {
    std::vector<Value>& values = incoming[from];
    long long size = 0;
    controller.Receive(&size, 1, from, ExchangeTag);
    values.resize(static_cast<std::size_t>(size));
    for (long long at = 0; at < size; at += longest)
    {
      controller.Receive(values.data() + at, std::min(longest, size - at), from, ExchangeTag);
    }
  };
  for (int step = 0; step < exchangeSteps(ranks); ++step)
  {
    const int partner = exchangePartner(rank, ranks, step);
    if (partner > rank)
    {
      send(partner);
      receive(partner);
    }
    else if (partner < rank)
    {
      receive(partner);
      send(partner);
    }
  }
  return incoming;
}
}
#endif
