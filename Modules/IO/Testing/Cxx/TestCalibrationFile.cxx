// SPDX-License-Identifier: BSD-3-Clause
#include "CalibrationFile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>

using nephoscope::Calibration;
using nephoscope::calibrationText;
using nephoscope::Fit;
using nephoscope::readCalibration;
using nephoscope::ReadError;
using testing::HasSubstr;
using testing::StartsWith;

namespace
{
Calibration sample()
{
  Fit fit;
  fit.name = "power 2 k";
  fit.residual = "absolute";
  fit.parameters = { { "k", 1.0 / 3, 1e-5, 0.1, 2 }, { "gain", 2, 0, 0, 2, true, true } };
  fit.covariance = { 1e-10, 0, 0, 0 };
  fit.training = { 100, -1e-17, 0.0123, 0.01, 0.02, 0.0699 };
  fit.heldOut = { 10, 0.1, 0.2, 0.3, 0.4, 5e-324 };
  fit.iterations = 7;
  fit.warnings = { "gain is at its upper bound 2" };
  fit.seconds = 3;
  return { "transmittance", "nephoscope fit transmittance", { fit } };
}

/// A file in the tests' folder that is gone at the end.
class CalibrationFile : public testing::Test
{
protected:
  ~CalibrationFile() override { std::remove(this->Path.c_str()); }

  void Write(const std::string& text) const { std::ofstream(this->Path, std::ios::binary) << text; }

  std::string Error() const
  {
    try
    {
      readCalibration(this->Path);
    }
    catch (const ReadError& error)
    {
      return error.what();
    }
    return "no error";
  }

  /// The file's text with one part replaced.
  static std::string Edited(const std::string& part, const std::string& with)
  {
    std::string text = calibrationText(sample());
    const std::size_t at = text.find(part);
    EXPECT_NE(at, std::string::npos) << part;
    return text.replace(at, part.size(), with);
  }

  std::string Path = testing::TempDir() + "calibration_" +
    testing::UnitTest::GetInstance()->current_test_info()->name() + ".json";
};
}

// Every bit of every number comes back; seconds, which differ from run to run, are not kept.
TEST_F(CalibrationFile, ComesBackAsItWas)
{
  this->Write(calibrationText(sample()));
  const Calibration back = readCalibration(this->Path);
  EXPECT_EQ(back.what, "transmittance");
  EXPECT_EQ(back.command, "nephoscope fit transmittance");
  ASSERT_EQ(back.fits.size(), 1U);
  const Fit& fit = back.fit("power 2 k");
  EXPECT_EQ(fit.value("k"), 1.0 / 3);
  EXPECT_EQ(fit.parameters[0].standardError, 1e-5);
  EXPECT_TRUE(fit.parameters[1].atBound);
  EXPECT_EQ(fit.covariance, sample().fits[0].covariance);
  EXPECT_EQ(fit.training.bias, -1e-17);
  EXPECT_EQ(fit.heldOut.max, 5e-324);
  EXPECT_EQ(fit.warnings, sample().fits[0].warnings);
  EXPECT_EQ(fit.seconds, 0);
  EXPECT_EQ(calibrationText(back), calibrationText(sample()));
}

TEST_F(CalibrationFile, SaysThatItIsMissing)
{
  EXPECT_THAT(this->Error(), StartsWith(this->Path + ": there is no calibration to read"));
  this->Path = testing::TempDir(); // a folder
  EXPECT_THAT(this->Error(), HasSubstr("there is no calibration to read"));
}

// Wherever it is cut, the message is about that.
TEST_F(CalibrationFile, SaysThatItIsCutShort)
{
  const std::string text = calibrationText(sample());
  for (std::size_t length = 0; length + 2 < text.size(); length += 37)
  {
    this->Write(text.substr(0, length));
    EXPECT_THAT(this->Error(), HasSubstr("is cut short or no JSON, at byte")) << length;
  }
}

TEST_F(CalibrationFile, SaysThatItIsNewer)
{
  this->Write(Edited("\"version\": 1", "\"version\": 2"));
  EXPECT_THAT(this->Error(),
    HasSubstr("is of version 2, newer than 1, the latest that is known here; update nephoscope"));
  this->Write(Edited("\"version\": 1", "\"version\": \"one\""));
  EXPECT_THAT(this->Error(), HasSubstr("has no version"));
}

TEST_F(CalibrationFile, SaysThatItWasEdited)
{
  this->Write(Edited("\"upper\":2", "\"upper\":3"));
  EXPECT_THAT(this->Error(), HasSubstr("was edited by hand"));
  EXPECT_THAT(
    this->Error(), HasSubstr("make it again with nephoscope fit transmittance -o " + this->Path));
  this->Write(Edited("\"command\": \"nephoscope fit transmittance\"", "\"command\": 7"));
  EXPECT_THAT(this->Error(), HasSubstr("make it again with nephoscope fit or calibrate -o"));
}

TEST_F(CalibrationFile, SaysThatItIsSomethingElse)
{
  for (const char* const text : { "{}", "[]", "7", "null", "{\"format\": 3}" })
  {
    this->Write(text);
    EXPECT_THAT(this->Error(), HasSubstr("is no nephoscope calibration")) << text;
  }
}

// With its checksum right, what it says is still looked at.
TEST_F(CalibrationFile, RefusesValuesThatCannotBe)
{
  Calibration wrong = sample();
  wrong.fits[0].parameters[0].value = 2.5;
  this->Write(calibrationText(wrong));
  EXPECT_THAT(this->Error(), HasSubstr("fit 'power 2 k': k = 2.500000 is not between its bounds"));
  wrong = sample();
  wrong.fits[0].covariance.pop_back();
  this->Write(calibrationText(wrong));
  EXPECT_THAT(this->Error(), HasSubstr("the covariance is not 2 x 2 finite numbers"));
  wrong = sample();
  wrong.fits[0].training.rms = std::numeric_limits<double>::quiet_NaN(); // JSON has null for it
  this->Write(calibrationText(wrong));
  EXPECT_THAT(this->Error(), HasSubstr("lacks a part of a calibration"));
}

// What is shipped is whole and of this version.
TEST(ShippedCalibrations, CanBeRead)
{
  int count = 0;
  const std::filesystem::path folder = NEPHOSCOPE_SOURCE_DIR "/Data/Calibration";
  for (const auto& entry : std::filesystem::directory_iterator(folder))
  {
    const Calibration calibration = readCalibration(entry.path().string());
    EXPECT_EQ(entry.path().stem(), calibration.what);
    EXPECT_FALSE(calibration.fits.empty());
    ++count;
  }
  EXPECT_GE(count, 1);
}
