// SPDX-License-Identifier: BSD-3-Clause
#include "Nearest.h"

#include <gtest/gtest.h>

using nephoscope::program::editDistance;
using nephoscope::program::nearest;
using nephoscope::program::suggestion;

TEST(EditDistance, CountsInsertionsDeletionsAndReplacements)
{
  EXPECT_EQ(editDistance("", ""), 0u);
  EXPECT_EQ(editDistance("", "abc"), 3u);
  EXPECT_EQ(editDistance("kitten", "sitting"), 3u); // the textbook's example
  EXPECT_EQ(editDistance("viewangle", "viewAngle"), 0u);
}

TEST(EditDistance, IsAMetric)
{
  const std::vector<std::string> words{ "", "size", "sise", "exposure", "position", "posit" };
  for (const auto& a : words)
  {
    for (const auto& b : words)
    {
      EXPECT_EQ(editDistance(a, b), editDistance(b, a));
      EXPECT_EQ(editDistance(a, b) == 0, a == b);
      for (const auto& c : words)
      {
        EXPECT_LE(editDistance(a, c), editDistance(a, b) + editDistance(b, c));
      }
    }
  }
}

TEST(Nearest, IsTheFirstOfTheNearest)
{
  EXPECT_EQ(nearest("exposur", { "size", "exposure", "position" }), "exposure");
  EXPECT_EQ(nearest("ab", { "ax", "ay" }), "ax");
  EXPECT_EQ(nearest("anything", {}), "");
  EXPECT_EQ(nearest("lat", { "up", "latitude" }), "latitude") << "a beginning is nearer";
}

TEST(Suggestion, NamesAllWhereNoneIsNear)
{
  const std::vector<std::string> known{ "surface", "texture" };
  EXPECT_EQ(suggestion("surfce", known), "did you mean 'surface'?");
  EXPECT_EQ(suggestion("tex", known), "did you mean 'texture'?");
  EXPECT_EQ(suggestion("fog", known), "it can be surface, texture");
}
