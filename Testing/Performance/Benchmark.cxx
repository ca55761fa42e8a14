// SPDX-License-Identifier: BSD-3-Clause
#include "Benchmark.h"

#include "Worker.h"

#include <algorithm>
#include <cstdlib>

namespace nephoscope
{
namespace performance
{
namespace
{
std::vector<Method>& registered()
{
  static std::vector<Method> all;
  return all;
}

double quantile(std::vector<double> values, double q)
{
  if (values.empty())
  {
    return 0;
  }
  std::sort(values.begin(), values.end());
  const double place = q * (static_cast<double>(values.size()) - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

std::string reasonToLeaveOut(const Method& method, const Situation& situation)
{
  if (method.window && !haveDisplay())
  {
    return "needs an OpenGL window and there is no display; run under xvfb-run";
  }
  if (method.mostCells > 0 && situation.cells() > method.mostCells)
  {
    return "takes minutes a run beyond " + std::to_string(method.mostCells) + " cells";
  }
  return {};
}

/// One method's process and what it has told so far.
struct Entry
{
  Measurement measurement;
  std::unique_ptr<Worker> worker;
  double used = 0;

  bool running() const { return this->worker != nullptr; }
  bool wantsMore(const Effort& effort) const
  {
    return this->running() && static_cast<int>(this->measurement.seconds.size()) < effort.runs &&
      this->used < effort.seconds;
  }
  /// Sends a command; a process that fails is let go, with what it said as the reason.
  bool ask(Worker::Command command, Worker::Answer& answer)
  {
    answer = this->worker->ask(command);
    if (!answer.failure.empty())
    {
      this->measurement.leftOut = answer.failure;
      this->worker.reset();
    }
    return this->running();
  }
};

void start(Entry& entry)
{
  Measurement& m = entry.measurement;
  m.leftOut = reasonToLeaveOut(m.method, m.situation);
  if (!m.leftOut.empty())
  {
    return;
  }
  entry.worker = std::make_unique<Worker>(m.method, m.situation);
  Worker::Answer answer;
  if (entry.ask(Worker::Command::Prepare, answer))
  {
    m.prepareSeconds = answer.seconds;
    m.inputMemory = answer.memory;
  }
  if (entry.running() && entry.ask(Worker::Command::Run, answer))
  {
    m.firstSeconds = answer.seconds;
    m.peakMemory = answer.memory;
    entry.used = answer.seconds;
  }
}

void runOnce(Entry& entry)
{
  Worker::Answer answer;
  if (entry.ask(Worker::Command::Run, answer))
  {
    entry.measurement.seconds.push_back(answer.seconds);
    entry.measurement.peakMemory = answer.memory;
    entry.used += answer.seconds;
  }
}

void finish(Entry& entry, bool figures)
{
  ::getloadavg(&entry.measurement.load, 1);
  Worker::Answer answer;
  if (figures && entry.running() && entry.ask(Worker::Command::Figures, answer))
  {
    entry.measurement.figures = answer.figures;
  }
  entry.worker.reset();
}
}

std::string Method::label() const
{
  std::string text = this->name;
  for (const auto& setting : this->settings)
  {
    text += (text == this->name ? " (" : ", ") + setting.first + " " + setting.second;
  }
  return this->settings.empty() ? text : text + ")";
}

double Measurement::median() const
{
  return this->seconds.empty() ? this->firstSeconds : quantile(this->seconds, 0.5);
}

double Measurement::spread() const
{
  return (quantile(this->seconds, 0.75) - quantile(this->seconds, 0.25)) / 2;
}

const std::vector<Method>& methods()
{
  return registered();
}

Registration::Registration(Method method)
{
  registered().push_back(std::move(method));
}

bool haveDisplay()
{
  const char* const display = std::getenv("DISPLAY");
  return display && *display;
}

std::vector<Measurement> measure(const std::vector<Method>& wanted, const Situation& situation,
  const Effort& effort, const std::function<void(const std::string&)>& progress)
{
  const auto tell = [&progress](const std::string& what)
  {
    if (progress)
    {
      progress(what);
    }
  };
  std::vector<Entry> entries(wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    entries[i].measurement.method = wanted[i];
    entries[i].measurement.situation = situation;
    tell("first run: " + wanted[i].label());
    start(entries[i]);
  }
  for (int round = 0; round < effort.runs; ++round)
  {
    tell("round " + std::to_string(round + 1) + " of " + std::to_string(effort.runs));
    for (Entry& entry : entries)
    {
      if (entry.wantsMore(effort))
      {
        runOnce(entry);
      }
    }
  }
  std::vector<Measurement> result;
  for (Entry& entry : entries)
  {
    tell("figures: " + entry.measurement.method.label());
    finish(entry, effort.figures);
    result.push_back(entry.measurement);
  }
  return result;
}
}
}
