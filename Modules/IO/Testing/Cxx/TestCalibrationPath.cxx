// SPDX-License-Identifier: BSD-3-Clause
#include "CalibrationFile.h"
#include "CalibrationPath.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

using nephoscope::calibrationFolders;
using nephoscope::calibrationPath;
using nephoscope::readCalibration;
using nephoscope::ReadError;
using testing::HasSubstr;
using testing::ThrowsMessage;

namespace
{
/// The variable is as it was at the end, and the folder gone.
class CalibrationPath : public testing::Test
{
protected:
  CalibrationPath()
  {
    if (const char* const before = std::getenv("NEPHOSCOPE_CALIBRATION"))
    {
      this->Before = before;
    }
    unsetenv("NEPHOSCOPE_CALIBRATION");
  }
  ~CalibrationPath() override
  {
    std::filesystem::remove_all(this->Folder);
    setenv("NEPHOSCOPE_CALIBRATION", this->Before.c_str(), 1);
  }

  std::string Before;
  std::string Folder = testing::TempDir() + "calibrations_" +
    testing::UnitTest::GetInstance()->current_test_info()->name();
};
}

// What is shipped is found without a hint, and is whole.
TEST_F(CalibrationPath, FindsWhatIsShipped)
{
  for (const char* const what : { "transmittance", "phase", "slab", "heightfield", "methods" })
  {
    EXPECT_EQ(readCalibration(calibrationPath(what)).what, what);
  }
}

// A folder of one's own comes first, for the calibrations that it has.
TEST_F(CalibrationPath, PrefersTheFolderThatIsNamed)
{
  std::filesystem::create_directory(this->Folder);
  setenv("NEPHOSCOPE_CALIBRATION", this->Folder.c_str(), 1);
  EXPECT_EQ(calibrationFolders().front(), this->Folder);
  EXPECT_EQ(readCalibration(calibrationPath("slab")).what, "slab");
  std::ofstream(this->Folder + "/slab.json") << "{}";
  EXPECT_EQ(calibrationPath("slab"), this->Folder + "/slab.json");
  EXPECT_EQ(readCalibration(calibrationPath("phase")).what, "phase");
}

// An error lists the folders; a folder of the file's name is not the file.
TEST_F(CalibrationPath, SaysWhereItLooked)
{
  std::filesystem::create_directories(this->Folder + "/nothing.json");
  setenv("NEPHOSCOPE_CALIBRATION", this->Folder.c_str(), 1);
  EXPECT_THAT([] { calibrationPath("nothing"); },
    ThrowsMessage<ReadError>(HasSubstr(
      "there is no calibration nothing.json in " + this->Folder + ", " + calibrationFolders()[1])));
}
