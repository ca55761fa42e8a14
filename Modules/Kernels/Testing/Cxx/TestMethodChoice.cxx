// SPDX-License-Identifier: BSD-3-Clause
#include "MethodChoice.h"
#include "RadianceError.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace nephoscope;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();

const std::vector<ChoicePart> Parts{
  { "clouds", { { "fast", 1, 0.1 }, { "good", 4, 0.01 }, { "exact", 100, 0 } } },
  { "haze", { { "coarse", 0.5, 0.02 }, { "fine", 3, 0.001 }, { "worse", 5, 0.05 } } }
};

/// The best choice by trying all.
double leastSeconds(const std::vector<ChoicePart>& parts, double tolerance, std::size_t part = 0,
  double error = 0, double seconds = 0)
{
  if (part == parts.size())
  {
    return error <= tolerance ? seconds : Infinity;
  }
  double least = Infinity;
  for (const MethodOption& option : parts[part].options)
  {
    least = std::min(least,
      leastSeconds(parts, tolerance, part + 1, error + option.error, seconds + option.seconds));
  }
  return least;
}

std::vector<ChoicePart> randomParts(std::mt19937& random)
{
  std::vector<ChoicePart> parts(5);
  for (ChoicePart& part : parts)
  {
    for (int option = 0; option < 6; ++option)
    {
      part.options.push_back({ std::to_string(option), std::exp(random() % 1000 / 100.0),
        std::exp(-static_cast<double>(random() % 1000) / 100.0) });
    }
  }
  return parts;
}
}

// The tolerance is split where it saves most: the sum counts, not each part's share.
TEST(MethodChoice, SplitsTheToleranceWhereItSavesMost)
{
  const MethodChoice choice = cheapestChoice(Parts, 0.04);
  EXPECT_THAT(choice.options, ElementsAre(1, 0));
  EXPECT_DOUBLE_EQ(choice.error, 0.03);
  EXPECT_DOUBLE_EQ(choice.seconds, 4.5);
  EXPECT_THAT(cheapestChoice(Parts, 0.03 + 1e-12).options, ElementsAre(1, 0));
  EXPECT_THAT(cheapestChoice(Parts, 0.0299).options, ElementsAre(1, 1));
  EXPECT_THAT(cheapestChoice(Parts, 10).options, ElementsAre(0, 0));
}

TEST(MethodChoice, TakesTheMostExactInATime)
{
  EXPECT_THAT(mostExactChoice(Parts, 1.5).options, ElementsAre(0, 0));
  EXPECT_THAT(mostExactChoice(Parts, 4.6).options, ElementsAre(1, 0));
  EXPECT_THAT(mostExactChoice(Parts, 1e9).options, ElementsAre(2, 1));
}

// Against all 7776 combinations of random methods.
TEST(MethodChoice, IsTheBestOfAll)
{
  std::mt19937 random(1);
  for (int n = 0; n < 20; ++n)
  {
    const std::vector<ChoicePart> parts = randomParts(random);
    const double tolerance = std::exp(-static_cast<double>(random() % 400) / 100.0);
    const double least = leastSeconds(parts, tolerance);
    if (std::isfinite(least))
    {
      EXPECT_NEAR(cheapestChoice(parts, tolerance).seconds / least, 1, 1e-9);
    }
    else
    {
      EXPECT_THROW(cheapestChoice(parts, tolerance), ChoiceError);
    }
  }
}

// Forty parts would have 2^40 choices; what is kept stays short, and within some per cent of the best.
TEST(MethodChoice, ThinsLongFronts)
{
  std::mt19937 random(7);
  std::vector<ChoicePart> parts(40);
  for (ChoicePart& part : parts)
  {
    const double error = std::exp(-static_cast<double>(random() % 900) / 100.0);
    const double seconds = std::exp(random() % 500 / 100.0);
    part.options = { { "a", 0, error }, { "b", seconds, 0 } };
  }
  EXPECT_LE(choiceFront(parts).size(), 2000U);
  const MethodChoice loose = cheapestChoice(parts, 0.1);
  EXPECT_LE(loose.error, 0.1);
  EXPECT_GT(loose.error, 0.08) << "so much of the tolerance is used";
}

