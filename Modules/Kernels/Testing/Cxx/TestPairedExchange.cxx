// SPDX-License-Identifier: BSD-3-Clause
#include "PairedExchange.h"

#include <gtest/gtest.h>

#include <set>

namespace
{
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
