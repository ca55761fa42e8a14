// SPDX-License-Identifier: BSD-3-Clause
#include "Frames.h"

#include "Failure.h"
#include "Messages.h"
#include "OutputFile.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <spawn.h>
#include <sstream>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

extern char** environ; // NOLINT(readability-redundant-declaration): POSIX leaves it to the program

namespace nephoscope::program
{
namespace
{
namespace fs = std::filesystem;

std::string contentsOf(const std::string& path)
{
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// ffmpeg's arguments, its own name first. Width and height have to be even for most players.
std::vector<std::string> movieCommand(
  const std::string& folder, double framesPerSecond, const std::string& movie)
{
  std::ostringstream rate;
  rate << framesPerSecond;
  return { "ffmpeg", "-loglevel", "error", "-y", "-framerate", rate.str(), "-i",
    folder + "/frame-%04d.png", "-vf", "crop=trunc(iw/2)*2:trunc(ih/2)*2", "-pix_fmt", "yuv420p",
    movie };
}

std::string lineOf(const std::vector<std::string>& words)
{
  std::string line;
  for (const std::string& word : words)
  {
    const bool plain = word.find_first_of(" ()'*%\"$") == std::string::npos;
    line += (line.empty() ? "" : " ") + (plain ? word : "'" + word + "'");
  }
  return line;
}

/// The exit code of a program that is found in PATH; 127 if there is none.
int runProgram(std::vector<std::string> words)
{
  std::vector<char*> arguments;
  for (std::string& word : words)
  {
    arguments.push_back(word.data());
  }
  arguments.push_back(nullptr);
  pid_t child = 0;
  if (posix_spawnp(&child, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0)
  {
    return 127;
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR)
  {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}
}

Frames::Frames(const std::string& folder, int number, const std::string& description)
  : Folder(folder)
  , Number(number)
  , Description(description)
{
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
  {
    throw Failure(folder + ": is not a folder; give another name");
  }
}

bool Frames::isBegun() const
{
  std::error_code error;
  return fs::exists(this->note(), error);
}

void Frames::begin() const
{
  std::error_code error;
  fs::create_directories(this->Folder, error);
  if (!fs::is_directory(this->Folder, error))
  {
    throw Failure(this->Folder + ": this folder cannot be made; give another name");
  }
  if (!this->isBegun())
  {
    writeText(this->note(), this->Description);
  }
  if (contentsOf(this->note()) != this->Description)
  {
    throw Failure(this->Folder +
      ": holds frames of another scene, size, number or time (see its animation.txt); give another "
      "folder, or remove it");
  }
}

std::string Frames::path(int frame) const
{
  char name[32];
  std::snprintf(name, sizeof(name), "/frame-%04d.png", frame);
  return this->Folder + name;
}

bool Frames::has(int frame) const
{
  std::error_code error;
  return fs::exists(this->path(frame), error);
}

int Frames::missing() const
{
  int missing = 0;
  for (int frame = 0; frame < this->Number; ++frame)
  {
    missing += this->has(frame) ? 0 : 1;
  }
  return missing;
}

FrameClaim::FrameClaim(const Frames& frames, int frame)
  : Lock(frames.folder() + "/.frame-" + std::to_string(frame) + ".lock")
{
  if (frames.has(frame))
  {
    return;
  }
  this->Descriptor = ::open(this->Lock.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644);
  if (this->Descriptor < 0)
  {
    throw Failure(this->Lock + ": cannot be written: " + std::strerror(errno));
  }
  // Whoever had the lock before may have finished the frame and removed the file's name.
  this->Locked = ::flock(this->Descriptor, LOCK_EX | LOCK_NB) == 0;
  this->Mine = this->Locked && !frames.has(frame);
}

FrameClaim::~FrameClaim()
{
  if (this->Locked)
  {
    ::unlink(this->Lock.c_str());
  }
  if (this->Descriptor >= 0)
  {
    ::close(this->Descriptor);
  }
}

void makeMovie(const Frames& frames, double framesPerSecond)
{
  const std::string movie = frames.folder() + "/movie.mp4";
  OutputFile file(movie);
  const int code = runProgram(movieCommand(frames.folder(), framesPerSecond, file.partial()));
  if (code == 127)
  {
    note("ffmpeg is not installed; with it, run: " +
      lineOf(movieCommand(frames.folder(), framesPerSecond, movie)));
    return;
  }
  if (code != 0)
  {
    throw Failure(movie + ": ffmpeg could not make it (exit code " + std::to_string(code) + ")");
  }
  file.commit();
}
}