TEST(MethodChoice, SaysWhatIsReachable)
{
  std::vector<ChoicePart> parts = Parts;
  parts[0].options.pop_back();
  EXPECT_THAT([&] { cheapestChoice(parts, 1e-3); },
    ThrowsMessage<ChoiceError>(
      "no methods reach a tolerance of 0.001; 0.011 can be reached, in 7 s; the largest "
      "part of it is that of clouds by good"));
  EXPECT_THAT([&] { mostExactChoice(parts, 1); },
    ThrowsMessage<ChoiceError>(
      "no methods take 1 s or less; the fastest take 1.5 s, with an error of 0.12; most "
      "of it is for clouds by fast"));
  for (const double none : { 0.0, -1.0, NaN, Infinity })
  {
    EXPECT_THAT([&] { cheapestChoice(parts, none); },
      ThrowsMessage<ChoiceError>(HasSubstr("is not a number above 0")));
  }
  parts[1].options.clear();
  EXPECT_THAT(
    [&] { cheapestChoice(parts, 1); }, ThrowsMessage<ChoiceError>("there is no method for haze"));
}

TEST(MethodChoice, ModelsStayInRange)
{
  const CostModel cost{ { 2, 0.5 } };
  EXPECT_EQ(cost.seconds({ 3, 4 }), 8);
  EXPECT_EQ(cost.seconds({ 3 }), 6) << "work that is not told is none";
  EXPECT_EQ(cost.seconds({ -5, 4 }), 2) << "a density below 0 asks for no work";
  EXPECT_EQ((CostModel{ { -1, 1 } }.seconds({ 3, 4 })), 4);
  EXPECT_EQ(cost.seconds({ Infinity, 1 }), Endless);
  EXPECT_EQ(cost.seconds({ NaN, 1 }), Endless);
  EXPECT_EQ((CostModel{ { 1, 0 } }.seconds({ 1, Infinity })), Endless);
  const ErrorModel error{ 0.5, 2 };
  EXPECT_EQ(error.error(3), 4.5);
  EXPECT_EQ(error.error(0), 0);
  EXPECT_EQ(error.error(-1), 0);
  EXPECT_EQ(error.error(1e200), Endless);
  EXPECT_EQ(error.error(NaN), Endless);
  EXPECT_EQ((ErrorModel{ 0, 2 }.error(NaN)), 0) << "an exact method has no error";
}

// What overflows is not chosen, and does not hide what is good.
TEST(MethodChoice, NeverTakesWhatIsEndless)
{
  const std::vector<ChoicePart> parts{ { "a", { { "nan", NaN, 0 }, { "finite", 1, 0.1 } } },
    { "b", { { "error", 0, Infinity }, { "finite", 2, 0.1 } } } };
  const MethodChoice choice = cheapestChoice(parts, 1);
  EXPECT_THAT(choice.options, ElementsAre(1, 1));
  EXPECT_EQ(choice.seconds, 3);
}

TEST(RadianceError, IsRelativeToTheBrightestColorAndAHundredthAtLeast)
{
  const double exact[3] = { 0.5, 0.25, 0 };
  const float drawn[3] = { 0.5F, 0.3F, 0 };
  EXPECT_NEAR(radianceError(drawn, exact), 0.1, 1e-6);
  const double dark[3] = { 0, 0, 1e-4 };
  const double black[3] = { 0, 0, 0 };
  EXPECT_DOUBLE_EQ(radianceError(black, dark), 0.01);
  const double broken[3] = { NaN, 0, 0 };
  EXPECT_EQ(radianceError(broken, exact), Infinity);
}

// No source, background or depth changes more by leaving out than is promised.
TEST(RadianceError, LeavingOutIsBounded)
{
  std::mt19937 random(3);
  const auto within = [&random](double low, double high)
  { return low * std::pow(high / low, random() / 4294967296.0); };
  double tightest = 0;
  for (int n = 0; n < 100000; ++n)
  {
    const double depth = within(1e-6, 10);
    const double largest = within(1e-4, 10);
    const double through = std::exp(-depth);
    double bare[3];
    double with[3];
    for (int c = 0; c < 3; ++c)
    {
      bare[c] = within(1e-5, 10);
      with[c] =
        through * bare[c] + (1 - through) * (c == 0 ? largest : within(1e-5, 1) / 10 * largest);
    }
    const double share = radianceError(bare, with) / errorOfLeavingOut(depth, largest);
    ASSERT_LE(share, 1 + 1e-9);
    tightest = std::max(tightest, share);
  }
  EXPECT_GT(tightest, 0.9) << "the bound is nearly reached";
  EXPECT_EQ(errorOfLeavingOut(0, 1), 0);
  EXPECT_EQ(errorOfLeavingOut(-1, 1), 0);
}

TEST(RadianceError, QuantilesAreOfTheValues)
{
  std::vector<double> values{ 5, 1, 4, 2, 3 };
  EXPECT_EQ(quantile(values, 0.5), 3);
  EXPECT_EQ(quantile(values, 0), 1);
  EXPECT_EQ(quantile(values, 1), 5);
  std::vector<double> none;
  EXPECT_EQ(quantile(none, 0.5), 0);
}
