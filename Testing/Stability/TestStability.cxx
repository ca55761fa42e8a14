// SPDX-License-Identifier: BSD-3-Clause
// Each registered situation as a test, with 4, 2 and 1 threads.
#include "Stability.h"
#include "vtkSMPTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <sstream>

using namespace nephoscope::stability;

namespace
{
class Stability : public testing::TestWithParam<std::size_t>
{
};

std::string nameOf(const testing::TestParamInfo<std::size_t>& info)
{
  std::string name = cases()[info.param].group + "_" + cases()[info.param].situation;
  for (char& c : name)
  {
    c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  }
  return name;
}
}

TEST_P(Stability, OursIsTheDefinedAnswer)
{
  const StabilityCase& c = cases()[GetParam()];
  const Outcome o = c.run();
  EXPECT_TRUE(o.holds) << c.situation << "\n  defined: " << c.defined << "\n  ours: " << o.ours
                       << "\n  naive: " << o.naive;
}

INSTANTIATE_TEST_SUITE_P(Cases, Stability, testing::Range(std::size_t(0), cases().size()), nameOf);

TEST(StabilityTable, HasARowForEachCaseAndCountsFailures)
{
  std::ostringstream table;
  EXPECT_EQ(printTable(table), 0);
  const std::string text = table.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), static_cast<int>(cases().size()) + 2);
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  int failed = 0;
  for (const int threads : { 4, 2, 1 }) // TBB does not raise its limit again
  {
    vtkSMPTools::Initialize(threads);
    failed += RUN_ALL_TESTS();
  }
  return failed == 0 ? 0 : 1;
}
