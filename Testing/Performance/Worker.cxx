// SPDX-License-Identifier: BSD-3-Clause
#include "Worker.h"

#include "vtkObject.h"
#include "vtkSMPTools.h"

#include <chrono>
#include <csignal>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace nephoscope
{
namespace performance
{
namespace
{
/// A figure in bytes from /proc/self/status, 0 where there is no such file.
double statusBytes(const std::string& key)
{
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
  {
    if (word == key)
    {
      double kilobytes = 0;
      status >> kilobytes;
      return 1024 * kilobytes;
    }
  }
  return 0;
}

void forgetPeakMemory()
{
  std::ofstream("/proc/self/clear_refs") << "5";
}

double secondsOf(const std::function<void()>& work)
{
  const auto before = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
}

/// What the child does: answers commands until the pipe is closed.
class Servant
{
public:
  Servant(const Method& method, const Situation& situation)
    : M(method)
    , S(situation)
  {
  }

  nlohmann::json answer(char command)
  {
    nlohmann::json answer;
    switch (static_cast<Worker::Command>(command))
    {
      case Worker::Command::Prepare:
        vtkObject::
          GlobalWarningDisplayOff(); // peers have much to say; failures are told by figures
        vtkSMPTools::Initialize(this->S.threads);
        answer["seconds"] = secondsOf([this] { this->J = this->M.prepare(this->S); });
        answer["memory"] = statusBytes("VmRSS:");
        forgetPeakMemory();
        break;
      case Worker::Command::Run:
        answer["seconds"] = secondsOf([this] { this->J->run(); });
        answer["memory"] = statusBytes("VmHWM:");
        break;
      case Worker::Command::Figures:
        answer["figures"] = this->J->figures();
        break;
    }
    return answer;
  }

  [[noreturn]] void serve(int in, int out)
  {
    char command = 0;
    while (::read(in, &command, 1) == 1)
    {
      nlohmann::json reply;
      try
      {
        reply = this->answer(command);
      }
      catch (const std::exception& error)
      {
        reply["failure"] = error.what();
      }
      const std::string line = reply.dump() + "\n";
      if (::write(out, line.data(), line.size()) != static_cast<ssize_t>(line.size()))
      {
        break;
      }
    }
    ::_exit(0); // no destructors: they belong to the parent's objects
  }

private:
  const Method& M;
  const Situation& S;
  std::unique_ptr<Job> J;
};
}

Worker::Worker(const Method& method, const Situation& situation)
{
  int down[2];
  int up[2];
  if (::pipe(down) != 0 || ::pipe(up) != 0)
  {
    throw std::runtime_error("no pipe to a benchmark's process; close other programs");
  }
  this->Process = ::fork();
  if (this->Process == 0)
  {
    ::close(down[1]);
    ::close(up[0]);
    Servant(method, situation).serve(down[0], up[1]);
  }
  ::close(down[0]);
  ::close(up[1]);
  this->ToChild = down[1];
  this->FromChild = up[0];
}

Worker::~Worker()
{
  ::close(this->ToChild);
  ::close(this->FromChild);
  if (this->Process > 0)
  {
    ::kill(this->Process, SIGKILL); // it may hold the pipes of processes made after it
    ::waitpid(this->Process, nullptr, 0);
  }
}

std::string Worker::read()
{
  std::string line;
  for (char c = 0; ::read(this->FromChild, &c, 1) == 1 && c != '\n';)
  {
    line += c;
  }
  return line;
}

Worker::Answer Worker::ask(Command command)
{
  Answer answer;
  const char letter = static_cast<char>(command);
  const auto before = ::signal(SIGPIPE, SIG_IGN);
  const bool sent = this->Process > 0 && ::write(this->ToChild, &letter, 1) == 1;
  ::signal(SIGPIPE, before);
  const std::string line = sent ? this->read() : std::string();
  const nlohmann::json reply = nlohmann::json::parse(line, nullptr, false);
  if (!reply.is_object())
  {
    answer.failure = "its process ended before it answered";
    return answer;
  }
  answer.seconds = reply.value("seconds", 0.0);
  answer.memory = reply.value("memory", 0.0);
  answer.failure = reply.value("failure", std::string());
  if (reply.contains("figures"))
  {
    answer.figures = reply["figures"].get<performance::Figures>();
  }
  return answer;
}
}
}
