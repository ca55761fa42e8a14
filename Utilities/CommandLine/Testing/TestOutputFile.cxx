// SPDX-License-Identifier: BSD-3-Clause
// A file appears whole or not at all.
#include "Failure.h"
#include "OutputFile.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace fs = std::filesystem;
using namespace nephoscope::program;

namespace
{
class OutputFileTest : public ::testing::Test
{
protected:
  void SetUp() override
  {
    this->Folder = fs::path(::testing::TempDir()) / ("output." + std::to_string(::getpid()));
    fs::create_directories(this->Folder);
  }
  void TearDown() override { fs::remove_all(this->Folder); }

  std::string path(const std::string& name) const { return (this->Folder / name).string(); }
  std::string contents(const std::string& name) const
  {
    std::ifstream stream(this->path(name));
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }
  long count() const
  {
    return std::distance(fs::directory_iterator(this->Folder), fs::directory_iterator());
  }
  fs::path Folder;
};

std::string failureOf(const std::string& path)
{
  try
  {
    writeText(path, "text");
  }
  catch (const Failure& failure)
  {
    return failure.what();
  }
  return "";
}
}

TEST_F(OutputFileTest, AppearsOnCommit)
{
  {
    OutputFile file(this->path("a.txt"));
    EXPECT_EQ(extensionOf(file.partial()), "txt");
    std::ofstream(file.partial()) << "whole";
    EXPECT_FALSE(fs::exists(this->path("a.txt")));
    file.commit();
  }
  EXPECT_EQ(this->contents("a.txt"), "whole");
  EXPECT_EQ(this->count(), 1);
}

TEST_F(OutputFileTest, LeavesNothingBehindWithoutCommit)
{
  writeText(this->path("a.txt"), "before");
  {
    const OutputFile file(this->path("a.txt"));
    std::ofstream(file.partial()) << "half";
  }
  EXPECT_EQ(this->contents("a.txt"), "before");
  EXPECT_EQ(this->count(), 1);
}

TEST_F(OutputFileTest, TakesTheLongestName)
{
  const std::string name = std::string(251, 'n') + ".txt";
  writeText(this->path(name), "long");
  EXPECT_EQ(this->contents(name), "long");
  EXPECT_EQ(this->count(), 1);
}

TEST_F(OutputFileTest, ReplacesTheTargetOfALink)
{
  writeText(this->path("target"), "old");
  fs::create_symlink("target", this->path("link"));
  writeText(this->path("link"), "new");
  EXPECT_TRUE(fs::is_symlink(this->path("link")));
  EXPECT_EQ(this->contents("target"), "new");
}

TEST_F(OutputFileTest, SaysWhyItCannotBeWritten)
{
  EXPECT_EQ(failureOf(this->path("none/a.txt")),
    this->path("none/a.txt") + ": there is no folder " + this->path("none") +
      " to write into; create it first");
  EXPECT_EQ(failureOf(this->Folder.string()),
    this->Folder.string() + ": is not a regular file; give the name of a file to write");
  EXPECT_NE(failureOf("/dev/null").find("is not a regular file"), std::string::npos);
}

TEST_F(OutputFileTest, IsNoneOfTheOthers)
{
  writeText(this->path("data.nc"), "precious");
  fs::create_symlink("data.nc", this->path("link"));
  const std::vector<std::string> others{ "", this->path("data.nc") };
  EXPECT_NO_THROW(checkWritable(this->path("a.nc"), others));
  const std::string around = "../" + this->Folder.filename().string() + "/data.nc";
  for (const std::string& name : { std::string("data.nc"), std::string("link"), around })
  {
    EXPECT_THROW(checkWritable(this->path(name), others), UsageFailure) << name;
  }
}

TEST(Extension, IsLowerCaseWithoutDot)
{
  EXPECT_EQ(extensionOf("a/b.PNG"), "png");
  EXPECT_EQ(extensionOf("a.b/c"), "");
  EXPECT_EQ(extensionOf(""), "");
}
