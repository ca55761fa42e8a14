// SPDX-License-Identifier: BSD-3-Clause
#include "OutputFile.h"

#include "Failure.h"

#include <algorithm>
#include <cctype>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>
#include <unistd.h>

namespace nephoscope::program
{
namespace
{
namespace fs = std::filesystem;

// All that a signal handler may touch.
volatile std::sig_atomic_t writing = 0;
volatile std::sig_atomic_t pending = 0;

[[noreturn]] void leave(int signal)
{
  const std::string_view text =
    ::isatty(STDERR_FILENO) ? "\r\033[Knephoscope: interrupted\n" : "nephoscope: interrupted\n";
  // Nothing can be done if standard error cannot be written.
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
  ::_exit(128 + signal);
}

extern "C" void onInterrupt(int signal)
{
  if (!writing)
  {
    leave(signal);
  }
  pending = signal;
}

/// The file that a path stands for: a link's target is replaced, not the link. @throw Failure if it cannot be written
fs::path targetOf(const std::string& path)
{
  std::error_code error;
  fs::path target = fs::weakly_canonical(fs::absolute(path), error);
  const fs::path folder = target.parent_path();
  if (error || !fs::is_directory(folder, error))
  {
    throw Failure(path + ": there is no folder " + fs::absolute(path).parent_path().string() +
      " to write into; create it first");
  }
  if (fs::exists(target, error) && !fs::is_regular_file(target, error))
  {
    throw Failure(path + ": is not a regular file; give the name of a file to write");
  }
  if (::access(folder.c_str(), W_OK) != 0)
  {
    throw Failure(path + ": the folder " + folder.string() + " cannot be written");
  }
  return target;
}
}

void checkWritable(const std::string& path, const std::vector<std::string>& others)
{
  const fs::path target = targetOf(path);
  for (const std::string& other : others)
  {
    std::error_code error;
    if (!other.empty() && fs::weakly_canonical(fs::absolute(other), error) == target)
    {
      throw UsageFailure(
        path + ": is a file that the command needs itself; give another name to write to");
    }
  }
}

OutputFile::OutputFile(const std::string& path)
{
  const fs::path target = targetOf(path);
  this->Path = target.string();
  // Not longer than the target's name, which may be as long as the file system allows.
  this->Partial = (target.parent_path() /
    (".nephoscope." + std::to_string(::getpid()) + target.extension().string()))
                    .string();
  writing = 1;
}

OutputFile::~OutputFile()
{
  std::error_code ignored;
  fs::remove(this->Partial, ignored);
  writing = 0;
  if (pending)
  {
    leave(pending);
  }
}

bool OutputFile::isInterrupted()
{
  return pending != 0;
}

void OutputFile::commit()
{
  if (pending)
  {
    return;
  }
  std::error_code error;
  fs::rename(this->Partial, this->Path, error);
  if (error)
  {
    throw Failure(this->Path + ": cannot be written: " + error.message());
  }
}

std::string extensionOf(const std::string& path)
{
  std::string extension = fs::path(path).extension().string();
  extension.erase(0, 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

void writeText(const std::string& path, const std::string& text)
{
  OutputFile file(path);
  std::ofstream stream(file.partial(), std::ios::binary);
  stream << text;
  stream.close();
  if (!stream)
  {
    throw Failure(path + ": cannot be written; is the disk full?");
  }
  file.commit();
}

void handleInterrupts()
{
  struct sigaction action = {};
  action.sa_handler = onInterrupt;
  for (const int signal : { SIGINT, SIGTERM, SIGHUP })
  {
    sigaction(signal, &action, nullptr);
  }
  action.sa_handler = SIG_IGN;
  sigaction(SIGXFSZ, &action, nullptr);
}
}
