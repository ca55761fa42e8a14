// SPDX-License-Identifier: BSD-3-Clause
#include "Messages.h"

#include "Failure.h"

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include <algorithm>
#include <iostream>
#include <mutex>
#include <regex>
#include <utility>

namespace nephoscope::program
{
namespace
{
std::mutex guard;
std::vector<std::string> errors;
std::vector<std::string> warnings;

/// A remedy in the words of the classes, in those of the command line.
std::string asOptions(const std::string& message)
{
  static const std::pair<std::regex, const char*> words[] = {
    { std::regex("SetVariableName"), "--variable ROLE=NAME" },
    { std::regex("SetGeometryToMap or SetGeometryToGlobe"), "--geometry map or globe" },
    { std::regex("SetGeometryToLocal"), "--geometry local" },
  };
  std::string said = message;
  for (const auto& [pattern, option] : words)
  {
    said = std::regex_replace(said, pattern, option);
  }
  return said;
}

void collect(std::vector<std::string>& list, const char* text)
{
  const std::string message = asOptions(bareMessage(text ? text : ""));
  const std::lock_guard<std::mutex> lock(guard);
  if (std::find(list.begin(), list.end(), message) == list.end())
  {
    list.push_back(message);
  }
}

class Collector : public vtkOutputWindow
{
public:
  static Collector* New();
  vtkTypeMacro(Collector, vtkOutputWindow);

  void DisplayText(const char*) override {}
  void DisplayDebugText(const char*) override {}
  void DisplayErrorText(const char* text) override { collect(errors, text); }
  void DisplayWarningText(const char* text) override { collect(warnings, text); }
  void DisplayGenericWarningText(const char* text) override { collect(warnings, text); }
};
vtkStandardNewMacro(Collector);
}

void Messages::install()
{
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  const vtkNew<Collector> collector;
  vtkOutputWindow::SetInstance(collector);
}

void Messages::throwIfError(const std::string& subject)
{
  std::string first;
  {
    const std::lock_guard<std::mutex> lock(guard);
    if (errors.empty())
    {
      return;
    }
    first = errors.front();
    errors.clear();
  }
  // A reader's message names the file already.
  throw Failure(first.rfind(subject, 0) == 0 ? first : subject + ": " + first);
}

std::vector<std::string> Messages::takeWarnings()
{
  const std::lock_guard<std::mutex> lock(guard);
  std::vector<std::string> taken;
  taken.swap(warnings);
  return taken;
}

void Messages::printWarnings()
{
  for (const std::string& warning : takeWarnings())
  {
    note("warning: " + warning);
  }
}

std::string bareMessage(const std::string& text)
{
  static const std::regex place(
    "^\\s*(Generic )?(ERROR|Warning|Debug): In [^\n]*, line \\d+\n", std::regex::icase);
  static const std::regex object("^\\w+ \\((0x)?[0-9a-fA-F]+\\): ");
  static const std::regex breaks("\\s*\n\\s*");
  static const std::regex request(" returned failure for request: [^]*");
  std::string bare = std::regex_replace(text, place, "");
  bare = std::regex_replace(bare, object, "");
  bare = std::regex_replace(bare, request, " failed");
  bare = std::regex_replace(bare, breaks, " ");
  bare.erase(bare.find_last_not_of(' ') + 1);
  return bare;
}

std::string printable(const std::string& text)
{
  constexpr std::size_t Most = 2000;
  std::string line = text.substr(0, Most) + (text.size() > Most ? "..." : "");
  std::replace_if(
    line.begin(), line.end(), [](unsigned char c) { return c < ' ' || c == 127; }, '?');
  return line;
}

void note(const std::string& text)
{
  std::cerr << "nephoscope: " << printable(text) << '\n';
}
}
