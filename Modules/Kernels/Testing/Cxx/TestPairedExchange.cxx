// SPDX-License-Identifier: BSD-3-Clause
#include "PairedExchange.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

namespace
{
/// What is on its way between threads, from one to another.
struct Post
{
  std::mutex Lock;
  std::condition_variable Arrival;
  std::map<std::pair<int, int>, std::deque<std::vector<char>>> Messages;
  long long MostBytes = 0; // of a message
};

/// As far as exchangeInPairs needs it, what a vtkMultiProcessController is.
class ThreadController
{
public:
  ThreadController(Post& post, int rank, int ranks)
    : Way(post)
    , Rank(rank)
    , Ranks(ranks)
  {
  }
  int GetNumberOfProcesses() const { return this->Ranks; }
  int GetLocalProcessId() const { return this->Rank; }
  template <class Value>
  void Send(const Value* values, long long count, int to, int)
  {
    std::vector<char> bytes(count * sizeof(Value));
    std::memcpy(bytes.data(), values, bytes.size());
    const std::lock_guard<std::mutex> guard(this->Way.Lock);
    this->Way.MostBytes = std::max(this->Way.MostBytes, static_cast<long long>(bytes.size()));
    this->Way.Messages[{ this->Rank, to }].push_back(std::move(bytes));
    this->Way.Arrival.notify_all();
  }
  template <class Value>
  void Receive(Value* values, long long count, int from, int)
  {
    std::unique_lock<std::mutex> guard(this->Way.Lock);
    std::deque<std::vector<char>>& messages = this->Way.Messages[{ from, this->Rank }];
    this->Way.Arrival.wait(guard, [&messages] { return !messages.empty(); });
    const std::vector<char> bytes = std::move(messages.front());
    messages.pop_front();
    const std::size_t room = count * sizeof(Value);
    EXPECT_EQ(bytes.size(), room);
    std::memcpy(values, bytes.data(), std::min(bytes.size(), room));
  }

private:
  Post& Way;
  int Rank;
  int Ranks;
};

/// 2 to 10 values in messages of 4 at most: less than one, full ones, and some left over.
TEST(PairedExchange, LongValuesGoInSeveralMessages)
{
  constexpr int Ranks = 3;
  const auto size = [](int from, int to) { return (5 * from + 4 * to) % 11; };
  Post post;
  std::vector<std::vector<std::vector<double>>> came(Ranks);
  std::vector<std::thread> threads;
  for (int rank = 0; rank < Ranks; ++rank)
  {
    threads.emplace_back(
      [&post, &came, &size, rank]
      {
        std::vector<std::vector<double>> outgoing(Ranks);
        for (int to = 0; to < Ranks; ++to)
        {
          for (int n = 0; n < size(rank, to); ++n)
          {
            outgoing[to].push_back(100 * rank + 10 * to + 0.5 * n);
          }
        }
        ThreadController controller(post, rank, Ranks);
        came[rank] = nephoscope::exchangeInPairs(controller, outgoing, 4);
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  for (int to = 0; to < Ranks; ++to)
  {
    for (int from = 0; from < Ranks; ++from)
    {
      ASSERT_EQ(came[to][from].size(), static_cast<std::size_t>(size(from, to)));
      for (int n = 0; n < size(from, to); ++n)
      {
        EXPECT_EQ(came[to][from][n], 100 * from + 10 * to + 0.5 * n);
      }
    }
  }
  EXPECT_EQ(post.MostBytes, static_cast<long long>(4 * sizeof(double)));
}

/// Each meets each other once; in a step nobody is met by two.
TEST(PairedExchange, EveryoneMeetsEveryone)
{
  for (int ranks = 1; ranks <= 9; ++ranks)
  {
    std::set<std::pair<int, int>> met;
    for (int step = 0; step < nephoscope::exchangeSteps(ranks); ++step)
    {
      for (int rank = 0; rank < ranks; ++rank)
      {
        const int partner = nephoscope::exchangePartner(rank, ranks, step);
        EXPECT_EQ(nephoscope::exchangePartner(partner, ranks, step), rank);
        if (partner != rank)
        {
          EXPECT_TRUE(met.insert({ rank, partner }).second) << rank << " of " << ranks;
        }
      }
    }
    EXPECT_EQ(met.size(), static_cast<std::size_t>(ranks * (ranks - 1)));
  }
}
}
