// SPDX-License-Identifier: BSD-3-Clause
#include "RankExchange.h"

#include "vtkMultiProcessController.h"

#include <algorithm>

namespace
{
constexpr int Tag = 7405;
constexpr vtkIdType LongestMessage = vtkIdType(1) << 30; // bytes are counted by int in MPI

void send(vtkMultiProcessController* controller, int to, std::vector<char>& bytes)
{
  const auto size = static_cast<vtkIdType>(bytes.size());
  controller->Send(&size, 1, to, Tag);
  for (vtkIdType at = 0; at < size; at += LongestMessage)
  {
    controller->Send(bytes.data() + at, std::min(LongestMessage, size - at), to, Tag);
  }
  bytes = {};
}

void receive(vtkMultiProcessController* controller, int from, std::vector<char>& bytes)
{
  vtkIdType size = 0;
  controller->Receive(&size, 1, from, Tag);
  bytes.resize(static_cast<std::size_t>(size));
  for (vtkIdType at = 0; at < size; at += LongestMessage)
  {
    controller->Receive(bytes.data() + at, std::min(LongestMessage, size - at), from, Tag);
  }
}
}

int stepsOf(int ranks)
{
  return ranks % 2 == 0 ? ranks - 1 : ranks;
}

int partnerOf(int rank, int ranks, int step)
{
  // One stays; the others sit in a circle of `steps` places and meet whose place adds up with theirs to the step.
  const int steps = stepsOf(ranks);
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

std::vector<std::vector<char>> exchange(
  vtkMultiProcessController* controller, std::vector<std::vector<char>>& outgoing)
{
  const int ranks = controller->GetNumberOfProcesses();
  const int rank = controller->GetLocalProcessId();
  std::vector<std::vector<char>> incoming(static_cast<std::size_t>(ranks));
  incoming[rank].swap(outgoing[rank]);
  for (int step = 0; step < stepsOf(ranks); ++step)
  {
    const int partner = partnerOf(rank, ranks, step);
    if (partner > rank)
    {
      send(controller, partner, outgoing[partner]);
      receive(controller, partner, incoming[partner]);
    }
    else if (partner < rank)
    {
      receive(controller, partner, incoming[partner]);
      send(controller, partner, outgoing[partner]);
    }
  }
  return incoming;
}
