// SPDX-License-Identifier: BSD-3-Clause
// VTK's messages become lines for a user.
#include "Failure.h"
#include "Messages.h"

#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkObjectFactory.h>

#include <gtest/gtest.h>

using namespace nephoscope::program;

namespace
{
class Sayer : public vtkObject
{
public:
  static Sayer* New();
  vtkTypeMacro(Sayer, vtkObject);
  void SayError(const char* text) { vtkErrorMacro(<< text); }
  void SayWarning(const char* text) { vtkWarningMacro(<< text); }
};
vtkStandardNewMacro(Sayer);

std::string errorOf(const std::string& subject)
{
  try
  {
    Messages::throwIfError(subject);
  }
  catch (const Failure& failure)
  {
    return failure.what();
  }
  return "";
}
}

TEST(Messages, KeepWhatMattersToAUser)
{
  EXPECT_EQ(
    bareMessage("ERROR: In /a b/vtkFoo.cxx, line 12\nvtkFoo (0x55aa): what\n  happened\n\n"),
    "what happened");
  EXPECT_EQ(bareMessage("Generic Warning: In /a.cxx, line 1\nbeware\n"), "beware");
  EXPECT_EQ(bareMessage("ERROR: In /a.cxx, line 1\nvtkFoo (0x1): Algorithm vtkBar returned failure "
                        "for request: vtkInformation (0x2)\n  Debug: Off\n"),
    "Algorithm vtkBar failed");
  EXPECT_EQ(bareMessage("plain"), "plain");
  EXPECT_EQ(bareMessage(""), "");
}

TEST(Messages, AreOneLineOfText)
{
  EXPECT_EQ(printable("a\x1b[31m\nb \xc3\xa4"), "a?[31m?b \xc3\xa4");
  EXPECT_EQ(printable(std::string(5000, 'x')), std::string(2000, 'x') + "...");
}

TEST(Messages, TheFirstErrorIsTheCause)
{
  Messages::install();
  const vtkNew<Sayer> sayer;
  sayer->SayError("no such variable");
  sayer->SayError("the pipeline stopped");
  EXPECT_EQ(errorOf("a.nc"), "a.nc: no such variable");
  EXPECT_EQ(errorOf("a.nc"), "") << "it is taken";
  sayer->SayError("a.nc: says so itself");
  EXPECT_EQ(errorOf("a.nc"), "a.nc: says so itself");
}

TEST(Messages, WarningsComeOnce)
{
  Messages::install();
  const vtkNew<Sayer> sayer;
  sayer->SayWarning("odd");
  sayer->SayWarning("odd");
  EXPECT_EQ(Messages::takeWarnings(), std::vector<std::string>{ "odd" });
  EXPECT_TRUE(Messages::takeWarnings().empty());
  EXPECT_EQ(errorOf("a.nc"), "");
}
