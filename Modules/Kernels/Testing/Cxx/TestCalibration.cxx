// SPDX-License-Identifier: BSD-3-Clause
#include "Calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

using nephoscope::Calibration;
using nephoscope::Fit;
using testing::HasSubstr;
using testing::ThrowsMessage;

namespace
{
Calibration sample()
{
  Fit fit;
  fit.name = "sexp";
  fit.parameters = { { "k", 0.7, 0.01, 0, 1 } };
  fit.covariance = { 1e-4 };
  return { "transmittance", "", { fit } };
}
}

// A name that is not there is answered with those that are.
TEST(Calibration, FindsByName)
{
  const Calibration calibration = sample();
  EXPECT_EQ(calibration.fit("sexp").value("k"), 0.7);
  EXPECT_THAT([&calibration] { calibration.fit("sexpo"); },
    ThrowsMessage<std::out_of_range>(
      "the calibration 'transmittance' has no fit 'sexpo'; it has sexp"));
  EXPECT_THAT([&calibration] { calibration.fit("sexp").value("gain"); },
    ThrowsMessage<std::out_of_range>("the fit 'sexp' has no parameter 'gain'; it has k"));
  EXPECT_THAT([] { Calibration{}.fit("k"); }, ThrowsMessage<std::out_of_range>(HasSubstr("none")));
}

TEST(Calibration, KnowsWhatCannotBe)
{
  EXPECT_EQ(whatIsWrong(sample()), "");
  Calibration wrong = sample();
  wrong.fits[0].parameters[0].value = 1.5;
  EXPECT_THAT(whatIsWrong(wrong), HasSubstr("fit 'sexp': k = 1.500000 is not between its bounds"));
  wrong = sample();
  wrong.fits[0].parameters[0].standardError = std::numeric_limits<double>::infinity();
  EXPECT_THAT(whatIsWrong(wrong), HasSubstr("k has a number that is not finite"));
  wrong = sample();
  wrong.fits[0].parameters[0].standardError = -1;
  EXPECT_THAT(whatIsWrong(wrong), HasSubstr("k has a negative standard error"));
  wrong = sample();
  wrong.fits[0].covariance = { 1, 2 };
  EXPECT_THAT(whatIsWrong(wrong), HasSubstr("the covariance is not 1 x 1"));
  wrong = sample();
  wrong.fits[0].heldOut.rms = -1;
  EXPECT_THAT(whatIsWrong(wrong), HasSubstr("an error that is no number"));
  wrong = sample();
  wrong.fits[0].name.clear();
  EXPECT_THAT(whatIsWrong(wrong), HasSubstr("it has no name"));
  wrong.what.clear();
  EXPECT_EQ(whatIsWrong(wrong), "the calibration has no name");
}
